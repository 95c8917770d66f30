//! The languages that a user's function may be written in, and a text without its comments.

use serde::{Deserialize, Serialize};

use crate::lab::verify::shader_words::{Hidden, code_alone};
use crate::language::ir::Ty;
use crate::language::targets::{GLES, GLSL, HLSL, Target, WGSL};

/// A language of users' functions.
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
    /// Slang, run like HLSL.
    Slang,
}

/// File extensions.
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
    /// The languages by their names on the command line. `Gles` has two, and `Glsl` has none.
    pub const NAMED: [(&'static str, Language); 5] = [
        ("wgsl", Language::Wgsl),
        ("glsl", Language::Gles),
        ("gles", Language::Gles),
        ("hlsl", Language::Hlsl),
        ("slang", Language::Slang),
    ];

    /// The language of a file, by its extension. None where that is not one of a language.
    pub fn of_file(file: &str) -> Option<Language> {
        let name = file.rsplit(['/', '\\']).next()?;
        let ending = name.rsplit_once('.')?.1.to_lowercase();
        let found = ENDINGS.iter().find(|(name, _)| *name == ending);
        found.map(|(_, language)| *language)
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

    /// Its name in reports: that of its target, or its own where it is no target.
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

    /// Its name for a type of one number or three.
    pub fn ty(self, ty: Ty) -> &'static str {
        match (self, ty == Ty::Vec3) {
            (Language::Wgsl, false) => "f32",
            (Language::Wgsl, true) => "vec3<f32>",
            (Language::Gles | Language::Glsl, false) => "highp float",
            (Language::Gles | Language::Glsl, true) => "highp vec3",
            (Language::Hlsl | Language::Slang, false) => "float",
            (Language::Hlsl | Language::Slang, true) => "float3",
        }
    }
}

/// The version of GLSL that a text states, where it is a desktop version.
pub fn desktop_version(text: &str) -> Option<u32> {
    let code = bare(text, false);
    let line = code.lines().find(|line| !line.trim().is_empty())?;
    let line = line.trim().strip_prefix('#')?.trim();
    let mut words = line.strip_prefix("version")?.split_whitespace();
    let version = words.next()?.parse().ok()?;
    (version != 100 && words.next() != Some("es")).then_some(version)
}

/// A user's text without comments, and without directives if `directives` says so. Nested comments are skipped in every language:
/// where their end is not clear, the text has been refused already.
pub fn bare(text: &str, directives: bool) -> String {
    let nests = true;
    code_alone(text, Hidden { directives, nests })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ending_tells_the_language() {
        let of = Language::of_file;
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
