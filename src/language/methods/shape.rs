//! The shapes of fitted methods: short forms in cos θ that are linear in their coefficients, so that coefficients can be
//! blended, filtered and integrated over a spectrum.
//!
//! `F = c0 + f1 (c1 + f2 (c2 + ...))`: each factor f is a function of c = cos θ alone, shared between channels. A coefficient
//! costs one multiplication and one addition a channel.
//!
//! The mean over the hemisphere, `2 ∫ F c dc`, is linear too: each coefficient is multiplied by a constant of the shape
//! ([`Basis::averages`](super::Basis::averages)). Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course, 2017,
//! <https://blog.selfshadow.com/publications/s2017-shading-course/>, and Turquin, "Practical multiple scattering compensation for
//! microfacet models", 2019, <https://blog.selfshadow.com/publications/turquin/ms_comp_final.pdf>, need it.

use std::fmt;

use super::input::{Input, InputSource, Inputs};
use crate::language::ir::Expr;

/// A factor of a shape, as a function of a cosine c in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factor {
    /// `(1 - c)^p`.
    Grazing(u32),
    /// `2^(-a c)`.
    Exponential(f64),
    /// `c`.
    Cosine,
    /// `c² + e`.
    Square(f64),
    /// `c + p`: used by the next ones.
    Shifted(f64),
    /// `1 / (c + p)`.
    Reciprocal(f64),
    /// `1 / √(c + p)`.
    Root(f64),
    /// `1 / (c² + e) - 1 / √(c + p)`, as (e, p).
    Peak(f64, f64),
    /// `(1 - c)² / (1 + a c)`.
    Bent(f64),
    /// `log2(c + p) + e`, as (p, e).
    Logarithm(f64, f64),
    /// `log2(c + p)² + e`, as (p, e).
    LogarithmSquared(f64, f64),
}

/// The shape of a fitted method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// The factor before each bracket, outermost first.
    pub factors: &'static [Factor],
}

impl Shape {
    /// The formula, for a method whose inputs are its coefficients. It is clamped to [0, 1], which is free on a GPU.
    pub fn build<'b>(&self, x: &Inputs<'b>) -> Expr<'b> {
        let mut made = Made {
            c: x.cosine(),
            is_half: x.is_half(),
            known: Vec::new(),
            taken: Vec::new(),
        };
        let mut sum = x.get(Input::COEFFICIENTS[self.factors.len()]);
        for (factor, input) in self.factors.iter().zip(self.inputs()).rev() {
            sum = x.get(*input) + made.factor(*factor) * sum;
            sum = sum.named(&input.name.replace('c', "sum"), "");
        }
        sum.saturate()
    }

    /// The number of coefficients.
    pub fn terms(&self) -> usize {
        self.factors.len() + 1
    }

    /// Its coefficients.
    pub fn inputs(&self) -> &'static [Input] {
        &Input::COEFFICIENTS[..self.terms()]
    }

    /// For each coefficient, adds `weight` times its function at a cosine in [0, 1] to its sum.
    pub fn add(&self, c: f64, weight: f64, sums: &mut [f64]) {
        let mut term = weight;
        sums[0] += term;
        for (factor, sum) in self.factors.iter().zip(&mut sums[1..]) {
            term *= factor.at(c);
            *sum += term;
        }
    }
}

impl Factor {
    /// Its value at a cosine in [0, 1].
    fn at(self, c: f64) -> f64 {
        match self {
            Factor::Grazing(power) => (0..power).fold(1.0, |whole, _| whole * (1.0 - c)),
            Factor::Exponential(a) => libm::exp2(-a * c),
            Factor::Cosine => c,
            Factor::Square(e) => c * c + e,
            Factor::Shifted(p) => c + p,
            Factor::Reciprocal(p) => 1.0 / (c + p),
            Factor::Root(p) => 1.0 / (c + p).sqrt(),
            Factor::Peak(e, p) => 1.0 / (c * c + e) - Factor::Root(p).at(c),
            Factor::Bent(a) => (1.0 - c) * (1.0 - c) / (1.0 + a * c),
            Factor::Logarithm(p, e) => libm::log2(c + p) + e,
            Factor::LogarithmSquared(p, e) => {
                let logarithm = libm::log2(c + p);
                logarithm * logarithm + e
            }
        }
    }
}

/// A factor as it is written in formulas.
impl fmt::Display for Factor {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Factor::Grazing(1) => write!(out, "(1 - c)"),
            Factor::Grazing(power) => write!(out, "(1 - c)^{power}"),
            Factor::Exponential(a) => write!(out, "2^(-{a} c)"),
            Factor::Cosine => write!(out, "c"),
            Factor::Square(e) => write!(out, "(c^2 + {e})"),
            Factor::Shifted(p) => write!(out, "(c + {p})"),
            Factor::Reciprocal(p) => write!(out, "1/(c + {p})"),
            Factor::Root(p) => write!(out, "1/sqrt(c + {p})"),
            Factor::Peak(e, p) => write!(out, "(1/(c^2 + {e}) - 1/sqrt(c + {p}))"),
            Factor::Bent(a) => write!(out, "(1 - c)^2/(1 + {a} c)"),
            Factor::Logarithm(p, 0.0) => write!(out, "log2(c + {p})"),
            Factor::Logarithm(p, e) => write!(out, "(log2(c + {p}) + {e})"),
            Factor::LogarithmSquared(p, e) => write!(out, "(log2(c + {p})^2 + {e})"),
        }
    }
}

/// A shape as a formula in c.
impl fmt::Display for Shape {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let last = self.factors.len();
        for (i, factor) in self.factors.iter().enumerate() {
            let bracket = if i + 1 < last { "(" } else { "" };
            write!(out, "c{i} + {factor} {bracket}")?;
        }
        write!(out, "c{last}{}", ")".repeat(last.saturating_sub(1)))
    }
}

/// Factors as nodes of a graph, each made once.
struct Made<'b> {
    c: Expr<'b>,
    is_half: bool,
    known: Vec<(Factor, Expr<'b>)>,
    taken: Vec<&'static str>,
}

impl<'b> Made<'b> {
    fn factor(&mut self, factor: Factor) -> Expr<'b> {
        let known = self.known.iter().find(|(other, _)| *other == factor);
        if let Some((_, made)) = known {
            return *made;
        }
        let made = self.make(factor);
        self.known.push((factor, made));
        made
    }

    /// The first of these names that no factor has yet.
    fn free<const N: usize>(&mut self, names: [&'static str; N]) -> &'static str {
        let is_free = |name: &&'static str| !self.taken.contains(name);
        let name = names.into_iter().find(is_free);
        let name = name.expect("no shape has so many factors of a kind");
        self.taken.push(name);
        name
    }

    fn make(&mut self, factor: Factor) -> Expr<'b> {
        let c = self.c;
        match factor {
            Factor::Grazing(1) => {
                let name = self.free(["b", "g"]);
                (1.0 - c).named(name, "0 at normal incidence, 1 at grazing")
            }
            Factor::Grazing(p) if self.is_half => power_in_half(c, p),
            Factor::Grazing(p) => power(self.factor(Factor::Grazing(1)), p),
            Factor::Exponential(a) => {
                let b = (-a * c).exp2();
                b.named(
                    self.free(["b", "e"]),
                    "small at normal incidence, 1 at grazing",
                )
            }
            Factor::Cosine => c,
            Factor::Square(e) => {
                let known = self.known.iter().find_map(|(other, made)| match other {
                    Factor::Square(first) => Some(*made + (e - first)),
                    _ => None,
                });
                let square = known.unwrap_or_else(|| c * c + e);
                square.named(self.free(["q", "u", "s"]), "")
            }
            Factor::Shifted(p) => (c + p).named("l", ""),
            Factor::Reciprocal(p) => (1.0 / self.factor(Factor::Shifted(p))).named("r", ""),
            Factor::Root(p) => {
                let root = self.factor(Factor::Shifted(p)).inverse_sqrt();
                root.named(self.free(["q", "t"]), "")
            }
            Factor::Peak(e, p) => {
                let root = self.factor(Factor::Root(p));
                (1.0 / (c * c + e) - root).named("a", "large at grazing")
            }
            Factor::Logarithm(p, 0.0) => {
                let logarithm = self.factor(Factor::Shifted(p)).log2();
                logarithm.named("g", "")
            }
            Factor::Logarithm(p, e) => {
                let moved = self.factor(Factor::Logarithm(p, 0.0)) + e;
                moved.named(self.free(["u", "v"]), "")
            }
            Factor::LogarithmSquared(p, e) => {
                let logarithm = self.factor(Factor::Logarithm(p, 0.0));
                (logarithm * logarithm + e).named("s", "")
            }
            Factor::Bent(a) => {
                let bent = self.factor(Factor::Grazing(2)) / (1.0 + a * c);
                bent.named("w", "0 at normal incidence, 1 at grazing")
            }
        }
    }
}

/// An integer power by products, the lower factors first, so that powers share what they can.
fn product<'b>(
    b: Expr<'b>,
    exponent: u32,
    times: fn(Expr<'b>, Expr<'b>, u32) -> Expr<'b>,
) -> Option<Expr<'b>> {
    let (mut whole, mut reached) = (None::<Expr<'b>>, 0);
    let (mut square, mut place) = (b, 1);
    while place <= exponent {
        if exponent & place != 0 {
            reached += place;
            whole = Some(whole.map_or(square, |whole| times(whole, square, reached)));
        }
        place *= 2;
        if place <= exponent {
            square = times(square, square, place);
        }
    }
    whole
}

fn power(b: Expr<'_>, exponent: u32) -> Expr<'_> {
    fn times<'b>(one: Expr<'b>, other: Expr<'b>, reached: u32) -> Expr<'b> {
        (one * other).named(&format!("b{reached}"), "")
    }
    product(b, exponent, times).unwrap_or_else(|| b.builder().number(1.0))
}

/// `(1 - c)^p` in half precision: 1 minus a term that is small at grazing, where a power of a rounded 1 - c would be off by p
/// roundings. `1 - (1 - x) (1 - y) = x + y - x y`.
fn power_in_half(c: Expr<'_>, exponent: u32) -> Expr<'_> {
    fn times<'b>(one: Expr<'b>, other: Expr<'b>, reached: u32) -> Expr<'b> {
        let both = one + other - one * other;
        both.named(&format!("less{reached}"), "1 - (1 - c)^p, small at grazing")
    }
    let less = product(c, exponent, times);
    let less = less.unwrap_or_else(|| c.builder().number(0.0));
    (1.0 - less).named(&format!("b{exponent}"), "")
}

#[allow(missing_docs)] // each says what it is
impl Input {
    pub const C0: Input = coefficient("c0", "coefficient of 1");
    pub const C1: Input = coefficient("c1", "coefficient of the first term");
    pub const C2: Input = coefficient("c2", "coefficient of the second term");
    pub const C3: Input = coefficient("c3", "coefficient of the third term");
    pub const C4: Input = coefficient("c4", "coefficient of the fourth term");
    pub const C5: Input = coefficient("c5", "coefficient of the fifth term");
    pub const C6: Input = coefficient("c6", "coefficient of the sixth term");
    pub const C7: Input = coefficient("c7", "coefficient of the seventh term");
    pub const COEFFICIENTS: [Input; 8] = [
        Input::C0,
        Input::C1,
        Input::C2,
        Input::C3,
        Input::C4,
        Input::C5,
        Input::C6,
        Input::C7,
    ];
}

const fn coefficient(name: &'static str, meaning: &'static str) -> Input {
    Input::rgb(name, meaning, [-1000.0, 1000.0], InputSource::Fit).tried(&[0.3, -2.0, 1.0])
}
