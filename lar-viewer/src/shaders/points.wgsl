// Points as round dots of constant size on the screen, in front of the lines that end in them.

struct PointInstance {
    @location(0) center: vec3<f32>,
    @location(1) part: u32,
    @location(2) size: f32,
}

struct PointFragment {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec2<f32>,                  // samples from the centre
    @location(1) @interpolate(flat) radius: f32,
    @location(2) @interpolate(flat) color: vec4<f32>,
    @location(3) @interpolate(flat) id: vec2<u32>,  // part + 1, dot
}

fn point_vertex(corner: u32, index: u32, point: PointInstance, way: u32) -> PointFragment {
    var out: PointFragment;
    out.position = NOWHERE;
    let part = part_at(point.part);
    if !is_drawn(part, part.color.a, way) || height_over_cut(point.center, part) > 0.0 {
        return out;
    }
    let view = view_position(point.center + displacement(part.group));
    if view.z > -frame.near {
        return out;
    }
    let larger = select(1.0, 1.6, (part.flags & HIGHLIGHTED) != 0u);
    let radius = 0.5 * larger * point.size * frame.samples_per_pixel;
    let center = screen_position(towards_eye(view, 2.0 * radius));
    let reach = radius + 1.0;
    let x = select(-reach, reach, (corner & 1u) == 1u);
    let y = select(-reach, reach, (corner & 2u) == 2u);
    out.place = vec2<f32>(x, y);
    out.position = vec4<f32>(center.xy + out.place / (0.5 * frame.viewport), center.z, 1.0);
    out.radius = radius;
    out.color = part.color;
    out.id = vec2<u32>(frame.first_part + point.part + 1u, index);
    return out;
}

@vertex
fn point_opaque_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    point: PointInstance,
) -> PointFragment {
    return point_vertex(corner, index, point, OPAQUE_WAY);
}

@vertex
fn point_layer_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    point: PointInstance,
) -> PointFragment {
    return point_vertex(corner, index, point, LAYER_WAY);
}

@vertex
fn point_id_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    point: PointInstance,
) -> PointFragment {
    return point_vertex(corner, index, point, ID_WAY);
}

@fragment
fn point_opaque(in: PointFragment) -> Opaque {
    if length(in.place) > in.radius {
        discard;
    }
    return opaque(in.color, in.position);
}

@fragment
fn point_id(in: PointFragment) -> @location(0) vec2<u32> {
    if length(in.place) > in.radius {
        discard;
    }
    return in.id;
}

