//! A material in its medium, as it is seen.

use crate::language::methods::{Light, Method};
use crate::physics::materials::{
    Channels, Material, MaterialKind, Surface, Unseen, ViewingConditions,
};

use super::derivation::Derivation;
use super::effective::{Effective, effective};
use super::reference_curve::ReferenceCurve;

/// The least n of a dielectric that fitted methods follow.
pub const LEAST_FITTED_N: f64 = 1.2;

/// A material in its medium, as functions are specialised to it.
#[derive(Clone, Debug)]
pub struct MaterialInMedium {
    /// The material's name, with `_in_` and the medium's where there is one.
    pub name: String,
    /// What a user types to get it again: a name, or a file's name.
    pub argument: String,
    /// The record.
    pub material: Material,
    /// What a user types to get the medium again, and its record, where it is not air.
    pub medium: Option<(String, Material)>,
    /// What is seen of it, in unpolarised light.
    pub reference: ReferenceCurve,
    /// The index per channel that stands for it.
    pub effective: Effective,
    /// How inputs are derived from it.
    pub derivation: Derivation,
}

/// A material with what a user types to get it: a name, or a file's name.
pub type Typed = (String, Material);

/// The fitted methods of four coefficients that materials have: of metals and semiconductors, and of dielectrics.
pub const FITTED_WITH_FOUR: [&str; 2] = ["fitted", "fitted_dielectric"];

impl MaterialInMedium {
    /// A material in air or in a medium, as it is seen.
    ///
    /// # Errors
    /// The material or the medium was not measured at a wavelength of these conditions, or the light has no white in the space.
    pub fn new(
        (argument, material): Typed,
        medium: Option<Typed>,
        viewing: &ViewingConditions,
        derivation: Derivation,
    ) -> Result<MaterialInMedium, Unseen> {
        let around = medium.as_ref().map(|(_, medium)| medium);
        let surface = Surface::new(&material, around, viewing)?;
        let reference = ReferenceCurve::new(surface, Light::Unpolarised);
        Ok(MaterialInMedium {
            name: match around {
                Some(medium) => format!("{}_in_{}", material.name, medium.name),
                None => material.name.clone(),
            },
            effective: effective(&reference, material.kind),
            argument,
            material,
            medium,
            reference,
            derivation,
        })
    }

    /// What a method's error is held against: the reference in its light; what reads a table keeps the table's colours.
    pub fn truth_for(&self, method: &Method) -> ReferenceCurve {
        let reference = if method.light == self.reference.light {
            self.reference.clone()
        } else {
            ReferenceCurve::new(self.reference.surface.clone(), method.light)
        };
        if method.is_textured() {
            reference.before_gamut()
        } else {
            reference
        }
    }

    /// Whether the exact law for dielectrics serves it.
    fn is_glass(&self) -> bool {
        self.material.kind == MaterialKind::Dielectric && self.effective.channels.is_transparent()
    }

    /// Whether a method describes it: the exact laws for dielectrics take no k, that for metals takes no small one. Coefficients
    /// follow a dielectric that absorbs too.
    pub fn is_described_by(&self, method: &Method) -> bool {
        let is_followed = method.is_fitted() && self.material.kind == MaterialKind::Dielectric;
        let Channels { n, k } = &self.effective.channels;
        is_followed || (0..3).all(|i| method.class.describes(n[i], k[i]))
    }

    /// The exact method of its class.
    pub fn exact_method(&self) -> &'static str {
        if self.is_glass() {
            "dielectric_exact"
        } else {
            "conductor_exact"
        }
    }

    /// The fitted method of its class with four coefficients, for arrays of materials. None follows a dielectric that is nearly
    /// matched, or seen from a denser medium.
    pub fn fitted_with_four(&self) -> Option<&'static str> {
        let n = self.effective.channels.n;
        match self.is_glass() {
            false => Some(FITTED_WITH_FOUR[0]),
            true if n.iter().all(|n| *n >= LEAST_FITTED_N) => Some(FITTED_WITH_FOUR[1]),
            true => None,
        }
    }

    /// The fitted method that suits its class: a semiconductor's needs five coefficients, or errs eight times as much.
    pub fn fitted_method(&self) -> Option<&'static str> {
        match self.material.kind {
            MaterialKind::Semiconductor => Some("fitted_five"),
            _ => self.fitted_with_four(),
        }
    }

    /// The methods that its file holds unless others are asked for: the exact one first.
    pub fn default_methods(&self) -> Vec<&'static str> {
        let rest = ["schlick_rescaled", "schlick_corrected", "table"];
        let exact = [self.exact_method()].into_iter();
        exact.chain(self.fitted_method()).chain(rest).collect()
    }
}
