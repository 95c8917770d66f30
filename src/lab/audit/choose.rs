//! The choice of the function of a file that is audited, and the verdict of every compiler of a language on a program around a
//! user's text.

use serde::{Deserialize, Serialize};

use super::bind::place_of;
use super::condition::Language;
use super::error::Error;
use super::runner::ProgramCode;
use super::scan::{FoundFunction, NumberShape, Parameter};
use crate::lab::fault::Fault;
use crate::lab::verify::compilers::{HlslVersion, Verdict, compiled, hlsl_to_spirv_in};
use crate::lab::verify::harness::ENTRY;
use crate::language::targets::{Compiler, DXC, GLSLANG, WGSL};
use crate::physics::names::UnknownName;
use crate::physics::num::Precision;

/// The function that is audited.
///
/// # Errors
/// There is none of that name, or several where none is named, or it cannot be a reflectance function.
pub fn choose(
    file: &str,
    found: Vec<FoundFunction>,
    name: Option<&str>,
    language: Language,
) -> Result<FoundFunction, Error> {
    let named = match name {
        None => found,
        Some(name) => named(file, &found, name)?,
    };
    let fits = named.iter().filter(|found| found.is_candidate());
    let candidates: Vec<FoundFunction> = fits.cloned().collect();
    match (candidates.as_slice(), name) {
        ([one], _) => Ok(one.clone()),
        ([], Some(_)) => Err(unfit(file, &named[0])),
        ([], None) => match named.iter().find(|found| found.needs_object) {
            Some(found) => Err(unfit(file, found)),
            None => Err(Error::NoReflectance {
                file: file.to_owned(),
            }),
        },
        _ => Err(Error::SeveralFunctions {
            file: file.to_owned(),
            names: told_apart(&candidates, language),
        }),
    }
}

/// The functions of a name, or of a name and a line: `schlick:12`.
fn named(file: &str, found: &[FoundFunction], name: &str) -> Result<Vec<FoundFunction>, Error> {
    let is_number = |line: &str| line.chars().all(|c| c.is_ascii_digit());
    let (name, line) = match name.rsplit_once(':') {
        Some((name, line)) if is_number(line) || !name.ends_with(':') => (name, Some(line)),
        _ => (name, None),
    };
    let of_name = found
        .iter()
        .filter(|found| found.name == name || found.path() == name);
    let of_name: Vec<FoundFunction> = of_name.cloned().collect();
    if of_name.is_empty() {
        let paths: Vec<String> = found.iter().map(FoundFunction::path).collect();
        let mut all: Vec<&str> = paths.iter().map(String::as_str).collect();
        all.dedup();
        return Err(if all.is_empty() {
            Error::NoFunction {
                file: file.to_owned(),
            }
        } else {
            UnknownName::new("function", name, &all).into()
        });
    }
    let Some(line) = line else {
        return Ok(of_name);
    };
    let is_there = |found: &&FoundFunction| line.parse() == Ok(found.line);
    let there: Vec<FoundFunction> = of_name.iter().filter(is_there).cloned().collect();
    if there.is_empty() {
        Err(Error::NoFunctionInLine {
            file: file.to_owned(),
            name: name.to_owned(),
            line: line.to_owned(),
            lines: of_name.iter().map(|found| found.line.to_string()).collect(),
        })
    } else {
        Ok(there)
    }
}

/// Names of functions. A name that several share comes with their lines and typed arguments.
fn told_apart(functions: &[FoundFunction], language: Language) -> Vec<String> {
    let words = |one: &FoundFunction| {
        let is_other = |other: &&FoundFunction| other.path() == one.path();
        if functions.iter().filter(is_other).count() == 1 {
            return one.path();
        }
        let params: Vec<String> = one
            .params
            .iter()
            .map(|param| typed(param, language))
            .collect();
        format!("{}:{} ({})", one.path(), one.line, params.join(", "))
    };
    functions.iter().map(words).collect()
}

/// An argument in the form of this language's function heads.
fn typed(param: &Parameter, language: Language) -> String {
    match language {
        Language::Wgsl => format!("{}: {}", param.name, param.ty),
        _ => format!("{} {}", param.ty, param.name),
    }
}

/// Why a function cannot be a reflectance function.
fn unfit(file: &str, found: &FoundFunction) -> Error {
    let is_other = |shape: &NumberShape| matches!(shape, NumberShape::Other(_));
    let is_open = |param: &&Parameter| is_other(&param.shape) && param.default.is_none();
    let other = found.params.iter().find(is_open);
    let why = if found.needs_object {
        let around = found.scope.last().map_or("", String::as_str);
        return Error::NeedsObject {
            place: place_of(file, found),
            ty: around.to_owned(),
        };
    } else if let Some(param) = other {
        format!("its argument `{}` is `{}`", param.name, param.shape.words())
    } else if is_other(&found.result) {
        format!("it gives `{}`", found.result.words())
    } else {
        "it takes no single number, which the cosine is".to_owned()
    };
    Error::Unfit {
        place: place_of(file, found),
        why,
    }
}

/// What compilers that are programs of their own say.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Accepted {
    /// Each compiler with its verdict.
    pub verdicts: Vec<(String, Verdict)>,
    /// The code to run, or why there is none.
    pub code: Result<ProgramCode, Fault>,
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

/// The verdict of DXC with both versions of HLSL. A text may be for either one. If both accept it, the older one is run.
fn hlsl(precision: Precision, program: &str) -> Accepted {
    let made = |version| hlsl_to_spirv_in(precision, program, ENTRY, version);
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

/// glslang's options for the SPIR-V of a compute shader.
fn desktop_options() -> String {
    format!("-V --target-env vulkan1.1 -S comp -e {ENTRY} --source-entrypoint main -o OUT FILE")
}

/// Khronos's compiler of Slang.
pub static SLANGC: Compiler = Compiler {
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

/// A pixel shader in HLSL as SPIR-V.
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
