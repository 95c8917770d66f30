//! A material in its medium under viewing conditions, the options for deriving its inputs, and the classes of materials.

use std::sync::{Arc, OnceLock};

use super::effective::{Effective, effective};
use super::reference_curve::ReferenceCurve;
use crate::language::methods::{Class, KnownFilm, Light, Method};
use crate::physics::materials::{
    Channels, Material, MaterialKind, Surface, SurfaceError, ViewingConditions,
};
use crate::physics::optics::Layer;

/// The least n of a dielectric for which there is a fitted method.
pub const LEAST_FITTED_N: f64 = 1.2;

/// A material in its medium, to which functions are specialised.
#[derive(Clone, Debug)]
pub struct MaterialInMedium {
    /// The material's name, followed by `_in_` and the medium's name if there is one.
    pub name: String,
    /// The argument that names it again on the command line: a name, or a file's name.
    pub argument: String,
    /// The record.
    pub material: Material,
    /// The argument that names the medium again, and its record; none for air.
    pub medium: Option<(String, Material)>,
    /// Its reflectance under the viewing conditions, in unpolarised light.
    pub reference: ReferenceCurve,
    /// The effective index of each channel.
    pub effective: Effective,
    /// How inputs are derived from it.
    pub derivation: Derivation,
    /// Its film without wavelengths, at three and at six. They are expensive, so they are found once, at the first use, for all
    /// clones.
    film: [Arc<OnceLock<KnownFilm>>; 3],
}

/// A film with less k than this counts as clear.
const CLEAR_K: f64 = 0.05;

/// A material with the argument that names it: a name, or a file's name.
pub type Typed = (String, Material);

/// The fitted methods with four coefficients: of metals and semiconductors, and of dielectrics.
const FITTED_WITH_FOUR: [&str; 2] = ["fitted", "fitted_dielectric"];

/// The fitted methods of adapters for engines: of metals and semiconductors, of dielectrics, and of all under films.
pub const FITTED_IN_ENGINES: [&str; 3] = [FITTED_WITH_FOUR[0], FITTED_WITH_FOUR[1], "fitted_film"];

impl MaterialInMedium {
    /// A material in air or in a medium, under viewing conditions.
    ///
    /// # Errors
    /// The material or the medium was not measured at a wavelength of these conditions, or the light has no white in the space.
    pub fn new(
        (argument, material): Typed,
        medium: Option<Typed>,
        viewing: &ViewingConditions,
        derivation: Derivation,
    ) -> Result<MaterialInMedium, SurfaceError> {
        let around = medium.as_ref().map(|(_, medium)| medium);
        let surface = Surface::new(&material, around, viewing)?;
        let reference = ReferenceCurve::new(surface, Light::Unpolarised);
        Ok(MaterialInMedium {
            name: match around {
                Some(medium) => format!("{}_in_{}", material.name, medium.name),
                None => material.name.clone(),
            },
            effective: effective(&reference, material.optical_kind()),
            argument,
            material,
            medium,
            reference,
            derivation,
            film: Default::default(),
        })
    }

    /// Its one film at so many wavelengths, 0, 3 or 6, as `find` finds it at the first use.
    pub fn film(
        &self,
        wavelengths: usize,
        find: fn(&MaterialInMedium, usize) -> KnownFilm,
    ) -> &KnownFilm {
        self.film[wavelengths / 3].get_or_init(|| find(self, wavelengths))
    }

    /// The reference for a method's error, in the method's light. For a method that reads a table, it keeps the table's colours.
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

    /// What names it in reports: the argument, or its name where films of the command line lie on it.
    pub fn label(&self) -> &str {
        if self.material.film_arguments().is_empty() {
            &self.argument
        } else {
            &self.material.name
        }
    }

    /// Whether films lie on it.
    pub fn has_films(&self) -> bool {
        !self.material.films.is_empty()
    }

    /// Whether one film lies on it, with less k than this.
    fn has_one_film(&self, k: f64) -> bool {
        let at = |films: &Vec<Layer>| matches!(films.as_slice(), [film] if film.k < k);
        self.has_films() && self.reference.surface.films.iter().all(at)
    }

    /// The name of its class: film, metal, semiconductor or dielectric.
    pub fn class(&self) -> &'static str {
        self.material.class_name()
    }

    /// Whether the exact law for dielectrics describes it.
    fn is_glass(&self) -> bool {
        !self.has_films()
            && self.material.kind == MaterialKind::Dielectric
            && self.effective.channels.is_transparent()
    }

    /// Whether a method describes it. Films ask for a method that takes any reflectance. The exact laws for dielectrics take no k, and
    /// that for metals no small one. Fitted coefficients also describe a dielectric that absorbs.
    pub fn is_described_by(&self, method: &Method) -> bool {
        if method.class == Class::Film {
            return self.has_films();
        }
        match method.class {
            Class::OneFilm => return self.medium.is_none() && self.has_one_film(f64::INFINITY),
            Class::ClearFilm => return self.has_one_film(CLEAR_K),
            _ => {}
        }
        if self.has_films() {
            return method.class == Class::Any;
        }
        let is_followed = method.is_fitted() && self.material.kind == MaterialKind::Dielectric;
        let Channels { n, k } = &self.effective.channels;
        is_followed || (0..3).all(|i| method.class.describes(n[i], k[i]))
    }

    /// The method whose function has the material's name alone: the exact one of its class, and under films, where there is none,
    /// the fitted one.
    pub fn main_method(&self) -> &'static str {
        if self.has_films() {
            "fitted_film"
        } else if self.is_glass() {
            "dielectric_exact"
        } else {
            "conductor_exact"
        }
    }

    /// The fitted method of its class with four coefficients, for arrays of materials. None for a dielectric that is nearly
    /// index-matched, or seen from a denser medium.
    pub fn fitted_with_four(&self) -> Option<&'static str> {
        let n = self.effective.channels.n;
        match self.is_glass() {
            false => Some(FITTED_WITH_FOUR[0]),
            true if n.iter().all(|n| *n >= LEAST_FITTED_N) => Some(FITTED_WITH_FOUR[1]),
            true => None,
        }
    }

    /// The fitted method of adapters for engines: under films the one that follows them.
    pub fn fitted_in_engines(&self) -> Option<&'static str> {
        match self.has_films() {
            true => Some(FITTED_IN_ENGINES[2]),
            false => self.fitted_with_four(),
        }
    }

    /// The best fitted method for its class: a semiconductor needs five coefficients, since with four the error is eight times as
    /// large.
    pub fn fitted_method(&self) -> Option<&'static str> {
        match self.material.kind {
            _ if self.has_films() => Some("fitted_film"),
            MaterialKind::Semiconductor => Some("fitted_five"),
            _ => self.fitted_with_four(),
        }
    }

    /// The default methods of its file, the main one first.
    pub fn default_methods(&self) -> Vec<&'static str> {
        if self.has_films() {
            return vec![self.main_method(), "fitted", "schlick_rescaled", "table"];
        }
        let rest = ["schlick_rescaled", "schlick_corrected", "table"];
        let exact = [self.main_method()].into_iter();
        exact.chain(self.fitted_method()).chain(rest).collect()
    }
}

/// cos θ at which λ is matched by default: 81.37 degrees. The thesis's text matches at 84.26 degrees, but its Table 2 results
/// from cos θ = 0.15, the other end of the range that it gives.
///
/// Source of λ: Lazányi and Szirmay-Kalos, "Fresnel Term Approximations for Metals", WSCG, 2005, <https://hdl.handle.net/11025/11214>.
pub const THESIS_MATCHING_COS: f64 = 0.15;

/// The options of a derivation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivation {
    /// cos θ at which λ of the corrected method matches the exact law.
    pub matching_cos: f64,
}

impl Default for Derivation {
    fn default() -> Derivation {
        Derivation {
            matching_cos: THESIS_MATCHING_COS,
        }
    }
}

/// A class of materials. It excludes gases, dielectrics that absorb, and materials known only at three wavelengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialClass {
    /// Metals and alloys.
    Metals,
    /// Semiconductors.
    Semiconductors,
    /// Transparent liquids and solids.
    Dielectrics,
    /// Any of these under films.
    Films,
}

impl MaterialClass {
    /// All of them.
    pub const ALL: [MaterialClass; 4] = [
        MaterialClass::Metals,
        MaterialClass::Semiconductors,
        MaterialClass::Dielectrics,
        MaterialClass::Films,
    ];

    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            MaterialClass::Metals => "metals",
            MaterialClass::Semiconductors => "semiconductors",
            MaterialClass::Dielectrics => "dielectrics",
            MaterialClass::Films => "films",
        }
    }

    /// Its name in full.
    pub fn title(self) -> &'static str {
        match self {
            MaterialClass::Dielectrics => "dielectrics, n of 1.2 and more",
            MaterialClass::Films => "materials under films",
            other => other.name(),
        }
    }

    /// The class of a material in its medium.
    pub fn containing(subject: &MaterialInMedium) -> Option<MaterialClass> {
        let channels = &subject.effective.channels;
        if subject.material.rgb_nm.is_some() {
            return None;
        }
        if subject.has_films() {
            return Some(MaterialClass::Films);
        }
        let is_solid = channels.n.iter().all(|n| *n >= LEAST_FITTED_N);
        match subject.material.kind {
            MaterialKind::Metal => Some(MaterialClass::Metals),
            MaterialKind::Semiconductor => Some(MaterialClass::Semiconductors),
            MaterialKind::Dielectric if is_solid && channels.is_transparent() => {
                Some(MaterialClass::Dielectrics)
            }
            MaterialKind::Dielectric => None,
        }
    }
}
