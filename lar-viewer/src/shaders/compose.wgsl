// The weighted mean of the layers of a sample over its opaque colour.

@group(1) @binding(0) var sums: texture_2d<f32>;
@group(1) @binding(1) var weights: texture_2d<f32>;

@fragment
fn compose(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let sum = textureLoad(sums, vec2<i32>(position.xy), 0);
    let weight = textureLoad(weights, vec2<i32>(position.xy), 0).r;
    let covered = 1.0 - sum.a;
    return vec4<f32>(covered * sum.rgb / max(weight, 1e-4), covered);
}
