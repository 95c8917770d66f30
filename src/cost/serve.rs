//! A worker: opens the compiler that its environment tells, and answers each shader with what the compiler says.

use std::ffi::CString;
use std::io::{self, Write};

use serde::Deserialize;
use serde_json::json;

use crate::cost::{Compiler, Dialect, ENTRY, Family, Statistics, VERTEX, WGSL_VERTEX};
use crate::cost::{gles_vertex, remarked};
use crate::emit::wgsl_to_spirv;
use crate::gpu::{Entry, Fault, Node, Null};
use crate::process::Inbox;

/// A compiler at work.
enum Open {
    Radv(Box<Null>, [CString; 2]),
    Mesa(Box<Node>, Dialect),
}

/// A fragment shader.
#[derive(Deserialize)]
#[serde(untagged)]
enum Shader {
    /// In the compiler's language, or in WGSL for one that takes SPIR-V.
    Text(String),
    /// A module of SPIR-V.
    Module(Vec<u8>),
}

/// Serves until there is nothing more to read: a line of JSON, a fragment shader as text or as the bytes of a module, is
/// answered by a line. The first line says who answers, whatever is asked.
///
/// # Errors
/// The family has no compiler, or the pipe is gone.
pub fn serve(family: &Family) -> io::Result<()> {
    let (mut input, mut output) = (Inbox::open(), io::stdout().lock());
    let mut answer = |value: serde_json::Value| {
        writeln!(output, "{value}")?;
        output.flush()
    };
    let opened = open(family);
    let hello = match &opened {
        Ok(open) => json!({ "compiler": open.compiler() }),
        Err(fault) => json!({ "absent": fault.to_string() }),
    };
    let _ = input.next();
    answer(hello)?;
    let Ok(open) = opened else { return Ok(()) };
    for line in input {
        let told = serde_json::from_str::<Shader>(&line)
            .map_err(|why| why.to_string())
            .and_then(|shader| open.measure(&shader));
        answer(match told {
            Ok(statistics) => json!({ "told": statistics }),
            Err(why) => json!({ "refused": why }),
        })?;
    }
    Ok(())
}

fn open(family: &Family) -> Result<Open, Fault> {
    match family.compiler {
        Compiler::Radv(_) => {
            let vertex = wgsl_to_spirv(WGSL_VERTEX).expect("the vertex shader is a constant");
            let names = [VERTEX, ENTRY].map(|name| CString::new(name).unwrap_or_default());
            Ok(Open::Radv(Box::new(Null::open(&vertex)?), names))
        }
        Compiler::Mesa { dialect, .. } => {
            let major = if dialect == Dialect::Es100 { 2 } else { 3 };
            Ok(Open::Mesa(Box::new(Node::open(major)?), dialect))
        }
        Compiler::Operations | Compiler::None(_) => Err(Fault::Absent {
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

    fn measure(&self, shader: &Shader) -> Result<Statistics, String> {
        match (self, shader) {
            (Open::Radv(null, [vertex, entry]), shader) => {
                let lowered;
                let module = match shader {
                    Shader::Module(module) => module,
                    Shader::Text(text) => {
                        lowered = wgsl_to_spirv(text)?;
                        &lowered
                    }
                };
                let fragment = Entry {
                    module,
                    name: entry,
                };
                let told = null.measure(vertex, fragment);
                told.map(Statistics::from_iter)
                    .map_err(|why| why.to_string())
            }
            (Open::Mesa(..), Shader::Module(_)) => Err("it takes GLSL ES, no SPIR-V".to_owned()),
            (Open::Mesa(node, dialect), Shader::Text(text)) => {
                let remarks = node
                    .link(&gles_vertex(*dialect), text)
                    .map_err(|why| why.to_string())?;
                let silent = || format!("the driver does not say what became of it: {remarks:?}");
                remarked(&remarks).ok_or_else(silent)
            }
        }
    }
}
