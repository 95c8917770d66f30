//! What is wrong with a glTF file, and where in its JSON.

use crate::physics::foreign::{Foreign, one_line};

/// A fault of a glTF file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {}: {}", Foreign(file), Foreign(place), one_line(what))]
pub struct GltfFault {
    /// The file, as the user named it.
    pub file: String,
    /// Where in its JSON, as `meshes[2].primitives[0].attributes.POSITION`, or in its bytes.
    pub place: String,
    /// What was found, and what is allowed.
    pub what: String,
}

/// A fault before the file's name is known.
#[derive(Debug)]
pub struct Place {
    place: String,
    what: String,
}

impl Place {
    pub fn new(place: impl Into<String>, what: impl Into<String>) -> Place {
        Place {
            place: place.into(),
            what: what.into(),
        }
    }

    pub fn fault(self, file: &str) -> GltfFault {
        GltfFault {
            file: file.to_owned(),
            place: self.place,
            what: self.what,
        }
    }
}
