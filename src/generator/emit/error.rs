//! The errors of emission.

use crate::generator::reference::MaterialInMedium;
use crate::language::methods::Method;
use crate::physics::foreign::{Foreign, one_line};

/// An error of emission.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A name cannot be used in a language, because of the prefix.
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
    /// A bug: the generated text is not valid in its language.
    #[error("this is a bug in fresnel-gen: {}: {}", Foreign(file), one_line(what))]
    Generated {
        /// The file.
        file: String,
        /// What a checker said.
        what: String,
    },
}

impl Error {
    /// A method cannot be specialised to a material, for this reason.
    pub(super) fn specialise(method: &Method, subject: &MaterialInMedium, what: String) -> Error {
        Error::Specialise {
            method: method.name.to_owned(),
            material: subject.name.clone(),
            what,
        }
    }

    /// What was generated for this file is wrong.
    pub(in crate::generator) fn generated(file: &str, what: impl ToString) -> Error {
        Error::Generated {
            file: file.to_owned(),
            what: what.to_string(),
        }
    }
}
