//! A user's function run in a process of its own, within a time.
//!
//! What a worker is asked about a user's function, and what it answers. Numbers go as bits: what is run may give NaN.
//!
//! A worker: compiles the program that it is handed, and runs it. A driver that crashes ends only this process.

use core::cell::{Cell, OnceCell, RefCell};
use core::time::Duration;
use std::io;

use serde::{Deserialize, Serialize};

use super::choose::{self, Accepted};
use super::condition::Language;
use super::cosine::CosineForm;
use super::loops::{MARK, TURNS};
use crate::generator::emit::validate_wgsl;
use crate::generator::fit::{ModelError, Perceived, error_of, perceived};
use crate::generator::reference::ReferenceCurve;
use crate::lab::gpu::{self, Argument, Kernel, Program, Uniform, Wanted};
use crate::lab::process::{Error, Inbox, Launch, Silence, Surroundings, Worker};
use crate::lab::verify::compilers::CompilerFault;
use crate::lab::verify::harness::ENTRY;
use crate::lab::verify::run::Devices;
use crate::language::ir::{Column, Value};
use crate::physics::num::{Precision, each_channel};
use crate::physics::spectra::Space;

/// What sees cosines, and the result at each.
pub type Look<'a> = &'a dyn Fn(&[f32], &[[f32; 3]]);

/// Why there are no results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// Something is missing here.
    Absent(String),
    /// It is not accepted: by whom, and in which words.
    Refused(String, String),
    /// It does not end, or took its process down.
    Failed(String),
}

/// A process that has the function compiled.
pub struct Runner {
    worker: RefCell<Worker>,
    limit: Duration,
    /// What the function takes for a cosine.
    form: CosineForm,
    /// On what it runs.
    pub device: String,
    /// At how many cosines it has run.
    pub points: Cell<usize>,
}

fn reason(silence: &Silence, limit: Duration) -> Trouble {
    Trouble::Failed(match silence {
        Silence::TooLong => format!(
            "it did not end within {} s: a loop without end, or more work than --limit allows",
            limit.as_secs()
        ),
        Silence::Ended(status) => {
            format!(
                "the process that ran it ended ({status}): its compiler or driver fell over this text"
            )
        }
    })
}

fn unprepared(silence: &Silence, limit: Duration) -> String {
    match silence {
        Silence::TooLong => format!(
            "the driver's compiler did not end within {} s, which is all that --limit allows",
            limit.as_secs()
        ),
        Silence::Ended(status) => {
            format!("the process that compiles it for the driver ended ({status})")
        }
    }
}

impl Runner {
    /// Starts a process and has it compile a program.
    ///
    /// # Errors
    /// No process can be started.
    pub fn start(
        code: ProgramCode,
        uniforms: &[Uniform],
        form: CosineForm,
        limit: Duration,
        surroundings: &Surroundings,
    ) -> Result<Result<Runner, Trouble>, Error> {
        let mut worker = Worker::new(Launch::new(&["audit", "--worker"], surroundings));
        let uniforms = uniforms.iter().map(UniformBits::new);
        let request = AuditRequest::Prepare(code, uniforms.collect());
        Ok(match worker.ask(&request, limit)? {
            Ok(AuditResponse::Ready(device)) => Ok(Runner {
                worker: RefCell::new(worker),
                limit,
                form,
                device,
                points: Cell::new(0),
            }),
            Ok(response) => Err(trouble(response)),
            // Nothing of the function has run: its compiler, its driver or the machine may be at fault.
            Err(silence) => Err(Trouble::Absent(unprepared(&silence, limit))),
        })
    }

    /// The results at these cosines.
    pub fn run(&self, cosines: &[f32]) -> Result<Vec<[f32; 3]>, Trouble> {
        self.run_as(self.form, cosines)
    }

    /// The same where the function takes this for a cosine.
    pub fn run_as(&self, form: CosineForm, cosines: &[f32]) -> Result<Vec<[f32; 3]>, Trouble> {
        let taken = cosines.iter().map(|c| form.value_at(*c).to_bits());
        let request = AuditRequest::Run(taken.collect());
        let response = self.worker.borrow_mut().ask(&request, self.limit);
        let response = response.map_err(|error| Trouble::Failed(error.to_string()))?;
        match response.map_err(|silence| reason(&silence, self.limit))? {
            AuditResponse::Ran(results) if results.len() == cosines.len() => {
                self.points.set(self.points.get() + cosines.len());
                let results = results.into_iter().map(|rgb| rgb.map(f32::from_bits));
                ended(cosines, results.collect())
            }
            other => Err(trouble(other)),
        }
    }

    /// The error against the reference. `look` sees every cosine with its result.
    pub fn error(&self, reference: &ReferenceCurve, look: Look) -> Result<ModelError, Trouble> {
        self.measured(self.form, look, |values| error_of(reference, values))
    }

    /// The same where the function takes this for a cosine.
    pub fn error_as(
        &self,
        form: CosineForm,
        reference: &ReferenceCurve,
    ) -> Result<ModelError, Trouble> {
        self.measured(form, &|_, _| {}, |values| error_of(reference, values))
    }

    /// The error as it is seen.
    pub fn perceived(
        &self,
        reference: &ReferenceCurve,
        space: Space,
    ) -> Result<Perceived, Trouble> {
        self.measured(self.form, &|_, _| {}, |values| {
            perceived(reference, space, values)
        })
    }

    /// What is measured of its values.
    fn measured<T>(
        &self,
        form: CosineForm,
        look: Look,
        measure: impl FnOnce(&dyn Fn(&[f64]) -> Value<f64>) -> T,
    ) -> Result<T, Trouble> {
        let failed: OnceCell<Trouble> = OnceCell::new();
        let measured = measure(&|cosines| {
            let single: Vec<f32> = cosines.iter().map(|c| *c as f32).collect();
            let nothing = || vec![[f32::NAN; 3]; single.len()];
            // What has failed once is not asked again: each wait takes its time.
            let got = match failed.get() {
                Some(_) => nothing(),
                None => self.run_as(form, &single).unwrap_or_else(|trouble| {
                    let _ = failed.set(trouble);
                    nothing()
                }),
            };
            if failed.get().is_none() {
                look(&single, &got);
            }
            let channel =
                |i: usize| Column::Each(got.iter().map(|rgb| f64::from(rgb[i])).collect());
            Value::Rgb(each_channel(channel))
        });
        failed.into_inner().map_or(Ok(measured), Err)
    }
}

/// The results, unless a loop has not ended at one of them.
fn ended(cosines: &[f32], results: Vec<[f32; 3]>) -> Result<Vec<[f32; 3]>, Trouble> {
    let endless = results.iter().position(|rgb| *rgb == [MARK; 3]);
    endless.map_or(Ok(results), |at| {
        let cosine = cosines[at];
        Err(Trouble::Failed(format!(
            "at cos_theta = {cosine:?} its loops have not ended after {TURNS} turns"
        )))
    })
}

fn trouble(response: AuditResponse) -> Trouble {
    match response {
        AuditResponse::Absent(why) => Trouble::Absent(why),
        AuditResponse::Refused(who, words) => Trouble::Refused(who, words),
        _ => Trouble::Failed("it answers another question".to_owned()),
    }
}

/// What a worker is asked.
#[derive(Debug, Serialize, Deserialize)]
pub enum AuditRequest {
    /// To ask the compilers of a language about a whole program whose `half` computes in this.
    Accept(Language, Precision, String),
    /// To make SPIR-V of a shader.
    Module(Language, Precision, String),
    /// To compile a program.
    Prepare(ProgramCode, Vec<UniformBits>),
    /// To run it over cosines.
    Run(Vec<u32>),
}

/// What a worker answers.
#[derive(Debug, Serialize, Deserialize)]
pub enum AuditResponse {
    /// What the compilers say.
    Accepted(Accepted),
    /// What the compiler has made, or why it has not.
    Module(Result<Vec<u8>, CompilerFault>),
    /// It is compiled, for this device.
    Ready(String),
    /// Something is missing here.
    Absent(String),
    /// A compiler refused it, or the device failed: its name, and its message.
    Refused(String, String),
    /// The results.
    Ran(Vec<[u32; 3]>),
}

/// A program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum ProgramCode {
    /// In WGSL.
    Wgsl(String),
    /// In GLSL ES 3.00.
    Gles(String),
    /// A module that DXC or slangc has made.
    Spirv(Vec<u8>),
}

/// A uniform with its value as bits.
#[derive(Debug, Serialize, Deserialize)]
pub struct UniformBits {
    name: String,
    is_rgb: bool,
    bits: [u32; 3],
}

impl UniformBits {
    /// As it is sent.
    pub fn new(uniform: &Uniform) -> UniformBits {
        let (is_rgb, value) = match uniform.value {
            Argument::Rgb(value) => (true, value),
            Argument::Scalar(value) => (false, [value; 3]),
        };
        UniformBits {
            name: uniform.name.clone(),
            is_rgb,
            bits: value.map(f32::to_bits),
        }
    }

    /// As it is bound.
    pub fn uniform(&self) -> Uniform {
        let value = self.bits.map(f32::from_bits);
        Uniform {
            name: self.name.clone(),
            value: if self.is_rgb {
                Argument::Rgb(value)
            } else {
                Argument::Scalar(value[0])
            },
        }
    }
}

/// Serves until the supervisor is gone.
///
/// # Errors
/// The pipe is gone.
pub fn serve() -> io::Result<()> {
    let (inbox, devices) = (Inbox::open(), Devices::new(Wanted::default()));
    let mut ready: Option<(Kernel, Vec<Uniform>)> = None;
    inbox.serve(|request| match request {
        AuditRequest::Accept(language, precision, program) => {
            AuditResponse::Accepted(choose::accepted(language, precision, program))
        }
        AuditRequest::Module(language, precision, shader) => {
            AuditResponse::Module(choose::module(language, precision, &shader))
        }
        AuditRequest::Prepare(code, values) => {
            let uniforms: Vec<Uniform> = values.iter().map(UniformBits::uniform).collect();
            match prepare(&devices, &code, &uniforms) {
                Ok((kernel, device)) => {
                    ready = Some((kernel, uniforms));
                    AuditResponse::Ready(device)
                }
                Err(refusal) => refusal,
            }
        }
        AuditRequest::Run(bits) => run(ready.as_ref(), &bits),
    })
}

fn prepare(
    devices: &Devices,
    code: &ProgramCode,
    uniforms: &[Uniform],
) -> Result<(Kernel, String), AuditResponse> {
    if let ProgramCode::Wgsl(text) = code {
        validate_wgsl(text).map_err(|words| AuditResponse::Refused("naga".to_owned(), words))?;
    }
    let device = match code {
        ProgramCode::Gles(_) => devices.gles(),
        ProgramCode::Wgsl(_) | ProgramCode::Spirv(_) => devices.compute(),
    };
    let device = device.map_err(|fault| AuditResponse::Absent(fault.to_string()))?;
    let (code, entry) = match code {
        ProgramCode::Wgsl(text) => (gpu::ShaderCode::Wgsl(text), ENTRY),
        ProgramCode::Gles(text) => (gpu::ShaderCode::Gles(text), "main"),
        ProgramCode::Spirv(bytes) => (gpu::ShaderCode::Spirv(bytes), ENTRY),
    };
    let program = Program {
        code,
        entry,
        uniforms,
        texture: None,
    };
    let name = device.adapter.to_string();
    match device.prepare(&program) {
        Ok(kernel) => Ok((kernel, name)),
        Err(fault) => Err(refusal(&name, &fault)),
    }
}

fn refusal(who: &str, fault: &gpu::DeviceFault) -> AuditResponse {
    match fault {
        gpu::DeviceFault::Absent { .. } | gpu::DeviceFault::Unable { .. } => {
            AuditResponse::Absent(fault.to_string())
        }
        _ => AuditResponse::Refused(who.to_owned(), fault.to_string()),
    }
}

fn run(ready: Option<&(Kernel, Vec<Uniform>)>, bits: &[u32]) -> AuditResponse {
    let Some((kernel, uniforms)) = ready else {
        return AuditResponse::Absent("there is nothing to run".to_owned());
    };
    let cosines: Vec<f32> = bits.iter().copied().map(f32::from_bits).collect();
    match kernel.run(&cosines, uniforms, None) {
        Ok(results) => {
            AuditResponse::Ran(results.iter().map(|rgb| rgb.map(f32::to_bits)).collect())
        }
        Err(fault) => refusal("the device", &fault),
    }
}
