//! What a target is: a record in a static table, with its harnesses, pages and validators. Its texts have holes: `{name}` stands for
//! what a program puts there.

use super::spelling::Spelling;
use crate::language::methods::Gpu;
use crate::physics::num::Precision;

/// An output language.
#[derive(Debug)]
#[non_exhaustive]
pub struct Target {
    /// Its one name: in `--target`, as a folder, and as a row in reports.
    pub name: &'static str,
    /// A description in one line.
    pub summary: &'static str,
    /// The specification, with a link.
    pub source: &'static str,
    /// The file extension, without the dot.
    pub extension: &'static str,
    /// Other extensions that engines use for files of this language.
    pub other_extensions: &'static [&'static str],
    /// Whether `--target all` and a run without `--target` write it.
    pub by_default: bool,
    /// How it writes names, types, numbers and operations.
    pub spelling: Spelling,
    /// How it writes half precision.
    pub half: HalfText,
    /// Words that no name may be.
    pub reserved: &'static [&'static [&'static str]],
    /// Prefixes that no name may have.
    pub reserved_prefixes: &'static [&'static str],
    /// The kinds of file around the functions; a binary target may have several.
    pub pages: &'static [Page],
    /// The template of the catalogue's array of coefficients; none where constants alone do not make a file.
    pub catalogue: Option<&'static str>,
    /// How a rendered page becomes a file.
    pub finish: Finish,
    /// Third-party compilers that can validate its files.
    pub validators: &'static [Validator],
    /// Whether block comments nest, so that the first end mark closes the inner one only.
    pub nests_comments: bool,
    /// What runs its files on this machine.
    pub stack: Stack,
    /// The GPU that its functions are written for where none is named.
    pub gpu: Gpu,
}

/// What runs the files of a target. A text file runs inside a program around it.
#[derive(Clone, Copy, Debug)]
pub enum Stack {
    /// wgpu, as a compute shader in WGSL.
    Wgpu(&'static Harness),
    /// OpenGL ES 3.0, as a vertex shader whose result transform feedback reads.
    OpenGlEs(&'static Harness),
    /// Vulkan, after DXC has compiled a compute shader in HLSL to SPIR-V.
    DxcToVulkan(&'static Harness),
    /// Vulkan, which takes the module as it is.
    SpirvModule,
    /// Nothing: its files are only re-read and compiled.
    None,
}

/// The text around a file that runs one of its functions over cosines.
///
/// All have one interface, that of our SPIR-V compute modules: group 0 with the run-time arguments in a uniform block at
/// binding 0, cosines at 1, reflectances at 2, a texture and its sampler at 3 and 4. The entry point is `fg_main`, or `main`
/// where the language has no other.
#[derive(Debug)]
pub struct Harness {
    /// The text before the file.
    pub before: &'static str,
    /// The declaration of a run-time argument: `{type}`, `{name}`, and its `{offset}` in the block.
    pub member: &'static str,
    /// The block of all `{members}`, where there are any.
    pub block: &'static str,
    /// The value of a run-time argument: `{name}`.
    pub argument: &'static str,
    /// The name by which a run-time argument is bound: `{name}`.
    pub uniform: &'static str,
    /// The declaration of a texture, where the function reads one.
    pub texture: &'static str,
    /// The texture as an argument.
    pub texture_argument: &'static str,
    /// The declaration of the cosines.
    pub cosines: &'static str,
    /// How many cosines there are.
    pub count: &'static str,
    /// The cosine of this invocation.
    pub cosine: &'static str,
    /// Three numbers from the `{value}` of a function that returns one.
    pub splat: &'static str,
    /// Whether converting a number between precisions needs an explicit conversion.
    pub converts: bool,
    /// How functions of many arguments are called.
    pub points: &'static PointHarness,
    /// The text after the file: `{block}`, `{texture}`, `{cosines}`, `{count}`, and the function's `{value}`.
    pub after: &'static str,
}

/// The text after a file that calls its functions at points. Their arguments stand in a buffer of slots, four numbers each. The
/// bindings are those of [`Harness`], with the slots instead of the cosines. In GLSL ES the slots are vertex attributes.
#[derive(Debug)]
pub struct PointHarness {
    /// The declaration of a slot as an attribute: `{at}`; empty where there is a buffer.
    pub input: &'static str,
    /// A slot of the current point: `{at}` of `{stride}`.
    pub place: &'static str,
    /// A matrix of type `{type}` from its four `{columns}`.
    pub matrix: &'static str,
    /// The declaration of a cube map.
    pub cube: &'static str,
    /// The cube as an argument.
    pub cube_argument: &'static str,
    /// All declarations: `{inputs}` and the `{texture}`.
    pub declarations: &'static str,
    /// An entry point: its name `{entry}` and the `{value}`, three numbers.
    pub entry: &'static str,
}

/// How a target writes half precision.
#[derive(Debug)]
pub struct HalfText {
    /// Names, types, numbers and operations.
    pub spelling: Spelling,
    /// The directive that must precede all code of a file.
    pub directive: &'static str,
    /// A remark for the head of a file: what makes its numbers half precision, or does not.
    pub remark: &'static str,
    /// Compilers that can validate it, like [`Target::validators`].
    pub validators: &'static [Validator],
}

/// A kind of file that a target writes for each method or material.
#[derive(Debug)]
pub struct Page {
    /// The text between the name and the extension, with its dot: `.frag`, or nothing.
    pub suffix: &'static str,
    /// Its template, in Tera's language.
    pub template: &'static str,
}

/// How a rendered page becomes a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// It is the file.
    Text,
    /// It is the file, once naga has parsed and validated it.
    ValidWgsl,
    /// It is WGSL that naga lowers to a SPIR-V module.
    Spirv,
}

/// A third-party compiler.
#[derive(Debug)]
pub struct Compiler {
    /// Its name.
    pub name: &'static str,
    /// Its command; none where it is linked into this program.
    pub command: Option<&'static str>,
    /// Where to get it.
    pub get: &'static str,
}

/// How a compiler validates a target's files.
#[derive(Debug)]
pub struct Validator {
    /// The compiler's name, and what distinguishes this use of it.
    pub name: &'static str,
    /// The compiler.
    pub compiler: &'static Compiler,
    /// The arguments of the command: `FILE` stands for the file, `OUT` for its output.
    pub options: &'static str,
    /// The text that turns a file into a program.
    pub frame: Frame,
}

/// The text around a file of functions that turns it into a program.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Texts that may precede the file: a program is made with each.
    pub beginnings: &'static [&'static str],
    /// The text after it. In it `{calls}` is a call of each function, added to `sum`, so that nothing is dead code.
    /// Their arguments are `at` and `at.x`, `a_texture` and `a_sampler`.
    pub ending: &'static str,
}

impl Frame {
    /// The file is validated as it is.
    pub const NONE: Frame = Frame {
        beginnings: &[""],
        ending: "",
    };
}

/// Khronos's reference GLSL compiler, which reads HLSL too.
pub static GLSLANG: Compiler = Compiler {
    name: "glslang",
    command: Some("glslangValidator"),
    get: "Debian package glslang-tools",
};

impl Validator {
    /// The command line, for people to read.
    pub fn command(&self) -> String {
        let Some(command) = self.compiler.command else {
            return "in process".to_owned();
        };
        let frame = if self.frame.ending.is_empty() {
            ""
        } else {
            ", FILE in a program that calls its functions"
        };
        format!("{command} {}{frame}", self.options)
    }
}

impl Stack {
    /// The program around a file, where text is run.
    pub fn harness(self) -> Option<&'static Harness> {
        match self {
            Stack::Wgpu(harness) | Stack::OpenGlEs(harness) | Stack::DxcToVulkan(harness) => {
                Some(harness)
            }
            Stack::SpirvModule | Stack::None => None,
        }
    }
}

impl Target {
    /// All extensions of files of this language.
    pub fn endings(&self) -> impl Iterator<Item = &'static str> {
        [self.extension]
            .into_iter()
            .chain(self.other_extensions.iter().copied())
    }

    /// How it writes code in this precision.
    pub fn spelling_in(&self, precision: Precision) -> &Spelling {
        match precision {
            Precision::F32 => &self.spelling,
            Precision::F16 => &self.half.spelling,
        }
    }

    /// Compilers that can validate code in this precision.
    pub fn validators_in(&self, precision: Precision) -> &'static [Validator] {
        match precision {
            Precision::F32 => self.validators,
            Precision::F16 => self.half.validators,
        }
    }

    /// The directive that must precede all code of a file in this precision, or nothing.
    pub fn directive_in(&self, precision: Precision) -> &'static str {
        match precision {
            Precision::F32 => "",
            Precision::F16 => self.half.directive,
        }
    }

    /// Why a name cannot be used in this language, if it cannot.
    pub fn name_fault(&self, name: &str) -> Option<String> {
        if self.reserved.iter().any(|words| words.contains(&name)) {
            return Some(format!("`{name}` is a reserved word of {}", self.name));
        }
        let prefix = self
            .reserved_prefixes
            .iter()
            .find(|prefix| name.starts_with(**prefix))?;
        Some(format!(
            "names that begin with `{prefix}` are reserved in {}",
            self.name
        ))
    }
}

/// A text with its holes filled. Each value comes with the name of its hole, and need not be used. What is filled in may hold
/// braces: it is not searched for holes.
///
/// # Panics
/// In tests, where the text has a hole without a value. Outside of tests such a hole stays, and a compiler refuses the text.
pub fn filled(text: &str, values: &[(&str, &str)]) -> String {
    let mut whole = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        whole += before;
        let is_hole = |(name, _): &(&str, &str)| name.bytes().all(|byte| byte.is_ascii_lowercase());
        let hole = after.split_once('}').filter(is_hole);
        let value = hole.and_then(|(name, _)| values.iter().find(|(known, _)| *known == name));
        match (hole, value) {
            (Some((_, behind)), Some((_, value))) => {
                whole += value;
                rest = behind;
            }
            _ => {
                debug_assert!(
                    hole.is_none_or(|(name, _)| name.is_empty()),
                    "a hole is left in {text}"
                );
                whole.push('{');
                rest = after;
            }
        }
    }
    whole + rest
}

#[cfg(test)]
mod tests {
    use super::filled;

    #[test]
    fn holes_are_filled_once() {
        let values = [("name", "{type}"), ("type", "f32"), ("unused", "")];
        assert_eq!(filled("{name}: {type};", &values), "{type}: f32;");
        assert_eq!(filled("fn f() { g(); } {}", &values), "fn f() { g(); } {}");
    }

    #[test]
    #[should_panic(expected = "a hole is left")]
    fn a_hole_without_a_value_is_a_fault() {
        filled("{other}", &[]);
    }
}
