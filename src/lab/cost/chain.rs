//! The fragment shader around a measured function, in any language: a chain of evaluations `r0 = f(c0)`,
//! `c1 = r0.x * r0.y - r0.z + w.z`, `r1 = f(c1)`, and so on. Also the shape of a text: the text with a mark in place of
//! each number.
//!
//! Location 0 holds the weights `w` and the first number. The function is called [`MEASURED`], and takes its cosine first. Where
//! its first argument is a vector, it is `w * c0`, `w * c1`, and so on.

use crate::language::ir::{Param, Ty};
use crate::language::targets::{Spelling, filled};

/// The name of every measured function, so that equal functions have equal shaders.
pub(super) const MEASURED: &str = "fg_measured";

/// How a language writes the shader. The shader declares arguments for [`BLOCKS`](super::BLOCKS) evaluations.
pub(super) struct ChainLanguage<'a> {
    /// The names of types.
    pub spelling: &'a Spelling,
    /// The declaration of a run-time argument: `{type}`, `{name}`.
    pub member: &'a str,
    /// The block of all `{members}`, where there are any.
    pub block: &'a str,
    /// A run-time argument in evaluation `{i}`: `{name}`, and the `{parts}` of a vector of four.
    pub argument: &'static str,
    /// The declaration of a texture, where the function reads one.
    pub texture: &'static str,
    /// The declaration of a cube map.
    pub cube: &'a str,
    /// The texture or the cube map as an argument.
    pub texture_argument: &'static str,
    /// The declaration of a local: `{type}`, `{name}`, `{value}`.
    pub local: &'static str,
    /// An input `{value}` as a `{type}`.
    pub input: &'static str,
    /// The prefix of the names of locals.
    pub prefix: &'static str,
    /// The shader: `{function}`, `{arguments}`, `{chain}`, and the `{last}` result.
    pub shader: &'a str,
}

/// A measured function.
#[derive(Clone, Copy, Debug)]
pub struct MeasuredFunction<'a> {
    /// Its text.
    pub text: &'a str,
    /// Its arguments. The first, its cosine, comes from the chain.
    pub params: &'a [Param],
    /// Whether it returns one number.
    pub is_scalar: bool,
}

impl MeasuredFunction<'_> {
    /// The shader with a chain of so many evaluations in a language.
    pub(super) fn shader(&self, language: &ChainLanguage, evaluations: usize) -> String {
        let last = format!("{}r{}", language.prefix, evaluations - 1);
        let holes: &[(&str, &str)] = &[
            ("arguments", &self.declarations(language)),
            ("chain", &self.chain(language, evaluations)),
            ("last", &last),
            ("function", self.text),
        ];
        filled(language.shader, holes)
    }

    fn declarations(&self, language: &ChainLanguage) -> String {
        let member = |param: &Param| {
            let ty = language.spelling.ty(param.ty);
            filled(language.member, &[("type", ty), ("name", &param.name)])
        };
        let members: String = uniforms(self.params).map(member).collect();
        let block = if members.is_empty() {
            members
        } else {
            filled(language.block, &[("members", &members)])
        };
        let reads = |ty| self.params.iter().any(|param| param.ty == ty);
        let texture = match (reads(Ty::Texture), reads(Ty::Cube)) {
            (true, _) => language.texture,
            (_, true) => language.cube,
            _ => "",
        };
        block + texture
    }

    fn chain(&self, language: &ChainLanguage, evaluations: usize) -> String {
        let prefix = language.prefix;
        let local = |ty: Ty, name: String, value: &str| {
            let holes: &[(&str, &str)] = &[
                ("type", language.spelling.ty(ty)),
                ("name", &format!("{prefix}{name}")),
                ("value", value),
            ];
            format!("    {}\n", filled(language.local, holes))
        };
        let input = |ty: Ty, name: &str, value: &str| {
            let holes: &[(&str, &str)] = &[("type", language.spelling.ty(ty)), ("value", value)];
            let value = filled(language.input, holes);
            local(ty, name.to_owned(), &value)
        };
        let step = |i: usize| {
            let cosine = match i.checked_sub(1).map(|i| format!("{prefix}r{i}")) {
                None => input(Ty::Scalar, "c0", "fg_in.w"),
                Some(r) if self.is_scalar => local(
                    Ty::Scalar,
                    format!("c{i}"),
                    &format!("{r} * {prefix}w.x + {prefix}w.y"),
                ),
                Some(r) => local(
                    Ty::Scalar,
                    format!("c{i}"),
                    &format!("{r}.x * {r}.y - {r}.z + {prefix}w.z"),
                ),
            };
            let ty = if self.is_scalar { Ty::Scalar } else { Ty::Vec3 };
            cosine + &local(ty, format!("r{i}"), &self.call(language, i))
        };
        let weights = input(Ty::Vec3, "w", "fg_in.xyz");
        weights + &(0..evaluations).map(step).collect::<String>()
    }

    fn call(&self, language: &ChainLanguage, i: usize) -> String {
        let argument = |param: &Param| match param.ty {
            Ty::Texture | Ty::Cube => language.texture_argument.to_owned(),
            _ => {
                let parts = if param.ty == Ty::Vec3 { "xyz" } else { "x" };
                let holes: &[(&str, &str)] = &[
                    ("i", &i.to_string()),
                    ("parts", parts),
                    ("name", &param.name),
                ];
                filled(language.argument, holes)
            }
        };
        let prefix = language.prefix;
        let first = match self.params.first().map_or(Ty::Scalar, |param| param.ty) {
            Ty::Vec3 => format!("{prefix}w * {prefix}c{i}"),
            Ty::Vec2 => format!("{prefix}w.xy * {prefix}c{i}"),
            _ => format!("{prefix}c{i}"),
        };
        let others = self.params.iter().skip(1).map(argument);
        let arguments: Vec<String> = [first].into_iter().chain(others).collect();
        format!("{MEASURED}({})", arguments.join(", "))
    }
}

/// The arguments that come from uniforms: all but the first one and textures.
pub(super) fn uniforms(params: &[Param]) -> impl Iterator<Item = &Param> {
    let params = params.iter().skip(1);
    params.filter(|param| !matches!(param.ty, Ty::Texture | Ty::Cube))
}

/// Replaces a number.
const MARK: char = '#';

/// A text of any of our languages with [`MARK`] in place of each number, its sign included. Digits in names stay.
pub(super) fn without_numbers(text: &str) -> String {
    let mut shape = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let name = length(rest, |c| c.is_ascii_alphanumeric() || c == '_');
        let taken = if is_number(rest) {
            if shape.ends_with('-') && !follows_operand(&shape) {
                shape.pop();
            }
            shape.push(MARK);
            number_length(rest)
        } else {
            let taken = name.max(first.len_utf8());
            shape.push_str(&rest[..taken]);
            taken
        };
        rest = &rest[taken..];
    }
    shape
}

/// The length in bytes of the leading run of such characters.
fn length(text: &str, is_such: impl Fn(char) -> bool) -> usize {
    text.find(|c| !is_such(c)).unwrap_or(text.len())
}

fn is_number(text: &str) -> bool {
    let digits = text.strip_prefix('.').unwrap_or(text);
    digits.starts_with(|c: char| c.is_ascii_digit())
}

/// The length of a number: digits, a point, an exponent with its sign, and letters of the type.
fn number_length(text: &str) -> usize {
    let plain = length(text, |c| c.is_ascii_alphanumeric() || c == '.');
    let is_open = text[..plain].ends_with(['e', 'E']);
    let exponent = match text[plain..].strip_prefix(['+', '-']) {
        Some(digits) if is_open => 1 + length(digits, |c| c.is_ascii_alphanumeric()),
        _ => 0,
    };
    plain + exponent
}

/// Whether the minus at the end is a subtraction, not a sign.
fn follows_operand(shape: &str) -> bool {
    let before = shape[..shape.len() - 1].trim_end();
    let is_operand = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | ')' | ']' | MARK);
    before.ends_with(is_operand) && !before.ends_with("return")
}

#[cfg(test)]
mod tests {
    use super::without_numbers;

    #[track_caller]
    fn check(text: &str, shape: &str) {
        assert_eq!(without_numbers(text), shape);
    }

    #[test]
    fn numbers_are_marked_and_names_stay() {
        check("let m2 = c0 * 0.5;", "let m2 = c0 * #;");
        check("vec3<f32>(1.0, -0.25, 3e-7)", "vec3<f32>(#, #, #)");
        check("float3(1e12f, .5h, 2)", "float3(#, #, #)");
        check("return -1.5E+03;", "return #;");
        check("r0.x * r0.y", "r0.x * r0.y");
        check("exp2(-8.35 * c)", "exp2(# * c)");
    }

    #[test]
    fn a_difference_is_no_sign() {
        check("1.0 - m", "# - m");
        check("m - 1.0", "m - #");
        check("(a) - 2.0 - -3.0", "(a) - # - #");
        check("b[1]-4.0", "b[#]-#");
    }
}
