//! A search for shapes: how far each misses over many materials, which nothing beats, and what a choice made without a
//! substance is worth for that substance.

mod text;

use std::collections::BTreeSet;

use crate::cost::{CostAndError, pareto_frontier};
use crate::fit::{Candidate, Tried};
use crate::methods::Method;
use crate::num::statistics::{median, medians, quantile};

pub use text::{Told, json, text};

/// The errors of shapes over measurements, each of a substance.
#[derive(Clone, Debug)]
pub struct Errors {
    /// What was measured, for each of the errors of a shape.
    pub substances: Vec<String>,
    /// The shapes with their errors.
    pub tried: Vec<Tried>,
}

/// Errors taken together: each measurement once, and each substance once, by the median of its measurements, however often it
/// was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// The median over measurements.
    pub median: f64,
    /// What nine of ten measurements keep within.
    pub p90: f64,
    /// The worst.
    pub worst: f64,
    /// The median over substances.
    pub median_vote: f64,
    /// What nine of ten substances keep within.
    pub p90_vote: f64,
}

/// A shape in a report.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The shape.
    pub candidate: Candidate,
    /// How far it misses.
    pub figures: Figures,
    /// Scalar operations of an evaluation.
    pub operations: usize,
    /// What an evaluation of its method's library function costs, where that was recorded.
    pub cost: Option<f64>,
    /// Whether nothing with fewer operations has as small a 90th percentile.
    pub is_best: bool,
}

/// What a choice is worth for a substance that had no part in it.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The shape that all measurements choose.
    pub choice: Candidate,
    /// Its errors, of the measurements that chose it.
    pub seen: Figures,
    /// The errors of each substance under the shape that all others choose.
    pub unseen: Figures,
    /// How many substances have which shape so, the most first.
    pub chosen: Vec<(Candidate, usize)>,
}

impl Figures {
    /// Of errors and what each is of. Both of the same length, and not empty.
    pub fn of(errors: &[f64], substances: &[String]) -> Figures {
        let votes = medians(errors, substances.iter().map(String::as_str));
        Figures {
            median: median(errors),
            p90: quantile(errors, 0.9),
            worst: quantile(errors, 1.0),
            median_vote: median(&votes),
            p90_vote: quantile(&votes, 0.9),
        }
    }
}

impl Errors {
    /// How many substances were measured.
    pub fn count(&self) -> usize {
        self.substances.iter().collect::<BTreeSet<_>>().len()
    }

    /// The shapes that nothing beats in operations and 90th percentile, and those of methods, the fewest operations first.
    pub fn rows(&self, cost: &dyn Fn(&Method) -> Option<f64>) -> Vec<Row> {
        let row = |tried: &Tried| Row {
            candidate: tried.candidate,
            figures: Figures::of(&tried.errors, &self.substances),
            operations: tried.candidate.operations(),
            cost: tried.candidate.method.and_then(cost),
            is_best: false,
        };
        let mut rows: Vec<Row> = self.tried.iter().map(row).collect();
        let point = |row: &Row| {
            Some(CostAndError {
                cost: row.operations as f64,
                error: row.figures.p90,
            })
        };
        let points: Vec<_> = rows.iter().map(point).collect();
        for place in pareto_frontier(&points) {
            rows[place].is_best = true;
        }
        rows.retain(|row| row.is_best || row.candidate.method.is_some());
        let order = |a: &Row, b: &Row| a.figures.p90.total_cmp(&b.figures.p90);
        rows.sort_by(|a, b| a.operations.cmp(&b.operations).then(order(a, b)));
        rows
    }

    /// Leaves out one substance after the other and chooses among the shapes with so many coefficients: the one with the least
    /// 90th percentile over the measurements of all others. None where fewer than two substances or no such shape are there.
    pub fn left_out(&self, terms: usize) -> Option<LeftOut> {
        let all: BTreeSet<&str> = self.substances.iter().map(String::as_str).collect();
        let own = |tried: &&Tried| tried.candidate.shape.terms() == terms;
        let tried: Vec<&Tried> = self.tried.iter().filter(own).collect();
        if all.len() < 2 {
            return None;
        }
        let choice = self.choice(&tried, None)?;
        let mut unseen = vec![0.0; self.substances.len()];
        let mut votes = vec![0; tried.len()];
        for substance in all {
            let chosen = self.choice(&tried, Some(substance))?;
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
        Some(LeftOut {
            choice: tried[choice].candidate,
            seen: Figures::of(&tried[choice].errors, &self.substances),
            unseen: Figures::of(&unseen, &self.substances),
            chosen,
        })
    }

    /// The place of the shape with the least 90th percentile over all measurements but those of a substance; of equals the first.
    fn choice(&self, tried: &[&Tried], without: Option<&str>) -> Option<usize> {
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
    use crate::fit::candidates;

    fn errors(substances: &[&str], tried: &[&[f64]]) -> Errors {
        let all = candidates(4);
        let tried = all.into_iter().zip(tried).map(|(candidate, errors)| Tried {
            candidate,
            errors: errors.to_vec(),
        });
        Errors {
            substances: substances.iter().map(|name| (*name).to_owned()).collect(),
            tried: tried.collect(),
        }
    }

    #[test]
    fn a_substance_that_was_measured_often_has_one_vote() {
        let names = ["gold", "gold", "gold", "iron", "lead"].map(str::to_owned);
        let found = Figures::of(&[1.0, 2.0, 9.0, 20.0, 30.0], &names);
        assert_eq!((found.median, found.worst), (9.0, 30.0));
        assert_eq!(found.median_vote, 20.0);
        assert_eq!(found.p90_vote, 28.0);
    }

    /// The first shape suits gold alone, the second all others: whoever left gold out would take the second.
    #[test]
    fn a_substance_has_no_part_in_the_choice_that_it_is_judged_by() {
        let own = errors(
            &["gold", "gold", "iron", "lead"],
            &[&[1.0, 1.0, 5.0, 4.0], &[6.0, 8.0, 2.0, 3.0]],
        );
        let found = own.left_out(4).expect("three substances");
        assert_eq!(found.seen.worst, 5.0);
        assert_eq!(found.unseen.worst, 8.0);
        assert_eq!(found.unseen.median_vote, 5.0);
        let votes: Vec<usize> = found.chosen.iter().map(|(_, votes)| *votes).collect();
        assert_eq!(votes, [2, 1]);
        assert!(own.left_out(5).is_none());
        assert!(errors(&["gold"], &[&[1.0]]).left_out(4).is_none());
    }

    #[test]
    fn what_is_beaten_is_not_told_unless_it_is_shipped() {
        let own = errors(&["gold"], &[&[1.0], &[2.0]]);
        let rows = own.rows(&|_| None);
        assert!(rows.iter().filter(|row| row.is_best).count() >= 1);
        assert!(rows.is_sorted_by_key(|row| row.operations));
    }
}
