//! The cost of a user's function by the compilers of GPUs, and its form in the report. It is measured as for our functions: what
//! further evaluations in a chain add, less what they add for the empty function.

use core::time::Duration;

use serde::Serialize;

use super::compile::{Compilers, placed};
use super::language::Language;
use super::program::AuditProgram;
use crate::lab::cost::{
    CompilerSession, CostFigures, Dialect, ENTRY, Family, FragmentShader, GpuCompiler,
    MeasuredFunction, Probe, answered, foreign, launch, records,
};
use crate::lab::fault::Fault;
use crate::lab::process::{Error, Surroundings, Worker};
use crate::lab::verify::naga_translation;
use crate::language::ir::{Param, Ty};
use crate::language::methods::Method;
use crate::physics::num::Precision;

/// Measures the cost of a program with the compiler of a family.
///
/// # Errors
/// No process can be started.
pub fn cost(
    program: &AuditProgram,
    family: &'static Family,
    compilers: &Compilers,
    limit: Duration,
    surroundings: &Surroundings,
) -> Result<AuditCost, Error> {
    let unknown = |why: String| AuditCost::new(family, None, Err(why));
    let (Some(dialect), Ok(launch)) = (family.compiler.dialect(), launch(family, surroundings))
    else {
        return Ok(unknown(absent(family, surroundings)));
    };
    let shaders = match shaders(program, dialect, compilers)? {
        Ok(shaders) => shaders,
        Err(why) => return Ok(unknown(why)),
    };
    let mut worker = Worker::new(launch);
    let mut session = CompilerSession::new(family, dialect, limit, &mut worker);
    let compiler = match answered(session.compiler())? {
        Ok(name) => name,
        Err(why) => return Ok(unknown(why)),
    };
    let figures = answered(session.figures_of_shaders(shaders))?;
    Ok(AuditCost::new(family, Some(compiler), figures))
}

fn absent(family: &Family, surroundings: &Surroundings) -> String {
    match family.compiler {
        GpuCompiler::Operations => {
            "operations are counted in formulas, and this is text".to_owned()
        }
        GpuCompiler::None(why) => why.to_owned(),
        _ => launch(family, surroundings).err().unwrap_or_default(),
    }
}

/// The shaders with the short and the long chain of the function and of the empty one, in the form that the worker takes.
fn shaders(
    program: &AuditProgram,
    dialect: Dialect,
    compilers: &Compilers,
) -> Result<Result<[FragmentShader; 4], String>, Error> {
    let AuditProgram {
        language,
        text,
        params,
        is_scalar,
        precision,
        ..
    } = program;
    let (with_precision, is_scalar) = (format!("{PRECISION}{text}"), *is_scalar);
    let own = MeasuredFunction {
        text: if language.is_glsl() {
            &with_precision
        } else {
            text
        },
        params,
        is_scalar,
    };
    let texts = [text.clone(), with_precision.clone()];
    let own_probe = Probe::of_text(params.clone(), is_scalar, texts);
    // The empty function has a result of as many channels.
    let result = if is_scalar { Ty::Scalar } else { Ty::Vec3 };
    let empty = MeasuredFunction {
        text: match (is_scalar, language) {
            (true, _) => foreign::EMPTY_SCALAR,
            (_, Language::Hlsl | Language::Slang) => foreign::EMPTY_HLSL,
            _ => foreign::EMPTY_GLSL,
        },
        params: &[Param {
            name: "cos_theta".to_owned(),
            ty: Ty::Scalar,
        }],
        is_scalar,
    };
    let empty_probe = Probe::empty(Ty::Scalar, result, Precision::F32);
    let mut shaders = Vec::new();
    for (probe, function) in [(own_probe, own), (empty_probe, empty)] {
        for evaluations in dialect.chains() {
            let made = match shader(*language, dialect, &probe, function, evaluations) {
                Ok(MeasuredShader::Ready(shader)) => Ok(shader),
                Ok(MeasuredShader::Foreign(text)) => {
                    module(compilers.module(*language, *precision, text)?)
                }
                Err(why) => Err(why),
            };
            match made {
                Ok(shader) => shaders.push(shader),
                // A compiler that timed out once is not asked again.
                Err(why) => return Ok(Err(why)),
            }
        }
    }
    Ok(Ok(shaders.try_into().expect("there are four")))
}

/// A shader that is measured.
enum MeasuredShader {
    /// In the form that the worker takes.
    Ready(FragmentShader),
    /// A text from which a compiler makes a module.
    Foreign(String),
}

fn ready(shader: String) -> MeasuredShader {
    MeasuredShader::Ready(FragmentShader::Text(shader))
}

/// A module, or why there is none.
fn module(made: Result<Vec<u8>, Fault>) -> Result<FragmentShader, String> {
    let module = made.map_err(|fault| match fault {
        Fault::Absent(why) => why,
        Fault::Failed(words) => placed("the shader that is measured", usize::MAX, &words),
    })?;
    Ok(FragmentShader::Module(module))
}

/// Precedes GLSL ES that may leave its precision to the program around it.
const PRECISION: &str = "precision highp float;\n";

/// A shader with a chain of so many evaluations of a function, which is given twice: as our shaders hold it, and as those in HLSL
/// and GLSL do.
fn shader(
    language: Language,
    dialect: Dialect,
    probe: &Probe,
    function: MeasuredFunction,
    evaluations: usize,
) -> Result<MeasuredShader, String> {
    match (language, dialect) {
        (Language::Wgsl, _) => wgsl(probe, dialect, evaluations),
        (Language::Gles | Language::Glsl, Dialect::Wgsl) => Ok(MeasuredShader::Foreign(
            foreign::glsl(function, evaluations),
        )),
        (Language::Hlsl | Language::Slang, Dialect::Wgsl) => Ok(MeasuredShader::Foreign(
            foreign::hlsl(function, evaluations),
        )),
        (Language::Gles, _) => Ok(ready(probe.text(evaluations, dialect))),
        (Language::Hlsl | Language::Slang | Language::Glsl, _) => {
            let language = language.name().to_uppercase();
            Err(format!(
                "it takes GLSL ES, which nothing here makes of {language}"
            ))
        }
    }
}

/// WGSL itself, or naga's GLSL ES of it.
fn wgsl(probe: &Probe, dialect: Dialect, evaluations: usize) -> Result<MeasuredShader, String> {
    let own = probe.text(evaluations, Dialect::Wgsl);
    match dialect {
        Dialect::Wgsl => Ok(ready(own)),
        Dialect::Es100 => Err("it takes GLSL ES 1.00, which nothing here makes of WGSL".to_owned()),
        Dialect::Es300 => {
            let made = naga_translation::to_gles(&own, ENTRY).map_err(|fault| fault.to_string())?;
            let input = made.inputs.get(&0).map_or("fg_in", String::as_str);
            Ok(ready(unblocked(&made.text.replace(input, "fg_in"))))
        }
    }
}

/// Moves arguments out of the block in which naga puts them, which is read from memory, into the form of our own shaders.
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

/// The cost of a function on a family of GPUs, or why it is not known.
#[derive(Clone, Debug, Serialize)]
pub struct AuditCost {
    /// The family.
    pub gpu: &'static str,
    /// The compiler with its version, where one was asked.
    pub compiler: Option<String>,
    /// What is measured.
    pub measure: &'static str,
    /// Instructions of the shader with the longer chain.
    pub instructions: Option<f64>,
    /// Its latency.
    pub latency: Option<f64>,
    /// Its inverse throughput.
    pub inverse_throughput: Option<f64>,
    /// Instructions of one evaluation.
    pub net_instructions: Option<f64>,
    /// The inverse throughput of one evaluation.
    pub net_inverse_throughput: Option<f64>,
    /// The cost of one evaluation.
    pub net: Option<f64>,
    /// Why there are no figures.
    pub reason: Option<String>,
    /// Where the family's compiler is not here: the recorded cost of our library function that the function computes.
    pub recorded: Option<f64>,
}

impl AuditCost {
    /// The row of these figures.
    pub fn new(
        family: &'static Family,
        compiler: Option<String>,
        figures: Result<CostFigures, String>,
    ) -> AuditCost {
        let known = figures.as_ref().ok();
        AuditCost {
            gpu: family.name,
            compiler,
            measure: family.columns.measure,
            instructions: known.map(|figures| figures.shader.instructions),
            latency: known.and_then(|figures| figures.shader.latency),
            inverse_throughput: known.and_then(|figures| figures.shader.inverse_throughput),
            net_instructions: known.map(|figures| figures.net.instructions),
            net_inverse_throughput: known.and_then(|figures| figures.net.inverse_throughput),
            net: known.map(CostFigures::cost),
            reason: figures.err(),
            recorded: None,
        }
    }

    /// The same, with the recorded cost of the method that the function computes where there are no figures.
    #[must_use]
    pub fn with_record_of(mut self, method: &'static Method) -> AuditCost {
        if self.net.is_none() {
            let figures = records(self.gpu).library(method);
            self.recorded = figures.as_ref().map(CostFigures::cost);
        }
        self
    }
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
