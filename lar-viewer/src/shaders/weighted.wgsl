// Transparency without storage buffers: layers are summed in any order, weighted by nearness, and what they let through
// is multiplied up. One layer comes out exact; of several the nearer count more (weighted blended order-independent
// transparency, McGuire and Bavoil, JCGT 2(2), 2013, with a weight for depths that are even in the scene).

struct Layer {
    @location(0) sum: vec4<f32>,       // colours times weights, and in alpha what is let through, by blending
    @location(1) weight: vec4<f32>,    // the weights
}

fn layer(color: vec4<f32>, position: vec4<f32>) -> Layer {
    let nearness = 1.0 - position.z;
    // At most 100, so that six hundred layers stay within 16-bit floats.
    let weight = color.a * clamp(100.0 * nearness * nearness * nearness, 0.01, 100.0);
    return Layer(vec4<f32>(weight * color.rgb, color.a), vec4<f32>(weight, 0.0, 0.0, color.a));
}
