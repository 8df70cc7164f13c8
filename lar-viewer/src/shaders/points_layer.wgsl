@fragment
fn point_layer(in: PointFragment) -> Layer {
    if length(in.place) > in.radius {
        discard;
    }
    return layer(in.color, in.position);
}
