//! Fits the coefficients of a fitted method to a material's reflectance curve: those with the least largest error over all
//! angles. A [`FitObjective`] says which measure of error is minimised, where the form is exact, and whether the form itself
//! keeps to [0, 1].
//!
//! A function ends with a clamp to [0, 1]. What is linear in the coefficients has none: the integrals of image-based light, and
//! the mean over the hemisphere. Coefficients that serve both are those of a form that keeps the range by itself. A function of
//! one material is fitted without that condition: it clamps, and is more accurate so.

use super::exact::{Exact, fit_meeting, rounded_coefficients};
use super::minimax::{Limit, Points, weighted_sum};
use super::rounded::rounded;
use super::weight::{Weight, luminance, shares};
use crate::generator::reference::{FITTED_COSINES, MaterialInMedium, ReferenceCurve};
use crate::language::methods::{Input, Method, Shape, Values};
use crate::physics::num::{Precision, each_channel};
use crate::physics::spectra::{Gamut, Space};

/// The reflectance of a material under viewing conditions, at [`FITTED_COSINES`].
#[derive(Clone, Debug, PartialEq)]
pub struct FitCurve {
    /// The reflectance at each cosine.
    pub seen: Vec<[f64; 3]>,
}

/// A form fitted to a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Each coefficient for three channels, in the objective's precision.
    pub coefficients: Vec<[f64; 3]>,
    /// The largest error at the curve's cosines, on paper, in the measure that was minimised.
    pub error: f64,
}

/// The objective of a fit: in which measure the coefficients are best, and where they are exact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FitObjective {
    /// The measure whose largest value over all angles is minimised.
    pub weight: Weight,
    /// The ends at which the form is exact, within 1e-7, with coefficients in f32. In half precision it is exact at none.
    pub exact: Exact,
    /// The precision of the coefficients. In half precision they are rounded within the optimisation.
    pub precision: Precision,
    /// The colour space of the three channels, for measures of colour.
    pub space: Space,
    /// Whether the form keeps to [0, 1] before its final clamp. [`Gamut::Keep`] leaves it free.
    pub gamut: Gamut,
}

/// The limits that keep a form in [0, 1]: its values at all points, and c0 alone, since a texture of unsigned numbers may hold
/// it.
fn limits(rows: &[Vec<f64>]) -> Vec<Limit> {
    let c0 = rows.first().map(|row| {
        let mut alone = vec![0.0; row.len()];
        alone[0] = 1.0;
        alone
    });
    let limit = |row| Limit {
        row,
        least: 0.0,
        most: 1.0,
    };
    rows.iter().cloned().chain(c0).map(limit).collect()
}

/// A curve with the weights of an objective, computed once for all shapes that are fitted to it.
#[derive(Clone, Debug)]
pub struct FitProblem<'a> {
    curve: &'a FitCurve,
    aim: FitObjective,
    wanted: [Vec<f64>; 3],
    weights: [Vec<f64>; 3],
}

impl FitCurve {
    /// The curve of a function that gives reflectance at a cosine.
    pub fn new(seen: impl Fn(f64) -> [f64; 3]) -> FitCurve {
        FitCurve {
            seen: FITTED_COSINES.iter().map(|c| seen(*c)).collect(),
        }
    }

    /// The curve of a material in unpolarised light, in its gamut.
    pub fn of(subject: &MaterialInMedium) -> FitCurve {
        FitCurve::of_reference(&subject.reference, subject.reference.surface.gamut)
    }

    /// The same before colours are clipped: a clipped curve has a corner, and a function that ends with a clamp clips by itself.
    pub fn unclipped(subject: &MaterialInMedium) -> FitCurve {
        let gamut = match subject.reference.surface.gamut {
            Gamut::Clip => Gamut::Keep,
            other => other,
        };
        FitCurve::of_reference(&subject.reference, gamut)
    }

    fn of_reference(reference: &ReferenceCurve, gamut: Gamut) -> FitCurve {
        let seen = reference.fitted_to().iter();
        FitCurve {
            seen: seen.map(|colour| gamut.apply(*colour).to_array()).collect(),
        }
    }
}

/// The factor of each coefficient of a shape, at each of a curve's cosines.
pub fn basis(shape: &Shape) -> Vec<Vec<f64>> {
    let row = |cos_theta: &f64| {
        let mut row = vec![0.0; shape.terms()];
        shape.add(*cos_theta, 1.0, &mut row);
        row
    };
    FITTED_COSINES.iter().map(row).collect()
}

impl FitProblem<'_> {
    /// The problem of fitting this curve with this objective.
    pub fn new(curve: &FitCurve, aim: FitObjective) -> FitProblem<'_> {
        let of = |seen: &[f64; 3]| aim.weight.of_channels(*seen, aim.space);
        let weights: Vec<[f64; 3]> = curve.seen.iter().map(of).collect();
        let channel = |all: &[[f64; 3]], i: usize| all.iter().map(|three| three[i]).collect();
        FitProblem {
            curve,
            aim,
            wanted: each_channel(|i| channel(&curve.seen, i)),
            weights: each_channel(|i| channel(&weights, i)),
        }
    }

    /// Fits the coefficients of a shape with this [`basis`]. None where its terms are linearly dependent. ΔE₀₀ depends on all
    /// channels together: the better of two fits is taken, with and without the channels' weights.
    pub fn fit(&self, basis: &[Vec<f64>]) -> Option<Fit> {
        let weighed = self.fit_by(&self.weights, basis)?;
        if self.aim.weight != Weight::DeltaE {
            return Some(weighed);
        }
        let even = self.fit_by(&each_channel(|_| vec![1.0; basis.len()]), basis);
        let better = even.filter(|even| even.error < weighed.error);
        Some(better.unwrap_or(weighed))
    }

    fn fit_by(&self, weights: &[Vec<f64>; 3], basis: &[Vec<f64>]) -> Option<Fit> {
        let ends = match self.aim.precision {
            Precision::F32 => self.aim.exact.ends(basis.len()),
            Precision::F16 => Vec::new(),
        };
        let channel = |i: usize| self.channel(basis, &self.wanted[i], &weights[i], &ends);
        let (red, blue) = (channel(0)?, channel(2)?);
        let green = match self.aim.weight {
            Weight::Luminance => self.green(basis, &ends, &red, &blue)?,
            _ => channel(1)?,
        };
        let single = |i: usize, found: &[f64]| {
            let met = ends
                .iter()
                .map(|end| (&basis[*end][..], self.wanted[i][*end]));
            rounded_coefficients(found, &met.collect::<Vec<_>>(), self.aim.precision)
        };
        let rounded = [single(0, &red), single(1, &green), single(2, &blue)];
        let coefficients: Vec<[f64; 3]> = (0..red.len())
            .map(|term| each_channel(|i| rounded[i][term]))
            .collect();
        Some(Fit {
            error: self.error(basis, &coefficients),
            coefficients,
        })
    }

    /// The coefficients of one channel, in the objective's precision: those of half precision are already rounded.
    fn channel(
        &self,
        rows: &[Vec<f64>],
        wanted: &[f64],
        weights: &[f64],
        ends: &[usize],
    ) -> Option<Vec<f64>> {
        let limits = match self.aim.gamut {
            Gamut::Keep => Vec::new(),
            Gamut::Clip | Gamut::Scale => limits(rows),
        };
        let points = Points {
            rows,
            wanted,
            weights,
            limits: &limits,
        };
        match self.aim.precision {
            Precision::F32 => fit_meeting(points, ends),
            Precision::F16 => rounded(points).map(|found| found.coefficients),
        }
    }

    /// The coefficients of green that make the luminance of all three channels the best form.
    fn green(
        &self,
        basis: &[Vec<f64>],
        ends: &[usize],
        red: &[f64],
        blue: &[f64],
    ) -> Option<Vec<f64>> {
        let share = shares(self.aim.space);
        let rest = |(row, seen): (&Vec<f64>, &[f64; 3])| {
            let others = share.x * weighted_sum(row, red) + share.z * weighted_sum(row, blue);
            (luminance(*seen, self.aim.space) - others) / share.y
        };
        let wanted: Vec<f64> = basis.iter().zip(&self.curve.seen).map(rest).collect();
        self.channel(basis, &wanted, &self.weights[1], ends)
    }

    /// The largest error of these coefficients, in the measure that is minimised.
    fn error(&self, basis: &[Vec<f64>], coefficients: &[[f64; 3]]) -> f64 {
        let FitObjective { weight, space, .. } = self.aim;
        let points = basis.iter().zip(&self.curve.seen);
        let errors = points.map(|(row, seen)| {
            let terms = row.iter().zip(coefficients);
            let given = terms.fold([0.0; 3], |sum, (b, c)| each_channel(|i| sum[i] + b * c[i]));
            weight.error(given, *seen, space)
        });
        errors.fold(0.0, f64::max)
    }
}

/// The coefficients of a fitted method for a curve and an objective, and the largest error on paper, in the objective's measure.
/// None where the method is not fitted, or where its terms are linearly dependent under these weights.
pub fn coefficients_and_error(
    method: &Method,
    curve: &FitCurve,
    aim: FitObjective,
) -> Option<(Values, f64)> {
    let fit = FitProblem::new(curve, aim).fit(&basis(&method.shape?))?;
    let names = Input::COEFFICIENTS.map(|input| input.name.to_owned());
    Some((names.into_iter().zip(fit.coefficients).collect(), fit.error))
}

/// The coefficients of a fitted method for a curve whose errors count by a weight above 0 at each cosine.
pub fn weighted_coefficients(
    method: &Method,
    curve: &FitCurve,
    aim: FitObjective,
    weight: impl Fn(f64) -> f64,
) -> Option<Vec<[f64; 3]>> {
    let weights: Vec<f64> = FITTED_COSINES.iter().map(|c| weight(*c)).collect();
    let problem = FitProblem::new(curve, aim);
    let fit = problem.fit_by(&each_channel(|_| weights.clone()), &basis(&method.shape?))?;
    Some(fit.coefficients)
}

/// Coefficients with their errors, on paper and before the clamp to [0, 1].
#[derive(Clone, Debug)]
pub struct Coefficients {
    /// The coefficients, by the names of inputs, in the objective's precision.
    pub values: Values,
    /// The objective of the fit.
    pub aim: FitObjective,
    /// The largest error in the measure that was minimised.
    pub error: f64,
    /// The same without the condition of exact ends; none if there is no such condition.
    pub error_without_exact: Option<f64>,
}

impl Coefficients {
    /// Fits a method. None where its terms are linearly dependent on the curve's angles.
    pub fn fit(method: &Method, curve: &FitCurve, aim: FitObjective) -> Option<Coefficients> {
        let (values, error) = coefficients_and_error(method, curve, aim)?;
        let exact = Exact::default();
        let free = || coefficients_and_error(method, curve, FitObjective { exact, ..aim });
        let free = aim.exact.is_any().then(free).flatten();
        Some(Coefficients {
            values,
            aim,
            error,
            error_without_exact: free.map(|(_, error)| error),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::find;
    use crate::physics::optics;

    /// Gold at three wavelengths, as the thesis has it.
    fn gold() -> FitCurve {
        let index = [(0.15, 3.7), (0.45, 2.4), (1.35, 1.85)];
        FitCurve::new(|c| index.map(|(n, k)| optics::conductor(n, k, c).unpolarised()))
    }

    fn water() -> FitCurve {
        FitCurve::new(|c| [1.331, 1.333, 1.337].map(|n| optics::conductor(n, 0.0, c).unpolarised()))
    }

    fn basis_of(name: &str) -> Vec<Vec<f64>> {
        let shape = find(name).and_then(|method| method.shape);
        basis(&shape.expect("a fitted method"))
    }

    /// The largest error in one measure of a fit for another.
    fn error(curve: &FitCurve, name: &str, measured: Weight, fitted: Weight) -> f64 {
        let basis = basis_of(name);
        let [measured, fitted] = [measured, fitted].map(|weight| {
            let aim = FitObjective {
                weight,
                ..FitObjective::default()
            };
            FitProblem::new(curve, aim)
        });
        let fit = fitted.fit(&basis).expect("it is fitted");
        measured.error(&basis, &fit.coefficients)
    }

    #[test]
    fn each_weight_is_best_in_its_own_measure() {
        for (curve, name) in [
            (gold(), "fitted"),
            (gold(), "fitted_five"),
            (water(), "fitted_dielectric"),
        ] {
            for weight in Weight::ALL {
                let own = error(&curve, name, weight, weight);
                for other in Weight::ALL.into_iter().filter(|other| *other != weight) {
                    let others = error(&curve, name, weight, other);
                    // ΔE₀₀ is minimised channel by channel: another fit may be slightly better.
                    let slack = if weight == Weight::DeltaE {
                        1.1
                    } else {
                        1.0 + 1e-6
                    };
                    assert!(
                        own <= others * slack,
                        "{name}: {weight:?} {own}, {other:?} {others}"
                    );
                }
            }
            let [relative, absolute] = [Weight::Relative, Weight::Absolute]
                .map(|by| error(&curve, name, Weight::Relative, by));
            assert!(relative < 0.95 * absolute, "{name}: {relative} {absolute}");
        }
    }

    /// With and without a gamut. The luminance error is the least only where green is free to compensate.
    #[test]
    fn ends_are_met_by_every_form_in_every_measure() {
        for name in ["fitted", "fitted_five", "fitted_rational"] {
            for weight in Weight::ALL {
                for gamut in [Gamut::Keep, Gamut::Clip] {
                    let free = FitObjective {
                        weight,
                        gamut,
                        ..FitObjective::default()
                    };
                    ends_are_met(name, free);
                }
            }
        }
    }

    #[track_caller]
    fn ends_are_met(name: &str, free: FitObjective) {
        let curve = gold();
        let basis = basis_of(name);
        let fit = |aim| {
            FitProblem::new(&curve, aim)
                .fit(&basis)
                .expect("it is fitted")
        };
        let least = fit(free).error;
        for (normal, grazing) in [(true, false), (false, true), (true, true)] {
            let exact = Exact { normal, grazing };
            let found = fit(FitObjective { exact, ..free });
            let is_least = match free.weight {
                Weight::DeltaE => false,
                Weight::Luminance => free.gamut == Gamut::Keep,
                Weight::Absolute | Weight::Relative => true,
            };
            assert!(
                !is_least || found.error >= least * 0.999_99,
                "{name} {free:?}"
            );
            for end in exact.ends(basis.len()) {
                let off = [0, 1, 2].map(|i| {
                    let own: Vec<f64> = found.coefficients.iter().map(|c| c[i]).collect();
                    (weighted_sum(&basis[end], &own) - curve.seen[end][i]).abs()
                });
                assert!(
                    off.iter().all(|off| *off < 1e-7),
                    "{name} {free:?}: {off:?}"
                );
            }
        }
    }
}
