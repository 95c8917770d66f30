struct View { world: mat4x4<f32>, position: vec3<f32> }
@group(0) @binding(0) var<uniform> view: View;
@group(1) @binding(0) var albedo: texture_2d<f32>;
@group(1) @binding(1) var albedo_sampler: sampler;
struct FragmentInput { @builtin(position) at: vec4<f32>, @location(0) normal: vec3<f32>, @location(1) uv: vec2<f32> }
const WHITE = vec3<f32>(1.0);
fn fresnel(n_dot_v: f32, f0: vec3<f32>) -> vec3<f32> { return f0 + (WHITE - f0) * pow5(1.0 - n_dot_v); }
fn pow5(x: f32) -> f32 { let x2 = x * x; return x2 * x2 * x; }
@fragment
fn fragment(in: FragmentInput) -> @location(0) vec4<f32> {
    let base = textureSample(albedo, albedo_sampler, in.uv).rgb;
    if base.r < 0.1 { discard; }
    return vec4<f32>(fresnel(dot(in.normal, view.position), base) + fwidth(in.uv.x), 1.0);
}
