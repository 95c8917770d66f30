//! What a method's inputs are for a material: each derived from n and k per channel, by the input's name.

use std::collections::BTreeMap;

use crate::ir::Ty;
use crate::materials::Channels;
use crate::methods::{
    BELCOUR_COSINES, Input, Method, ONLY_ROW, TEXELS, Values, WARP, belcour_weights,
};
use crate::num::Precision;
use crate::optics::{self, COS_82};

use super::fitted::{Aim, Curve, Task, basis};
use super::lambda::{THESIS_MATCHING_COS, lambda_for};

/// The choices that a derivation leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivation {
    /// cos θ at which λ of the corrected method meets the exact law.
    pub matching_cos: f64,
}

impl Default for Derivation {
    fn default() -> Derivation {
        Derivation {
            matching_cos: THESIS_MATCHING_COS,
        }
    }
}

/// cos θ at which the empirical term meets the exact law: 60 degrees.
const COS_60: f64 = 0.5;

/// What inputs are derived from: the index per channel, and reflectances at a few angles. Where a channel is one
/// wavelength these are the law's; where it is a whole spectrum they are the spectrum's, and the index stands for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// The index per channel.
    pub channels: Channels,
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// At 81.79 degrees.
    pub f82: [f64; 3],
    /// At 60 degrees.
    f60: [f64; 3],
    /// At the angle where λ is matched.
    matching: [f64; 3],
    /// At the two angles where Belcour's curves are weighed.
    belcour: [[f64; 3]; 2],
}

impl Known {
    /// Of a surface that is known by its channels alone.
    pub fn of_channels(channels: &Channels, derivation: &Derivation) -> Known {
        let law = |c: f64| [0, 1, 2].map(|i| exact(channels.n[i], channels.k[i], c));
        let normal = [0, 1, 2].map(|i| f0(channels.n[i], channels.k[i]));
        Known {
            f0: normal,
            ..Known::with(*channels, law, derivation)
        }
    }

    /// Of a surface for which these channels stand, by what it reflects at a cosine.
    pub fn with(
        channels: Channels,
        seen: impl Fn(f64) -> [f64; 3],
        derivation: &Derivation,
    ) -> Known {
        Known {
            channels,
            f0: seen(1.0),
            f82: seen(COS_82),
            f60: seen(COS_60),
            matching: seen(derivation.matching_cos),
            belcour: BELCOUR_COSINES.map(&seen),
        }
    }
}

/// The values of all inputs of a method for a surface known by its channels alone.
pub fn values(method: &Method, channels: &Channels, derivation: &Derivation) -> Values {
    if method.is_fitted() {
        let Channels { n, k } = *channels;
        let curve = Curve::new(|c| [0, 1, 2].map(|i| exact(n[i], k[i], c)));
        return fitted_values(method, Precision::F32, &curve);
    }
    let known = Known::of_channels(channels, derivation);
    values_of(method, &known, derivation)
}

/// The coefficients of a fitted method for a curve, as a precision holds them.
pub fn fitted_values(method: &Method, precision: Precision, curve: &Curve) -> Values {
    let aim = Aim {
        precision,
        ..Aim::default()
    };
    let fitted = fitted_for(method, curve, aim);
    let fitted = fitted.expect("a fitted method's terms tell angles apart; a test fits them all");
    fitted.0
}

/// The coefficients of a fitted method for a curve with an aim, and the largest error in its measure on paper. None where the
/// method is not fitted, or its terms do not tell angles apart under such weights.
pub fn fitted_for(method: &Method, curve: &Curve, aim: Aim) -> Option<(Values, f64)> {
    let fit = Task::new(curve, aim).fit(&basis(&method.shape?))?;
    let names = Input::COEFFICIENTS.map(|input| input.name.to_owned());
    Some((names.into_iter().zip(fit.coefficients).collect(), fit.error))
}

/// The values of all inputs of a method but a texture. A λ that does not exist is 0, which drops the term. A method that solves its
/// colours for an index gets colours that an index has.
pub fn values_of(method: &Method, known: &Known, derivation: &Derivation) -> Values {
    let solvable;
    let known = if method.specialised.is_some() {
        solvable = Known::of_channels(&known.channels, derivation);
        &solvable
    } else {
        known
    };
    let value = |name: &str| derived(name, known, derivation);
    let numbers = method.inputs.iter().filter(|input| input.ty != Ty::Texture);
    numbers
        .map(|input| (input.name.to_owned(), value(input.name)))
        .collect::<BTreeMap<_, _>>()
}

/// The value of one input of the vocabulary.
pub fn derived(name: &str, known: &Known, derivation: &Derivation) -> [f64; 3] {
    let Channels { n, k } = known.channels;
    let each = |f: &dyn Fn(usize) -> f64| [0, 1, 2].map(f);
    match name {
        "eta" | "n" => n,
        "k" => k,
        "f0" => known.f0,
        "f90" => [1.0; 3],
        "f82" => known.f82,
        "tint" => each(&|i| known.f82[i] / schlick_82(known.f0[i])),
        "reflectivity" => each(&|i| f0(n[i], k[i])),
        "edge_tint" => each(&|i| edge_tint(n[i], k[i])),
        "bias" => [mean(known.f0); 3],
        "scale" => [1.0 - mean(known.f0); 3],
        "power" => [power(mean(known.f0), mean(known.f60)); 3],
        "exponent" => [5.0; 3],
        "lambda" => each(&|i| {
            lambda_for(n[i], k[i], derivation.matching_cos, known.matching[i]).unwrap_or(0.0)
        }),
        "b2_weight" => each(&|i| belcour(known, i)[0]),
        "b3_weight" => each(&|i| belcour(known, i)[1]),
        "texels" => [TEXELS as f64; 3],
        "warp" => [WARP; 3],
        "row" => [ONLY_ROW; 3],
        "table_scale" => [1.0; 3],
        _ => unreachable!("every input of the vocabulary has its derivation; a test asks for all"),
    }
}

fn f0(n: f64, k: f64) -> f64 {
    optics::normal_incidence(n, k)
}

fn exact(n: f64, k: f64, cos_theta: f64) -> f64 {
    optics::conductor(n, k, cos_theta).unpolarised()
}

/// Schlick's value at cos θ = 1/7, where the weight is (6/7)⁵.
pub(super) fn schlick_82(f0: f64) -> f64 {
    f0 + (1.0 - f0) * 7_776.0 / 16_807.0
}

fn belcour(known: &Known, i: usize) -> [f64; 2] {
    belcour_weights(known.f0[i], known.belcour.map(|seen| seen[i]))
}

fn mean(channels: [f64; 3]) -> f64 {
    channels.iter().sum::<f64>() / 3.0
}

/// Gulbrandsen's g: where n lies between the most (0) and the least (1) that F0 allows.
fn edge_tint(n: f64, k: f64) -> f64 {
    let r = f0(n, k);
    let (most, least) = ((1.0 + r.sqrt()) / (1.0 - r.sqrt()), (1.0 - r) / (1.0 + r));
    if most == least {
        0.0
    } else {
        ((most - n) / (most - least)).clamp(0.0, 1.0)
    }
}

/// The power with which bias + (1 - bias) (1-c)^power meets `target` at 60 degrees; Schlick's 5 where none does.
fn power(bias: f64, target: f64) -> f64 {
    let share = (target - bias) / (1.0 - bias);
    if share > 0.0 && share < 1.0 {
        libm::log2(share) / libm::log2(1.0 - COS_60)
    } else {
        5.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::ALL;

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
