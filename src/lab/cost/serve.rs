//! A worker: opens the compiler that its environment tells, and answers who it is and what it says of shaders.

use std::ffi::CString;
use std::io;

use crate::generator::emit::wgsl_to_spirv;
use crate::lab::gpu::{DeviceFault, GlesCompiler, ModuleEntry, VulkanCompiler};
use crate::lab::process::Inbox;

use super::family::{Dialect, Family, GpuCompiler};
use super::figures::{Statistics, remarked};
use super::probe::{ENTRY, VERTEX, WGSL_VERTEX, gles_vertex};
use super::protocol::{CompilerRequest, CompilerResponse, FragmentShader};

/// A compiler at work.
enum Open {
    Radv(Box<VulkanCompiler>, [CString; 2]),
    Mesa(Box<GlesCompiler>, Dialect),
}

/// Serves until the supervisor is gone.
///
/// # Errors
/// The pipe is gone.
pub fn serve(family: &Family) -> io::Result<()> {
    let inbox = Inbox::open();
    let opened = open(family);
    inbox.serve(|request| match (&opened, request) {
        (Err(fault), _) => CompilerResponse::Absent(fault.to_string()),
        (Ok(open), CompilerRequest::Name) => CompilerResponse::Name(open.compiler()),
        (Ok(open), CompilerRequest::Measure(shader)) => match open.measure(&shader) {
            Ok(statistics) => CompilerResponse::Statistics(statistics),
            Err(why) => CompilerResponse::Refused(why),
        },
    })
}

fn open(family: &Family) -> Result<Open, DeviceFault> {
    match family.compiler {
        GpuCompiler::Radv(_) => {
            let vertex = wgsl_to_spirv(WGSL_VERTEX).expect("the vertex shader is a constant");
            let names = [VERTEX, ENTRY].map(|name| CString::new(name).unwrap_or_default());
            Ok(Open::Radv(Box::new(VulkanCompiler::open(&vertex)?), names))
        }
        GpuCompiler::Mesa { dialect, .. } => {
            let major = if dialect == Dialect::Es100 { 2 } else { 3 };
            Ok(Open::Mesa(Box::new(GlesCompiler::open(major)?), dialect))
        }
        GpuCompiler::Operations | GpuCompiler::None(_) => Err(DeviceFault::Absent {
            what: format!("{} has no compiler", family.name),
            get: "none is needed".to_owned(),
        }),
    }
}

impl Open {
    fn compiler(&self) -> String {
        match self {
            Open::Radv(null, _) => format!("{}, {}", null.driver, null.name),
            Open::Mesa(node, _) => format!("{}, {}", node.driver, node.name),
        }
    }

    fn measure(&self, shader: &FragmentShader) -> Result<Statistics, String> {
        match (self, shader) {
            (Open::Radv(null, [vertex, entry]), shader) => {
                let lowered;
                let module = match shader {
                    FragmentShader::Module(module) => module,
                    FragmentShader::Text(text) => {
                        lowered = wgsl_to_spirv(text)?;
                        &lowered
                    }
                };
                let fragment = ModuleEntry {
                    module,
                    name: entry,
                };
                let told = null.measure(vertex, fragment);
                told.map(Statistics::from_iter)
                    .map_err(|why| why.to_string())
            }
            (Open::Mesa(..), FragmentShader::Module(_)) => {
                Err("it takes GLSL ES, no SPIR-V".to_owned())
            }
            (Open::Mesa(node, dialect), FragmentShader::Text(text)) => {
                let remarks = node
                    .link(&gles_vertex(*dialect), text)
                    .map_err(|why| why.to_string())?;
                let silent = || format!("the driver does not say what became of it: {remarks:?}");
                remarked(&remarks).ok_or_else(silent)
            }
        }
    }
}
