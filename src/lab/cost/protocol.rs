//! What a process with a family's compiler is asked, and what it answers.

use serde::{Deserialize, Serialize};

use super::figures::Statistics;

/// What it is asked.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum CompilerRequest {
    /// Who it is.
    Name,
    /// What a shader becomes.
    Measure(FragmentShader),
}

/// A fragment shader.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum FragmentShader {
    /// In the compiler's language, or in WGSL for one that takes SPIR-V.
    Text(String),
    /// A module of SPIR-V.
    Module(Vec<u8>),
}

/// What it answers.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum CompilerResponse {
    /// It is here: its name and version.
    Name(String),
    /// It is not, and why.
    Absent(String),
    /// What it says of a shader.
    Statistics(Statistics),
    /// It refuses a shader, and why.
    Refused(String),
}

impl CompilerResponse {
    /// The compiler's name and version.
    pub fn name(self) -> Result<String, String> {
        match self {
            CompilerResponse::Name(name) => Ok(name),
            CompilerResponse::Absent(why) | CompilerResponse::Refused(why) => Err(why),
            CompilerResponse::Statistics(_) => Err("it answers another question".to_owned()),
        }
    }

    /// What it says of a shader.
    pub fn statistics(self) -> Result<Statistics, String> {
        match self {
            CompilerResponse::Statistics(statistics) => Ok(statistics),
            CompilerResponse::Refused(why)
            | CompilerResponse::Absent(why)
            | CompilerResponse::Name(why) => Err(why),
        }
    }
}
