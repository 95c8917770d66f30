//! The shapes of fitted methods: short forms in cos θ that are linear in their coefficients, so that coefficients can be
//! blended, filtered and integrated over a spectrum.
//!
//! `F = c0 + b^g1 (c1 + b^g2 (c2 + ...))`, b being a base that runs from small at normal incidence to 1 at grazing. The
//! steps g are whole; powers of the base are shared between channels, and a coefficient costs one multiplication and one
//! addition a channel.
//!
//! The mean over the hemisphere, `2 ∫ F c dc`, is linear too: what multiplies a coefficient is a constant of the shape
//! ([`Shape::averages`]). Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course, 2017,
//! <https://blog.selfshadow.com/publications/s2017-shading-course/>, and Turquin, "Practical multiple scattering compensation for
//! microfacet models", 2019, <https://blog.selfshadow.com/publications/turquin/ms_comp_final.pdf>, ask for it.

use crate::ir::Expr;

use super::input::{Input, Inputs};

/// What the powers of a shape are of, for a cosine c in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base {
    /// `1 - c`.
    Grazing,
    /// `2^(-a c)`.
    Exponential(f64),
    /// `(1 - c)² / (1 + a c)`.
    Rational(f64),
}

/// A shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// What its powers are of.
    pub base: Base,
    /// By how much the power grows from one coefficient to the next.
    pub steps: &'static [u32],
}

impl Shape {
    /// The formula, for a method whose inputs are its coefficients. It is limited to [0, 1], which costs nothing on a GPU.
    pub fn build<'b>(&self, x: &Inputs<'b>) -> Expr<'b> {
        let c = x.cosine();
        let b = self.base.build(c).named("b", self.base.text());
        let mut sum = x.get(Input::COEFFICIENTS[self.steps.len()]);
        let terms = Input::COEFFICIENTS[..self.steps.len()].iter().rev();
        for (step, input) in self.steps.iter().rev().zip(terms) {
            sum = x.get(*input) + power(b, *step) * sum;
            sum = sum.named(&input.name.replace('c', "sum"), "");
        }
        sum.saturate()
    }
}

impl Shape {
    /// How many coefficients it has.
    pub fn terms(&self) -> usize {
        self.steps.len() + 1
    }

    /// The power of the base that each coefficient multiplies: 0 for the first.
    pub fn powers(&self) -> Vec<u32> {
        let grown = self.steps.iter().scan(0, |power, step| {
            *power += step;
            Some(*power)
        });
        [0].into_iter().chain(grown).collect()
    }

    /// Adds to each of these sums, one a coefficient, a weight times what that coefficient multiplies at a cosine in [0, 1].
    pub fn add(&self, c: f64, weight: f64, sums: &mut [f64]) {
        let b = self.base.at(c);
        let mut term = weight;
        for (i, sum) in sums.iter_mut().enumerate() {
            if i > 0 {
                term *= whole_power(b, self.steps[i - 1]);
            }
            *sum += term;
        }
    }

    /// What multiplies each coefficient in the mean over the hemisphere, of the form before its limit: `2 ∫ b^p c dc` over c
    /// from 0 to 1, in closed form, within 1e-15.
    pub fn averages(&self) -> Vec<f64> {
        let powers = self.powers();
        powers
            .iter()
            .map(|power| self.base.average(*power))
            .collect()
    }

    /// The mean over the hemisphere of coefficients: their sum, each times its constant. It is limited to [0, 1].
    pub fn build_average<'b>(&self, coefficients: &[Expr<'b>]) -> Expr<'b> {
        let averages = self.averages().into_iter().skip(1);
        let terms = coefficients[1..].iter().zip(averages);
        let sum = terms.fold(coefficients[0], |sum, (c, average)| sum + average * *c);
        sum.saturate()
    }
}

impl Base {
    /// What powers are of, at a cosine in [0, 1].
    fn at(self, c: f64) -> f64 {
        match self {
            Base::Grazing => 1.0 - c,
            Base::Exponential(a) => libm::exp2(-a * c),
            Base::Rational(a) => (1.0 - c) * (1.0 - c) / (1.0 + a * c),
        }
    }

    /// `2 ∫ b^p c dc` over c from 0 to 1.
    ///
    /// - Of `(1 - c)^p`: Euler's beta function, `2 B(2, p + 1) = 2 / ((p + 1) (p + 2))`.
    /// - Of `e^(-k c)`, k = a p ln 2, in parts: `2 (1 - (1 + k) e^(-k)) / k²`.
    /// - Of `(1 - c)^(2p) / (1 + a c)^p`: with u = 1 + a c and A = 1 + a it is
    ///   `2 / a^(2p + 2) ∫ (A - u)^(2p) (u - 1) u^(-p) du` over u from 1 to A, whole powers of u once the bracket is
    ///   multiplied out.
    fn average(self, power: u32) -> f64 {
        let p = f64::from(power);
        match self {
            _ if power == 0 => 1.0,
            Base::Grazing => 2.0 / ((p + 1.0) * (p + 2.0)),
            Base::Exponential(a) => {
                let k = a * p * std::f64::consts::LN_2;
                2.0 * (1.0 - (1.0 + k) * libm::exp2(-a * p)) / (k * k)
            }
            Base::Rational(a) => rational_average(a, power),
        }
    }

    fn build<'b>(self, c: Expr<'b>) -> Expr<'b> {
        match self {
            Base::Grazing => 1.0 - c,
            Base::Exponential(a) => (-a * c).exp2(),
            Base::Rational(a) => (1.0 - c).named("m", "").squared() / (1.0 + a * c),
        }
    }

    fn text(self) -> &'static str {
        match self {
            Base::Grazing | Base::Rational(_) => "0 at normal incidence, 1 at grazing",
            Base::Exponential(_) => "small at normal incidence, 1 at grazing",
        }
    }
}

/// `2 ∫ ((1 - c)² / (1 + a c))^p c dc` over c from 0 to 1: see [`Base::average`].
fn rational_average(a: f64, power: u32) -> f64 {
    let (end, n) = (1.0 + a, 2 * power);
    let (mut sum, mut binomial) = (0.0, 1.0);
    for j in 0..=n {
        let e = j.cast_signed() - power.cast_signed();
        let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
        let factor = sign * binomial * whole_power(end, n - j);
        sum += factor * (power_integral(end, e + 1) - power_integral(end, e));
        binomial *= f64::from(n - j) / f64::from(j + 1);
    }
    2.0 * sum / whole_power(a, n + 2)
}

/// `∫ u^e du` over u from 1 to `end`.
fn power_integral(end: f64, e: i32) -> f64 {
    let power = whole_power(end, (e + 1).unsigned_abs());
    match e + 1 {
        0 => libm::log(end),
        n if n < 0 => (1.0 / power - 1.0) / f64::from(n),
        n => (power - 1.0) / f64::from(n),
    }
}

/// A whole power by multiplications, the same to the last bit everywhere.
fn whole_power(b: f64, exponent: u32) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * b)
}

/// The same as steps of a graph, the lower factors first, so that powers share what they can.
fn power(b: Expr<'_>, exponent: u32) -> Expr<'_> {
    let (mut whole, mut reached) = (None::<Expr<'_>>, 0);
    let (mut square, mut place) = (b, 1);
    while place <= exponent {
        if exponent & place != 0 {
            reached += place;
            whole = Some(whole.map_or(square, |whole| named_power(whole * square, reached)));
        }
        place *= 2;
        if place <= exponent {
            square = named_power(square.squared(), place);
        }
    }
    whole.unwrap_or_else(|| b.builder().number(1.0))
}

fn named_power(power: Expr<'_>, exponent: u32) -> Expr<'_> {
    power.named(&format!("b{exponent}"), "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::ALL;
    use crate::num::Legendre;

    #[test]
    fn averages_are_the_integrals() {
        let shapes: Vec<Shape> = ALL.iter().filter_map(|method| method.shape).collect();
        assert_eq!(shapes.len(), 3);
        let rule = Legendre::new(64);
        for shape in shapes {
            let mut sums = vec![0.0; shape.powers().len()];
            for (c, weight) in rule.over(0.0, 1.0) {
                shape.add(c, 2.0 * c * weight, &mut sums);
            }
            for (sum, average) in sums.iter().zip(shape.averages()) {
                assert!((sum - average).abs() < 1e-14, "{shape:?}: {sum} {average}");
            }
        }
    }
}
