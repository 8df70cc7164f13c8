@fragment
fn mesh_layer(in: MeshFragment) -> Layer {
    if in.height > 0.0 {
        discard;
    }
    return layer(mesh_color(in), in.position);
}
