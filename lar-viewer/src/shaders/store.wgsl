// Layers are counted even when there is no room for them, so that the count says how much room is needed.

struct Layer {
    @location(0) nothing: vec4<f32>,    // not written: what counts is in the lists
}

fn layer(color: vec4<f32>, position: vec4<f32>) -> Layer {
    let depth = bitcast<u32>(position.z);
    if depth <= textureLoad(opaque_depth, vec2<i32>(position.xy), 0).r {
        let node = atomicAdd(&node_counts[frame.band], 1u);
        if node < frame.node_capacity {
            let next = atomicExchange(&heads[head_index(position)], node + 1u);
            nodes[node] = Node(pack4x8unorm(color), depth, next);
        }
    }
    return Layer(vec4<f32>(0.0));
}
