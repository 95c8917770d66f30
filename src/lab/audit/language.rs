//! The languages that a user's function may be written in.

use serde::{Deserialize, Serialize};

use crate::generator::emit::shader_words::{Hidden, code_alone};
use crate::language::ir::Ty;
use crate::language::targets::{DXC, GLES, GLSL, GLSLANG, HLSL, Target, WGSL};

use super::accept::SLANGC;
use super::error::Error;

/// A language of functions that users bring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Language {
    /// WGSL.
    Wgsl,
    /// GLSL, run as GLSL ES 3.00.
    Gles,
    /// GLSL of the desktop, run as GLSL 4.50 through SPIR-V.
    Glsl,
    /// HLSL.
    Hlsl,
    /// Slang, run as HLSL is.
    Slang,
}

/// Endings of files.
const ENDINGS: [(&str, Language); 20] = [
    ("wgsl", Language::Wgsl),
    ("glsl", Language::Gles),
    ("gles", Language::Gles),
    ("frag", Language::Gles),
    ("vert", Language::Gles),
    ("fs", Language::Gles),
    ("vs", Language::Gles),
    ("fsh", Language::Gles),
    ("vsh", Language::Gles),
    ("gdshader", Language::Gles),
    ("gdshaderinc", Language::Gles),
    ("hlsl", Language::Hlsl),
    ("hlsli", Language::Hlsl),
    ("fx", Language::Hlsl),
    ("fxh", Language::Hlsl),
    ("cginc", Language::Hlsl),
    ("ush", Language::Hlsl),
    ("usf", Language::Hlsl),
    ("effect", Language::Hlsl),
    ("slang", Language::Slang),
];

impl Language {
    /// All of them by their names on the command line; one has two.
    pub const NAMED: [(&'static str, Language); 5] = [
        ("wgsl", Language::Wgsl),
        ("glsl", Language::Gles),
        ("gles", Language::Gles),
        ("hlsl", Language::Hlsl),
        ("slang", Language::Slang),
    ];

    /// The compiler beside us that is asked about it.
    pub fn compiler(self) -> &'static str {
        match self {
            Language::Wgsl => "tint",
            Language::Gles | Language::Glsl => GLSLANG.name,
            Language::Hlsl => DXC.name,
            Language::Slang => SLANGC.name,
        }
    }

    /// The language that the file's ending tells.
    ///
    /// # Errors
    /// The ending tells nothing.
    pub fn of_file(file: &str) -> Result<Language, Error> {
        let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        let ending = ending.to_lowercase();
        let found = ENDINGS.iter().find(|(name, _)| *name == ending);
        let found = found.map(|(_, language)| *language);
        found.ok_or_else(|| Error::NoLanguage {
            file: file.to_owned(),
        })
    }

    /// The target of this language.
    pub fn target(self) -> &'static Target {
        match self {
            Language::Wgsl => &WGSL,
            Language::Gles => &GLES,
            Language::Glsl => &GLSL,
            Language::Hlsl | Language::Slang => &HLSL,
        }
    }

    /// Its name in reports: that of its target, or its own.
    pub fn name(self) -> &'static str {
        match self {
            Language::Slang => "slang",
            _ => self.target().name,
        }
    }

    /// Whether it is GLSL, of either kind.
    pub fn is_glsl(self) -> bool {
        matches!(self, Language::Gles | Language::Glsl)
    }

    /// Whether lines may begin with `#`.
    pub fn has_preprocessor(self) -> bool {
        self != Language::Wgsl
    }

    /// How it writes one number, or three.
    pub fn ty(self, ty: Ty) -> &'static str {
        match (self, ty == Ty::Rgb) {
            (Language::Wgsl, false) => "f32",
            (Language::Wgsl, true) => "vec3<f32>",
            (Language::Gles | Language::Glsl, false) => "highp float",
            (Language::Gles | Language::Glsl, true) => "highp vec3",
            (Language::Hlsl | Language::Slang, false) => "float",
            (Language::Hlsl | Language::Slang, true) => "float3",
        }
    }
}

/// The version of GLSL that a text states, where it is one of the desktop.
pub fn desktop_version(text: &str) -> Option<u32> {
    let code = bare(text, false);
    let line = code.lines().find(|line| !line.trim().is_empty())?;
    let line = line.trim().strip_prefix('#')?.trim();
    let mut words = line.strip_prefix("version")?.split_whitespace();
    let version = words.next()?.parse().ok()?;
    (version != 100 && words.next() != Some("es")).then_some(version)
}

/// A user's text without comments, and without directives where those are to be passed over. A comment in a comment is passed
/// over in every language: where its end is not clear the text is refused before.
pub fn bare(text: &str, directives: bool) -> String {
    let nests = true;
    code_alone(text, Hidden { directives, nests })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ending_tells_the_language() {
        let of = |file| Language::of_file(file).ok();
        assert_eq!(of("a/b.WGSL"), Some(Language::Wgsl));
        assert_eq!(of("b.frag"), Some(Language::Gles));
        assert_eq!(of("b.fx"), Some(Language::Hlsl));
        assert_eq!(of("b.ush"), Some(Language::Hlsl));
        assert_eq!(of("b.gdshader"), Some(Language::Gles));
        assert_eq!(of("b.slang"), Some(Language::Slang));
        assert_eq!(of("b.txt"), None);
        assert_eq!(of("wgsl"), None);
    }
}
