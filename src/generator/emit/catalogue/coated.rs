//! A metal under the clear coat of an engine: coefficients of what the base must add, so that base and coat together reflect what both
//! interfaces do ([`Surface::through_coat`](crate::physics::materials::Surface::through_coat)).

use crate::generator::fit::{FitCurve, FitObjective, weighted_coefficients};
use crate::generator::reference::{MaterialInMedium, cosines};
use crate::language::methods::Method;
use crate::physics::materials::MaterialKind;
use crate::physics::num::each_channel;
use crate::physics::optics::dielectric;

/// The index of engines' clear coats: their F0 is .04, as in KHR_materials_clearcoat,
/// <https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_materials_clearcoat>.
pub const COAT: f64 = 1.5;

/// The base of a clear coat.
#[derive(Clone, Debug)]
pub struct Coated {
    /// The coefficients of the material's method, three channels each, in f32.
    pub coefficients: Vec<[f64; 3]>,
    /// The mean over the hemisphere.
    pub average: [f64; 3],
    /// The largest error of what coat and base reflect together, over angles and channels.
    pub max_abs: f64,
    /// The cosine of the largest error.
    pub worst_cos: f64,
}

impl Coated {
    /// The base of a metal or a semiconductor in air. None for dielectrics, which hardly show below a coat, and in other media.
    pub fn of(subject: &MaterialInMedium, method: &'static Method) -> Option<Coated> {
        let mut medium = subject.medium.iter();
        let is_in_air = medium.all(|(_, medium)| medium.name == "air");
        if subject.material.kind == MaterialKind::Dielectric || !is_in_air {
            return None;
        }
        let surface = &subject.reference.surface;
        let seen = |c: f64| {
            surface
                .gamut
                .apply(surface.through_coat(COAT, c))
                .to_array()
        };
        let aim = FitObjective {
            gamut: surface.gamut,
            ..FitObjective::default()
        };
        // What is seen of the base has passed the coat.
        let passed = |c: f64| 1.0 - dielectric(COAT, c).unpolarised();
        let weight = |c: f64| passed(c).max(LEAST_WEIGHT);
        let coefficients = weighted_coefficients(method, &FitCurve::new(seen), aim, weight)?;
        let basis = method.basis()?;
        let of = |weights: &[f64]| {
            each_channel(|channel| {
                let terms = coefficients.iter().zip(weights);
                terms
                    .map(|(c, weight)| c[channel] * weight)
                    .sum::<f64>()
                    .clamp(0.0, 1.0)
            })
        };
        let average = of(&basis.averages());
        let off = |c: f64| {
            let mut terms = vec![0.0; basis.terms()];
            basis.add(c, 1.0, &mut terms);
            let (got, want) = (of(&terms), seen(c));
            let apart = each_channel(|i| (got[i] - want[i]).abs());
            (passed(c) * apart.into_iter().fold(0.0, f64::max), c)
        };
        let all = cosines(ANGLES).into_iter().map(off);
        let (max_abs, worst_cos) = all.fold(
            (0.0, 1.0),
            |most, one| if one.0 > most.0 { one } else { most },
        );
        Some(Coated {
            coefficients,
            average,
            max_abs,
            worst_cos,
        })
    }
}

/// The least weight of an error, where nothing enters the coat.
const LEAST_WEIGHT: f64 = 1e-3;
/// The angles over which the error is sought.
const ANGLES: usize = 256;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::reference::Derivation;
    use crate::language::methods::find;
    use crate::physics::materials::{self, ViewingConditions};

    #[test]
    fn metals_below_a_coat_are_followed() {
        let viewing = ViewingConditions::default();
        let of = |name: &str, method: &str| {
            let typed = (name.to_owned(), materials::find(name).unwrap().unwrap());
            let subject =
                MaterialInMedium::new(typed, None, &viewing, Derivation::default()).unwrap();
            Coated::of(&subject, find(method).unwrap())
        };
        for name in [
            "gold", "copper", "silver", "platinum", "titanium", "silicon",
        ] {
            let coated = of(name, "fitted").unwrap();
            assert!(
                coated.max_abs < 0.0125,
                "{name}: {} at {}",
                coated.max_abs,
                coated.worst_cos
            );
        }
        assert!(
            of("anodised_titanium_purple", "fitted_film")
                .unwrap()
                .max_abs
                < 0.0125
        );
        assert!(of("water", "fitted_dielectric").is_none());
    }
}
