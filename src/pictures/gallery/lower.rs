//! Passes in GLSL ES 3.00. naga translates the code around our functions, and our own text replaces its translation of them.

use naga::back::glsl;
use naga::compact::{KeepUnused, compact};
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{GlobalVariable, Handle, Module};
use serde::Serialize;

use crate::pictures::scene::GLES_CALLS;

/// The translation failed: a bug.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{0}")]
pub struct LoweringFault(pub String);

/// A vertex or fragment shader without the users' functions: their names, and the text before and after them.
#[derive(Clone, Debug, Serialize)]
pub struct GlesProgram {
    /// The text before the first function.
    pub before: String,
    /// The functions that it calls itself, in their order.
    pub functions: Vec<String>,
    /// Whether the calls of the method follow these functions.
    pub calls: bool,
    /// The text after them.
    pub after: String,
    /// The name of the frame's block, if it reads it.
    pub block: Option<String>,
    /// Its textures.
    pub textures: Vec<LoweredTexture>,
}

/// A texture with its sampler.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct LoweredTexture {
    /// Its name.
    pub name: String,
    /// The binding of the texture in the WGSL.
    pub texture: u32,
    /// The binding of the sampler, if there is one.
    pub sampler: Option<u32>,
}

/// Stands in for the calls of a method until one is chosen. It reads the frame, as they do.
pub const STAND_IN: &str = "
fn reflectance(incident: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return incident * normal + frame.inputs[0].xyz;
}

fn film_reflectance(cos_theta: f32, thickness_nm: f32) -> vec3<f32> {
    return cos_theta * thickness_nm * frame.inputs[0].xyz;
}

fn transmittance_out(direction: vec3<f32>, normal_out: vec3<f32>, eta: f32) -> f32 {
    return dot(direction, normal_out) + eta + frame.inputs[0].x;
}

fn specular(n_dot_v: f32, n_dot_l: f32, n_dot_h: f32, v_dot_h: f32, alpha: f32) -> vec3<f32> {
    return n_dot_v * n_dot_l * n_dot_h * v_dot_h * alpha * frame.inputs[0].xyz;
}
";
const CALLS: [&str; 4] = [
    "reflectance",
    "film_reflectance",
    "transmittance_out",
    "specular",
];

/// The entry point of a module in GLSL ES, without the functions of these names and without the calls. Off screen, the rows of a
/// picture are counted from the top, as in WebGPU.
///
/// # Errors
/// naga refuses the module, or writes it in an unexpected form.
pub fn lowered(
    module: &Module,
    entry: &str,
    functions: &[String],
    is_off_screen: bool,
) -> Result<GlesProgram, LoweringFault> {
    let mut module = module.clone();
    // naga also writes functions that are not called.
    module.entry_points.retain(|point| point.name == entry);
    compact(&mut module, KeepUnused::No);
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module);
    let info = info.map_err(|fault| LoweringFault(format!("{entry}: {fault}")))?;
    let (mut text, names) = translated(&module, &info, entry, is_off_screen)?;
    // naga appends a `_` to names that end in a digit.
    for name in functions {
        text = text.replace(&format!(" {name}_("), &format!(" {name}("));
    }
    let all: Vec<&str> = functions.iter().map(String::as_str).chain(CALLS).collect();
    let (mut kept, mut rest) = (String::new(), text.as_str());
    let (mut first, mut own, mut calls) = (None, Vec::new(), false);
    while let Some((from, to, name)) = next_function(rest, &all) {
        kept += &rest[..from];
        first.get_or_insert(kept.len());
        rest = &rest[to..];
        if CALLS.contains(&name) {
            calls = true;
        } else {
            own.push(name.to_owned());
        }
    }
    kept += rest;
    let (before, after) = kept.split_at(first.unwrap_or(kept.len()));
    let frame = GLES_CALLS.frame;
    if calls && !before.contains(&format!(" {frame};")) {
        let why = format!("{entry} calls a method, and has no {frame}");
        return Err(LoweringFault(why));
    }
    Ok(GlesProgram {
        before: before.to_owned(),
        functions: own,
        calls,
        after: after.to_owned(),
        block: block(&module, &names),
        textures: textures(&module, &names),
    })
}

fn translated(
    module: &Module,
    info: &ModuleInfo,
    entry: &str,
    is_off_screen: bool,
) -> Result<(String, glsl::ReflectionInfo), LoweringFault> {
    let point = module.entry_points.first();
    let point = point.ok_or_else(|| LoweringFault(format!("the module has no {entry}")))?;
    let flags = if is_off_screen {
        glsl::WriterFlags::ADJUST_COORDINATE_SPACE
    } else {
        glsl::WriterFlags::empty()
    };
    let options = glsl::Options {
        version: glsl::Version::new_gles(300),
        writer_flags: flags,
        ..Default::default()
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage: point.stage,
        entry_point: entry.to_owned(),
        multiview: None,
    };
    let (mut text, checks) = (String::new(), BoundsCheckPolicies::default());
    let names = glsl::Writer::new(&mut text, module, info, &options, &pipeline, checks)
        .and_then(|mut writer| writer.write())
        .map_err(|fault| LoweringFault(format!("{entry}: {fault}")))?;
    Ok((text, names))
}

/// The first of these functions in the text: where it begins, where the text goes on, and its name.
fn next_function<'a>(text: &str, names: &[&'a str]) -> Option<(usize, usize, &'a str)> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let is_head = !line.starts_with([' ', '}', '#']) && line.ends_with(") {\n");
        let name = line
            .split_once('(')
            .and_then(|(head, _)| head.split(' ').next_back());
        let known = names.iter().find(|known| Some(**known) == name);
        if let (true, Some(known)) = (is_head, known) {
            let end = text[at..].find("\n}\n")? + at + "\n}\n".len();
            return Some((at, end, known));
        }
        at += line.len();
    }
    None
}

fn binding(module: &Module, variable: Handle<GlobalVariable>) -> Option<u32> {
    let bound = module.global_variables[variable].binding;
    bound.map(|bound| bound.binding)
}

/// The name of the block itself; its instance has another name.
fn block(module: &Module, names: &glsl::ReflectionInfo) -> Option<String> {
    let mut blocks = names.uniforms.iter();
    let found = blocks.find(|(variable, _)| binding(module, **variable) == Some(0));
    found.map(|(_, name)| name.clone())
}

fn textures(module: &Module, names: &glsl::ReflectionInfo) -> Vec<LoweredTexture> {
    let mapped = names.texture_mapping.iter().filter_map(|(name, mapping)| {
        Some(LoweredTexture {
            name: name.clone(),
            texture: binding(module, mapping.texture)?,
            sampler: mapping.sampler.and_then(|sampler| binding(module, sampler)),
        })
    });
    let mut all: Vec<LoweredTexture> = mapped.collect();
    all.sort();
    all
}
