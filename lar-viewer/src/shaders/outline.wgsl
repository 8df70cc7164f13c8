// Outlines: ink where the solids of a sample and of one of eight others around it differ.

@group(1) @binding(0) var solids: texture_2d<u32>;

fn solid_at(at: vec2<i32>) -> u32 {
    return textureLoad(solids, clamp(at, vec2<i32>(0), vec2<i32>(frame.viewport) - 1), 0).r;
}

@fragment
fn outline(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let at = vec2<i32>(position.xy);
    let own = solid_at(at);
    let straight = i32(round(frame.outline_reach));
    let slanted = i32(round(0.7071 * frame.outline_reach));
    var directions = array<vec2<i32>, 8>(
        vec2<i32>(straight, 0), vec2<i32>(-straight, 0), vec2<i32>(0, straight), vec2<i32>(0, -straight),
        vec2<i32>(slanted, slanted), vec2<i32>(-slanted, slanted), vec2<i32>(slanted, -slanted), vec2<i32>(-slanted, -slanted),
    );
    for (var i = 0u; i < 8u; i++) {
        if solid_at(at + directions[i]) != own {
            return frame.outline_color;
        }
    }
    discard;
}
