// The weighted mean of the layers of a sample over its opaque colour.

@group(1) @binding(0) var sums: texture_2d<f32>;
@group(1) @binding(1) var weights: texture_2d<f32>;

@vertex
fn whole_screen(@builtin(vertex_index) corner: u32) -> @builtin(position) vec4<f32> {
    let x = select(-1.0, 3.0, corner == 1u);
    let y = select(-1.0, 3.0, corner == 2u);
    return vec4<f32>(x, y, 0.0, 1.0);
}

@fragment
fn compose(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let sum = textureLoad(sums, vec2<i32>(position.xy), 0);
    let weight = textureLoad(weights, vec2<i32>(position.xy), 0).r;
    let covered = 1.0 - sum.a;
    return vec4<f32>(covered * sum.rgb / max(weight, 1e-4), covered);
}
