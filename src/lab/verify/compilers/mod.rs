//! Independent compilers: whether they accept what was generated, and the SPIR-V that DXC makes of HLSL. A compiler that is
//! missing gives no verdict, and the reason says where to get it.

mod call;
mod program;

use crate::generator::emit::{NAGA_VERSION, validate_wgsl};
use crate::generator::fit::Measured;
use crate::lab::fault::Fault;
use crate::language::targets::{Compiler, DXC, Target, Validator};
use crate::physics::num::Precision;
use call::{Called, CompilerInput};

pub use program::calls;

/// What a compiler says of a file: it accepts it, it refuses it in these words (the first lines), or it was not asked.
pub type Verdict = Result<(), Fault>;

/// A version of HLSL, the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HlslVersion {
    /// As most engines compile it.
    V2018,
    /// As DXC compiles it unless asked otherwise.
    V2021,
}

/// The most lines of a refusal that are reported.
const LINES: usize = 8;

/// The verdict on a file of this precision of every compiler that can judge its target. `name` is the file's name in their messages.
pub fn accepts(
    precision: Precision,
    target: &Target,
    name: &str,
    bytes: &[u8],
) -> Vec<(&'static str, Verdict)> {
    let validators = target.validators_in(precision).iter();
    validators
        .map(|validator| (validator.name, verdict(validator, name, bytes)))
        .collect()
}

/// The verdict of one validator.
///
/// # Errors
/// It refuses the text, or is not here.
pub fn verdict(validator: &Validator, name: &str, bytes: &[u8]) -> Verdict {
    let framed = match program::framed(&validator.frame, bytes) {
        Ok(framed) => framed,
        Err(fault) => return Err(Fault::Failed(fault.to_string())),
    };
    if validator.compiler.command.is_none() {
        let text = String::from_utf8_lossy(bytes);
        return validate_wgsl(&text)
            .map(drop)
            .map_err(|words| Fault::Failed(first_lines(&words)));
    }
    let files: Vec<CompilerInput> = program::named(name, framed);
    run(validator.compiler, validator.options, &files).map(drop)
}

/// The SPIR-V that DXC makes of a compute shader in HLSL, for Vulkan 1.1. Register numbers become bindings, spaces become sets.
/// `half` has as many bits as the precision: 16 or 32.
///
/// # Errors
/// DXC refuses the text, or is not here.
pub fn hlsl_to_spirv(
    precision: Precision,
    text: &str,
    entry: &str,
    version: HlslVersion,
) -> Result<Vec<u8>, Fault> {
    let model = match precision {
        Precision::F32 => "cs_6_0",
        Precision::F16 => "cs_6_2 -enable-16bit-types",
    };
    let version = match version {
        HlslVersion::V2018 => 2018,
        HlslVersion::V2021 => 2021,
    };
    let options = format!(
        "-T {model} -E {entry} -HV {version} -no-warnings -spirv -fspv-target-env=vulkan1.1 -Fo OUT FILE"
    );
    let file = CompilerInput {
        name: "shader.hlsl".to_owned(),
        bytes: text.as_bytes().to_vec(),
    };
    written(&DXC, &options, run(&DXC, &options, &[file])?)
}

/// A compiler's output for a text under this name. Its options have the form of a [`Validator`]'s.
///
/// # Errors
/// The compiler refuses the text, or is not here.
pub fn compiled(
    compiler: &Compiler,
    options: &str,
    name: &str,
    text: &str,
) -> Result<Vec<u8>, Fault> {
    let file = CompilerInput {
        name: name.to_owned(),
        bytes: text.as_bytes().to_vec(),
    };
    written(compiler, options, run(compiler, options, &[file])?)
}

/// What a compiler has written, where its options ask for a file.
fn written(compiler: &Compiler, options: &str, made: Vec<u8>) -> Result<Vec<u8>, Fault> {
    if made.is_empty() && options.split_whitespace().any(|word| word == "OUT") {
        let why = format!("{} ended without a fault and wrote nothing", compiler.name);
        return Err(Fault::Absent(why));
    }
    Ok(made)
}

/// Whether a compiler can be asked here.
pub fn is_here(compiler: &Compiler) -> bool {
    let found = |command| call::find(command).is_some();
    compiler.command.is_none_or(found)
}

/// The version of a compiler here, in its own words.
pub fn version(compiler: &Compiler) -> Measured<String> {
    if compiler.command.is_none() {
        return Measured::Yes(NAGA_VERSION.to_owned());
    }
    match called(compiler, "--version", &[]) {
        Ok(Called { ok: true, said, .. }) => Measured::Yes(first_line(&said)),
        Ok(_) => Measured::No("it does not tell its version".to_owned()),
        Err(fault) => Measured::No(format!("not checked: {fault}")),
    }
}

/// Runs a compiler on these files.
fn run(compiler: &Compiler, options: &str, files: &[CompilerInput]) -> Result<Vec<u8>, Fault> {
    let called = called(compiler, options, files)?;
    if called.ok {
        return Ok(called.made);
    }
    let words = first_lines(&called.said);
    if names_place(&called.said, files) {
        return Err(Fault::Failed(words));
    }
    // A message that names no place may be a fault of the compiler or of the machine.
    let name = compiler.name;
    let why = format!("{name} failed and named no place in the text: {words}");
    Err(Fault::Absent(why))
}

/// Whether a compiler's message names a place in one of its files: `a.hlsl:3:5`, `a.hlsl(3,5)`, glslang's `ERROR: 0:3:`. A binary
/// file has no lines, so there a message that begins with `error` counts.
fn names_place(words: &str, files: &[CompilerInput]) -> bool {
    let begins_number = |rest: &str| {
        let rest = rest.strip_prefix([':', '(']);
        rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    let is_named = |line: &str| {
        let behind = |file: &CompilerInput| {
            line.match_indices(file.name.as_str())
                .any(|(at, name)| begins_number(&line[at + name.len()..]))
        };
        let glslang = line.strip_prefix("ERROR: 0");
        files.iter().any(behind) || glslang.is_some_and(begins_number)
    };
    let is_module = files
        .iter()
        .any(|file| std::str::from_utf8(&file.bytes).is_err());
    let is_fault = |line: &str| {
        is_named(line) && !line.contains(": warning:") || is_module && line.starts_with("error")
    };
    words.lines().any(is_fault)
}

fn called(compiler: &Compiler, options: &str, files: &[CompilerInput]) -> Result<Called, Fault> {
    let Compiler { name, get, .. } = compiler;
    let absent = || Fault::Absent(format!("no {name} here ({get})"));
    let command = compiler.command.ok_or_else(absent)?;
    let path = call::find(command).ok_or_else(absent)?;
    call::call(&path, options, files)
        .map_err(|silent| Fault::Absent(format!("{name} was not asked: {silent}")))
}

fn first_line(words: &str) -> String {
    words.lines().next().unwrap_or("").trim().to_owned()
}

/// The first lines that are not empty.
fn first_lines(words: &str) -> String {
    let lines = words.lines().map(str::trim_end);
    let said: Vec<&str> = lines.filter(|line| !line.is_empty()).take(LINES).collect();
    said.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(words: &str, expected: bool) {
        let file = CompilerInput {
            name: "0-a.hlsl".to_owned(),
            bytes: b"float f;".to_vec(),
        };
        assert_eq!(names_place(words, &[file]), expected, "{words}");
    }

    #[test]
    fn only_words_with_a_place_are_about_the_text() {
        check("0-a.hlsl:3:5: error: x", true);
        check("C:\\made\\0-a.hlsl(3,5): error X3000", true);
        check("0-a.hlsl\nERROR: 0:3: 'x' : undeclared", true);
        check(" --> 0-a.hlsl:3:12", true);
        check(
            "slangc: error while loading shared libraries: libslang.so",
            false,
        );
        check("error: cannot open 0-a.hlsl", false);
        check("0-a.hlsl:1:1: warning: x\nerror: out of memory", false);
        check("10:03:05 internal error", false);
        check("ERROR: Linking vertex stage: Missing entry point", false);
        check("no word, signal: 11 (SIGSEGV)", false);
        check("stopped after 20 s\n", false);
    }

    #[test]
    fn a_module_has_no_lines() {
        let file = CompilerInput {
            name: "a.spv".to_owned(),
            bytes: vec![0x03, 0x02, 0x23, 0xFF],
        };
        let named = |words| names_place(words, std::slice::from_ref(&file));
        assert!(named("error: Invalid SPIR-V magic number."));
        assert!(!named("spirv-val: cannot load"));
    }
}
