// Segments as quads of constant width on the screen with round ends. They are drawn a little nearer to the eye than
// they are, by as much as their width, so that the faces they bound do not cover half of them. Edges of cells so small
// on the screen that their edges would cover them are drawn thinner.

struct LineInstance {
    @location(0) start: vec3<f32>,
    @location(1) part: u32,
    @location(2) end: vec3<f32>,
    @location(3) width: f32,
    @location(4) most: f32,     // most that the width may be, as a length in the scene
}

struct LineFragment {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec2<f32>,                         // samples along the segment from its start, and across
    @location(1) @interpolate(flat) extent: vec2<f32>,     // its length and half its width, in samples
    @location(2) @interpolate(flat) color: vec4<f32>,
    @location(3) @interpolate(flat) id: vec2<u32>,         // part + 1, segment
}

// The end moved along the segment to the near plane when it lies behind it.
fn clipped(end: vec3<f32>, other: vec3<f32>) -> vec3<f32> {
    let plane = -frame.near;
    if end.z <= plane {
        return end;
    }
    return mix(end, other, (plane - end.z) / (other.z - end.z));
}

// The end moved along the segment to the clip plane when it is cut away; heights are over that plane.
fn cut(end: vec3<f32>, other: vec3<f32>, height: f32, other_height: f32) -> vec3<f32> {
    if height <= 0.0 {
        return end;
    }
    return mix(end, other, height / (height - other_height));
}

fn line_vertex(corner: u32, index: u32, line: LineInstance, way: u32) -> LineFragment {
    var out: LineFragment;
    out.position = NOWHERE;
    let part = part_at(line.part);
    let heights = vec2<f32>(height_over_cut(line.start, part), height_over_cut(line.end, part));
    if !is_drawn(part, part.color.a, way) || min(heights.x, heights.y) > 0.0 {
        return out;
    }
    let moved = displacement(part.group);
    let start = view_position(cut(line.start, line.end, heights.x, heights.y) + moved);
    let end = view_position(cut(line.end, line.start, heights.y, heights.x) + moved);
    if min(start.z, end.z) > -frame.near {
        return out;
    }
    let sample = frame.sample_size * select(1.0, -0.5 * (start.z + end.z), frame.perspective == 1u);
    let most = line.most / max(abs(sample), 1e-20);
    let wider = select(1.0, 2.0, (part.flags & HIGHLIGHTED) != 0u);
    let half_width = 0.5 * wider * min(line.width * frame.samples_per_pixel, most);
    let bias = 2.0 * half_width;
    let a = screen_position(towards_eye(clipped(start, end), bias));
    let b = screen_position(towards_eye(clipped(end, start), bias));
    let half_view = 0.5 * frame.viewport;
    let span = (b.xy - a.xy) * half_view;
    let length = length(span);
    let along = select(vec2<f32>(1.0, 0.0), span / max(length, 1e-6), length > 1e-6);
    let across = vec2<f32>(-along.y, along.x);
    let at_end = (corner & 1u) == 1u;
    let reach = half_width + 1.0;
    let out_along = select(-reach, reach, at_end);
    let out_across = select(-reach, reach, (corner & 2u) == 2u);
    let base = select(a, b, at_end);
    let offset = (along * out_along + across * out_across) / half_view;
    out.position = vec4<f32>(base.xy + offset, base.z, 1.0);
    out.place = vec2<f32>(out_along + select(0.0, length, at_end), out_across);
    out.extent = vec2<f32>(length, half_width);
    out.color = part.color;
    out.id = vec2<u32>(frame.first_part + line.part + 1u, index);
    return out;
}

@vertex
fn line_opaque_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    line: LineInstance,
) -> LineFragment {
    return line_vertex(corner, index, line, OPAQUE_WAY);
}

@vertex
fn line_layer_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    line: LineInstance,
) -> LineFragment {
    return line_vertex(corner, index, line, LAYER_WAY);
}

@vertex
fn line_id_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    line: LineInstance,
) -> LineFragment {
    return line_vertex(corner, index, line, ID_WAY);
}

fn is_on_line(in: LineFragment) -> bool {
    let beyond = max(max(-in.place.x, in.place.x - in.extent.x), 0.0);
    return length(vec2<f32>(beyond, in.place.y)) <= in.extent.y;
}

@fragment
fn line_opaque(in: LineFragment) -> Opaque {
    if !is_on_line(in) {
        discard;
    }
    return opaque(in.color, in.position);
}

@fragment
fn line_id(in: LineFragment) -> @location(0) vec2<u32> {
    if !is_on_line(in) {
        discard;
    }
    return in.id;
}

