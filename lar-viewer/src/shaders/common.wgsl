// What every shader shares: the parameters of a frame, the parts, light, and the way from scene to screen.

struct Frame {
    view_from_scene: mat4x4<f32>,
    clip_from_view: mat4x4<f32>,
    explode: array<vec4<f32>, 4>,   // factor − 1 per axis, for each level of groups
    about: vec3<f32>,               // fixed point of the explosion
    opacity: f32,                   // multiplies the opacity of meshes
    cut: vec4<f32>,                 // n, d of the clip plane: n · p > d is cut away
    viewport: vec2<f32>,            // size in samples
    samples_per_pixel: f32,         // samples along one side of a pixel of line width
    sample_size: f32,               // length of one sample in view space: at depth 1, or anywhere when orthographic
    near: f32,
    perspective: u32,
    hide_edges: u32,
    supersample: u32,               // samples along one side of a pixel of the picture
    band_row: u32,                  // first row of samples of the band whose layers are being stored
    band: u32,
    node_capacity: u32,
    cut_groups: u32,                // the clip plane takes or leaves groups whole
    first_part: u32,                // number of the scene's first part among those of all scenes of the frame
    outlined_level: u32,            // level of the groups that are outlined, or WHOLE
    outline_reach: f32,             // half the width of outlines, in samples
    padding: u32,
    outline_color: vec4<f32>,
}

// What the triangles, segments or dots of a drawable have in common.
struct Part {
    color: vec4<f32>,
    flags: u32,
    group: u32,
}

const LIT: u32 = 1u;
const CELL_EDGE: u32 = 2u;
const HIGHLIGHTED: u32 = 4u;
const CLIPPED: u32 = 8u;
const NO_GROUP: u32 = 0xffffffffu;
const WHOLE: u32 = 0xffffffffu;
const NOWHERE: vec4<f32> = vec4<f32>(0.0, 0.0, 2.0, 1.0);
const TABLE_WIDTH: u32 = 2048u;

// Which elements a pass draws.
const OPAQUE_WAY: u32 = 0u;
const LAYER_WAY: u32 = 1u;
const ID_WAY: u32 = 2u;

@group(0) @binding(0) var<uniform> frame: Frame;
// Tables in textures, since not every adapter reads storage buffers in vertex shaders. Two texels a part: the bits of its
// colour; flags and group. Four texels a group, one a level: the bits of its centroid relative to the centre, then relative
// to the centroid of the group around it; and the number of the group around it at that level, or its own beyond its level.
@group(0) @binding(1) var parts: texture_2d<u32>;
@group(0) @binding(2) var groups: texture_2d<u32>;

struct Opaque {
    @location(0) color: vec4<f32>,
    @location(1) depth: u32,   // the bits of a number in 0..=1, which order as the number does
}

fn opaque(color: vec4<f32>, position: vec4<f32>) -> Opaque {
    return Opaque(vec4<f32>(color.rgb, 1.0), bitcast<u32>(position.z));
}

fn place_in_table(index: u32) -> vec2<u32> {
    return vec2<u32>(index % TABLE_WIDTH, index / TABLE_WIDTH);
}

fn part_at(index: u32) -> Part {
    let color = textureLoad(parts, place_in_table(2u * index), 0);
    let rest = textureLoad(parts, place_in_table(2u * index + 1u), 0);
    return Part(bitcast<vec4<f32>>(color), rest.x, rest.y);
}

fn group_offset(group: u32, level: u32) -> vec3<f32> {
    return bitcast<vec4<f32>>(textureLoad(groups, place_in_table(4u * group + level), 0)).xyz;
}

// What a group is outlined as: a number above 0.
fn outlined(group: u32) -> u32 {
    if group == NO_GROUP || frame.outlined_level == WHOLE {
        return 1u;
    }
    return 2u + textureLoad(groups, place_in_table(4u * group + frame.outlined_level), 0).w;
}

// How far a group moves in the exploded scene.
fn displacement(group: u32) -> vec3<f32> {
    if group == NO_GROUP {
        return vec3<f32>(0.0);
    }
    var moved = frame.explode[0].xyz * (group_offset(group, 0u) - frame.about);
    for (var level = 1u; level < 4u; level++) {
        moved += frame.explode[level].xyz * group_offset(group, level);
    }
    return moved;
}

fn centroid(group: u32) -> vec3<f32> {
    return group_offset(group, 0u) + group_offset(group, 1u) + group_offset(group, 2u) + group_offset(group, 3u);
}

// Height of a point of the scene over the clip plane; below 0 where nothing cuts.
fn height_over_cut(position: vec3<f32>, part: Part) -> f32 {
    let by_group = frame.cut_groups == 1u && part.group != NO_GROUP;
    let height = dot(frame.cut.xyz, position) - frame.cut.w;
    return select(height, -1.0, (part.flags & CLIPPED) == 0u || by_group);
}

// Whether the pass draws a part of this opacity.
fn is_drawn(part: Part, alpha: f32, way: u32) -> bool {
    let in_pass = select(0.0 < alpha && (way == ID_WAY || alpha < 1.0), 1.0 <= alpha, way == OPAQUE_WAY);
    let hidden = (part.flags & CELL_EDGE) != 0u && frame.hide_edges == 1u;
    if !in_pass || hidden {
        return false;
    }
    if frame.cut_groups == 1u && (part.flags & CLIPPED) != 0u && part.group != NO_GROUP {
        return dot(frame.cut.xyz, centroid(part.group)) <= frame.cut.w;
    }
    return true;
}

// A position of the exploded scene in camera axes.
fn view_position(exploded: vec3<f32>) -> vec3<f32> {
    return (frame.view_from_scene * vec4<f32>(exploded, 1.0)).xyz;
}

// The same point on the screen, nearer to the eye by the length that `samples` samples show there.
fn towards_eye(view: vec3<f32>, samples: f32) -> vec3<f32> {
    if frame.perspective == 1u {
        return view * (1.0 - min(0.5, samples * frame.sample_size));
    }
    return view + vec3<f32>(0.0, 0.0, samples * frame.sample_size);
}

// Divided by w: clipping is done, and what is interpolated then is linear on the screen.
fn screen_position(view: vec3<f32>) -> vec3<f32> {
    let clip = frame.clip_from_view * vec4<f32>(view, 1.0);
    return clip.xyz / clip.w;
}

// Flat two-sided light: from the eye, and from above left; colours are sRGB values and stay so.
fn shaded(color: vec3<f32>, normal: vec3<f32>, view: vec3<f32>) -> vec3<f32> {
    let eye = select(vec3<f32>(0.0, 0.0, 1.0), -normalize(view), frame.perspective == 1u);
    let facing = dot(normal, eye);
    let outward = select(normal, -normal, facing < 0.0);
    let key = max(0.0, dot(outward, vec3<f32>(-0.42, 0.80, 0.43)));
    return color * min(1.0, 0.64 + 0.27 * abs(facing) + 0.27 * key);
}
