//! The fragment shader around a measured function, in any language: a chain of evaluations `r0 = f(c0)`,
//! `c1 = r0.x * r0.y - r0.z + w.z`, `r1 = f(c1)`, and so on.
//!
//! Location 0 holds the weights `w` and the first cosine. The function is called [`MEASURED`]; it takes its cosine first.

use crate::ir::{Param, Ty};

/// The name of every measured function, so that equal functions have equal shaders.
pub(super) const MEASURED: &str = "fg_measured";

/// How a language writes the shader. The shader declares arguments for [`BLOCKS`](super::BLOCKS) evaluations.
pub(super) struct ChainLanguage<'a> {
    /// The types of a number and of three.
    pub types: [&'static str; 2],
    /// The declaration of a run-time argument: `{type}`, `{name}`.
    pub member: &'a str,
    /// The block of all `{members}`, where there are any.
    pub block: &'a str,
    /// A run-time argument in evaluation `{i}`: `{name}`, and `{parts}` of a vector of four.
    pub argument: &'static str,
    /// The declaration of a texture, where the function reads one.
    pub texture: &'static str,
    /// The texture as an argument.
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
    /// Its arguments, the cosine first.
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
            let ty = language.types[usize::from(param.ty == Ty::Rgb)];
            let member = language.member.replace("{type}", ty);
            member.replace("{name}", &param.name)
        };
        let members: String = uniforms(self.params).map(member).collect();
        let block = match members.is_empty() {
            true => members,
            false => language.block.replace("{members}", &members),
        };
        let is_textured = self.params.iter().any(|param| param.ty == Ty::Texture);
        let texture = if is_textured { language.texture } else { "" };
        block + texture
    }

    fn chain(&self, language: &ChainLanguage) -> String {
        let prefix = language.prefix;
        let local = |is_rgb: bool, name: String, value: &str| {
            let local = language
                .local
                .replace("{type}", language.types[usize::from(is_rgb)]);
            let local = local.replace("{name}", &format!("{prefix}{name}"));
            format!("    {}\n", local.replace("{value}", value))
        };
        let input = |is_rgb: bool, name: &str, value: &str| {
            let ty = language.types[usize::from(is_rgb)];
            let value = language
                .input
                .replace("{type}", ty)
                .replace("{value}", value);
            local(is_rgb, name.to_owned(), &value)
        };
        let step = |i: usize| {
            let cosine = match i.checked_sub(1).map(|i| format!("{prefix}r{i}")) {
                None => input(false, "c0", "fg_in.w"),
                Some(r) if self.is_scalar => local(
                    false,
                    format!("c{i}"),
                    &format!("{r} * {prefix}w.x + {prefix}w.y"),
                ),
                Some(r) => local(
                    false,
                    format!("c{i}"),
                    &format!("{r}.x * {r}.y - {r}.z + {prefix}w.z"),
                ),
            };
            cosine + &local(!self.is_scalar, format!("r{i}"), &self.call(language, i))
        };
        let weights = input(true, "w", "fg_in.xyz");
        weights + &(0..self.evaluations).map(step).collect::<String>()
    }

    fn call(&self, language: &ChainLanguage, i: usize) -> String {
        let argument = |param: &Param| match param.ty {
            Ty::Texture => language.texture_argument.to_owned(),
            _ => language
                .argument
                .replace("{i}", &i.to_string())
                .replace("{parts}", if param.ty == Ty::Rgb { "xyz" } else { "x" })
                .replace("{name}", &param.name),
        };
        let cosine = format!("{}c{i}", language.prefix);
        let others = self.params.iter().skip(1).map(argument);
        let arguments: Vec<String> = [cosine].into_iter().chain(others).collect();
        format!("{MEASURED}({})", arguments.join(", "))
    }
}

/// The arguments that come from uniforms: all after the cosine but a texture.
pub(super) fn uniforms(params: &[Param]) -> impl Iterator<Item = &Param> {
    let params = params.iter().skip(1);
    params.filter(|param| param.ty != Ty::Texture)
}
