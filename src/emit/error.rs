//! What can go wrong in emission.

/// An error of this room.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A name cannot be used in a language: the prefix is at fault.
    #[error("{what}; choose another --prefix")]
    Name {
        /// The name and why.
        what: String,
    },
    /// A method cannot be specialised to a material.
    #[error("method `{method}` cannot be specialised to `{material}`: {what}")]
    Specialise {
        /// The method.
        method: String,
        /// The material.
        material: String,
        /// Why not.
        what: String,
    },
    /// A bug: what was generated is not what its language allows.
    #[error("this is a bug in fresnel-gen: {file}: {what}")]
    Generated {
        /// The file.
        file: String,
        /// What a checker said.
        what: String,
    },
}
