@fragment
fn label_layer(in: StrokeFragment) -> Layer {
    if !is_on_stroke(in) {
        discard;
    }
    return layer(in.color, in.position);
}
