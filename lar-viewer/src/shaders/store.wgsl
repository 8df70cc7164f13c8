// Layers are counted even when there is no room for them, so that the count says how much room is needed.

fn store_layer(color: vec4<f32>, position: vec4<f32>) {
    let depth = bitcast<u32>(position.z);
    if depth > textureLoad(opaque_depth, vec2<i32>(position.xy), 0).r {
        return;
    }
    let node = atomicAdd(&node_counts[frame.band], 1u);
    if node >= frame.node_capacity {
        return;
    }
    let next = atomicExchange(&heads[head_index(position)], node + 1u);
    nodes[node] = Node(pack4x8unorm(color), depth, next);
}
