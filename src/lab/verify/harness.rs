//! Harnesses: the code around the text of a file that runs one of its functions over cosines. The text itself stays as it is, to
//! the byte. The code of each language stands in its target's [`Harness`].

use super::naga_translation::Gles;
use crate::generator::emit::{EmittedFunction, uniform_offsets};
use crate::language::ir::{Param, Ty};
use crate::language::targets::{DESKTOP, GLSL, Harness, STREAM, Target, WGSL, filled};
use crate::physics::num::Precision;

/// A function as a harness calls it.
#[derive(Clone, Copy, Debug)]
pub struct Call<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its arguments, `cos_theta` first where it takes one.
    pub params: &'a [Param],
    /// Whether it returns one channel.
    pub is_scalar: bool,
    /// The precision that it computes in. Inputs and outputs are f32 in any case.
    pub precision: Precision,
}

/// The entry point of every harness.
pub const ENTRY: &str = "fg_main";

impl Call<'_> {
    /// The call of a function.
    pub fn to_emitted(emitted: &EmittedFunction) -> Call<'_> {
        Call {
            name: &emitted.name,
            params: &emitted.function.params,
            is_scalar: emitted.function.ty() == Ty::Scalar,
            precision: emitted.precision,
        }
    }

    fn numbers(&self) -> impl Iterator<Item = &Param> {
        let params = self.params.iter();
        params.filter(|param| param.ty != Ty::Texture && !param.is_cosine())
    }

    fn ty(&self) -> Ty {
        if self.is_scalar { Ty::Scalar } else { Ty::Vec3 }
    }

    /// Whether it reads a texture.
    pub fn is_textured(&self) -> bool {
        self.params.iter().any(|param| param.ty == Ty::Texture)
    }

    /// The call, with each argument in the form of this language.
    fn call_text(
        &self,
        cos_theta: &str,
        texture: &str,
        number: impl Fn(&Param) -> String,
    ) -> String {
        let argument = |param: &Param| match param.ty {
            Ty::Texture => texture.to_owned(),
            _ if param.is_cosine() => cos_theta.to_owned(),
            _ => number(param),
        };
        let arguments: Vec<String> = self.params.iter().map(argument).collect();
        format!("{}({})", self.name, arguments.join(", "))
    }
}

/// A program around the text of a file that calls one of its functions for each cosine. None for a target that is not run as text.
pub fn program(target: &Target, file: &str, call: &Call) -> Option<String> {
    let harness = target.stack.harness()?;
    Some(program_in(harness, target, file, call))
}

/// As [`program`], for desktop GLSL, which no target runs as text.
pub fn desktop(file: &str, call: &Call) -> String {
    program_in(&DESKTOP, &GLSL, file, call)
}

/// As [`program`], for WGSL, where the cosines are all f32 from a first one on.
pub fn stream(file: &str, call: &Call) -> String {
    program_in(&STREAM, &WGSL, file, call)
}

fn program_in(harness: &Harness, target: &Target, file: &str, call: &Call) -> String {
    let spelling = &target.spelling;
    let offsets = uniform_offsets(call.params);
    let members: String = call
        .numbers()
        .zip(offsets)
        .map(|(param, offset)| {
            let holes: &[(&str, &str)] = &[
                ("type", spelling.ty(param.ty)),
                ("offset", &offset.to_string()),
                ("name", &param.name),
            ];
            filled(harness.member, holes)
        })
        .collect();
    let block = if members.is_empty() {
        String::new()
    } else {
        filled(harness.block, &[("members", &members)])
    };
    let texture = if call.is_textured() {
        harness.texture
    } else {
        ""
    };
    let converted = |ty: Ty, value: String, precision: Precision| match call.precision {
        Precision::F16 if harness.converts => {
            format!("{}({value})", target.spelling_in(precision).ty(ty))
        }
        _ => value,
    };
    let cosine = converted(Ty::Scalar, harness.cosine.to_owned(), Precision::F16);
    let value = call.call_text(&cosine, harness.texture_argument, |param| {
        let value = filled(harness.argument, &[("name", &param.name)]);
        converted(param.ty, value, Precision::F16)
    });
    let value = converted(call.ty(), value, Precision::F32);
    let value = if call.is_scalar {
        filled(harness.splat, &[("value", &value)])
    } else {
        value
    };
    let holes: &[(&str, &str)] = &[
        ("block", &block),
        ("texture", texture),
        ("cosines", harness.cosines),
        ("count", harness.count),
        ("value", &value),
    ];
    let after = filled(harness.after, holes);
    format!("{}{file}{after}", harness.before)
}

/// A vertex shader around a WGSL file, with the values of the arguments in it. naga translates it into GLSL ES.
pub fn wgsl_vertex(file: &str, call: &Call, values: &[[f32; 3]]) -> String {
    let texture = if call.is_textured() {
        STREAM.texture
    } else {
        ""
    };
    let value = call.call_text("fg_cosine", "fg_table, fg_sampler", |param| {
        let place = call.numbers().position(|other| other.name == param.name);
        let [r, g, b] = place
            .and_then(|i| values.get(i))
            .copied()
            .unwrap_or_default();
        if param.ty == Ty::Vec3 {
            format!("vec3<f32>({r:?}f, {g:?}f, {b:?}f)")
        } else {
            format!("{r:?}f")
        }
    });
    format!(
        "{file}
{texture}struct FgResult {{
    @builtin(position) fg_position: vec4<f32>,
    @location(0) fg_value: vec3<f32>,
}}
@vertex
fn {ENTRY}(@location(0) fg_cosine: f32) -> FgResult {{
    return FgResult(vec4<f32>(), vec3<f32>({value}));
}}
"
    )
}

/// naga's GLSL ES, renamed to the names that are bound here.
pub fn renamed(made: &Gles) -> String {
    let pairs = [
        (made.inputs.get(&0), "cos_theta"),
        (made.outputs.get(&0), "reflectance"),
        (made.textures.get(&(0, 3)), "table"),
    ];
    pairs
        .iter()
        .fold(made.text.clone(), |text, (from, to)| match from {
            Some(from) => text.replace(from.as_str(), to),
            None => text,
        })
}
