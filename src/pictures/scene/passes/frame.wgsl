// What every pass sees: the frame, the environment, the entry points for vertices.

// Matrices and the eye are those of the pass's view.
struct Frame {
    view_projection: mat4x4<f32>,
    inverse: mat4x4<f32>,
    // w: the body's size
    eye: vec4<f32>,
    // of red, green and blue
    n: vec4<f32>,
    k: vec4<f32>,
    room_min: vec4<f32>,
    room_max: vec4<f32>,
    room_centre: vec4<f32>,
    // of the eye and of the eye mirrored in y = 0, in pictures with a margin
    margin: mat4x4<f32>,
    mirrored: mat4x4<f32>,
    // of the body's material, of red, green and blue, per unit of length; w: its roughness
    absorption: vec4<f32>,
    // x: the film's thickness in nanometres where it is thickest
    film: vec4<f32>,
    // of the method, in its order
    inputs: array<vec4<f32>, 16>,
}

struct Surface {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) uv: vec2<f32>,
}

struct Cover {
    @builtin(position) clip: vec4<f32>,
    @location(0) ndc: vec2<f32>,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var clamped: sampler;
@group(0) @binding(2) var around: sampler;
@group(0) @binding(3) var environment: texture_2d<f32>;

// Rows of a picture are counted from the top, and y points up.
const UV_SCALE_BIAS = vec4<f32>(0.5, -0.5, 0.5, 0.5);

// What a pixel is, in alpha.
const SKY = 0.0;
const FOUND = 1.0;
const MISSED = 2.0;
const TOTAL = 3.0;
const LEAKED = 4.0;

@vertex
fn vs_body(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) uv: vec2<f32>,
) -> Surface {
    return Surface(frame.view_projection * vec4<f32>(position, 1.0), position, normal, tangent, uv);
}

@vertex
fn vs_cover(@builtin(vertex_index) index: u32) -> Cover {
    let ndc = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    return Cover(vec4<f32>(ndc, 0.5, 1.0), ndc);
}

fn look_up(direction: vec3<f32>) -> vec3<f32> {
    let unit = normalize(direction);
    let u = atan2(unit.x, -unit.z) * 0.15915494 + 0.5;
    let v = acos(clamp(unit.y, -1.0, 1.0)) * 0.31830987;
    return textureSampleLevel(environment, around, vec2<f32>(u, v), 0.0).rgb;
}

@fragment
fn fs_sky(at: Cover) -> @location(0) vec4<f32> {
    let far = frame.inverse * vec4<f32>(at.ndc, 1.0, 1.0);
    return vec4<f32>(look_up(far.xyz / far.w - frame.eye.xyz), SKY);
}
