//! What is wrong with a request, by kind: each says what was given, what is allowed, and where.

use std::path::PathBuf;

use thiserror::Error;

use crate::language::methods::Method;
use crate::physics::foreign::{self, Foreign, one_line};

/// How a material gets another name.
pub const NEW_NAME: &str = "rename one in its file; a page or a table is named after its file: rename that, or let `fresnel-gen materials import FILE --name NAME -o NAME.toml` make a material file";

/// What is wrong with a request.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RequestFault {
    /// A flag's number beyond its limits.
    #[error("--{flag} is {}; it {}", Foreign(value), one_line(allowed))]
    OutOfRange {
        /// The flag.
        flag: &'static str,
        /// What was given.
        value: String,
        /// What is allowed: `is 1 to 1000`.
        allowed: String,
    },
    /// Flags, or values of one, that contradict each other.
    #[error("{}", one_line(why))]
    Conflict {
        /// Why they do, and what to leave out.
        why: String,
    },
    /// A command of materials, and `--material none`.
    #[error("{why}")]
    NoMaterial {
        /// What the command wants of materials.
        why: &'static str,
    },
    /// Names that leave nothing to do.
    #[error("there is nothing to {work}: {why}")]
    NothingToDo {
        /// What the command does: `run`, `scan`, `measure`.
        work: &'static str,
        /// Why nothing is left.
        why: &'static str,
    },
    /// Two materials of one name.
    #[error("two different materials are named `{}`: `{}` and `{}`; {NEW_NAME}", Foreign(name), Foreign(&words[0]), Foreign(&words[1]))]
    SameName {
        /// The name.
        name: String,
        /// The words that name them.
        words: [String; 2],
    },
    /// A file of a material in the place of another's.
    #[error("{} was written of `{}`, and `{}` comes out with the same name; nothing was written; {NEW_NAME}", Foreign(file), Foreign(&words[0]), Foreign(&words[1]))]
    Namesake {
        /// The file.
        file: String,
        /// The words that name them, as a shell takes them.
        words: [String; 2],
    },
    /// A material whose name means something else.
    #[error(
        "the material `{}` has the name of {meaning}; choose another `name` in its file",
        Foreign(name)
    )]
    NameTaken {
        /// The name.
        name: String,
        /// What it means.
        meaning: &'static str,
    },
    /// A medium that no light comes through.
    #[error(
        "the medium `{}` is a {class}; a medium must be transparent: a dielectric",
        Foreign(name)
    )]
    OpaqueMedium {
        /// The medium.
        name: String,
        /// Its class.
        class: &'static str,
    },
    /// A light's file whose name is that of a standard light.
    #[error(
        "the light's file is named `{}`, as a standard light is; rename it",
        Foreign(name)
    )]
    LightNameTaken {
        /// The name.
        name: String,
    },
    /// An output that cannot lie where it should.
    #[error("{}: {why}", foreign::path(place))]
    Place {
        /// The output.
        place: PathBuf,
        /// What lies there, and the way out.
        why: &'static str,
    },
    /// A picture, a page or a report that cannot be made.
    #[error("{}", one_line(reason))]
    NotDrawn {
        /// The reason of whatever makes it.
        reason: String,
    },
}

impl RequestFault {
    /// Flags, or values of one, that contradict each other, and why.
    pub fn conflict(why: impl Into<String>) -> RequestFault {
        RequestFault::Conflict { why: why.into() }
    }

    /// A method that an effect cannot take R from.
    pub fn textured_reflectance(method: &Method) -> RequestFault {
        RequestFault::conflict(format!(
            "method `{}` reads a texture of its own, which effects do not pass on; name another --method",
            method.name
        ))
    }
}
