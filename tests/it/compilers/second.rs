//! naga's translations of WGSL are what the compilers of those languages take, and DXC's SPIR-V is valid.

use std::fs;

use tempfile::TempDir;

use super::Judgement;
use super::Tool;
use super::accepted;
use super::text;
use super::tree;
use crate::not_checked;
use fresnel_gen::generator::emit::Artifact;
use fresnel_gen::lab::fault::Fault;
use fresnel_gen::lab::verify::compilers::{HlslVersion, accepts, hlsl_to_spirv};
use fresnel_gen::lab::verify::naga_translation::{to_gles, to_hlsl};
use fresnel_gen::language::targets;
use fresnel_gen::physics::num::Precision;

const GLSLANG: Tool = Tool {
    command: "glslangValidator",
    package: "glslang-tools",
};

/// A vertex shader for transform feedback.
const VERTEX: &str = "
struct Captured { @builtin(position) position: vec4<f32>, @location(0) reflectance: vec3<f32> }
@vertex fn points(@location(0) cos_theta: f32) -> Captured { return Captured(vec4<f32>(), FUNCTION(cos_theta)); }
";

const COMPUTE: &str = "
@group(0) @binding(1) var<storage, read> cosines: array<f32>;
@group(0) @binding(2) var<storage, read_write> reflectances: array<vec4<f32>>;
@compute @workgroup_size(64) fn points(@builtin(global_invocation_id) at: vec3<u32>) {
    if at.x < arrayLength(&cosines) { reflectances[at.x] = vec4<f32>(FUNCTION(cosines[at.x]), 1.0); }
}
";

/// The same over our own text.
const HLSL_COMPUTE: &str = "
StructuredBuffer<float> cosines : register(t1);
RWStructuredBuffer<float4> reflectances : register(u2);
[numthreads(64, 1, 1)] void points(uint3 at : SV_DispatchThreadID)
{
    reflectances[at.x] = float4(FUNCTION(cosines[at.x]), 1.0);
}
";

#[test]
fn nagas_gles_is_accepted() {
    if !GLSLANG.is_here("naga's GLSL ES") {
        return;
    }
    accepted(&materials("wgsl"), |(file, function)| {
        let gles = to_gles(&within(file, function, VERTEX), "points").map_err(|f| f.to_string())?;
        assert!(gles.text.contains(&format!(" {};", gles.inputs[&0])));
        assert!(gles.text.contains(&format!("vec3 {};", gles.outputs[&0])));
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("a.vert");
        fs::write(&path, gles.text).unwrap();
        GLSLANG.run([path])
    });
}

#[test]
fn nagas_hlsl_and_ours_become_valid_spirv() {
    let of_naga = |(file, function): &(&Artifact, &str)| {
        let hlsl = to_hlsl(&within(file, function, COMPUTE), "points").unwrap();
        valid(hlsl_to_spirv(
            Precision::F32,
            &hlsl.text,
            &hlsl.entry,
            HlslVersion::V2018,
        ))
    };
    accepted(&materials("wgsl"), of_naga);
    let of_us = |(file, function): &(&Artifact, &str)| {
        let text = within(file, function, HLSL_COMPUTE);
        valid(hlsl_to_spirv(
            Precision::F32,
            &text,
            "points",
            HlslVersion::V2018,
        ))?;
        valid(hlsl_to_spirv(
            Precision::F32,
            &text,
            "points",
            HlslVersion::V2021,
        ))
    };
    accepted(&materials("hlsl"), of_us);
}

#[test]
fn what_dxc_refuses_is_told() {
    match hlsl_to_spirv(Precision::F32, "float f(", "f", HlslVersion::V2021) {
        Err(Fault::Failed(words)) => assert!(words.contains("shader.hlsl:1:"), "{words}"),
        Err(Fault::Absent(reason)) => not_checked(&format!("DXC's SPIR-V: {reason}")),
        Ok(_) => panic!("it is no HLSL"),
    }
}

/// The first function of each material of the tree, which takes a cosine alone.
fn materials(target: &str) -> Vec<(&'static Artifact, &'static str)> {
    let mut files = tree(target);
    files.retain(|file| file.material.is_some());
    let first = |file: &&'static Artifact| file.detail.functions()[0].name.as_str();
    files.iter().map(|file| (*file, first(file))).collect()
}

fn within(file: &Artifact, function: &str, entry: &str) -> String {
    text(file).to_owned() + &entry.replace("FUNCTION", function)
}

/// What is not checked here, another test of these compilers names.
fn valid(spirv: Result<Vec<u8>, Fault>) -> Judgement {
    let bytes = match spirv {
        Ok(bytes) => bytes,
        Err(Fault::Absent(_)) => return Ok(String::new()),
        Err(Fault::Failed(words)) => return Err(words),
    };
    assert!(bytes.starts_with(&[3, 2, 35, 7]), "SPIR-V's magic number");
    let target = targets::find("spirv").unwrap();
    for (name, verdict) in accepts(Precision::F32, target, "a.spv", &bytes) {
        if let Err(Fault::Failed(words)) = verdict {
            return Err(format!("{name}: {words}"));
        }
    }
    Ok(String::new())
}
