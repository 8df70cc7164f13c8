// Strokes of labels: segments of constant size and width on the screen, all of a label at the depth of its anchor. Each
// has a core and, a little farther away, a wider rim in a contrasting shade, so that strokes that meet show their cores.

struct StrokeInstance {
    @location(0) anchor: vec3<f32>,
    @location(1) part: u32,
    @location(2) ends: vec4<i32>,       // in 1/16 pixel from the anchor, y up
    @location(3) width: f32,            // in pixels; negative: over everything
}

struct StrokeFragment {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec2<f32>,                         // samples along the stroke from its start, and across
    @location(1) @interpolate(flat) extent: vec2<f32>,     // its length and half its width, in samples
    @location(2) @interpolate(flat) color: vec4<f32>,
    @location(3) @interpolate(flat) id: vec2<u32>,         // part + 1, stroke
}

const UNITS: f32 = 16.0;
const RIM: f32 = 1.4;                   // width of the rim in pixels
const RIM_DEPTH: f32 = 1e-6;            // how much farther it is, as a difference of depths
const ON_TOP: f32 = 1e-3;               // depths are pressed into this part of the range
const TOWARDS_EYE: f32 = 6.0;           // pixels by which labels lie before their anchors

fn label_vertex(corner: u32, index: u32, stroke: StrokeInstance, way: u32) -> StrokeFragment {
    var out: StrokeFragment;
    out.position = NOWHERE;
    let part = part_at(stroke.part);
    let is_core = corner < 6u;
    if !is_drawn(part, part.color.a, way) || height_over_cut(stroke.anchor, part) > 0.0 || (way == LAYER_WAY && !is_core) {
        return out;
    }
    let view = view_position(stroke.anchor + displacement(part.group));
    if view.z > -frame.near {
        return out;
    }
    let pixel = frame.samples_per_pixel;
    let anchor = screen_position(towards_eye(view, TOWARDS_EYE * pixel));
    let a = vec2<f32>(stroke.ends.xy) * pixel / UNITS;
    let span = vec2<f32>(stroke.ends.zw) * pixel / UNITS - a;
    let length = length(span);
    let along = select(vec2<f32>(1.0, 0.0), span / max(length, 1e-6), length > 1e-6);
    let half_width = 0.5 * abs(stroke.width) * pixel + select(RIM * pixel, 0.0, is_core);
    let reach = half_width + 1.0;
    // The corners of two triangles: 0 1 2, 2 1 3, each 2 · (across) + (at the end).
    let c = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u)[corner % 6u];
    let at_end = (c & 1u) == 1u;
    let out_along = select(-reach, length + reach, at_end);
    let out_across = select(-reach, reach, (c & 2u) == 2u);
    let offset = a + along * out_along + vec2<f32>(-along.y, along.x) * out_across;
    let depth = select(anchor.z, ON_TOP * anchor.z, stroke.width < 0.0) + select(RIM_DEPTH, 0.0, is_core);
    out.position = vec4<f32>(anchor.xy + offset / (0.5 * frame.viewport), depth, 1.0);
    out.place = vec2<f32>(out_along, out_across);
    out.extent = vec2<f32>(length, half_width);
    let luminance = dot(part.color.rgb, vec3<f32>(0.299, 0.587, 0.114));
    let rim = vec3<f32>(select(0.97, 0.10, luminance > 0.45));
    out.color = vec4<f32>(select(rim, part.color.rgb, is_core), part.color.a);
    out.id = vec2<u32>(frame.first_part + stroke.part + 1u, index);
    return out;
}

@vertex
fn label_opaque_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    stroke: StrokeInstance,
) -> StrokeFragment {
    return label_vertex(corner, index, stroke, OPAQUE_WAY);
}

@vertex
fn label_layer_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    stroke: StrokeInstance,
) -> StrokeFragment {
    return label_vertex(corner, index, stroke, LAYER_WAY);
}

@vertex
fn label_id_vertex(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) index: u32,
    stroke: StrokeInstance,
) -> StrokeFragment {
    return label_vertex(corner, index, stroke, ID_WAY);
}

fn is_on_stroke(in: StrokeFragment) -> bool {
    let beyond = max(max(-in.place.x, in.place.x - in.extent.x), 0.0);
    return length(vec2<f32>(beyond, in.place.y)) <= in.extent.y;
}

@fragment
fn label_opaque(in: StrokeFragment) -> Opaque {
    if !is_on_stroke(in) {
        discard;
    }
    return opaque(in.color, in.position);
}

@fragment
fn label_id(in: StrokeFragment) -> @location(0) vec2<u32> {
    if !is_on_stroke(in) {
        discard;
    }
    return in.id;
}

