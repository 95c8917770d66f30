//! Methods that are affine in numbers of a material: their fitted coefficients, or what the method names ([`Affine`]).
//!
//! Such a method is `F = N0 + N1 w1 + N2 w2 + ...` before clamping, with weights w of c = cos θ that all materials share. Its
//! means over the hemisphere and over the lobe of a rough surface are affine too, so one table of the means of the weights
//! serves every material. N0 is F0, and its weight is 1: for a white material all other numbers are 0, and the mean is the first
//! term.

use std::sync::LazyLock;

use super::input::{Input, Inputs};
use super::shape::Shape;
use crate::language::ir::Expr;
use crate::physics::num::Legendre;

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
            build: |x| vec![x.get(Input::F0), 1.0 - x.get(Input::F0)],
            weights,
        }
    }
}

/// What a split-sum table of a method integrates: functions of the cosine, each multiplied by a number.
#[derive(Clone, Copy, Debug)]
pub enum Basis {
    /// Of a fitted method: the numbers are its coefficients.
    Fitted(Shape),
    /// Of a method that is affine in numbers of a material.
    Affine(Affine),
}

/// The quadrature rule for means: weights and factors are smooth, and more points change nothing.
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
            Basis::Fitted(shape) => shape.inputs().iter().map(|input| input.name).collect(),
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
            Basis::Fitted(shape) => shape.inputs().iter().map(|input| x.get(*input)).collect(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::limits::value;
    use crate::language::methods::{ALL, Factor, Method, Values, find};

    /// Values of inputs for which hardly any method here is clamped.
    const TRIED: [[f64; 3]; 5] = [
        [0.04, 0.4, 0.0],
        [0.3, 0.5, 0.05],
        [0.6, 0.7, -0.02],
        [0.8, 0.85, 0.01],
        [0.95, 0.9, 0.0],
    ];

    /// The largest difference between the sum with these weights, clamped to [0, 1], and the method's own graph.
    fn difference(method: &Method, weights: fn(f64) -> [f64; MOST_TERMS]) -> f64 {
        let mut most = 0.0;
        for tried in TRIED {
            // Weights of Belcour's curves are small. Other inputs are reflectances or fractions of them.
            let small = |i: usize| method.inputs[i].name.ends_with("_weight");
            let given: Vec<f64> = (0..method.inputs.len())
                .map(|i| if small(i) { tried[2] } else { tried[i] })
                .collect();
            let values: Values = method
                .inputs
                .iter()
                .zip(&given)
                .map(|(input, value)| (input.name.to_owned(), [*value; 3]))
                .collect();
            let numbers = method.numbers(&values).unwrap();
            for step in 0..=200 {
                let c = f64::from(step) / 200.0;
                let terms = numbers.iter().zip(weights(c));
                let got: f64 = terms.map(|(number, weight)| number[0] * weight).sum();
                most = f64::max(most, (got.clamp(0.0, 1.0) - value(method, c, &given)).abs());
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
            let worst = difference(method, affine.weights);
            assert!(worst < 1e-12, "{}: {worst:e}", method.name);
            let Some(Basis::Affine(_)) = method.basis() else {
                panic!("{}: it is fitted too", method.name);
            };
        }
        assert!(found > 0);
        // And the other way round: the weights of another method are detected.
        let wrong = find("fitted_f82").unwrap().affine.unwrap().weights;
        assert!(difference(find("hoffman_f82").unwrap(), wrong) > 0.01);
    }

    #[track_caller]
    fn close(one: f64, other: f64) {
        assert!((one - other).abs() < 1e-14, "{one} {other}");
    }

    /// Of (1 - c)⁵ it is 2/42, of c (1 - c)⁶ 2 · 2! 6!/9! = 1/126, of F90's weight the same as of white.
    #[test]
    fn averages_are_the_closed_forms() {
        let averages = |name: &str| find(name).unwrap().basis().unwrap().averages();
        for name in ["schlick", "schlick_f90", "f82_tint", "hoffman_f82"] {
            assert_eq!(averages(name)[0], 1.0);
            close(averages(name)[1], 1.0 / 21.0);
        }
        for name in ["f82_tint", "hoffman_f82"] {
            close(averages(name)[2], 823_543.0 / 46_656.0 / 126.0);
        }
        assert_eq!(averages("constant_f0"), [1.0]);
    }

    /// Of (1 - c)^p, Euler's beta function: 2 / ((p + 1) (p + 2)). Of e^(-k c), k = a p ln 2, in parts:
    /// 2 (1 - (1 + k) e^(-k)) / k². Of c e^(-k c) in parts again: 2 (2 - (2 + 2 k + k²) e^(-k)) / k³.
    #[test]
    fn averages_of_shapes_are_the_closed_forms() {
        let averages = |factors| Basis::Fitted(Shape { factors }).averages();
        let powers = averages(&[Factor::Grazing(3), Factor::Grazing(4)]);
        assert_eq!((powers[0], powers.len()), (1.0, 3));
        close(powers[1], 2.0 / 20.0);
        close(powers[2], 2.0 / 72.0);
        let exponential = averages(&[Factor::Exponential(6.5), Factor::Cosine]);
        let k = 6.5 * std::f64::consts::LN_2;
        let end = libm::exp2(-6.5);
        close(exponential[1], 2.0 * (1.0 - (1.0 + k) * end) / (k * k));
        close(
            exponential[2],
            2.0 * (2.0 - (2.0 + 2.0 * k + k * k) * end) / (k * k * k),
        );
    }

    /// A rule of fewer points gives the same: no weight or factor is too steep for it.
    #[test]
    fn averages_are_the_integrals() {
        for basis in ALL.iter().filter_map(|method| method.basis()) {
            let mut sums = vec![0.0; basis.terms()];
            for (c, weight) in Legendre::new(40).over(0.0, 1.0) {
                basis.add(c, 2.0 * c * weight, &mut sums);
            }
            let within = match basis {
                Basis::Fitted(_) => 1e-14,
                Basis::Affine(_) => 1e-13,
            };
            for (one, other) in sums.iter().zip(basis.averages()) {
                assert!((one - other).abs() < within, "{one} {other}");
            }
        }
    }
}
