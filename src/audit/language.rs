//! The languages that a user's function may be written in.

use serde::{Deserialize, Serialize};

use crate::ir::Ty;
use crate::names::UnknownName;
use crate::targets::{DXC, GLES, GLSLANG, HLSL, Target, WGSL};
use crate::verify::text::{Hidden, code_alone};

use super::error::Error;

/// A language of functions that users bring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Language {
    /// WGSL.
    Wgsl,
    /// GLSL, run as GLSL ES 3.00.
    Gles,
    /// HLSL.
    Hlsl,
}

/// Names of languages, and endings of files.
const NAMES: [(&str, Language); 10] = [
    ("wgsl", Language::Wgsl),
    ("glsl", Language::Gles),
    ("gles", Language::Gles),
    ("frag", Language::Gles),
    ("vert", Language::Gles),
    ("fs", Language::Gles),
    ("vs", Language::Gles),
    ("hlsl", Language::Hlsl),
    ("hlsli", Language::Hlsl),
    ("fx", Language::Hlsl),
];
/// How many of them are names of languages.
const LANGUAGES: [&str; 4] = ["wgsl", "glsl", "gles", "hlsl"];

impl Language {
    /// The compiler beside us that is asked about it.
    pub fn compiler(self) -> &'static str {
        match self {
            Language::Wgsl => "tint",
            Language::Gles => GLSLANG.name,
            Language::Hlsl => DXC.name,
        }
    }

    /// The language that is named, or that the file's ending tells.
    ///
    /// # Errors
    /// There is none of that name, or the ending tells nothing.
    pub fn named(file: &str, named: Option<&str>) -> Result<Language, Error> {
        let find = |word: &str| NAMES.iter().find(|(name, _)| *name == word);
        if let Some(name) = named {
            let found = find(name).filter(|_| LANGUAGES.contains(&name));
            let found = found.map(|(_, language)| *language);
            return found.ok_or_else(|| UnknownName::new("language", name, &LANGUAGES).into());
        }
        let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        let found = find(&ending.to_lowercase()).map(|(_, language)| *language);
        found.ok_or_else(|| Error::NoLanguage {
            file: file.to_owned(),
        })
    }

    /// The target of this language.
    pub fn target(self) -> &'static Target {
        match self {
            Language::Wgsl => &WGSL,
            Language::Gles => &GLES,
            Language::Hlsl => &HLSL,
        }
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
            (Language::Gles, false) => "highp float",
            (Language::Gles, true) => "highp vec3",
            (Language::Hlsl, false) => "float",
            (Language::Hlsl, true) => "float3",
        }
    }
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
    fn an_ending_or_a_flag_tells_the_language() {
        let of = |file, named| Language::named(file, named).ok();
        assert_eq!(of("a/b.WGSL", None), Some(Language::Wgsl));
        assert_eq!(of("b.frag", None), Some(Language::Gles));
        assert_eq!(of("b.fx", None), Some(Language::Hlsl));
        assert_eq!(of("b.txt", Some("hlsl")), Some(Language::Hlsl));
        assert_eq!(of("b.txt", None), None);
        assert_eq!(of("wgsl", None), None);
        assert_eq!(of("b.wgsl", Some("fx")), None);
    }
}
