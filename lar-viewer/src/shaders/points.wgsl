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
}

@vertex
fn point_vertex(@builtin(vertex_index) corner: u32, point: PointInstance) -> PointFragment {
    var out: PointFragment;
    let part = parts[point.part];
    let view = view_position(point.center, part.centroid);
    if view.z > -frame.near {
        out.position = NOWHERE;
        return out;
    }
    let radius = 0.5 * point.size * frame.samples_per_pixel;
    let center = screen_position(towards_eye(view, 2.0 * radius));
    let reach = radius + 1.0;
    let x = select(-reach, reach, (corner & 1u) == 1u);
    let y = select(-reach, reach, (corner & 2u) == 2u);
    out.place = vec2<f32>(x, y);
    out.position = vec4<f32>(center.xy + out.place / (0.5 * frame.viewport), center.z, 1.0);
    out.radius = radius;
    out.color = part.color;
    return out;
}

@fragment
fn point_opaque(in: PointFragment) -> Opaque {
    if length(in.place) > in.radius {
        discard;
    }
    return opaque(in.color, in.position);
}

@fragment
fn point_layer(in: PointFragment) -> @location(0) vec4<f32> {
    if length(in.place) <= in.radius {
        store_layer(in.color, in.position);
    }
    return vec4<f32>(0.0);
}
