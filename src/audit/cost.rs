//! What a user's function costs, by the compilers of GPUs: the slope of a chain of it, less the empty function's, as ours.

use core::time::Duration;
use std::ffi::OsString;

use crate::cost::{Compiler, Dialect, ENTRY, Family, Figures, Probe, Statistics, figures, foreign};
use crate::cost::{Said, environment, reason};
use crate::num::Precision;
use crate::process::Surroundings;
use crate::process::Worker;
use crate::verify::compilers::Fault;
use crate::verify::second;

use super::compile::Compilers;
use super::error::Error;
use super::language::Language;
use super::place::placed;
use super::program::Program;

/// The cost of a function on a family, or why it is not known.
#[derive(Clone, Debug)]
pub struct Cost {
    /// The family.
    pub family: &'static Family,
    /// The compiler with its version, where one spoke.
    pub compiler: Option<String>,
    /// What is known, or why nothing is.
    pub figures: Result<Figures, String>,
}

/// What a compiler is handed: a line of JSON.
type Line = String;

/// Asks the compiler of a family.
///
/// # Errors
/// No process can be started.
pub fn cost(
    program: &Program,
    family: &'static Family,
    compilers: &Compilers,
    limit: Duration,
    surroundings: &Surroundings,
) -> Result<Cost, Error> {
    let unknown = |why: String| Cost {
        family,
        compiler: None,
        figures: Err(why),
    };
    let (Some(dialect), Ok(environment)) =
        (family.compiler.dialect(), environment(family, surroundings))
    else {
        return Ok(unknown(absent(family, surroundings)));
    };
    let lines = match lines(program, dialect, compilers)? {
        Ok(lines) => lines,
        Err(why) => return Ok(unknown(why)),
    };
    let words = ["cost", "--worker", family.name].map(OsString::from);
    let mut worker = Worker::start(&words, &environment, surroundings)?;
    let mut ask = |line: &str| {
        let said = worker.ask::<Said>(line, limit);
        said.map_err(|silence| reason(&silence, limit))
    };
    let compiler = match ask("").and_then(Said::compiler) {
        Ok(name) => name,
        Err(why) => return Ok(unknown(why)),
    };
    let told = lines
        .iter()
        .map(|line| ask(line).and_then(Said::statistics));
    let told: Result<Vec<Statistics>, String> = told.collect();
    Ok(Cost {
        family,
        compiler: Some(compiler),
        figures: told.and_then(|told| counted(family, dialect, told)),
    })
}

/// The figures of four shaders: both chains of the function, both of the empty one.
fn counted(family: &Family, dialect: Dialect, told: Vec<Statistics>) -> Result<Figures, String> {
    let silent = || "the compiler does not tell instructions".to_owned();
    let [short, long, bare_short, bare_long] =
        <[Statistics; 4]>::try_from(told).map_err(|_| silent())?;
    let (own, bare) = ([short, long], [bare_short, bare_long]);
    figures(&family.columns, dialect.chains(), &own, &bare).ok_or_else(silent)
}

fn absent(family: &Family, surroundings: &Surroundings) -> String {
    match family.compiler {
        Compiler::Operations => "operations are counted in formulas, and this is text".to_owned(),
        Compiler::None(why) => why.to_owned(),
        _ => environment(family, surroundings).err().unwrap_or_default(),
    }
}

/// The four shaders as the worker takes them.
fn lines(
    program: &Program,
    dialect: Dialect,
    compilers: &Compilers,
) -> Result<Result<Vec<Line>, String>, Error> {
    let chains = dialect.chains();
    let own = chains.map(|evaluations| shader(program, dialect, evaluations));
    let bare = chains.map(|evaluations| empty(program.language, dialect, evaluations));
    let mut lines = Vec::new();
    // What a compiler did not end for once is not asked again.
    for made in own.into_iter().chain(bare) {
        match made {
            Ok(Shader::Line(line)) => lines.push(line),
            Ok(Shader::Text(language, text)) => match module(compilers.module(language, text)?) {
                Ok(line) => lines.push(line),
                Err(why) => return Ok(Err(why)),
            },
            Err(why) => return Ok(Err(why)),
        }
    }
    Ok(Ok(lines))
}

/// A shader that is measured.
enum Shader {
    /// As the worker takes it.
    Line(Line),
    /// As a compiler makes a module of it.
    Text(Language, String),
}

fn text(shader: &str) -> Result<Shader, String> {
    let line = serde_json::to_string(shader);
    line.map(Shader::Line).map_err(|why| why.to_string())
}

/// A module, or why there is none.
fn module(made: Result<Vec<u8>, Fault>) -> Result<Line, String> {
    let bytes = made.map_err(|fault| match fault {
        Fault::NotChecked(why) => why,
        Fault::Refused(words) => placed("the shader that is measured", usize::MAX, &words),
    })?;
    serde_json::to_string(&bytes).map_err(|why| why.to_string())
}

/// What stands before GLSL ES that may leave precision to the program around it.
const PRECISION: &str = "precision highp float;\n";

fn shader(program: &Program, dialect: Dialect, evaluations: usize) -> Result<Shader, String> {
    let Program {
        language,
        text: own,
        params,
        ..
    } = program;
    match (language, dialect) {
        (Language::Wgsl, _) => {
            let probe = Probe::of_text(params.clone(), own.clone(), String::new());
            wgsl(&probe, dialect, evaluations)
        }
        (Language::Gles, Dialect::Wgsl) => {
            let own = format!("{PRECISION}{own}");
            let shader = foreign::glsl(&own, params, evaluations);
            Ok(Shader::Text(Language::Gles, shader))
        }
        (Language::Gles, _) => {
            let own = format!("{PRECISION}{own}");
            let probe = Probe::of_text(params.clone(), String::new(), own);
            text(&probe.text(evaluations, dialect))
        }
        (Language::Hlsl, Dialect::Wgsl) => Ok(Shader::Text(
            Language::Hlsl,
            foreign::hlsl(own, params, evaluations),
        )),
        (Language::Hlsl, _) => Err("it takes GLSL ES, which nothing here makes of HLSL".to_owned()),
    }
}

fn empty(language: Language, dialect: Dialect, evaluations: usize) -> Result<Shader, String> {
    let probe = Probe::empty(false, Precision::F32);
    let none = [crate::ir::Param {
        name: "cos_theta".to_owned(),
        ty: crate::ir::Ty::Scalar,
    }];
    match (language, dialect) {
        (Language::Wgsl, _) => wgsl(&probe, dialect, evaluations),
        (Language::Gles, Dialect::Wgsl) => Ok(Shader::Text(
            Language::Gles,
            foreign::glsl(foreign::EMPTY_GLSL, &none, evaluations),
        )),
        (Language::Hlsl, Dialect::Wgsl) => Ok(Shader::Text(
            Language::Hlsl,
            foreign::hlsl(foreign::EMPTY_HLSL, &none, evaluations),
        )),
        (Language::Gles | Language::Hlsl, _) => text(&probe.text(evaluations, dialect)),
    }
}

/// WGSL itself, or naga's GLSL ES of it.
fn wgsl(probe: &Probe, dialect: Dialect, evaluations: usize) -> Result<Shader, String> {
    let own = probe.text(evaluations, Dialect::Wgsl);
    match dialect {
        Dialect::Wgsl => text(&own),
        Dialect::Es100 => Err("it takes GLSL ES 1.00, which nothing here makes of WGSL".to_owned()),
        Dialect::Es300 => {
            let made = second::to_gles(&own, ENTRY).map_err(|fault| fault.to_string())?;
            let input = made.inputs.get(&0).map_or("fg_in", String::as_str);
            text(&unblocked(&made.text.replace(input, "fg_in")))
        }
    }
}

/// Arguments as our own shaders have them: naga puts them in a block, which is read from memory.
fn unblocked(text: &str) -> String {
    let line = |line: &str| {
        let inside = line
            .strip_prefix("layout(std140) uniform ")
            .and_then(|rest| rest.split_once('{'))
            .and_then(|(_, rest)| rest.split_once('}'));
        inside.map_or_else(|| line.to_owned(), |(inside, _)| format!("uniform{inside}"))
    };
    let lines: Vec<String> = text.lines().map(line).collect();
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::unblocked;

    #[test]
    fn a_block_becomes_a_uniform() {
        let text = "layout(std140) uniform B_block_0Fragment { B _group_0[8]; };\nvoid main() {}\n";
        assert_eq!(unblocked(text), "uniform B _group_0[8]; \nvoid main() {}\n");
    }
}
