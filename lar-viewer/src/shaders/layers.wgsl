// The A-buffer: for each sample a linked list of the transparent layers in front of the opaque surface.

struct Node {
    color: u32,
    depth: u32,     // as in Opaque
    next: u32,      // index of the next node plus one; 0 ends the list
}

@group(1) @binding(0) var<storage, read_write> heads: array<atomic<u32>>;
@group(1) @binding(1) var<storage, read_write> nodes: array<Node>;
@group(1) @binding(2) var<storage, read_write> node_counts: array<atomic<u32>>;
@group(1) @binding(3) var opaque_depth: texture_2d<u32>;

fn head_index(position: vec4<f32>) -> u32 {
    let sample = vec2<u32>(position.xy);
    return (sample.y - frame.band_row) * u32(frame.viewport.x) + sample.x;
}
