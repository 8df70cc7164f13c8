// From samples to pixels: the mean of a square block.

@group(1) @binding(0) var samples: texture_2d<f32>;

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
