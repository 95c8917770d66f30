//! The errors of methods as `data/records/errors.csv` has them, since finding them for the whole catalogue takes half a minute of a
//! processor. A row has a fingerprint of what its errors depend on: what the function computes, and the material with its films, its
//! light and its space of colours. Errors without a row are found anew. A test finds all of them anew.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::generator::fit::{InputChoice, MethodErrors};
use crate::generator::reference::MaterialInMedium;
use crate::physics::digest::sha256;
use crate::physics::materials::Material;
use crate::physics::records::rows;
use crate::physics::spectra::Space;

static RECORD: &str = include_str!("../../../data/records/errors.csv");

/// A row of the record.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct RecordedErrors {
    /// The material that was typed.
    pub material: String,
    /// The method.
    pub method: String,
    /// `intended` or `best`.
    pub inputs: String,
    /// Of the function, the inputs' choice and the material.
    pub fingerprint: String,
    /// As in [`MethodErrors`], all four.
    pub max_abs: Option<f64>,
    /// The mean relative error.
    pub mean_rel: Option<f64>,
    /// The error of luminance.
    pub luminance: Option<f64>,
    /// The difference of colours.
    pub de2000: Option<f64>,
}

/// All that is recorded, by fingerprint.
pub static RECORDED: LazyLock<HashMap<String, MethodErrors>> = LazyLock::new(|| {
    let all = rows::<RecordedErrors>(RECORD).into_iter();
    all.map(|row| (row.fingerprint.clone(), row.errors()))
        .collect()
});

impl RecordedErrors {
    fn errors(&self) -> MethodErrors {
        MethodErrors {
            max_abs: self.max_abs,
            mean_rel: self.mean_rel,
            luminance: self.luminance,
            de2000: self.de2000,
        }
    }
}

/// The fingerprint of errors: of a function, given by its own fingerprint, with these inputs, for a material, given by its mark.
pub fn fingerprint(function: &str, inputs: InputChoice, material: &str) -> String {
    let inputs = inputs.name();
    sha256(format!("{function} {inputs} {material}").as_bytes())[..16].to_owned()
}

/// A mark of all that a material's own errors depend on: what was measured of it, its films and what is around it, the light, the space
/// of colours, and the options of derived inputs. Its name and notes are not among them.
pub fn mark(subject: &MaterialInMedium, space: Space) -> String {
    let measured = |material: &Material| format!("{:?} {:?}", material.n, material.k);
    let films = subject.material.films.iter();
    let films: Vec<String> = films
        .map(|film| format!("{} of {}", film.thickness_nm, measured(&film.material)))
        .collect();
    let medium = subject.medium.as_ref().map(|(_, medium)| measured(medium));
    let surface = &subject.reference.surface;
    let seen = (&surface.indices, &surface.films, &surface.integrator);
    let choices = (
        surface.gamut,
        space,
        subject.derivation,
        subject.material.kind,
    );
    let own = measured(&subject.material);
    sha256(format!("{own} {films:?} {medium:?} {seen:?} {choices:?}").as_bytes())
}
