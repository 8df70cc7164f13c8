// Triangles with one normal each.

struct MeshVertex {
    @location(0) position: vec3<f32>,
    @location(1) part: u32,
    @location(2) normal: vec4<f32>,
}

struct MeshFragment {
    @builtin(position) position: vec4<f32>,
    @location(0) view: vec3<f32>,
    @location(1) @interpolate(flat) normal: vec3<f32>,
    @location(2) @interpolate(flat) color: vec4<f32>,
    @location(3) @interpolate(flat) flags: u32,
}

@vertex
fn mesh_vertex(vertex: MeshVertex) -> MeshFragment {
    let part = parts[vertex.part];
    let view = view_position(vertex.position, part.centroid);
    var out: MeshFragment;
    out.position = frame.clip_from_view * vec4<f32>(view, 1.0);
    out.view = view;
    out.normal = (frame.view_from_scene * vec4<f32>(vertex.normal.xyz, 0.0)).xyz;
    out.color = vec4<f32>(part.color.rgb, part.color.a * frame.opacity);
    out.flags = part.flags;
    return out;
}

fn mesh_color(in: MeshFragment) -> vec4<f32> {
    if (in.flags & LIT) == 0u {
        return in.color;
    }
    return vec4<f32>(shaded(in.color.rgb, normalize(in.normal), in.view), in.color.a);
}

@fragment
fn mesh_opaque(in: MeshFragment) -> Opaque {
    return opaque(mesh_color(in), in.position);
}

@fragment
fn mesh_layer(in: MeshFragment) -> @location(0) vec4<f32> {
    store_layer(mesh_color(in), in.position);
    return vec4<f32>(0.0);
}
