//! A worker: compiles the program that it is handed, and runs it. What a user's text does to a driver ends with it.

use std::io::{self, Write};

use crate::emit::validate_wgsl;
use crate::gpu::{self, Kernel, Program, Uniform, Wanted};
use crate::process::Inbox;
use crate::verify::harness::ENTRY;
use crate::verify::run::Devices;

use super::accept;
use super::job::{Asked, Code, Said};

/// Serves until there is nothing more to read.
///
/// # Errors
/// The pipe is gone.
pub fn serve() -> io::Result<()> {
    let (input, mut output) = (Inbox::open(), io::stdout().lock());
    let devices = Devices::new(Wanted::default());
    let mut ready: Option<(Kernel, Vec<Uniform>)> = None;
    for line in input {
        let said = match serde_json::from_str(&line) {
            Ok(Asked::Accept(language, program)) => {
                Said::Accepted(accept::accepted(language, program))
            }
            Ok(Asked::Module(language, shader)) => Said::Module(accept::module(language, &shader)),
            Ok(Asked::Prepare(code, values)) => {
                let uniforms: Vec<Uniform> = values.iter().map(|value| value.uniform()).collect();
                match prepare(&devices, &code, &uniforms) {
                    Ok((kernel, device)) => {
                        ready = Some((kernel, uniforms));
                        Said::Ready(device)
                    }
                    Err(said) => said,
                }
            }
            Ok(Asked::Run(bits)) => run(ready.as_ref(), &bits),
            Err(why) => Said::Refused("the worker".to_owned(), why.to_string()),
        };
        writeln!(output, "{}", serde_json::to_string(&said)?)?;
        output.flush()?;
    }
    Ok(())
}

fn prepare(devices: &Devices, code: &Code, uniforms: &[Uniform]) -> Result<(Kernel, String), Said> {
    if let Code::Wgsl(text) = code {
        validate_wgsl(text).map_err(|words| Said::Refused("naga".to_owned(), words))?;
    }
    let device = match code {
        Code::Gles(_) => devices.gles(),
        Code::Wgsl(_) | Code::Spirv(_) => devices.compute(),
    };
    let device = device.map_err(|fault| Said::Absent(fault.to_string()))?;
    let (code, entry) = match code {
        Code::Wgsl(text) => (gpu::Code::Wgsl(text), ENTRY),
        Code::Gles(text) => (gpu::Code::Gles(text), "main"),
        Code::Spirv(bytes) => (gpu::Code::Spirv(bytes), ENTRY),
    };
    let program = Program {
        code,
        entry,
        uniforms,
        textured: false,
    };
    let name = device.adapter.to_string();
    match device.prepare(&program) {
        Ok(kernel) => Ok((kernel, name)),
        Err(fault) => Err(said(&name, &fault)),
    }
}

fn said(who: &str, fault: &gpu::Fault) -> Said {
    match fault {
        gpu::Fault::Absent { .. } | gpu::Fault::Unable { .. } => Said::Absent(fault.to_string()),
        _ => Said::Refused(who.to_owned(), fault.to_string()),
    }
}

fn run(ready: Option<&(Kernel, Vec<Uniform>)>, bits: &[u32]) -> Said {
    let Some((kernel, uniforms)) = ready else {
        return Said::Absent("there is nothing to run".to_owned());
    };
    let cosines: Vec<f32> = bits.iter().copied().map(f32::from_bits).collect();
    match kernel.run(&cosines, uniforms, None) {
        Ok(results) => Said::Ran(results.iter().map(|rgb| rgb.map(f32::to_bits)).collect()),
        Err(fault) => said("the device", &fault),
    }
}
