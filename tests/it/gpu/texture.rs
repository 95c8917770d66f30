//! A texture is sampled as the filter of the tables says: linear between the centres of texels.

use super::device;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::gpu::{
    Backend, Program, ShaderCode, Texture, TextureFilter, TextureFormat, TextureShape, Wrap,
};

const TEXELS: usize = 8;

/// Samples at u = cos_theta.
const WGSL: &str = "
@group(0) @binding(1) var<storage, read> cosines: array<f32>;
@group(0) @binding(2) var<storage, read_write> reflectances: array<vec4<f32>>;
@group(0) @binding(3) var table: texture_2d<f32>;
@group(0) @binding(4) var table_sampler: sampler;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if index < arrayLength(&cosines) {
        reflectances[index] = textureSampleLevel(table, table_sampler, vec2<f32>(cosines[index], 0.5), 0.0);
    }
}
";

const GLES: &str = "#version 300 es
uniform highp sampler2D table;
in highp float cos_theta;
out highp vec3 reflectance;
void main() {
    reflectance = textureLod(table, vec2(cos_theta, 0.5), 0.0).rgb;
}
";

/// A texel's value: exact in all formats but that of sRGB.
fn texel(i: usize) -> f32 {
    if i.is_multiple_of(2) { 0.0 } else { 1.0 }
}

/// What lies at u, halfway between 0 and 1 at the boundaries of texels.
fn expected(u: f32, wrap: Wrap) -> f32 {
    let place = u * TEXELS as f32 - 0.5;
    let at = |i: f32| match wrap {
        Wrap::Clamp => texel(i.clamp(0.0, TEXELS as f32 - 1.0) as usize),
        Wrap::Repeat => texel(i.rem_euclid(TEXELS as f32) as usize),
    };
    let (left, share) = (place.floor(), place - place.floor());
    at(left) * (1.0 - share) + at(left + 1.0) * share
}

#[track_caller]
fn check(backend: Backend, format: TextureFormat, wrap: Wrap, curve: fn(f32) -> f32) {
    let Some(device) = device(backend) else {
        return;
    };
    let code = match backend {
        Backend::Gles => ShaderCode::Gles(GLES),
        _ => ShaderCode::Wgsl(WGSL),
    };
    let kernel = device
        .prepare(&Program {
            code,
            entry: "main",
            uniforms: &[],
            texture: Some(TextureShape::Flat),
        })
        .unwrap();
    let texels: Vec<[f32; 4]> = (0..TEXELS)
        .map(|i| [texel(i), curve(0.5), 0.25, 1.0])
        .collect();
    let texture = Texture {
        width: TEXELS,
        texels: &texels,
        format,
        wrap,
        shape: TextureShape::Flat,
        filter: TextureFilter::Linear,
    };
    let points: Vec<f32> = (0..=256).map(|i| i as f32 / 256.0).collect();
    let got = match kernel.run(&points, &[], Some(&texture)) {
        // Two formats are not everywhere.
        Err(fault @ Fault::Absent(_)) => return super::not_checked(&fault.to_string()),
        got => got.unwrap(),
    };
    for (u, [ramp, half, quarter]) in points.iter().zip(got) {
        let want = expected(*u, wrap);
        let what = format!("{}: {format:?} at u {u}", device.adapter);
        assert!(
            (ramp - want).abs() < 2.0 / 256.0,
            "{what}: {ramp}, not {want}"
        );
        assert!((half - 0.5).abs() < 3.0 / 255.0, "{what}: {half}");
        let quarter_is = if format == TextureFormat::Srgb8 {
            0.0508
        } else {
            0.25
        };
        assert!(
            (quarter - quarter_is).abs() < 1.0 / 255.0,
            "{what}: {quarter}"
        );
    }
}

const FORMATS: [TextureFormat; 4] = [
    TextureFormat::Half,
    TextureFormat::Float,
    TextureFormat::Unorm8,
    TextureFormat::Unorm16,
];

#[test]
fn a_ramp_in_wgsl() {
    for wrap in [Wrap::Clamp, Wrap::Repeat] {
        for format in FORMATS {
            check(Backend::Vulkan, format, wrap, |v| v);
        }
    }
}

#[test]
fn a_ramp_in_gles() {
    for wrap in [Wrap::Clamp, Wrap::Repeat] {
        for format in FORMATS {
            check(Backend::Gles, format, wrap, |v| v);
        }
    }
}

/// The inverse of the curve of sRGB, IEC 61966-2-1:1999.
fn encoded(value: f32) -> f32 {
    1.055 * value.powf(1.0 / 2.4) - 0.055
}

#[test]
fn a_sampler_takes_srgb_through_its_curve() {
    for backend in [Backend::Vulkan, Backend::Gles] {
        check(backend, TextureFormat::Srgb8, Wrap::Clamp, encoded);
    }
}
