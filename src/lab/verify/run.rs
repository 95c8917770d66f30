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
//!
//! Functions of effects are compared with what they mean. Functions in half precision run at every f16 from 0 to 1 and at every
//! exponent beyond. They are compared with f64 and with f16 rounded after every operation.

use std::cell::OnceCell;

use super::compilers::{HlslVersion, Verdict, hlsl_to_spirv};
use super::effect_trial::{EffectTrial, TEXELS};
use super::file::FileTrial;
use super::harness::{self, Call, ENTRY};
use super::judge::{EffectRun, HalfRun, PathRun, RanFunction, RunResult};
use super::naga_translation;
use super::requested::VerifyPlan;
use super::row::VerifyRow;
use super::trial::Trial;
use crate::generator::emit::{EffectPart, EmittedFunction, batch_entry, batch_program, places};
use crate::generator::fit::{Measured, values_for_material_in};
use crate::lab::fault::Fault;
use crate::lab::gpu::{
    Argument, Device, Kernel, Program, ShaderCode, Texture, TextureFilter, TextureFormat,
    TextureShape, Uniform, Wanted, Wrap,
};
use crate::lab::verify::{HalfError, HalfTrial, halves, halves_beyond, result_range};
use crate::language::ir::{Param, Ty};
use crate::language::methods::{Contract, Method};
use crate::language::targets::{Stack, Target, filled};
use crate::physics::num::{Num, Precision};

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

/// The values of a method's inputs for the materials that library functions are run with.
fn input_values(plan: &VerifyPlan, method: &Method) -> Vec<Vec<(String, [f64; 3])>> {
    let subjects = plan.trial_subjects().iter();
    let described = subjects.filter(|subject| subject.is_described_by(method));
    described
        .map(|subject| {
            let values = values_for_material_in(Precision::F32, subject, method);
            values.into_iter().collect()
        })
        .collect()
}

impl FileTrial<'_> {
    /// The row of a function of an effect.
    pub(super) fn effect_row(
        &self,
        plan: &VerifyPlan,
        part: EffectPart,
        accepts: &[(&'static str, Verdict)],
    ) -> VerifyRow {
        let trial = EffectTrial::new(self.emitted, part, &input_values(plan, self.emitted.method));
        let paths = ExecutionPath::all_for_effect(self.file.target).iter();
        let runs: Vec<(ExecutionPath, Result<PathRun, Fault>)> = paths
            .map(|path| (*path, self.run_effect(&trial, *path)))
            .collect();
        RanFunction {
            file: self.file,
            emitted: self.emitted,
            material: "",
            accepts,
            runs: &runs,
        }
        .verify_row()
    }

    fn run_effect(&self, trial: &EffectTrial, path: ExecutionPath) -> Result<PathRun, Fault> {
        let shown = self.shown_safely(path)?;
        let got = self.devices.run_effect(&shown, path, trial)?;
        let (outcome, allowed) = match &self.emitted.code {
            Measured::Yes(bound) => (trial.judge(&got), bound.value()),
            Measured::No(_) => trial.judge_without_promise(&got),
        };
        let device = self.devices.device_for(shown.target, path)?;
        Ok(PathRun {
            points: outcome.points,
            share: f64::NAN,
            result: RunResult::Effect(EffectRun { outcome, allowed }),
            model_error: None,
            device: device.adapter.to_string(),
        })
    }
}

/// How much further off than the emulation, which is promised, a device may be: 2⁻¹¹, the last place below 1. A device may fuse,
/// reorder, divide and take roots in two steps, and flush denormals to 0.
const FREEDOM: f64 = 1.0 / 2048.0;

/// Runs a function in half precision. One that promises nothing may be twice as far off as its emulation.
pub(super) fn run_in_half(
    runnable: &Runnable,
    shown: &ShippedFunction,
    trial: &Trial,
) -> Result<PathRun, Fault> {
    let emitted = shown.function;
    let meaning = emitted.meaning();
    let meaning = meaning.map_err(|fault| Fault::Failed(fault.to_string()))?;
    let half = HalfTrial {
        function: &emitted.function,
        meaning: &meaning,
        values: &trial.values,
        table: trial.table.as_ref(),
    };
    let mut cosines = halves();
    match emitted.method.contract {
        Contract::Kept => cosines.extend(halves_beyond()),
        // Nothing is promised at grazing angles, where most give NaN.
        Contract::Exempt(_) => cosines.retain(|c| *c > 0.1),
    }
    let got = runnable.run(trial, &cosines)?;
    let (want, emulated) = (half.want(&cosines), half.emulated(&cosines));
    let mut result = HalfRun {
        error: HalfError::NONE,
        emulation: HalfError::NONE,
        allowed: match trial.bound {
            Measured::Yes(most) => most + FREEDOM,
            Measured::No(_) => 2.0 * half.error(&halves_of(&cosines)).max_abs,
        },
    };
    let [least, most] = result_range(&cosines, &want);
    for (point, (cos_theta, got)) in cosines.iter().zip(&got).enumerate() {
        for channel in 0..3 {
            let got = f64::from(got[channel]);
            if cos_theta.is_nan() {
                // Any reflectance is right. NaN counts as an infinite error.
                let nearest = got.clamp(least, most);
                result.error.include(got, nearest, *cos_theta);
                continue;
            }
            result
                .error
                .include(got, want.at(point)[channel], *cos_theta);
            let rounded = emulated.at(point)[channel].to_f64();
            result.emulation.include(got, rounded, *cos_theta);
        }
    }
    Ok(PathRun {
        points: cosines.len(),
        share: 1.0,
        result: RunResult::Half(result),
        model_error: emitted.model_error,
        device: runnable.device.clone(),
    })
}

/// The cosines within [0, 1]. Beyond them the emulation has no error of its own, and for NaN none is defined.
fn halves_of(cosines: &[f32]) -> Vec<f32> {
    let inside = |c: &&f32| (0.0..=1.0).contains(*c);
    cosines.iter().filter(inside).copied().collect()
}
