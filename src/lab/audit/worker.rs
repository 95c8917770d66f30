//! The worker that asks compilers about a user's program and runs it: its requests, its responses, and its loop. Numbers are sent
//! as bits, since a function may return NaN. A driver that crashes ends only the worker.

use std::io;

use serde::{Deserialize, Serialize};

use super::compilers::{self, Accepted, ProgramCode};
use super::language::Language;
use crate::generator::emit::validate_wgsl;
use crate::lab::fault::Fault;
use crate::lab::gpu::{self, Argument, Kernel, Program, Uniform, Wanted};
use crate::lab::process::Inbox;
use crate::lab::verify::harness::ENTRY;
use crate::lab::verify::run::Devices;
use crate::physics::num::Precision;

/// A request to a worker.
#[derive(Debug, Serialize, Deserialize)]
pub enum AuditRequest {
    /// To ask the compilers of a language about a whole program, with this precision of `half`.
    Accept(Language, Precision, String),
    /// To make SPIR-V of a shader.
    Module(Language, Precision, String),
    /// To compile a program.
    Prepare(ProgramCode, Vec<UniformBits>),
    /// To run it over cosines.
    Run(Vec<u32>),
}

/// A worker's answer.
#[derive(Debug, Serialize, Deserialize)]
pub enum AuditResponse {
    /// What the compilers say.
    Accepted(Accepted),
    /// The compiler's output, or why there is none.
    Module(Result<Vec<u8>, Fault>),
    /// It is compiled, for this device.
    Ready(String),
    /// The results.
    Ran(Vec<[u32; 3]>),
    /// Why it cannot be compiled, or has no results.
    NoResult(RunError),
}

/// Why a function has no results.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum RunError {
    /// Something is missing on this machine.
    Absent(String),
    /// A compiler or driver refuses it: its name, and its message.
    Refused(String, String),
    /// It timed out, or crashed its process.
    Failed(String),
}

/// A uniform with its value as bits.
#[derive(Debug, Serialize, Deserialize)]
pub struct UniformBits {
    name: String,
    is_rgb: bool,
    bits: [u32; 3],
}

impl UniformBits {
    /// The form that is sent.
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

    /// The form that is bound.
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
            AuditResponse::Accepted(compilers::accepted(language, precision, program))
        }
        AuditRequest::Module(language, precision, shader) => {
            AuditResponse::Module(compilers::module(language, precision, &shader))
        }
        AuditRequest::Prepare(code, values) => {
            let uniforms: Vec<Uniform> = values.iter().map(UniformBits::uniform).collect();
            match prepare(&devices, &code, &uniforms) {
                Ok((kernel, device)) => {
                    ready = Some((kernel, uniforms));
                    AuditResponse::Ready(device)
                }
                Err(error) => AuditResponse::NoResult(error),
            }
        }
        AuditRequest::Run(bits) => run(ready.as_ref(), &bits),
    })
}

fn prepare(
    devices: &Devices,
    code: &ProgramCode,
    uniforms: &[Uniform],
) -> Result<(Kernel, String), RunError> {
    if let ProgramCode::Wgsl(text) = code {
        validate_wgsl(text).map_err(|words| RunError::Refused("naga".to_owned(), words))?;
    }
    let device = match code {
        ProgramCode::Gles(_) => devices.gles(),
        ProgramCode::Wgsl(_) | ProgramCode::Spirv(_) => devices.compute(),
    };
    let device = device.map_err(|fault| RunError::Absent(fault.to_string()))?;
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
        Err(fault) => Err(run_error(&name, fault)),
    }
}

fn run_error(who: &str, fault: Fault) -> RunError {
    match fault {
        Fault::Absent(why) => RunError::Absent(why),
        Fault::Failed(words) => RunError::Refused(who.to_owned(), words),
    }
}

fn run(ready: Option<&(Kernel, Vec<Uniform>)>, bits: &[u32]) -> AuditResponse {
    let Some((kernel, uniforms)) = ready else {
        let why = "there is nothing to run".to_owned();
        return AuditResponse::NoResult(RunError::Absent(why));
    };
    let cosines: Vec<f32> = bits.iter().copied().map(f32::from_bits).collect();
    match kernel.run(&cosines, uniforms, None) {
        Ok(results) => {
            AuditResponse::Ran(results.iter().map(|rgb| rgb.map(f32::to_bits)).collect())
        }
        Err(fault) => AuditResponse::NoResult(run_error("the device", fault)),
    }
}
