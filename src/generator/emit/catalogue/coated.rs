//! A metal under the clear coat of an engine: coefficients of what the base must add, so that base and coat together reflect what both
//! interfaces do ([`Surface::through_coat`](crate::physics::materials::Surface::through_coat)).

use crate::generator::fit::{FitCurve, FitObjective, coefficients_and_error};
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
        if subject.material.kind == MaterialKind::Dielectric || subject.medium.is_some() {
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
        let (constants, _) = coefficients_and_error(method, &FitCurve::new(seen), aim)?;
        let inputs = method.inputs.iter();
        let coefficients: Vec<[f64; 3]> = inputs.map(|input| constants[input.name]).collect();
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
            let entering = 1.0 - dielectric(COAT, c).unpolarised();
            (
                entering
                    * each_channel(|i| (got[i] - want[i]).abs())
                        .into_iter()
                        .fold(0.0, f64::max),
                c,
            )
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

/// The angles over which the error is sought.
const ANGLES: usize = 256;
