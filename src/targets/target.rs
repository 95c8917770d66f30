//! What a target is: a plain record in a static table.

use crate::num::Precision;

use super::spelling::Spelling;

/// An output language.
#[derive(Debug)]
pub struct Target {
    /// Its one name: `--target`, folder, row in reports.
    pub name: &'static str,
    /// One line.
    pub summary: &'static str,
    /// The specification, with a link.
    pub source: &'static str,
    /// Of its files, without the dot.
    pub extension: &'static str,
    /// Whether `--target all` and a run without `--target` write it.
    pub by_default: bool,
    /// How it writes names, types, numbers and operations.
    pub spelling: Spelling,
    /// How it writes half precision.
    pub half: HalfText,
    /// Words that no name may be.
    pub reserved: &'static [&'static [&'static str]],
    /// Beginnings that no name may have.
    pub reserved_prefixes: &'static [&'static str],
    /// The page around the functions; a binary target may have several.
    pub pages: &'static [Page],
    /// The template of the catalogue's array of coefficients; none where constants alone are no file.
    pub catalogue: Option<&'static str>,
    /// What becomes of the rendered page.
    pub finish: Finish,
    /// Compilers that are not ours and can judge it.
    pub validators: &'static [Validator],
}

/// How a target writes half precision.
#[derive(Debug)]
pub struct HalfText {
    /// Names, types, numbers and operations.
    pub spelling: Spelling,
    /// What must stand before all code of a file.
    pub directive: &'static str,
    /// What makes it half precision, or not, for the head of a file.
    pub remark: &'static str,
    /// Compilers that can judge it, as [`Target::validators`].
    pub validators: &'static [Validator],
}

/// A kind of file that a target writes for each method or material.
#[derive(Debug)]
pub struct Page {
    /// Goes between the name and the extension, with its dot: `.frag`, or nothing.
    pub suffix: &'static str,
    /// Its template, in Tera's language.
    pub template: &'static str,
}

/// What becomes of a rendered page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// It is the file.
    Text,
    /// It is the file, once naga has parsed and validated it.
    ValidWgsl,
    /// It is WGSL that naga lowers to a SPIR-V module.
    Spirv,
}

/// A compiler that is not ours.
#[derive(Debug)]
pub struct Compiler {
    /// Its name.
    pub name: &'static str,
    /// Its command; none where it is part of this program.
    pub command: Option<&'static str>,
    /// Where to get it.
    pub get: &'static str,
}

/// How a compiler judges a target's files.
#[derive(Debug)]
pub struct Validator {
    /// The compiler's name, and what tells its ways apart.
    pub name: &'static str,
    /// Who judges.
    pub compiler: &'static Compiler,
    /// What the command is called with: `FILE` stands for the file, `OUT` for what it writes.
    pub options: &'static str,
    /// What makes a program of a file.
    pub frame: Frame,
}

/// The text around a file of functions that makes a program of it.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// What may stand before the file: a program for each.
    pub beginnings: &'static [&'static str],
    /// What stands after it. The line `CALLS` becomes a call of each function, added to `sum`: so nothing is dead code.
    /// Their arguments are `at` and `at.x`, `a_texture` and `a_sampler`.
    pub ending: &'static str,
}

impl Frame {
    /// The file is judged as it is.
    pub const NONE: Frame = Frame {
        beginnings: &[""],
        ending: "",
    };
}

/// Khronos's reference compiler of GLSL, which reads HLSL too.
pub static GLSLANG: Compiler = Compiler {
    name: "glslang",
    command: Some("glslangValidator"),
    get: "Debian package glslang-tools",
};

impl Validator {
    /// How it judges, for people.
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

impl Target {
    /// How it writes code in this precision.
    pub fn spelling_in(&self, precision: Precision) -> &Spelling {
        match precision {
            Precision::F32 => &self.spelling,
            Precision::F16 => &self.half.spelling,
        }
    }

    /// Compilers that can judge code in this precision.
    pub fn validators_in(&self, precision: Precision) -> &'static [Validator] {
        match precision {
            Precision::F32 => self.validators,
            Precision::F16 => self.half.validators,
        }
    }

    /// What must stand before all code of a file in this precision, or nothing.
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
