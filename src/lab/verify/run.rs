//! Runs what was generated: the text of a file, unchanged, on the graphics stack of its language.
//!
//! | target | how |
//! |---|---|
//! | wgsl | by wgpu |
//! | spirv | the module itself, handed to the driver |
//! | gles | in a context of OpenGL ES 3.0, by transform feedback |
//! | hlsl | by DXC to SPIR-V (HLSL 2018 and 2021), and that as above |
//!
//! MSL runs on Apple's systems only, and GLSL 4.50 is not a language of any of these stacks: they are not run here.

use std::cell::OnceCell;

use super::compilers::{HlslVersion, hlsl_to_spirv};
use super::effect_trial::{EffectTrial, TEXELS};
use super::harness::{self, Call, ENTRY};
use super::naga_translation;
use super::trial::Trial;
use crate::generator::emit::{EmittedFunction, batch_entry, batch_program, places};
use crate::lab::fault::Fault;
use crate::lab::gpu::{
    Argument, Device, Kernel, Program, ShaderCode, Texture, TextureFilter, TextureFormat,
    TextureShape, Uniform, Wanted, Wrap,
};
use crate::language::ir::{Param, Ty};
use crate::language::targets::{Stack, Target, filled};
use crate::physics::num::Precision;

/// The devices of a run, each opened when it is first needed.
pub struct Devices {
    wanted: Wanted,
    compute: OnceCell<Result<Device, Fault>>,
    gles: OnceCell<Result<Device, Fault>>,
}

/// How a target's text is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExecutionPath {
    /// As the target's language says.
    Own,
    /// As HLSL 2021.
    Hlsl2021,
    /// naga's translation of the WGSL into GLSL ES.
    NagaGles,
    /// naga's translation of the WGSL into HLSL.
    NagaHlsl,
}

impl ExecutionPath {
    /// The paths of a target, its own first. In half precision naga writes no GLSL, and HLSL for another shader model.
    pub fn all_for(target: &Target, precision: Precision) -> &'static [ExecutionPath] {
        match (target.stack, precision) {
            (Stack::Wgpu(_), Precision::F32) => &[
                ExecutionPath::Own,
                ExecutionPath::NagaGles,
                ExecutionPath::NagaHlsl,
            ],
            (Stack::DxcToVulkan(_), _) => &[ExecutionPath::Own, ExecutionPath::Hlsl2021],
            _ => &[ExecutionPath::Own],
        }
    }

    /// The paths of an effect's function. naga's translations are for functions of a cosine only.
    pub fn all_for_effect(target: &Target) -> &'static [ExecutionPath] {
        match target.stack {
            Stack::DxcToVulkan(_) => &[ExecutionPath::Own, ExecutionPath::Hlsl2021],
            _ => &[ExecutionPath::Own],
        }
    }

    /// The version of HLSL that DXC is asked for.
    fn hlsl_version(self) -> HlslVersion {
        match self {
            ExecutionPath::Hlsl2021 => HlslVersion::V2021,
            _ => HlslVersion::V2018,
        }
    }

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            ExecutionPath::Own => "as it is",
            ExecutionPath::Hlsl2021 => "HLSL 2021",
            ExecutionPath::NagaGles => "naga's GLSL ES",
            ExecutionPath::NagaHlsl => "naga's HLSL",
        }
    }
}

/// A function of a file.
#[derive(Clone, Copy, Debug)]
pub struct ShippedFunction<'a> {
    /// The target.
    pub target: &'static Target,
    /// The content of the file.
    pub bytes: &'a [u8],
    /// The function.
    pub function: &'a EmittedFunction,
    /// The entry point of a module.
    pub entry: &'a str,
}

/// A function ready to run.
pub struct Runnable {
    target: &'static Target,
    kernel: Kernel,
    /// The description of its device.
    pub device: String,
    params: Vec<Param>,
    /// Whether the values of the arguments stand in the text, as in naga's translations.
    is_bound: bool,
}

impl Devices {
    /// Devices of which none is opened yet.
    pub fn new(wanted: Wanted) -> Devices {
        Devices {
            wanted,
            compute: OnceCell::new(),
            gles: OnceCell::new(),
        }
    }

    /// The device that runs WGSL and SPIR-V.
    ///
    /// # Errors
    /// There is none.
    pub fn compute(&self) -> Result<&Device, Fault> {
        let opened = self.compute.get_or_init(|| Device::open(&self.wanted));
        opened.as_ref().map_err(Fault::clone)
    }

    /// The device that runs GLSL ES.
    ///
    /// # Errors
    /// There is none.
    pub fn gles(&self) -> Result<&Device, Fault> {
        let opened = self.gles.get_or_init(Device::gles);
        opened.as_ref().map_err(Fault::clone)
    }

    /// The device that runs a target's text by an execution path.
    ///
    /// # Errors
    /// There is none.
    pub fn device_for(&self, target: &Target, path: ExecutionPath) -> Result<&Device, Fault> {
        if matches!(target.stack, Stack::OpenGlEs(_)) || path == ExecutionPath::NagaGles {
            self.gles()
        } else {
            self.compute()
        }
    }

    /// Compiles a function of a file for running. naga's translations hold the values of the trial's arguments.
    ///
    /// # Errors
    /// A compiler refuses the text, or something that it needs is missing here.
    pub fn prepare(
        &self,
        shown: &ShippedFunction,
        path: ExecutionPath,
        trial: &Trial,
    ) -> Result<Runnable, Fault> {
        let emitted = shown.function;
        let call = Call::to_emitted(emitted);
        let device = self.device_for(shown.target, path)?;
        check_able(device, emitted)?;
        let ready = |code: ShaderCode, entry: &str, is_bound: bool| {
            let params = &emitted.function.params;
            let uniforms = if is_bound {
                Vec::new()
            } else {
                uniforms(params, trial, shown.target)
            };
            let program = Program {
                code,
                entry,
                uniforms: &uniforms,
                texture: call.is_textured().then_some(TextureShape::Flat),
            };
            Ok(Runnable {
                target: shown.target,
                kernel: device.prepare(&program)?,
                device: device.adapter.to_string(),
                params: params.clone(),
                is_bound,
            })
        };
        if let Stack::SpirvModule = shown.target.stack {
            return ready(ShaderCode::Spirv(shown.bytes), shown.entry, false);
        }
        let text =
            std::str::from_utf8(shown.bytes).map_err(|fault| Fault::Failed(fault.to_string()))?;
        let shader = harness::program(shown.target, text, &call);
        let shader = shader.ok_or_else(|| not_run(shown.target))?;
        match (shown.target.stack, path) {
            (Stack::Wgpu(_), ExecutionPath::NagaGles) => {
                let vertex = harness::wgsl_vertex(text, &call, &trial.values);
                let made = naga_translation::to_gles(&vertex, ENTRY)?;
                ready(ShaderCode::Gles(&harness::renamed(&made)), "main", true)
            }
            (Stack::Wgpu(_), ExecutionPath::NagaHlsl) => {
                let made = naga_translation::to_hlsl(&shader, ENTRY)?;
                let code =
                    hlsl_to_spirv(Precision::F32, &made.text, &made.entry, HlslVersion::V2018)?;
                ready(ShaderCode::Spirv(&code), &made.entry, false)
            }
            (Stack::OpenGlEs(_), _) => ready(ShaderCode::Gles(&shader), "main", false),
            (Stack::DxcToVulkan(_), _) => {
                let version = path.hlsl_version();
                let code = hlsl_to_spirv(emitted.precision, &shader, ENTRY, version)?;
                ready(ShaderCode::Spirv(&code), ENTRY, false)
            }
            _ => ready(ShaderCode::Wgsl(&shader), ENTRY, false),
        }
    }
}

impl Devices {
    /// Runs a function of an effect at the points of a trial.
    ///
    /// # Errors
    /// A compiler refuses the text, something that it needs is missing here, or the device fails.
    pub fn run_effect(
        &self,
        shown: &ShippedFunction,
        path: ExecutionPath,
        trial: &EffectTrial,
    ) -> Result<Vec<[f32; 3]>, Fault> {
        let emitted = shown.function;
        let device = self.device_for(shown.target, path)?;
        let params = &emitted.function.params;
        let reads = |ty: Ty| params.iter().any(|param| param.ty == ty);
        let shape = match (reads(Ty::Texture), reads(Ty::Cube)) {
            (true, _) => Some(TextureShape::Flat),
            (_, true) => Some(TextureShape::Cube),
            _ => None,
        };
        let run = |code: ShaderCode, entry: &str| -> Result<Vec<[f32; 3]>, Fault> {
            let program = Program {
                code,
                entry,
                uniforms: &[],
                texture: shape,
            };
            let batch = device.prepare_batch(&program, places(params))?;
            let texture = shape.map(|shape| Texture {
                width: TEXELS,
                texels: &trial.texels,
                format: TextureFormat::Half,
                wrap: Wrap::Clamp,
                shape,
                filter: TextureFilter::Linear,
            });
            batch.run(&trial.places(), texture.as_ref())
        };
        if let Stack::SpirvModule = shown.target.stack {
            return run(ShaderCode::Spirv(shown.bytes), shown.entry);
        }
        let text =
            std::str::from_utf8(shown.bytes).map_err(|fault| Fault::Failed(fault.to_string()))?;
        let program = batch_program(shown.target, text, &[emitted]);
        let program = program.ok_or_else(|| not_run(shown.target))?;
        let entry = batch_entry(&emitted.name);
        match shown.target.stack {
            Stack::OpenGlEs(_) => run(ShaderCode::Gles(&program), "main"),
            Stack::DxcToVulkan(_) => {
                let code = hlsl_to_spirv(Precision::F32, &program, &entry, path.hlsl_version())?;
                run(ShaderCode::Spirv(&code), &entry)
            }
            _ => run(ShaderCode::Wgsl(&program), &entry),
        }
    }
}

/// The fault of a target whose text is not run here.
fn not_run(target: &Target) -> Fault {
    let name = target.name;
    Fault::Absent(format!(
        "{name} cannot be run here: it is read again and compiled only"
    ))
}

/// Checks that a device has 16-bit arithmetic where a function needs it.
fn check_able(device: &Device, emitted: &EmittedFunction) -> Result<(), Fault> {
    if !emitted.precision.is_half() || device.has_half() {
        return Ok(());
    }
    let lacks = "has no 16-bit arithmetic in shaders (shader-f16, shaderFloat16)";
    Err(Fault::Absent(format!("{} {lacks}", device.adapter)))
}

/// The arguments of a trial by name, as a target's harness names them.
fn uniforms(params: &[Param], trial: &Trial, target: &Target) -> Vec<Uniform> {
    let name = target
        .stack
        .harness()
        .map_or("{name}", |harness| harness.uniform);
    let numbers = params
        .iter()
        .filter(|param| param.ty != Ty::Texture && !param.is_cosine());
    let uniform = |(param, value): (&Param, &[f32; 3])| Uniform {
        name: filled(name, &[("name", &param.name)]),
        value: if param.ty == Ty::Vec3 {
            Argument::Rgb(*value)
        } else {
            Argument::Scalar(value[0])
        },
    };
    numbers.zip(&trial.values).map(uniform).collect()
}

impl Runnable {
    /// The results at these cosines with the arguments of a trial.
    ///
    /// # Errors
    /// The device fails.
    pub fn run(&self, trial: &Trial, cosines: &[f32]) -> Result<Vec<[f32; 3]>, Fault> {
        let uniforms = if self.is_bound {
            Vec::new()
        } else {
            uniforms(&self.params, trial, self.target)
        };
        let texels: Option<Vec<[f32; 4]>> = trial.table.as_ref().map(|table| {
            table
                .texels
                .iter()
                .map(|[r, g, b]| [*r, *g, *b, 1.0])
                .collect()
        });
        let texture = texels
            .as_ref()
            .zip(trial.table.as_ref())
            .map(|(texels, table)| Texture {
                width: table.width,
                texels,
                format: TextureFormat::Half,
                wrap: Wrap::Clamp,
                shape: TextureShape::Flat,
                filter: TextureFilter::Linear,
            });
        self.kernel.run(cosines, &uniforms, texture.as_ref())
    }
}
