//! A text's own names of types: `#define real float`, `typedef float real;`, `alias real = f32;`. Heads of functions are read
//! with the types in their place.

use std::collections::BTreeMap;

use super::directives::definitions;
use super::language::{Language, bare};
use crate::lab::verify::function_head::{TypeShape, type_shape};
use crate::lab::verify::shader_words::{Token, tokens};

/// The longest chain of names that stand for each other. It stops a name that stands for itself.
const DEPTH: usize = 8;

/// The names with their meanings, one for each definition, since `#if` may choose among several.
#[derive(Debug, Default)]
pub struct TypeNames {
    meanings: BTreeMap<String, Vec<Vec<String>>>,
}

impl TypeNames {
    /// The names of a text.
    pub fn of_text(text: &str, language: Language) -> TypeNames {
        let mut names = TypeNames::default();
        let code = bare(text, false);
        let tokens = tokens(&code);
        if language.has_preprocessor() {
            let plain = definitions(&tokens).filter(|one| one.params.is_none());
            plain.for_each(|one| names.enter(one.name, one.body));
        }
        for at in 0..tokens.len() {
            if let Some((name, meaning)) = declared(&tokens[at..], language) {
                names.enter(name, meaning);
            }
        }
        names
    }

    fn enter(&mut self, name: &str, meaning: &[Token]) {
        let meaning = meaning.iter().map(|token| token.text.to_owned()).collect();
        let all = self.meanings.entry(name.to_owned()).or_default();
        all.push(meaning);
    }

    /// Words with the types in place of their names. A name whose definitions differ, or are not types, stays.
    pub fn replaced<'t>(&'t self, words: &[Token<'t>]) -> Vec<Token<'t>> {
        let mut all = Vec::new();
        for word in words {
            match self.meaning(word.text, DEPTH) {
                None => all.push(*word),
                Some(meaning) => {
                    all.extend(meaning.into_iter().map(|text| Token { text, ..*word }));
                }
            }
        }
        all
    }

    /// The words of types and qualifiers that a name stands for.
    fn meaning(&self, name: &str, depth: usize) -> Option<Vec<&str>> {
        let definitions = self.meanings.get(name).filter(|_| depth > 0)?;
        let mut known: Option<(TypeShape, Vec<&str>)> = None;
        for definition in definitions {
            let words: Vec<&str> = definition
                .iter()
                .flat_map(|word| self.meaning(word, depth - 1).unwrap_or(vec![word]))
                .collect();
            let shape = type_shape(&words)?;
            match &known {
                Some((other, _)) if *other != shape => return None,
                Some(_) => {}
                None => known = Some((shape, words)),
            }
        }
        known.map(|(_, words)| words)
    }
}

/// `typedef type name;` or `alias name = type;`.
fn declared<'t, 'a>(
    tokens: &'t [Token<'a>],
    language: Language,
) -> Option<(&'a str, &'t [Token<'a>])> {
    let end = tokens.iter().take(DEPTH).position(|t| t.text == ";")?;
    match (&tokens[..end], language) {
        ([word, meaning @ .., name], Language::Hlsl | Language::Slang)
            if word.text == "typedef" =>
        {
            Some((name.text, meaning))
        }
        ([word, name, equals, meaning @ ..], Language::Wgsl)
            if word.text == "alias" && equals.text == "=" =>
        {
            Some((name.text, meaning))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, language: Language, words: &str, expected: &str) {
        let names = TypeNames::of_text(text, language);
        let words = tokens(words);
        let replaced = names.replaced(&words);
        let texts: Vec<&str> = replaced.iter().map(|token| token.text).collect();
        assert_eq!(texts.join(" "), expected, "{text}");
    }

    #[test]
    fn names_of_types_become_types() {
        let text = "#define real float\n#define real3 half3\n#define REAL real\n# define INLINE\n";
        check(
            text,
            Language::Hlsl,
            "INLINE REAL f(real3 x)",
            "float f ( half3 x )",
        );
        check("typedef float3 Colour;", Language::Hlsl, "Colour", "float3");
        check(
            "alias real = vec3<f32>;",
            Language::Wgsl,
            "real",
            "vec3 < f32 >",
        );
        check(
            "#define P mediump\n",
            Language::Gles,
            "P float",
            "mediump float",
        );
    }

    #[test]
    fn definitions_that_differ_in_precision_alone_are_one() {
        let text = "#if HALF\n#define real half\n#define real3 half3\n#else\n#define real float\n#define real3 float3\n#endif\n";
        check(text, Language::Hlsl, "real real3", "half half3");
        let text = "#if WIDE\n#define real float3\n#else\n#define real float\n#endif\n";
        check(text, Language::Hlsl, "real", "real");
    }

    #[test]
    fn what_takes_arguments_or_names_no_type_stays() {
        check("#define f g\n", Language::Gles, "f", "f");
        check("#define real4 float4\n", Language::Hlsl, "real4", "real4");
        check("#define f(x) x\n", Language::Gles, "f", "f");
        check("#define a b\n#define b a\n", Language::Gles, "a", "a");
        check("typedef float real;", Language::Gles, "real", "real");
    }
}
