// Three panels side by side: the chosen method, the exact law, their difference magnified.

struct Show {
    // pixels of a panel, samples of a pixel, the exposure's factor, the difference's
    numbers: vec4<f32>,
}

struct Cover {
    @builtin(position) clip: vec4<f32>,
    @location(0) ndc: vec2<f32>,
}

@group(0) @binding(0) var<uniform> show: Show;
@group(0) @binding(3) var chosen: texture_2d<f32>;
@group(0) @binding(4) var exact: texture_2d<f32>;

@vertex
fn vs_cover(@builtin(vertex_index) index: u32) -> Cover {
    let ndc = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    return Cover(vec4<f32>(ndc, 0.5, 1.0), ndc);
}

// IEC 61966-2-1:1999, linear to sRGB.
fn encoded(linear: vec3<f32>) -> vec3<f32> {
    let x = clamp(linear, vec3<f32>(0.0), vec3<f32>(1.0));
    let curved = 1.055 * pow(max(x, vec3<f32>(0.0031308)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(curved, 12.92 * x, x <= vec3<f32>(0.0031308));
}

@fragment
fn fs_show(at: Cover) -> @location(0) vec4<f32> {
    let side = show.numbers.x;
    let samples = i32(show.numbers.y);
    let across = (at.ndc.x * 0.5 + 0.5) * 3.0;
    let panel = floor(across);
    let place = vec2<f32>(across - panel, 0.5 - at.ndc.y * 0.5);
    let pixel = min(vec2<i32>(place * side), vec2<i32>(i32(side) - 1)) * samples;
    var one = vec3<f32>(0.0);
    var other = vec3<f32>(0.0);
    var apart = vec3<f32>(0.0);
    for (var i = 0; i < samples; i += 1) {
        for (var j = 0; j < samples; j += 1) {
            let a = textureLoad(chosen, pixel + vec2<i32>(i, j), 0).rgb;
            let b = textureLoad(exact, pixel + vec2<i32>(i, j), 0).rgb;
            one += a;
            other += b;
            apart += abs(a - b);
        }
    }
    let share = show.numbers.z / f32(samples * samples);
    if (panel > 1.5) {
        return vec4<f32>(encoded(apart * share * show.numbers.w), 1.0);
    }
    if (panel > 0.5) {
        return vec4<f32>(encoded(other * share), 1.0);
    }
    return vec4<f32>(encoded(one * share), 1.0);
}
