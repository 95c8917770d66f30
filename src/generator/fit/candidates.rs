//! The shapes among which one is chosen: nests of cheap factors with their constants in steps, in families, and the shapes of
//! the methods that there are.
//!
//! | family | factors | constants |
//! |---|---|---|
//! | powers | `(1 - c)^p` | all p up to some |
//! | exponentials | `2^(-a c)` first, then the same, `c` or `c² + e` | a from 4 to 13, e .05 to .15 |
//! | reciprocals | `1/(c + p)`, that is `1/(1 + a c)` with a = 1/p, with its root in some places, or with `c` first | p from .05 to .7 |
//! | bent | `(1 - c)²/(1 + a c)` first, then the same or `c` | a from 0 to 10 |
//! | peaks | `1/(c² + e) - 1/√(c + p)` first, then `1/(c + p)` or its root | e .06 to .2, p .08 to .28 |
//!
//! A family is a choice of ours, and the best of them all is the best of these.

use std::ops::RangeInclusive;

use crate::language::ir::{Builder, fold};
use crate::language::methods::{ALL, Factor, Input, Inputs, Method, Shape};
use crate::physics::num::Precision;

/// A shape that may be chosen.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// The shape.
    pub shape: Shape,
    /// Which family it is of; `shipped` for a method's that is of none.
    pub family: &'static str,
    /// The method that has it.
    pub method: Option<&'static Method>,
}

/// All candidates with so many coefficients, 4 or 5, in a fixed order. None with others.
pub fn candidates(terms: usize) -> Vec<Candidate> {
    let own = match terms {
        4 => families(3, &[1..=5, 1..=6, 2..=10]),
        5 => families(4, &[1..=4, 1..=5, 1..=6, 2..=8]),
        _ => Vec::new(),
    };
    let shipped = ALL.iter().filter(|method| method.inputs.len() == terms);
    let mut all: Vec<Candidate> = own;
    for (method, shape) in shipped.filter_map(|method| Some((*method, method.shape?))) {
        match all.iter_mut().find(|own| own.shape == shape) {
            Some(own) => own.method = Some(method),
            None => all.push(Candidate {
                shape,
                family: "shipped",
                method: Some(method),
            }),
        }
    }
    all
}

impl Candidate {
    /// The scalar operations of an evaluation, three channels, with the coefficients as arguments, before any compiler.
    pub fn operations(&self) -> usize {
        let builder = Builder::new();
        let coefficients = &Input::COEFFICIENTS[..self.shape.terms()];
        let inputs = Inputs::declare(&builder, coefficients, false, Precision::F32);
        let whole = builder.finish("shape", self.shape.build(&inputs).rgb());
        fold(&whole).work()
    }
}

/// Nests of so many factors in all families; powers within these limits.
fn families(length: usize, powers: &[RangeInclusive<u32>]) -> Vec<Candidate> {
    let of = |family: &'static str, nests: Vec<Vec<Factor>>| {
        let one = move |factors: Vec<Factor>| Candidate {
            shape: Shape {
                factors: factors.leak(),
            },
            family,
            method: None,
        };
        nests.into_iter().map(one)
    };
    let all = of("powers", self::powers(powers))
        .chain(of("exponentials", exponentials(length)))
        .chain(of("reciprocals", reciprocals(length)))
        .chain(of("bent", bent(length)))
        .chain(of("peaks", peaks(length)));
    all.collect()
}

fn powers(limits: &[RangeInclusive<u32>]) -> Vec<Vec<Factor>> {
    limits.iter().fold(vec![Vec::new()], |nests, limit| {
        let longer = |nest: &Vec<Factor>| {
            let nest = nest.clone();
            limit
                .clone()
                .map(move |power| [&nest[..], &[Factor::Grazing(power)]].concat())
        };
        nests.iter().flat_map(longer).collect()
    })
}

/// All nests of so many factors that begin with one and go on with any of these.
fn words(first: Factor, others: &[Factor], length: usize) -> Vec<Vec<Factor>> {
    (1..length).fold(vec![vec![first]], |nests, _| {
        let longer = |nest: &Vec<Factor>| {
            let nest = nest.clone();
            others
                .iter()
                .map(move |other| [&nest[..], &[*other]].concat())
        };
        nests.iter().flat_map(longer).collect()
    })
}

fn exponentials(length: usize) -> Vec<Vec<Factor>> {
    let plain = (8..=26).flat_map(|half| {
        let b = Factor::Exponential(f64::from(half) / 2.0);
        words(b, &[b, Factor::Cosine], length)
    });
    let squared = (4..=13).flat_map(|a| {
        let b = Factor::Exponential(f64::from(a));
        [0.05, 0.094, 0.15].into_iter().flat_map(move |e| {
            let q = Factor::Square(e);
            let all = words(b, &[b, Factor::Cosine, q], length).into_iter();
            all.filter(move |nest| nest.contains(&q))
        })
    });
    plain.chain(squared).collect()
}

/// Steps of a quarter; two digits are enough.
fn reciprocals(length: usize) -> Vec<Vec<Factor>> {
    const PLACES: [f64; 13] = [
        0.05, 0.062, 0.078, 0.098, 0.12, 0.15, 0.19, 0.24, 0.3, 0.37, 0.46, 0.58, 0.7,
    ];
    let nests = PLACES.into_iter().flat_map(|p| {
        let (r, q) = (Factor::Reciprocal(p), Factor::Root(p));
        let mut bent_last = vec![r; length];
        bent_last[0] = Factor::Cosine;
        let begun = [r, q]
            .into_iter()
            .flat_map(move |first| words(first, &[r, q], length));
        begun.chain([bent_last])
    });
    nests.collect()
}

fn bent(length: usize) -> Vec<Vec<Factor>> {
    let nests = (0..=20).flat_map(|half| {
        let w = Factor::Bent(f64::from(half) / 2.0);
        words(w, &[w, Factor::Cosine], length)
    });
    nests.collect()
}

fn peaks(length: usize) -> Vec<Vec<Factor>> {
    let constants = [0.06, 0.08, 0.112, 0.15, 0.2];
    let constants = constants
        .into_iter()
        .flat_map(|e| [0.08, 0.1, 0.144, 0.2, 0.28].map(|p| (e, p)));
    let nests = constants.flat_map(|(e, p)| {
        let others = [Factor::Reciprocal(p), Factor::Root(p)];
        words(Factor::Peak(e, p), &others, length)
    });
    nests.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_stands_once_and_every_fitted_method_is_among_them() {
        for (terms, methods) in [(3, 0), (4, 3), (5, 1), (6, 0)] {
            let all = candidates(terms);
            let shipped = all.iter().filter(|one| one.method.is_some()).count();
            assert!(shipped >= methods, "{terms}: {shipped}");
            for (i, one) in all.iter().enumerate() {
                assert_eq!(one.shape.terms(), terms);
                assert!(
                    all[..i].iter().all(|other| other.shape != one.shape),
                    "{}",
                    one.shape
                );
            }
        }
    }

    /// The count of a method's library function.
    #[test]
    fn operations_are_those_of_the_library() {
        for terms in [4, 5] {
            for one in candidates(terms) {
                let Some(method) = one.method else { continue };
                let function = method.function(false).expect("well formed");
                assert_eq!(one.operations(), function.work(), "{}", method.name);
            }
        }
    }
}
