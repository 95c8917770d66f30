//! naga's translation of WGSL into GLSL ES and HLSL: a second opinion on what the WGSL means, run beside our text of the same
//! function. naga renames identifiers, so each translation comes with the names that a caller binds.

use std::collections::BTreeMap;
use std::fmt::Display;

use naga::back::{glsl, hlsl};
use naga::proc::BoundsCheckPolicies;
use naga::{GlobalVariable, Handle, Module, ShaderStage, TypeInner};

use crate::generator::emit::validate_wgsl;
use crate::lab::fault::Fault;

/// `@group` and `@binding` of a variable in the WGSL.
pub type Binding = (u32, u32);
/// Names by binding.
pub type Bindings = BTreeMap<Binding, String>;
/// Names by location.
pub type Locations = BTreeMap<u32, String>;

/// A vertex or fragment shader in GLSL ES 3.00.
#[derive(Clone, Debug)]
pub struct Gles {
    /// The shader; its entry point is `main`.
    pub text: String,
    /// The names of inputs.
    pub inputs: Locations,
    /// The names of outputs.
    pub outputs: Locations,
    /// The names of `sampler2D`s, by the binding of the texture.
    pub textures: Bindings,
}

/// A compute shader in HLSL. `@binding` is the register's number, `@group` its space. Buffers are byte address buffers.
#[derive(Clone, Debug)]
pub struct Hlsl {
    /// The shader.
    pub text: String,
    /// The name of its entry point.
    pub entry: String,
}

/// WGSL's entry point of this name, of a vertex or fragment shader, in GLSL ES 3.00.
///
/// # Errors
/// The text is not valid WGSL, has no such entry point, or naga cannot write it.
pub fn to_gles(wgsl: &str, entry: &str) -> Result<Gles, Fault> {
    let (module, info) = validate_wgsl(wgsl).map_err(Fault::Failed)?;
    let pipeline = glsl::PipelineOptions {
        shader_stage: stage(&module, entry)?,
        entry_point: entry.to_owned(),
        multiview: None,
    };
    let (mut text, checks) = (String::new(), BoundsCheckPolicies::default());
    let options = gles_options();
    let mut writer = glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, checks)
        .map_err(refused)?;
    let names = writer.write().map_err(refused)?;
    Ok(Gles {
        inputs: varyings(&text, " in "),
        outputs: varyings(&text, " out "),
        textures: textures(&module, &names),
        text,
    })
}

/// WGSL's entry point of this name, of a compute shader, in HLSL 2018 for shader model 6.0.
///
/// # Errors
/// The text is not valid WGSL, has no such entry point, or samples a texture.
pub fn to_hlsl(wgsl: &str, entry: &str) -> Result<Hlsl, Fault> {
    let (module, info) = validate_wgsl(wgsl).map_err(Fault::Failed)?;
    let has_sampler = module
        .global_variables
        .iter()
        .any(|(_, variable)| matches!(module.types[variable.ty].inner, TypeInner::Sampler { .. }));
    if has_sampler {
        let reason = "naga's HLSL takes its samplers from a heap that only wgpu fills";
        return Err(Fault::Absent(reason.to_owned()));
    }
    let pipeline = hlsl::PipelineOptions {
        entry_point: Some((stage(&module, entry)?, entry.to_owned())),
    };
    let options = hlsl::Options {
        shader_model: hlsl::ShaderModel::V6_0,
        ..Default::default()
    };
    let mut text = String::new();
    let names = hlsl::Writer::new(&mut text, &options, &pipeline)
        .write(&module, &info, None)
        .map_err(refused)?;
    let mut entries = module.entry_points.iter().zip(names.entry_point_names);
    let (_, name) = entries
        .find(|(point, _)| point.name == entry)
        .ok_or_else(|| absent(entry))?;
    let entry = name.map_err(refused)?;
    Ok(Hlsl { text, entry })
}

fn gles_options() -> glsl::Options {
    glsl::Options {
        version: glsl::Version::new_gles(300),
        // The caller's own position, without a flip for another API.
        writer_flags: glsl::WriterFlags::empty(),
        ..Default::default()
    }
}

fn stage(module: &Module, entry: &str) -> Result<ShaderStage, Fault> {
    let mut points = module.entry_points.iter();
    let point = points.find(|point| point.name == entry);
    point.map(|point| point.stage).ok_or_else(|| absent(entry))
}

fn absent(entry: &str) -> Fault {
    Fault::Failed(format!("the module has no entry point `{entry}`"))
}

fn refused(fault: impl Display) -> Fault {
    Fault::Failed(fault.to_string())
}

/// Inputs or outputs, read from their declarations, `smooth out vec3 _vs2fs_location0;`. naga reports them only where the
/// language has no other way to state a location.
fn varyings(text: &str, qualifier: &str) -> Locations {
    let varying = |line: &str| {
        let (_, declared) = line.split_once(qualifier)?;
        let name = declared.strip_suffix(';')?.rsplit(' ').next()?;
        let (_, location) = name.rsplit_once("_location")?;
        Some((location.parse().ok()?, name.to_owned()))
    };
    let outermost = text.lines().filter(|line| !line.starts_with(' '));
    outermost.filter_map(varying).collect()
}

fn textures(module: &Module, names: &glsl::ReflectionInfo) -> Bindings {
    let textures = names.texture_mapping.iter();
    textures
        .filter_map(|(name, mapping)| Some((binding(module, mapping.texture)?, name.clone())))
        .collect()
}

fn binding(module: &Module, variable: Handle<GlobalVariable>) -> Option<Binding> {
    let at = module.global_variables[variable].binding.as_ref()?;
    Some((at.group, at.binding))
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTEX: &str = "
struct Parameters { f0: vec3<f32>, exponent: f32 }
@group(0) @binding(0) var<uniform> parameters: Parameters;
struct Out { @builtin(position) position: vec4<f32>, @location(0) reflectance: vec3<f32> }
fn f(cos_theta: f32) -> vec3<f32> { return parameters.f0 * pow(cos_theta, parameters.exponent); }
@vertex fn points(@location(0) cos_theta: f32) -> Out { return Out(vec4<f32>(), f(cos_theta)); }
";

    const COMPUTE: &str = "
@group(0) @binding(1) var<storage, read> cosines: array<f32>;
@group(0) @binding(2) var<storage, read_write> reflectances: array<vec4<f32>>;
@compute @workgroup_size(64) fn sample(@builtin(global_invocation_id) at: vec3<u32>) {
    if at.x < arrayLength(&cosines) { reflectances[at.x] = vec4<f32>(cosines[at.x]); }
}
";

    const TEXTURED: &str = "
@group(0) @binding(3) var table: texture_2d<f32>;
@group(0) @binding(4) var table_filter: sampler;
fn f(u: f32) -> vec3<f32> { return textureSampleLevel(table, table_filter, vec2<f32>(u, 0.5), 0.0).rgb; }
struct Out { @builtin(position) position: vec4<f32>, @location(0) reflectance: vec3<f32> }
@vertex fn points(@location(0) u: f32) -> Out { return Out(vec4<f32>(), f(u)); }
@compute @workgroup_size(1) fn one() { _ = f(0.5); }
";

    #[test]
    fn a_vertex_shader_comes_with_its_names() {
        let gles = to_gles(VERTEX, "points").unwrap();
        assert!(gles.text.starts_with("#version 300 es\n"), "{}", gles.text);
        let names = [&gles.inputs[&0], &gles.outputs[&0]];
        assert!(names.iter().all(|name| gles.text.contains(*name)));
        assert!(gles.textures.is_empty());
    }

    #[test]
    fn a_compute_shader_keeps_its_bindings() {
        let hlsl = to_hlsl(COMPUTE, "sample").unwrap();
        // `sample` is a keyword of HLSL.
        assert_eq!(hlsl.entry, "sample_");
        for register in ["register(t1)", "register(u2)"] {
            assert!(hlsl.text.contains(register), "{}", hlsl.text);
        }
    }

    #[test]
    fn textures_have_names_in_gles_and_no_second_opinion_in_hlsl() {
        let gles = to_gles(TEXTURED, "points").unwrap();
        assert!(gles.text.contains(&gles.textures[&(0, 3)]), "{}", gles.text);
        let fault = to_hlsl(TEXTURED, "one").unwrap_err();
        assert!(matches!(fault, Fault::Absent(_)), "{fault}");
    }

    #[test]
    fn faults_are_told() {
        for result in [to_gles(VERTEX, "main").err(), to_hlsl("fn f(", "f").err()] {
            assert!(matches!(result, Some(Fault::Failed(_))), "{result:?}");
        }
    }
}
