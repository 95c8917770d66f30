//! Methods that are affine in numbers of a material ([`Affine`]), and the surface that inputs are derived from
//! ([`KnownSurface`]).
//!
//! Such a method is `F = N0 + N1 w1 + N2 w2 + ...` before clamping, with weights w of c = cos θ that all materials share. Its
//! means over the hemisphere and over the lobe of a rough surface are affine too, so one table of the means of the weights
//! serves every material. N0 is F0, and its weight is 1: for a white material all other numbers are 0, and the mean is the first
//! term.

use std::sync::LazyLock;

use super::input::{Input, Inputs};
use super::method::{Build, Method, Values};
use super::shape::Shape;
use crate::language::ir::{BrokenRule, Builder, Checked, Expr, check_in, evaluate, fold_in};
use crate::language::methods::formulas::BELCOUR_COSINES;
use crate::physics::num::{Legendre, Precision, each_channel};
use crate::physics::optics::{self, COS_82};

/// The most terms of an affine method: the channels of a texture.
pub const MOST_TERMS: usize = 4;

/// The numbers that a method is affine in, and their weights.
#[derive(Clone, Copy, Debug)]
pub struct Affine {
    /// The numbers as formulas of the method's inputs.
    pub numbers: &'static [&'static str],
    /// The same as nodes of a graph.
    pub build: for<'b> fn(&Inputs<'b>) -> Vec<Expr<'b>>,
    /// The weights of the numbers at a cosine in [0, 1]. The first is 1, and unused ones are 0.
    pub weights: fn(f64) -> [f64; MOST_TERMS],
}

impl Affine {
    /// An interpolation from F0 to white.
    pub(super) const fn to_white(weights: fn(f64) -> [f64; MOST_TERMS]) -> Affine {
        Affine {
            numbers: &["f0", "1 - f0"],
            build: f0_and_rise,
            weights,
        }
    }
}

/// F0, and 1 - F0.
fn f0_and_rise<'b>(x: &Inputs<'b>) -> Vec<Expr<'b>> {
    let f0 = x.get(Input::F0);
    vec![f0, 1.0 - f0]
}

/// What a split-sum table of a method integrates: functions of the cosine, each multiplied by a number.
#[derive(Clone, Copy, Debug)]
pub enum Basis {
    /// Of a fitted method: the numbers are its coefficients.
    Fitted(Shape),
    /// Of a method that is affine in numbers of a material.
    Affine(Affine),
}

/// The quadrature rule for means: weights are smooth, and more points change nothing.
static RULE: LazyLock<Legendre> = LazyLock::new(|| Legendre::new(64));

impl Basis {
    /// The number of terms.
    pub fn terms(&self) -> usize {
        match self {
            Basis::Fitted(shape) => shape.terms(),
            Basis::Affine(affine) => affine.numbers.len(),
        }
    }

    /// The numbers as formulas of the method's inputs.
    pub fn numbers(&self) -> Vec<&'static str> {
        match self {
            Basis::Fitted(shape) => {
                let inputs = Input::COEFFICIENTS[..shape.terms()].iter();
                inputs.map(|input| input.name).collect()
            }
            Basis::Affine(affine) => affine.numbers.to_vec(),
        }
    }

    /// For each term, adds `weight` times its function at a cosine in [0, 1] to its sum.
    pub fn add(&self, c: f64, weight: f64, sums: &mut [f64]) {
        match self {
            Basis::Fitted(shape) => shape.add(c, weight, sums),
            Basis::Affine(affine) => {
                for (sum, own) in sums.iter_mut().zip((affine.weights)(c)) {
                    *sum += weight * own;
                }
            }
        }
    }

    /// The weight of each number in the mean over the hemisphere, `2 ∫ w c dc`, by Gauss's rule, within 1e-14.
    pub fn averages(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.terms()];
        for (c, weight) in RULE.over(0.0, 1.0) {
            self.add(c, 2.0 * c * weight, &mut sums);
        }
        sums[0] = 1.0;
        sums
    }

    /// The numbers as nodes of a graph.
    pub(super) fn build<'b>(&self, x: &Inputs<'b>) -> Vec<Expr<'b>> {
        match self {
            Basis::Fitted(shape) => {
                let inputs = Input::COEFFICIENTS[..shape.terms()].iter();
                inputs.map(|input| x.get(*input)).collect()
            }
            Basis::Affine(affine) => (affine.build)(x),
        }
    }

    /// The mean over the hemisphere: the sum of the numbers, each times its constant, clamped to [0, 1].
    pub(super) fn build_average<'b>(&self, x: &Inputs<'b>) -> Expr<'b> {
        let numbers = self.build(x);
        let averages = self.averages().into_iter().skip(1);
        let terms = numbers[1..].iter().zip(averages);
        let sum = terms.fold(numbers[0], |sum, (number, average)| sum + average * *number);
        sum.saturate()
    }
}

/// A mean over the hemisphere, `2 ∫ F c dc`, that is fitted.
#[derive(Clone, Copy, Debug)]
pub struct FittedAverage {
    /// Builds it. The inputs have no cosine.
    pub build: Build,
    /// Its largest difference from the true mean.
    pub max_abs: f64,
    /// The arguments that this holds for, in words.
    pub over: &'static str,
    /// The errors of published fits of the same mean, with their source.
    pub published: &'static str,
}

impl Method {
    /// What a split-sum table of this method integrates; none where F is not affine in numbers of a material.
    pub fn basis(&self) -> Option<Basis> {
        let fitted = self.shape.map(Basis::Fitted);
        fitted.or_else(|| self.affine.map(Basis::Affine))
    }

    /// The mean over the hemisphere with the method's inputs as run-time arguments. None for methods that have neither a basis nor
    /// a fit.
    pub fn average_in(
        &self,
        precision: Precision,
        scalar_form: bool,
    ) -> Option<Result<Checked, BrokenRule>> {
        let builder = Builder::new();
        let inputs = Inputs::without_cosine(&builder, self.inputs, scalar_form, precision);
        let mean = match (self.basis(), self.average) {
            (Some(basis), _) => basis.build_average(&inputs),
            (None, Some(average)) => (average.build)(&inputs),
            (None, None) => return None,
        };
        let whole = builder.finish(self.name, mean);
        Some(check_in(precision, fold_in(precision, &whole)))
    }

    /// A coefficient of a fitted method from this method's inputs as run-time arguments, three channels. None for methods that
    /// compute none.
    pub fn coefficient_in(
        &self,
        precision: Precision,
        place: usize,
    ) -> Option<Result<Checked, BrokenRule>> {
        let coefficients = self.coefficients?;
        let builder = Builder::new();
        let inputs = Inputs::without_cosine(&builder, self.inputs, false, precision);
        let whole = builder.finish(self.name, (coefficients.build)(&inputs)[place]);
        Some(check_in(precision, fold_in(precision, &whole)))
    }

    /// The number of each term, from values of the method's inputs, three channels each. None where there are none.
    pub fn numbers(&self, values: &Values) -> Option<Vec<[f64; 3]>> {
        let basis = self.basis()?;
        let arguments = self.arguments::<f64>(values, None);
        let number = |place: usize| {
            let builder = Builder::new();
            let inputs = Inputs::without_cosine(&builder, self.inputs, false, Precision::F32);
            let number = basis.build(&inputs)[place].rgb();
            let whole = builder.finish(self.name, number);
            let checked = check_in(Precision::F32, fold_in(Precision::F32, &whole)).ok()?;
            Some(evaluate(&checked, &arguments).at(0))
        };
        (0..basis.terms()).map(number).collect()
    }
}

/// cos θ at which the empirical term meets the exact law: 60 degrees.
pub const COS_60: f64 = 0.5;

/// An index per channel, and reflectances at a few angles. Where a channel is one wavelength, these follow from the index by the
/// exact law. Where it is a whole spectrum, they are the spectrum's, and the index represents it.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownSurface {
    /// The real part of the index per channel.
    pub n: [f64; 3],
    /// The extinction coefficient per channel.
    pub k: [f64; 3],
    /// Reflectance at 0 degrees.
    pub f0: [f64; 3],
    /// Reflectance at 81.79 degrees.
    pub f82: [f64; 3],
    /// Reflectance at 60 degrees.
    pub f60: [f64; 3],
    /// cos θ at which λ of the corrected method is matched.
    pub matching_cos: f64,
    /// Reflectance there.
    pub matching: [f64; 3],
    /// Reflectance at the two angles that determine Belcour's weights.
    pub belcour: [[f64; 3]; 2],
}

impl KnownSurface {
    /// The surface with this index.
    pub fn of_index(n: [f64; 3], k: [f64; 3], matching_cos: f64) -> KnownSurface {
        let law = |c: f64| each(|i| optics::conductor(n[i], k[i], c).unpolarised());
        KnownSurface {
            f0: each(|i| optics::normal_incidence(n[i], k[i])),
            ..KnownSurface::with(n, k, law, matching_cos)
        }
    }

    /// The surface that this index represents, with its reflectance as a function of the cosine.
    pub fn with(
        n: [f64; 3],
        k: [f64; 3],
        seen: impl Fn(f64) -> [f64; 3],
        matching_cos: f64,
    ) -> KnownSurface {
        KnownSurface {
            n,
            k,
            f0: seen(1.0),
            f82: seen(COS_82),
            f60: seen(COS_60),
            matching_cos,
            matching: seen(matching_cos),
            belcour: BELCOUR_COSINES.map(&seen),
        }
    }
}

/// A value for each channel.
pub fn each(value: impl Fn(usize) -> f64) -> [f64; 3] {
    each_channel(value)
}

/// The mean of the channels.
pub fn mean(channels: [f64; 3]) -> f64 {
    channels.iter().sum::<f64>() / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::ir::Value;
    use crate::language::methods::{ALL, find};

    /// A number of a method, for one channel.
    fn number(method: &Method, affine: &Affine, place: usize) -> Checked {
        let builder = Builder::new();
        let inputs = Inputs::without_cosine(&builder, method.inputs, true, Precision::F32);
        let whole = builder.finish(method.name, (affine.build)(&inputs)[place]);
        check_in(Precision::F32, fold_in(Precision::F32, &whole)).unwrap()
    }

    /// Values of inputs for which hardly any method here is clamped.
    const TRIED: [[f64; 3]; 5] = [
        [0.04, 0.4, 0.0],
        [0.3, 0.5, 0.05],
        [0.6, 0.7, -0.02],
        [0.8, 0.85, 0.01],
        [0.95, 0.9, 0.0],
    ];

    /// The largest difference between the sum, clamped to [0, 1], and the method's own graph.
    fn difference(method: &Method, affine: &Affine) -> f64 {
        let function = method.function(false).unwrap();
        let mut most = 0.0;
        for tried in TRIED {
            // Weights of Belcour's curves are small. Other inputs are reflectances or fractions of them.
            let small = |i: usize| method.inputs[i].name.ends_with("_weight");
            let given: Vec<f64> = (0..method.inputs.len())
                .map(|i| if small(i) { tried[2] } else { tried[i] })
                .collect();
            let alone: Vec<_> = given.iter().map(|value| Value::scalar(*value)).collect();
            let numbers: Vec<f64> = (0..affine.numbers.len())
                .map(|i| evaluate(&number(method, affine, i), &alone).at(0)[0])
                .collect();
            for step in 0..=200 {
                let c = f64::from(step) / 200.0;
                let mut values = vec![Value::<f64>::scalar(c)];
                values.extend(
                    function.params[1..]
                        .iter()
                        .zip(&given)
                        .map(|(param, value)| match param.ty.channels() {
                            3 => Value::rgb([*value; 3]),
                            _ => Value::scalar(*value),
                        }),
                );
                let want = evaluate(&function, &values).at(0)[0];
                let weights = (affine.weights)(c);
                let got: f64 = numbers.iter().zip(weights).map(|(one, w)| one * w).sum();
                most = f64::max(most, (got.clamp(0.0, 1.0) - want).abs());
            }
        }
        most
    }

    #[test]
    fn the_sum_is_what_the_method_computes() {
        let mut found = 0;
        for method in ALL {
            let Some(affine) = &method.affine else {
                continue;
            };
            found += 1;
            assert!(affine.numbers.len() <= MOST_TERMS && affine.numbers[0] == "f0");
            let worst = difference(method, affine);
            assert!(worst < 1e-12, "{}: {worst:e}", method.name);
            let Some(Basis::Affine(_)) = method.basis() else {
                panic!("{}: it is fitted too", method.name);
            };
        }
        assert!(found > 0);
        // And the other way round: the weights of another method are detected.
        let mut wrong = find("hoffman_f82").unwrap().affine.unwrap();
        wrong.weights = find("fitted_f82").unwrap().affine.unwrap().weights;
        assert!(difference(find("hoffman_f82").unwrap(), &wrong) > 0.01);
    }

    /// Of (1 - c)⁵ it is 2/42, of c (1 - c)⁶ 2 · 2! 6!/9! = 1/126, of F90's weight the same as of white.
    #[test]
    fn averages_are_the_closed_forms() {
        let averages = |name: &str| find(name).unwrap().basis().unwrap().averages();
        let close = |one: f64, other: f64| assert!((one - other).abs() < 1e-14, "{one} {other}");
        for name in ["schlick", "schlick_f90", "f82_tint", "hoffman_f82"] {
            assert_eq!(averages(name)[0], 1.0);
            close(averages(name)[1], 1.0 / 21.0);
        }
        for name in ["f82_tint", "hoffman_f82"] {
            close(averages(name)[2], 823_543.0 / 46_656.0 / 126.0);
        }
        assert_eq!(averages("constant_f0"), [1.0]);
    }

    /// A rule of fewer points gives the same.
    #[test]
    fn averages_are_the_integrals() {
        for basis in ALL.iter().filter_map(|method| method.basis()) {
            let mut sums = vec![0.0; basis.terms()];
            for (c, weight) in Legendre::new(40).over(0.0, 1.0) {
                basis.add(c, 2.0 * c * weight, &mut sums);
            }
            for (one, other) in sums.iter().zip(basis.averages()) {
                assert!((one - other).abs() < 1e-13, "{one} {other}");
            }
        }
    }
}
