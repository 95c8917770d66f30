//! The shapes of fitted methods: short forms in cos θ that are linear in their coefficients, so that coefficients can be
//! blended, filtered and integrated over a spectrum.
//!
//! `F = c0 + b^g1 (c1 + b^g2 (c2 + ...))`, b being a base that runs from small at normal incidence to 1 at grazing. The
//! steps g are whole; powers of the base are shared between channels, and a coefficient costs one multiplication and one
//! addition a channel.

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

impl Base {
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

/// A whole power by multiplications, the lower factors first, so that powers share what they can.
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
