@fragment
fn line_layer(in: LineFragment) -> Layer {
    if !is_on_line(in) {
        discard;
    }
    return layer(in.color, in.position);
}
