// What every shader shares: the parameters of a frame, the parts, light, and the way from scene to screen.

struct Frame {
    view_from_scene: mat4x4<f32>,
    clip_from_view: mat4x4<f32>,
    explode: vec3<f32>,          // factor − 1, per axis
    opacity: f32,                // multiplies the opacity of meshes
    viewport: vec2<f32>,         // size in samples
    samples_per_pixel: f32,      // samples along one side of a pixel of line width
    sample_size: f32,            // length of one sample in view space: at depth 1, or anywhere when orthographic
    near: f32,
    perspective: u32,
    hide_edges: u32,
    supersample: u32,            // samples along one side of a pixel of the picture
    band_row: u32,               // first row of samples of the band whose layers are being stored
    band: u32,
    node_capacity: u32,
    padding: u32,
}

struct Part {
    color: vec4<f32>,
    centroid: vec3<f32>,
    flags: u32,
}

const LIT: u32 = 1u;
const CELL_EDGE: u32 = 2u;
const NOWHERE: vec4<f32> = vec4<f32>(0.0, 0.0, 2.0, 1.0);

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> parts: array<Part>;

struct Opaque {
    @location(0) color: vec4<f32>,
    @location(1) depth: u32,   // the bits of a number in 0..=1, which order as the number does
}

fn opaque(color: vec4<f32>, position: vec4<f32>) -> Opaque {
    return Opaque(vec4<f32>(color.rgb, 1.0), bitcast<u32>(position.z));
}

// The exploded position in camera axes.
fn view_position(position: vec3<f32>, centroid: vec3<f32>) -> vec3<f32> {
    return (frame.view_from_scene * vec4<f32>(position + frame.explode * centroid, 1.0)).xyz;
}

// The same point on the screen, nearer to the eye by the length that `samples` samples show there.
fn towards_eye(view: vec3<f32>, samples: f32) -> vec3<f32> {
    if frame.perspective == 1u {
        return view * (1.0 - min(0.5, samples * frame.sample_size));
    }
    return view + vec3<f32>(0.0, 0.0, samples * frame.sample_size);
}

fn is_hidden(flags: u32) -> bool {
    return (flags & CELL_EDGE) != 0u && frame.hide_edges == 1u;
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
