//! The values of a method's inputs for a material: those of fitted methods come from a fit, all others from each input's own
//! rule.

use super::known_film::known_film;
use super::problem::{FitCurve, FitObjective, coefficients_and_error};
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::language::methods::{Class, Input, KnownSurface, Method, Values};
use crate::physics::materials::Channels;
use crate::physics::num::{Precision, each_channel};
use crate::physics::optics;
use crate::physics::spectra::Gamut;

/// What the channels alone say about a surface.
pub fn known(channels: &Channels, derivation: &Derivation) -> KnownSurface {
    KnownSurface::of_index(channels.n, channels.k, derivation.matching_cos)
}

/// The values of all of a method's inputs, for a surface known only by its channels.
pub fn values(method: &Method, channels: &Channels, derivation: &Derivation) -> Values {
    if method.is_fitted() {
        let Channels { n, k } = *channels;
        let law = |i: usize, c| optics::conductor(n[i], k[i], c).unpolarised();
        let curve = FitCurve::new(|c| each_channel(|i| law(i, c)));
        return fitted_coefficients(method, Precision::F32, &curve);
    }
    values_of(method, &known(channels, derivation))
}

/// The values of a method's inputs for a material under viewing conditions.
pub fn values_for_material(subject: &MaterialInMedium, method: &Method) -> Values {
    values_for_material_in(Precision::F32, subject, method)
}

/// The same, with fitted coefficients rounded to this precision.
pub fn values_for_material_in(
    precision: Precision,
    subject: &MaterialInMedium,
    method: &Method,
) -> Values {
    if method.is_fitted() {
        return fitted_coefficients(method, precision, &FitCurve::unclipped(subject));
    }
    let seen = |cos_theta| subject.reference.at(cos_theta);
    let Channels { n, k } = subject.effective.channels;
    let mut known = KnownSurface::with(n, k, seen, subject.derivation.matching_cos);
    if matches!(method.class, Class::OneFilm | Class::ClearFilm) && subject.is_described_by(method)
    {
        known.film = subject.film(method.wavelengths, known_film).clone();
    }
    values_of(method, &known)
}

/// The coefficients of a fitted method for a curve, in this precision, for a function that ends with a clamp.
fn fitted_coefficients(method: &Method, precision: Precision, curve: &FitCurve) -> Values {
    let aim = FitObjective {
        precision,
        gamut: Gamut::Keep,
        ..FitObjective::default()
    };
    let fitted = coefficients_and_error(method, curve, aim);
    let fitted = fitted.expect("a fitted method's terms tell angles apart; a test fits them all");
    fitted.0
}

/// The values of all inputs of a method except a texture. A method that solves its colours for an index gets colours that some
/// index has.
fn values_of(method: &Method, surface: &KnownSurface) -> Values {
    assert!(!method.is_fitted(), "coefficients come of a fit: a bug");
    let surface = if method.replacement.is_some() {
        &KnownSurface::of_index(surface.n, surface.k, surface.matching_cos)
    } else {
        surface
    };
    let value = |input: &Input| Some((input.name.to_owned(), input.value(surface)?));
    method.inputs.iter().filter_map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::ALL;

    #[test]
    fn every_input_of_every_method_has_a_derivation() {
        let channels = Channels {
            n: [0.23, 0.57, 1.39],
            k: [3.94, 2.18, 1.72],
        };
        for method in ALL {
            let values = values(method, &channels, &Derivation::default());
            let textures = usize::from(method.is_textured());
            assert_eq!(values.len() + textures, method.inputs.len());
            assert!(
                values.values().flatten().all(|value| value.is_finite()),
                "{}: {values:?}",
                method.name
            );
        }
    }
}
