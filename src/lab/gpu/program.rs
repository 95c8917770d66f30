//! Programs and their arguments.

use super::texture::{Texture, TextureShape};
use crate::lab::fault::Fault;

/// A shader to be run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShaderCode<'a> {
    /// A WGSL module with a compute entry point.
    Wgsl(&'a str),
    /// A SPIR-V module with a compute entry point, passed to the driver unchanged. The caller must have validated it, since a
    /// driver may do anything with an invalid module.
    Spirv(&'a [u8]),
    /// A vertex shader in GLSL ES 3.00, complete, `#version` included.
    Gles(&'a str),
}

/// A program: cosines in, reflectances out.
///
/// In compute, workgroups are 64 wide. Group 0 holds: binding 0, a uniform block with the run-time arguments, none if there are
/// none; binding 1, the cosines or, in a stream, the bits of the first; binding 2, a storage array of `vec4<f32>` with one
/// element per point; bindings 3 and 4, a `texture_2d<f32>` and its sampler, none if there is no texture. The last workgroup may
/// extend beyond the points, so the program must check `arrayLength`.
///
/// A vertex shader has `in highp float cos_theta`, its arguments as uniforms by name, `uniform highp sampler2D table`
/// if there is a texture, and `out highp vec3 reflectance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Program<'a> {
    /// The shader.
    pub code: ShaderCode<'a>,
    /// The entry point. In GLSL ES it is always `main`, and this is ignored.
    pub entry: &'a str,
    /// The run-time arguments in the order of the block. Only names and shapes matter here.
    pub uniforms: &'a [Uniform],
    /// The texture that it reads.
    pub texture: Option<TextureShape>,
}

/// The content of binding 1 of a compute program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PointInputs {
    /// `var<storage, read> cosines: array<f32>`.
    Cosines,
    /// `var<uniform> first: u32`: point i has the bits `first + i`.
    Bits,
    /// `var<storage, read> points: array<vec4<f32>>`, with so many elements per point.
    Places(usize),
}

/// A run-time argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Uniform {
    /// Its name in the text.
    pub name: String,
    /// Its value.
    pub value: Argument,
}

/// The value of an argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Argument {
    /// `f32`, `float`.
    Scalar(f32),
    /// `vec3<f32>`, `vec3`.
    Rgb([f32; 3]),
}

/// The bytes of the uniform block of these arguments, by the rules that WGSL and std140 share. Three channels begin at a multiple
/// of 16 bytes, and a scalar may follow them in the fourth component.
pub(super) fn block(uniforms: &[Uniform]) -> Vec<u8> {
    let mut words: Vec<f32> = Vec::new();
    for uniform in uniforms {
        match uniform.value {
            Argument::Scalar(value) => words.push(value),
            Argument::Rgb(value) => {
                words.resize(words.len().next_multiple_of(4), 0.0);
                words.extend(value);
            }
        }
    }
    words.resize(words.len().next_multiple_of(4), 0.0);
    bytemuck::cast_slice(&words).to_vec()
}

/// Checks that a program gets the arguments and the texture that it was prepared for.
///
/// # Errors
/// It does not, and the fault says what differs.
pub(super) fn check_fit(
    wanted: &[Uniform],
    given: &[Uniform],
    wanted_texture: Option<TextureShape>,
    texture: Option<&Texture>,
) -> Result<(), Fault> {
    let shape = |uniform: &Uniform| match uniform.value {
        Argument::Scalar(_) => format!("{}: scalar", uniform.name),
        Argument::Rgb(_) => format!("{}: rgb", uniform.name),
    };
    let shapes = |uniforms: &[Uniform]| uniforms.iter().map(shape).collect::<Vec<_>>().join(", ");
    let (want, got) = (shapes(wanted), shapes(given));
    if want != got {
        return Err(Fault::refused(format!(
            "its arguments are ({want}), and it is run with ({got})"
        )));
    }
    match (wanted_texture, texture.map(|texture| texture.shape)) {
        (Some(_), None) => Err(Fault::refused("it reads a texture and is run with none")),
        (None, Some(_)) => Err(Fault::refused("it reads no texture and is run with one")),
        (Some(want), Some(got)) if want != got => Err(Fault::refused(format!(
            "it reads a texture that is {want:?}, and is run with one that is {got:?}"
        ))),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scalar_fills_the_fourth_place_and_three_channels_are_aligned() {
        let uniform = |value| Uniform {
            name: String::new(),
            value,
        };
        let words = |values: &[Argument]| {
            let uniforms: Vec<Uniform> = values.iter().copied().map(uniform).collect();
            bytemuck::pod_collect_to_vec::<u8, f32>(&block(&uniforms))
        };
        let rgb = Argument::Rgb([1.0, 2.0, 3.0]);
        let scalar = Argument::Scalar(4.0);
        assert!(words(&[]).is_empty());
        assert_eq!(words(&[scalar]), [4.0, 0.0, 0.0, 0.0]);
        assert_eq!(words(&[rgb, scalar]), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(
            words(&[scalar, rgb]),
            [4.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 0.0]
        );
    }
}
