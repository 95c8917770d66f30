//! The fragment shader around a measured function, in any language: a chain of evaluations `r0 = f(c0)`,
//! `c1 = r0.x * r0.y - r0.z + w.z`, `r1 = f(c1)`, and so on.
//!
//! Location 0 holds the weights `w` and the first number. The function is called [`MEASURED`]; it takes its cosine first. Where its first
//! argument is a vector, it is `w * c0`, `w * c1`, and so on.

use crate::language::ir::{Param, Ty};
use crate::language::targets::Spelling;

/// The name of every measured function, so that equal functions have equal shaders.
pub(super) const MEASURED: &str = "fg_measured";

/// How a language writes the shader. The shader declares arguments for [`BLOCKS`](super::BLOCKS) evaluations.
pub(super) struct ChainLanguage<'a> {
    /// How types are named.
    pub spelling: &'a Spelling,
    /// The declaration of a run-time argument: `{type}`, `{name}`.
    pub member: &'a str,
    /// The block of all `{members}`, where there are any.
    pub block: &'a str,
    /// A run-time argument in evaluation `{i}`: `{name}`, and `{parts}` of a vector of four.
    pub argument: &'static str,
    /// The declaration of a texture, where the function reads one.
    pub texture: &'static str,
    /// The declaration of a cube of textures.
    pub cube: &'a str,
    /// The texture or the cube as an argument.
    pub texture_argument: &'static str,
    /// The declaration of a local: `{type}`, `{name}`, `{value}`.
    pub local: &'static str,
    /// An input `{value}` as a `{type}`.
    pub input: &'static str,
    /// What the names of locals begin with.
    pub prefix: &'static str,
    /// The shader: `{function}`, `{arguments}`, `{chain}`, and the `{last}` result.
    pub shader: &'a str,
}

/// A measured function and how often it is evaluated.
pub(super) struct Chain<'a> {
    /// Its text.
    pub function: &'a str,
    /// Its arguments; the first comes from the chain.
    pub params: &'a [Param],
    /// Whether it gives one number.
    pub is_scalar: bool,
    /// How often it is evaluated.
    pub evaluations: usize,
}

impl Chain<'_> {
    /// The shader in a language.
    pub fn shader(&self, language: &ChainLanguage) -> String {
        let last = format!("{}r{}", language.prefix, self.evaluations - 1);
        let shader = language
            .shader
            .replace("{arguments}", &self.declarations(language))
            .replace("{chain}", &self.chain(language))
            .replace("{last}", &last);
        // The function comes last: its text may be a user's.
        shader.replace("{function}", self.function)
    }

    fn declarations(&self, language: &ChainLanguage) -> String {
        let member = |param: &Param| {
            let ty = language.spelling.ty(param.ty);
            let member = language.member.replace("{type}", ty);
            member.replace("{name}", &param.name)
        };
        let members: String = uniforms(self.params).map(member).collect();
        let block = if members.is_empty() {
            members
        } else {
            language.block.replace("{members}", &members)
        };
        let reads = |ty| self.params.iter().any(|param| param.ty == ty);
        let texture = match (reads(Ty::Texture), reads(Ty::Cube)) {
            (true, _) => language.texture,
            (_, true) => language.cube,
            _ => "",
        };
        block + texture
    }

    fn chain(&self, language: &ChainLanguage) -> String {
        let prefix = language.prefix;
        let local = |ty: Ty, name: String, value: &str| {
            let local = language.local.replace("{type}", language.spelling.ty(ty));
            let local = local.replace("{name}", &format!("{prefix}{name}"));
            format!("    {}\n", local.replace("{value}", value))
        };
        let input = |ty: Ty, name: &str, value: &str| {
            let spelled = language.spelling.ty(ty);
            let value = language
                .input
                .replace("{type}", spelled)
                .replace("{value}", value);
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
            let ty = if self.is_scalar { Ty::Scalar } else { Ty::Rgb };
            cosine + &local(ty, format!("r{i}"), &self.call(language, i))
        };
        let weights = input(Ty::Rgb, "w", "fg_in.xyz");
        weights + &(0..self.evaluations).map(step).collect::<String>()
    }

    fn call(&self, language: &ChainLanguage, i: usize) -> String {
        let argument = |param: &Param| match param.ty {
            Ty::Texture | Ty::Cube => language.texture_argument.to_owned(),
            _ => language
                .argument
                .replace("{i}", &i.to_string())
                .replace("{parts}", if param.ty == Ty::Rgb { "xyz" } else { "x" })
                .replace("{name}", &param.name),
        };
        let prefix = language.prefix;
        let first = match self.params.first().map_or(Ty::Scalar, |param| param.ty) {
            Ty::Rgb => format!("{prefix}w * {prefix}c{i}"),
            Ty::Vec2 => format!("{prefix}w.xy * {prefix}c{i}"),
            _ => format!("{prefix}c{i}"),
        };
        let others = self.params.iter().skip(1).map(argument);
        let arguments: Vec<String> = [first].into_iter().chain(others).collect();
        format!("{MEASURED}({})", arguments.join(", "))
    }
}

/// The arguments that come from uniforms: all after the first but textures.
pub(super) fn uniforms(params: &[Param]) -> impl Iterator<Item = &Param> {
    let params = params.iter().skip(1);
    params.filter(|param| !matches!(param.ty, Ty::Texture | Ty::Cube))
}
