// Triangles with one normal each.

struct MeshVertex {
    @location(0) position: vec3<f32>,
    @location(1) part: u32,
    @location(2) normal: vec4<f32>,
}

struct MeshFragment {
    @builtin(position) position: vec4<f32>,
    @location(0) view: vec3<f32>,
    @location(1) height: f32,                              // over the clip plane
    @location(2) @interpolate(flat) normal: vec3<f32>,
    @location(3) @interpolate(flat) color: vec4<f32>,
    @location(4) @interpolate(flat) lit: u32,
    @location(5) @interpolate(flat) id: vec2<u32>,         // part + 1, triangle
    @location(6) @interpolate(flat) solid: u32,            // what it is outlined as
}

fn mesh_vertex(vertex: MeshVertex, index: u32, way: u32) -> MeshFragment {
    var out: MeshFragment;
    let part = part_at(vertex.part);
    let dimming = select(frame.opacity, 1.0, (part.flags & HIGHLIGHTED) != 0u);
    out.color = vec4<f32>(part.color.rgb, part.color.a * dimming);
    if !is_drawn(part, out.color.a, way) {
        out.position = NOWHERE;
        return out;
    }
    let view = view_position(vertex.position + displacement(part.group));
    out.position = frame.clip_from_view * vec4<f32>(view, 1.0);
    out.view = view;
    out.height = height_over_cut(vertex.position, part);
    out.normal = (frame.view_from_scene * vec4<f32>(vertex.normal.xyz, 0.0)).xyz;
    out.lit = part.flags & LIT;
    out.id = vec2<u32>(frame.first_part + vertex.part + 1u, index / 3u);
    return out;
}

@vertex
fn mesh_opaque_vertex(@builtin(vertex_index) index: u32, vertex: MeshVertex) -> MeshFragment {
    return mesh_vertex(vertex, index, OPAQUE_WAY);
}

@vertex
fn mesh_layer_vertex(@builtin(vertex_index) index: u32, vertex: MeshVertex) -> MeshFragment {
    return mesh_vertex(vertex, index, LAYER_WAY);
}

@vertex
fn mesh_id_vertex(@builtin(vertex_index) index: u32, vertex: MeshVertex) -> MeshFragment {
    return mesh_vertex(vertex, index, ID_WAY);
}

@vertex
fn mesh_solid_vertex(@builtin(vertex_index) index: u32, vertex: MeshVertex) -> MeshFragment {
    var out = mesh_vertex(vertex, index, ID_WAY);
    out.solid = outlined(part_at(vertex.part).group);
    return out;
}

fn mesh_color(in: MeshFragment) -> vec4<f32> {
    if in.lit == 0u {
        return in.color;
    }
    return vec4<f32>(shaded(in.color.rgb, normalize(in.normal), in.view), in.color.a);
}

@fragment
fn mesh_opaque(in: MeshFragment) -> Opaque {
    if in.height > 0.0 {
        discard;
    }
    return opaque(mesh_color(in), in.position);
}

@fragment
fn mesh_solid(in: MeshFragment) -> @location(0) u32 {
    if in.height > 0.0 {
        discard;
    }
    return in.solid;
}

@fragment
fn mesh_id(in: MeshFragment) -> @location(0) vec2<u32> {
    if in.height > 0.0 {
        discard;
    }
    return in.id;
}

