//! What a worker is asked about a user's function, and what it answers. Numbers go as bits: what is run may give NaN.

use serde::{Deserialize, Serialize};

use crate::lab::gpu::{Argument, Uniform};
use crate::lab::verify::compilers::CompilerFault;
use crate::physics::num::Precision;

use super::accept::Accepted;
use super::language::Language;

/// What a worker is asked.
#[derive(Debug, Serialize, Deserialize)]
pub enum AuditRequest {
    /// To ask the compilers of a language about a whole program whose `half` computes in this.
    Accept(Language, Precision, String),
    /// To make SPIR-V of a shader.
    Module(Language, Precision, String),
    /// To compile a program.
    Prepare(ProgramCode, Vec<UniformBits>),
    /// To run it over cosines.
    Run(Vec<u32>),
}

/// What a worker answers.
#[derive(Debug, Serialize, Deserialize)]
pub enum AuditResponse {
    /// What the compilers say.
    Accepted(Accepted),
    /// What the compiler has made, or why it has not.
    Module(Result<Vec<u8>, CompilerFault>),
    /// It is compiled, for this device.
    Ready(String),
    /// Something is missing here.
    Absent(String),
    /// A compiler refused it, or the device failed: its name, and its message.
    Refused(String, String),
    /// The results.
    Ran(Vec<[u32; 3]>),
}

/// A program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum ProgramCode {
    /// In WGSL.
    Wgsl(String),
    /// In GLSL ES 3.00.
    Gles(String),
    /// A module that DXC or slangc has made.
    Spirv(Vec<u8>),
}

/// A uniform with its value as bits.
#[derive(Debug, Serialize, Deserialize)]
pub struct UniformBits {
    name: String,
    is_rgb: bool,
    bits: [u32; 3],
}

impl UniformBits {
    /// As it is sent.
    pub fn new(uniform: &Uniform) -> UniformBits {
        let (is_rgb, value) = match uniform.value {
            Argument::Rgb(value) => (true, value),
            Argument::Scalar(value) => (false, [value; 3]),
        };
        UniformBits {
            name: uniform.name.clone(),
            is_rgb,
            bits: value.map(f32::to_bits),
        }
    }

    /// As it is bound.
    pub fn uniform(&self) -> Uniform {
        let value = self.bits.map(f32::from_bits);
        Uniform {
            name: self.name.clone(),
            value: if self.is_rgb {
                Argument::Rgb(value)
            } else {
                Argument::Scalar(value[0])
            },
        }
    }
}
