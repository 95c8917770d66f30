//! The shapes of fitted methods: short forms in cos θ that are linear in their coefficients, so that coefficients can be
//! blended, filtered and integrated over a spectrum.
//!
//! `F = c0 + b^g1 (c1 + b^g2 (c2 + ...))`, b being a base that runs from small at normal incidence to 1 at grazing. The
//! steps g are whole; powers of the base are shared between channels, and a coefficient costs one multiplication and one
//! addition a channel.

use crate::ir::{Builder, Checked, Expr, Fault, check_in, fold_in};
use crate::num::Precision;

use super::input::{Input, Inputs};

/// What the powers of a shape are of, for a cosine c in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base {
    /// `1 - c`.
    Grazing,
    /// `2^(-a c)`.
    Exponential(f64),
    /// `1 / (1 + a c)`.
    Reciprocal(f64),
    /// `(1 - c)² / (1 + a c)`.
    Rational(f64),
}

/// A shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape<'a> {
    /// What its powers are of.
    pub base: Base,
    /// By how much the power grows from one coefficient to the next.
    pub steps: &'a [u32],
    /// Whether the last coefficient's term has a factor c, as Hoffman's dip has.
    pub is_tilted: bool,
}

impl Shape<'_> {
    /// How many coefficients it has.
    pub fn terms(&self) -> usize {
        self.steps.len() + 1
    }

    /// The formula, for a method whose inputs are its coefficients. It is limited to [0, 1], which costs nothing on a GPU.
    pub fn build<'b>(&self, x: &Inputs<'b>) -> Expr<'b> {
        let c = x.cosine();
        let b = self.base.build(c).named("b", self.base.text());
        let coefficients = Input::COEFFICIENTS.map(|input| input);
        let mut terms = coefficients[..self.terms()].iter().rev();
        let last = x.get(*terms.next().expect("a shape has a coefficient"));
        let mut sum = if self.is_tilted { c * last } else { last };
        for (step, input) in self.steps.iter().rev().zip(terms) {
            sum = x.get(*input) + power(b, *step) * sum;
            sum = sum.named(&input.name.replace('c', "sum"), "");
        }
        sum.saturate()
    }

    /// The three-channel function of this shape alone, of which no method need know.
    ///
    /// # Errors
    /// The graph breaks a rule of the representation: a bug.
    pub fn function(&self) -> Result<Checked, Fault> {
        let builder = Builder::new();
        let inputs = &Input::COEFFICIENTS[..self.terms()];
        let inputs = Inputs::declare(&builder, inputs, false, Precision::F32);
        let whole = builder.finish("shape", self.build(&inputs));
        check_in(Precision::F32, fold_in(Precision::F32, &whole))
    }

    /// The formula in ASCII.
    pub fn formula(&self) -> String {
        let last = self.steps.len();
        let tilt = if self.is_tilted { "c " } else { "" };
        let mut text = format!("{tilt}c{last}");
        for (i, step) in self.steps.iter().enumerate().rev() {
            let inner = if i + 1 == last && !self.is_tilted {
                text
            } else {
                format!("({text})")
            };
            let b = if *step == 1 {
                "b".to_owned()
            } else {
                format!("b^{step}")
            };
            text = format!("c{i} + {b} {inner}");
        }
        format!("{text}, b = {}", self.base.formula())
    }
}

impl Base {
    fn build<'b>(self, c: Expr<'b>) -> Expr<'b> {
        match self {
            Base::Grazing => 1.0 - c,
            Base::Exponential(a) => (-a * c).exp2(),
            Base::Reciprocal(a) => 1.0 / (1.0 + a * c),
            Base::Rational(a) => (1.0 - c).named("m", "").squared() / (1.0 + a * c),
        }
    }

    /// In ASCII.
    pub fn formula(self) -> String {
        match self {
            Base::Grazing => "1 - c".to_owned(),
            Base::Exponential(a) => format!("2^(-{a} c)"),
            Base::Reciprocal(a) => format!("1 / (1 + {a} c)"),
            Base::Rational(a) => format!("(1 - c)^2 / (1 + {a} c)"),
        }
    }

    fn text(self) -> &'static str {
        match self {
            Base::Grazing | Base::Rational(_) => "0 at normal incidence, 1 at grazing",
            Base::Exponential(_) | Base::Reciprocal(_) => "small at normal incidence, 1 at grazing",
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::{Value, evaluate};

    const C: f64 = 0.3;

    fn value(shape: &Shape, coefficients: &[f64]) -> f64 {
        let numbers = coefficients.iter().map(|c| Value::rgb([*c; 3]));
        let arguments: Vec<Value<f64>> = [Value::scalar(C)].into_iter().chain(numbers).collect();
        evaluate(&shape.function().expect("it is well formed"), &arguments).at(0)[0]
    }

    #[test]
    fn a_shape_is_its_formula() {
        let shape = Shape {
            base: Base::Grazing,
            steps: &[3, 4, 7],
            is_tilted: false,
        };
        let x: f64 = 1.0 - C;
        let want = 0.1 + 0.2 * x.powi(3) + 0.3 * x.powi(7) - 0.4 * x.powi(14);
        assert!((value(&shape, &[0.1, 0.2, 0.3, -0.4]) - want).abs() < 1e-15);
        let formula = "c0 + b^3 (c1 + b^4 (c2 + b^7 c3)), b = 1 - c";
        assert_eq!(shape.formula(), formula);
        let dip = Shape {
            steps: &[5, 1],
            is_tilted: true,
            ..shape
        };
        let want = 0.5 + 0.5 * x.powi(5) - 0.3 * C * x.powi(6);
        assert!((value(&dip, &[0.5, 0.5, -0.3]) - want).abs() < 1e-15);
        assert_eq!(dip.formula(), "c0 + b^5 (c1 + b (c c2)), b = 1 - c");
    }

    #[test]
    fn every_base_is_its_formula_and_ends_at_one() {
        let a = 2.5;
        for (base, want) in [
            (Base::Exponential(a), (-a * C).exp2()),
            (Base::Reciprocal(a), 1.0 / (1.0 + a * C)),
            (Base::Rational(a), (1.0 - C).powi(2) / (1.0 + a * C)),
        ] {
            let shape = Shape {
                base,
                steps: &[1],
                is_tilted: false,
            };
            let got = value(&shape, &[0.0, 1.0]);
            assert!((got - want).abs() < 1e-15, "{base:?}: {got}");
        }
    }
}
