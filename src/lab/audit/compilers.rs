//! What every compiler of a language says of a program around a user's text, and the SPIR-V that they make of it.

use serde::{Deserialize, Serialize};

use super::language::Language;
use crate::lab::fault::Fault;
use crate::lab::verify::compilers::{HlslVersion, Verdict, compiled, hlsl_to_spirv, is_here};
use crate::lab::verify::harness::ENTRY;
use crate::language::targets::{Compiler, DXC, GLSLANG, WGSL};
use crate::physics::num::Precision;

/// What compilers that are programs of their own say.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Accepted {
    /// Each compiler with its verdict.
    pub verdicts: Vec<(String, Verdict)>,
    /// The code to run, or why there is none.
    pub code: Result<ProgramCode, Fault>,
}

/// A program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum ProgramCode {
    /// In WGSL.
    Wgsl(String),
    /// In GLSL ES 3.00.
    Gles(String),
    /// A module that an external compiler has made.
    Spirv(Vec<u8>),
}

/// The independent compiler of a language, by name.
pub fn compiler_name(language: Language) -> &'static str {
    match language {
        Language::Wgsl => "tint",
        Language::Gles | Language::Glsl => GLSLANG.name,
        Language::Hlsl => DXC.name,
        Language::Slang => SLANGC.name,
    }
}

/// Asks the compilers about a whole program.
pub fn accepted(language: Language, precision: Precision, program: String) -> Accepted {
    match language {
        Language::Wgsl => Accepted {
            verdicts: tint(&program).into_iter().collect(),
            code: Ok(ProgramCode::Wgsl(program)),
        },
        Language::Gles => {
            let made = compiled(&GLSLANG, "-S vert FILE", "shader.vert", &program);
            Accepted {
                verdicts: vec![(GLSLANG.name.to_owned(), made.map(drop))],
                code: Ok(ProgramCode::Gles(program)),
            }
        }
        Language::Glsl => {
            let made = compiled(&GLSLANG, &desktop_options(), "shader.comp", &program);
            Accepted {
                verdicts: vec![(GLSLANG.name.to_owned(), made.clone().map(drop))],
                code: made.map(ProgramCode::Spirv),
            }
        }
        Language::Hlsl => hlsl(precision, &program),
        Language::Slang => {
            let made = slang(&program, "compute");
            Accepted {
                verdicts: vec![(SLANGC.name.to_owned(), made.clone().map(drop))],
                code: made.map(ProgramCode::Spirv),
            }
        }
    }
}

/// The verdict of Tint, Chrome's compiler, with the options of the target.
fn tint(program: &str) -> Option<(String, Verdict)> {
    let tint = WGSL
        .validators
        .iter()
        .find(|one| one.compiler.command.is_some())?;
    let compiler: &Compiler = tint.compiler;
    let made = compiled(compiler, tint.options, "shader.wgsl", program);
    Some((compiler.name.to_owned(), made.map(drop)))
}

/// The verdict of DXC with both versions of HLSL. A text may be for either one. If both accept it, the older one is run. Where DXC is
/// not here, glslang reads the text, without types of 16 bits.
fn hlsl(precision: Precision, program: &str) -> Accepted {
    let made = |version| hlsl_to_spirv(precision, program, ENTRY, version);
    if let Some(module) = hlsl_without_dxc(precision, program, "comp") {
        return Accepted {
            verdicts: vec![("glslang (dxc is not here)".to_owned(), Ok(()))],
            code: Ok(ProgramCode::Spirv(module)),
        };
    }
    let (old, new) = (made(HlslVersion::V2018), made(HlslVersion::V2021));
    let verdicts: &[(&str, &Result<Vec<u8>, Fault>)] = match (&old, &new) {
        (Ok(_), Err(Fault::Failed(_))) => &[("dxc -HV 2018 (2021 refuses it)", &old)],
        (Err(Fault::Failed(_)), Ok(_)) => &[("dxc -HV 2021 (2018 refuses it)", &new)],
        _ => &[("dxc -HV 2018", &old), ("dxc -HV 2021", &new)],
    };
    let verdicts = verdicts.iter();
    let verdicts = verdicts.map(|(name, made)| ((*name).to_owned(), (*made).clone().map(drop)));
    let verdicts = verdicts.collect();
    let code = old.or_else(|fault| new.map_err(|_| fault));
    Accepted {
        verdicts,
        code: code.map(ProgramCode::Spirv),
    }
}

/// The SPIR-V of a shader whose cost is measured.
///
/// # Errors
/// The compiler is not here, or refuses it.
pub fn module(language: Language, precision: Precision, text: &str) -> Result<Vec<u8>, Fault> {
    match language {
        Language::Hlsl => pixel(precision, text),
        Language::Slang => slang(text, "fragment"),
        Language::Gles | Language::Glsl | Language::Wgsl => fragment(text),
    }
}

/// A shader of a stage in HLSL as SPIR-V by glslang, where DXC is not here. glslang knows no types of 16 bits and nothing of HLSL 2021, so
/// what it refuses is not checked: none.
fn hlsl_without_dxc(precision: Precision, text: &str, stage: &str) -> Option<Vec<u8>> {
    if is_here(&DXC) || precision == Precision::F16 {
        return None;
    }
    let options = format!(
        "-D -V --target-env vulkan1.1 -D__HLSL_VERSION=2018 -S {stage} -e {ENTRY} -o OUT FILE"
    );
    compiled(&GLSLANG, &options, "shader.hlsl", text).ok()
}

/// glslang's options for the SPIR-V of a compute shader.
fn desktop_options() -> String {
    format!("-V --target-env vulkan1.1 -S comp -e {ENTRY} --source-entrypoint main -o OUT FILE")
}

/// Khronos's compiler of Slang.
static SLANGC: Compiler = Compiler {
    name: "slangc",
    command: Some("slangc"),
    get: "https://github.com/shader-slang/slang/releases",
};

/// A shader of a stage in Slang as SPIR-V.
///
/// # Errors
/// slangc is not here, or refuses it.
fn slang(text: &str, stage: &str) -> Result<Vec<u8>, Fault> {
    let options =
        format!("FILE -target spirv -stage {stage} -entry {ENTRY} -fvk-use-entrypoint-name -o OUT");
    compiled(&SLANGC, &options, "shader.slang", text)
}

/// A pixel shader in HLSL as SPIR-V, by glslang where DXC is not here.
///
/// # Errors
/// DXC is not here, or refuses it.
fn pixel(precision: Precision, text: &str) -> Result<Vec<u8>, Fault> {
    let model = match precision {
        Precision::F32 => "ps_6_0",
        Precision::F16 => "ps_6_2 -enable-16bit-types",
    };
    let made = |version: usize| {
        let options = format!(
            "-T {model} -E {ENTRY} -HV {version} -no-warnings -spirv -fspv-target-env=vulkan1.1 -Fo OUT FILE"
        );
        compiled(&DXC, &options, "shader.hlsl", text)
    };
    if let Some(module) = hlsl_without_dxc(precision, text, "frag") {
        return Ok(module);
    }
    made(2018).or_else(|fault| made(2021).map_err(|_| fault))
}

/// A fragment shader in GLSL 4.50 as SPIR-V.
///
/// # Errors
/// glslang is not here, or refuses it.
fn fragment(text: &str) -> Result<Vec<u8>, Fault> {
    let options = format!("-V -S frag -e {ENTRY} --source-entrypoint main -o OUT FILE");
    compiled(&GLSLANG, &options, "shader.frag", text)
}
