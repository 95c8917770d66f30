//! A worker: compiles the program that it is handed, and runs it. A driver that crashes ends only this process.

use std::io;

use crate::generator::emit::validate_wgsl;
use crate::lab::gpu::{self, Kernel, Program, Uniform, Wanted};
use crate::lab::process::Inbox;
use crate::lab::verify::harness::ENTRY;
use crate::lab::verify::run::Devices;

use super::accept;
use super::protocol::{AuditRequest, AuditResponse, ProgramCode, UniformBits};

/// Serves until the supervisor is gone.
///
/// # Errors
/// The pipe is gone.
pub fn serve() -> io::Result<()> {
    let (inbox, devices) = (Inbox::open(), Devices::new(Wanted::default()));
    let mut ready: Option<(Kernel, Vec<Uniform>)> = None;
    inbox.serve(|request| match request {
        AuditRequest::Accept(language, precision, program) => {
            AuditResponse::Accepted(accept::accepted(language, precision, program))
        }
        AuditRequest::Module(language, precision, shader) => {
            AuditResponse::Module(accept::module(language, precision, &shader))
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
