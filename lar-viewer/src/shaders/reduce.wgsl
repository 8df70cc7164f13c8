// From samples to pixels: the mean of a square block.

@group(1) @binding(0) var samples: texture_2d<f32>;

@vertex
fn whole_screen(@builtin(vertex_index) corner: u32) -> @builtin(position) vec4<f32> {
    let x = select(-1.0, 3.0, corner == 1u);
    let y = select(-1.0, 3.0, corner == 2u);
    return vec4<f32>(x, y, 0.0, 1.0);
}

@fragment
fn reduce(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let side = i32(frame.supersample);
    let corner = vec2<i32>(position.xy) * side;
    var sum = vec4<f32>(0.0);
    for (var y = 0; y < side; y++) {
        for (var x = 0; x < side; x++) {
            sum += textureLoad(samples, corner + vec2<i32>(x, y), 0);
        }
    }
    return sum / f32(side * side);
}
