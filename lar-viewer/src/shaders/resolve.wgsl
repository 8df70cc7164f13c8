// Blends the layers of a sample over its opaque colour, nearest first.
//
// The list is in order of arrival, which differs from run to run. It is read repeatedly, each time taking the next
// CHUNK layers in order of depth, so any number of layers is blended exactly. Layers of equal depth go by colour, so
// the result does not depend on the order of drawing.

const CHUNK: u32 = 16u;
const OPAQUE_ENOUGH: f32 = 0.002;   // half a step of 8 bits

fn precedes(a: vec3<u32>, b: vec3<u32>) -> bool {
    if a.x != b.x {
        return a.x < b.x;
    }
    if a.y != b.y {
        return a.y < b.y;
    }
    return a.z < b.z;
}

@fragment
fn resolve(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let first = atomicLoad(&heads[head_index(position)]);
    var chunk: array<vec3<u32>, 16>;
    var last = vec3<u32>(0u);
    var blended = vec3<f32>(0.0);
    var through = 1.0;
    loop {
        var count = 0u;
        var link = first;
        while link != 0u {
            let node = nodes[link - 1u];
            let layer = vec3<u32>(node.depth, node.color, link);
            if precedes(last, layer) && (count < CHUNK || precedes(layer, chunk[CHUNK - 1u])) {
                var at = min(count, CHUNK - 1u);
                while at > 0u {
                    if !precedes(layer, chunk[at - 1u]) {
                        break;
                    }
                    chunk[at] = chunk[at - 1u];
                    at -= 1u;
                }
                chunk[at] = layer;
                count = min(count + 1u, CHUNK);
            }
            link = node.next;
        }
        for (var i = 0u; i < count; i++) {
            let color = unpack4x8unorm(chunk[i].y);
            blended += through * color.a * color.rgb;
            through *= 1.0 - color.a;
        }
        if count < CHUNK || through < OPAQUE_ENOUGH {
            break;
        }
        last = chunk[CHUNK - 1u];
    }
    return vec4<f32>(blended, 1.0 - through);
}
