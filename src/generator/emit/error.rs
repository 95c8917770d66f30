//! What can go wrong in emission.

use crate::physics::foreign::{Foreign, one_line};

/// An error of this room.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A name cannot be used in a language: the prefix is at fault.
    #[error("{}; choose another --prefix", one_line(what))]
    Name {
        /// The name and why.
        what: String,
    },
    /// A method cannot be specialised to a material.
    #[error(
        "method `{}` cannot be specialised to `{}`: {}",
        Foreign(method),
        Foreign(material),
        one_line(what)
    )]
    Specialise {
        /// The method.
        method: String,
        /// The material.
        material: String,
        /// Why not.
        what: String,
    },
    /// A bug: what was generated is not what its language allows.
    #[error("this is a bug in fresnel-gen: {}: {}", Foreign(file), one_line(what))]
    Generated {
        /// The file.
        file: String,
        /// What a checker said.
        what: String,
    },
}
