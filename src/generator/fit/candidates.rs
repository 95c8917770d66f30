//! Candidate shapes: which there are, what errors they leave on each curve, and which one to choose.
//!
//! The candidates are nests of cheap factors with constants in steps, grouped into families, and the shapes of the existing
//! methods.
//!
//! | family | factors | constants |
//! |---|---|---|
//! | powers | `(1 - c)^p` | all p up to some |
//! | exponentials | `2^(-a c)` first, then the same, `c` or `c² + e` | a from 4 to 13, e .05 to .15 |
//! | reciprocals | `1/(c + p)`, that is `1/(1 + a c)` with a = 1/p, with its root in some places, or with `c` first | p from .05 to .7 |
//! | bent | `(1 - c)²/(1 + a c)` first, then the same or `c` | a from 0 to 10 |
//! | peaks | `1/(c² + e) - 1/√(c + p)` first, then `1/(c + p)` or its root | e .06 to .2, p .08 to .28 |
//!
//! The families are our choice, so the best candidate is only the best among these.
//!
//! A choice is judged over many materials, and for each substance by a choice made without that substance.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use serde::Serialize;

use super::problem::{FitProblem, basis};
use crate::language::ir::{Builder, fold};
use crate::language::methods::{ALL, Factor, Input, Inputs, Method, Shape};
use crate::physics::num::statistics::{median, medians, quantile};
use crate::physics::num::{Precision, in_parallel};

/// A shape that may be chosen.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// The shape.
    pub shape: Shape,
    /// Its family; `shipped` for a method's shape that belongs to none.
    pub family: &'static str,
    /// The method that has this shape.
    pub method: Option<&'static Method>,
}

/// All candidates with `terms` coefficients, in a fixed order. The families have shapes with 4 or 5 only.
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
    /// The scalar operations of one evaluation in three channels, with the coefficients as arguments, before any compiler.
    pub fn operations(&self) -> usize {
        let builder = Builder::new();
        let coefficients = &Input::COEFFICIENTS[..self.shape.terms()];
        let inputs = Inputs::declare(&builder, coefficients, false, Precision::F32);
        let whole = builder.finish("shape", self.shape.build(&inputs).rgb());
        fold(&whole).work()
    }
}

/// Nests of `length` factors in all families, with powers within these limits.
fn families(length: usize, powers: &[RangeInclusive<u32>]) -> Vec<Candidate> {
    let powers = powers
        .iter()
        .map(|limit| limit.clone().map(Factor::Grazing).collect());
    let families = [
        ("powers", nests(powers)),
        ("exponentials", exponentials(length)),
        ("reciprocals", reciprocals(length)),
        ("bent", bent(length)),
        ("peaks", peaks(length)),
    ];
    let mut all = Vec::new();
    for (family, nests) in families {
        all.extend(nests.into_iter().map(|factors| Candidate {
            shape: Shape {
                factors: factors.leak(),
            },
            family,
            method: None,
        }));
    }
    all
}

/// All nests that have one of these factors in each place.
fn nests(places: impl Iterator<Item = Vec<Factor>>) -> Vec<Vec<Factor>> {
    places.fold(vec![Vec::new()], |nests, choices| {
        let longer = |nest: &Vec<Factor>| {
            let longer = choices.iter().map(|next| [&nest[..], &[*next]].concat());
            longer.collect::<Vec<_>>()
        };
        nests.iter().flat_map(longer).collect()
    })
}

/// All nests of `length` factors that begin with `first` and go on with any of `others`.
fn words(first: Factor, others: &[Factor], length: usize) -> Vec<Vec<Factor>> {
    let others = std::iter::repeat_n(others.to_vec(), length - 1);
    nests([vec![first]].into_iter().chain(others))
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

/// Reciprocals, with constants that grow by a quarter per step: two digits are enough.
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

/// A measured value, or the reason why there is none: never an empty cell and never a zero.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum Measured<T> {
    /// The figure.
    Yes(T),
    /// Why there is none.
    No(String),
}

/// A candidate, and its largest error for each curve, in the measure of that curve's objective.
#[derive(Clone, Debug)]
pub struct Tried {
    /// The candidate.
    pub candidate: Candidate,
    /// The errors, in the order of the curves.
    pub errors: Vec<f64>,
}

/// Fits every candidate to every curve. A candidate is left out if its terms are too nearly dependent on some curve. `progress`
/// receives how many are done, of how many. The result does not depend on the number of processors.
pub fn search(
    candidates: &[Candidate],
    tasks: &[FitProblem],
    progress: &mut dyn FnMut(u64, u64),
) -> Vec<Tried> {
    let one = |i: usize| tried(&candidates[i], tasks);
    let all = in_parallel(candidates.len(), &one, progress);
    all.into_iter().flatten().collect()
}

fn tried(candidate: &Candidate, tasks: &[FitProblem]) -> Option<Tried> {
    let basis = basis(&candidate.shape);
    let errors = tasks.iter().map(|task| Some(task.fit(&basis)?.error));
    Some(Tried {
        candidate: *candidate,
        errors: errors.collect::<Option<_>>()?,
    })
}

/// The errors of shapes over measurements of substances.
#[derive(Clone, Debug)]
pub struct TriedShapes {
    /// The substance of each measurement, in the order of a shape's errors.
    pub substances: Vec<String>,
    /// The shapes with their errors.
    pub tried: Vec<Tried>,
}

/// Quantiles of a shape's errors, over measurements and over substances. A substance counts by the median of its measurements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorQuantiles {
    /// The median over measurements.
    pub median: f64,
    /// The 90th percentile over measurements.
    pub p90: f64,
    /// The worst.
    pub worst: f64,
    /// The median over substances.
    pub median_by_substance: f64,
    /// The 90th percentile over substances.
    pub p90_by_substance: f64,
}

/// How good a choice is for a substance that had no part in it.
#[derive(Clone, Debug)]
pub struct LeaveOneOut {
    /// The shape chosen from all measurements.
    pub choice: Candidate,
    /// Its errors on the measurements that chose it.
    pub seen: ErrorQuantiles,
    /// The errors on each substance of the shape that all others choose.
    pub unseen: ErrorQuantiles,
    /// How often each shape was chosen so, the most frequent first.
    pub chosen: Vec<(Candidate, usize)>,
}

impl ErrorQuantiles {
    /// Quantiles of `errors`, with the substance of each. Both have the same length and are not empty.
    pub fn new(errors: &[f64], substances: &[String]) -> ErrorQuantiles {
        let votes = medians(errors, substances.iter().map(String::as_str));
        ErrorQuantiles {
            median: median(errors),
            p90: quantile(errors, 0.9),
            worst: quantile(errors, 1.0),
            median_by_substance: median(&votes),
            p90_by_substance: quantile(&votes, 0.9),
        }
    }
}

impl TriedShapes {
    /// How many substances were measured.
    pub fn substance_count(&self) -> usize {
        self.substances.iter().collect::<BTreeSet<_>>().len()
    }

    /// Leaves out one substance after the other, and chooses among the shapes with `terms` coefficients the one with the least
    /// 90th percentile over the measurements of all others. None for fewer than two substances, or if there is no such shape.
    pub fn leave_one_out(&self, terms: usize) -> Option<LeaveOneOut> {
        let all: BTreeSet<&str> = self.substances.iter().map(String::as_str).collect();
        let own = |tried: &&Tried| tried.candidate.shape.terms() == terms;
        let tried: Vec<&Tried> = self.tried.iter().filter(own).collect();
        if all.len() < 2 {
            return None;
        }
        let choice = self.best_shape(&tried, None)?;
        let mut unseen = vec![0.0; self.substances.len()];
        let mut votes = vec![0; tried.len()];
        for substance in all {
            let chosen = self.best_shape(&tried, Some(substance))?;
            votes[chosen] += 1;
            let places = self.substances.iter().enumerate();
            for (place, _) in places.filter(|(_, other)| *other == substance) {
                unseen[place] = tried[chosen].errors[place];
            }
        }
        let voted = votes.iter().enumerate().filter(|(_, votes)| **votes > 0);
        let mut chosen: Vec<(Candidate, usize)> = voted
            .map(|(place, votes)| (tried[place].candidate, *votes))
            .collect();
        chosen.sort_by_key(|(_, votes)| std::cmp::Reverse(*votes));
        Some(LeaveOneOut {
            choice: tried[choice].candidate,
            seen: ErrorQuantiles::new(&tried[choice].errors, &self.substances),
            unseen: ErrorQuantiles::new(&unseen, &self.substances),
            chosen,
        })
    }

    /// The index of the shape with the least 90th percentile over all measurements except those of `without`; of equals, the
    /// first.
    fn best_shape(&self, tried: &[&Tried], without: Option<&str>) -> Option<usize> {
        let counts = |(_, substance): &(&f64, &String)| Some(substance.as_str()) != without;
        let limit = |tried: &&Tried| {
            let known = tried.errors.iter().zip(&self.substances).filter(counts);
            let known: Vec<f64> = known.map(|(error, _)| *error).collect();
            quantile(&known, 0.9)
        };
        let limits = tried.iter().map(limit).enumerate();
        let least = limits.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(least.0)
    }
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

    /// The count agrees with that of a method's library function.
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

    fn errors(substances: &[&str], tried: &[&[f64]]) -> TriedShapes {
        let all = candidates(4);
        let tried = all.into_iter().zip(tried).map(|(candidate, errors)| Tried {
            candidate,
            errors: errors.to_vec(),
        });
        TriedShapes {
            substances: substances.iter().map(|name| (*name).to_owned()).collect(),
            tried: tried.collect(),
        }
    }

    #[test]
    fn a_substance_that_was_measured_often_has_one_vote() {
        let names = ["gold", "gold", "gold", "iron", "lead"].map(str::to_owned);
        let found = ErrorQuantiles::new(&[1.0, 2.0, 9.0, 20.0, 30.0], &names);
        assert_eq!((found.median, found.worst), (9.0, 30.0));
        assert_eq!(found.median_by_substance, 20.0);
        assert_eq!(found.p90_by_substance, 28.0);
    }

    /// The first shape suits only gold, the second all others: without gold, the second is chosen.
    #[test]
    fn a_substance_has_no_part_in_the_choice_that_it_is_judged_by() {
        let own = errors(
            &["gold", "gold", "iron", "lead"],
            &[&[1.0, 1.0, 5.0, 4.0], &[6.0, 8.0, 2.0, 3.0]],
        );
        let found = own.leave_one_out(4).expect("three substances");
        assert_eq!(found.seen.worst, 5.0);
        assert_eq!(found.unseen.worst, 8.0);
        assert_eq!(found.unseen.median_by_substance, 5.0);
        let votes: Vec<usize> = found.chosen.iter().map(|(_, votes)| *votes).collect();
        assert_eq!(votes, [2, 1]);
        assert!(own.leave_one_out(5).is_none());
        assert!(errors(&["gold"], &[&[1.0]]).leave_one_out(4).is_none());
    }
}
