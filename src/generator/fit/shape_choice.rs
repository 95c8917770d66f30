//! What shapes are worth over many materials, and what a choice made without a substance is worth for that substance.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::physics::num::statistics::{median, medians, quantile};

use super::candidates::Candidate;
use super::search::Tried;

/// The errors of shapes over measurements, each of a substance.
#[derive(Clone, Debug)]
pub struct TriedShapes {
    /// What was measured, for each of the errors of a shape.
    pub substances: Vec<String>,
    /// The shapes with their errors.
    pub tried: Vec<Tried>,
}

/// Errors of a shape over all that it was tried on, once with each measurement counted and once with each substance counted. A
/// substance counts by the median of its measurements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorQuantiles {
    /// The median over measurements.
    pub median: f64,
    /// What nine of ten measurements keep within.
    pub p90: f64,
    /// The worst.
    pub worst: f64,
    /// The median over substances.
    pub median_by_substance: f64,
    /// What nine of ten substances keep within.
    pub p90_by_substance: f64,
}

/// What a choice is worth for a substance that had no part in it.
#[derive(Clone, Debug)]
pub struct LeaveOneOut {
    /// The shape that all measurements choose.
    pub choice: Candidate,
    /// Its errors, of the measurements that chose it.
    pub seen: ErrorQuantiles,
    /// The errors of each substance under the shape that all others choose.
    pub unseen: ErrorQuantiles,
    /// How many substances have which shape so, the most first.
    pub chosen: Vec<(Candidate, usize)>,
}

impl ErrorQuantiles {
    /// Of errors and what each is of. Both of the same length, and not empty.
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

    /// Leaves out one substance after the other and chooses among the shapes with so many coefficients: the one with the least
    /// 90th percentile over the measurements of all others. None where fewer than two substances or no such shape are there.
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

    /// The place of the shape with the least 90th percentile over all measurements but those of a substance; of equals the first.
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
    use super::super::candidates::candidates;
    use super::*;

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

    /// The first shape suits gold alone, the second all others: whoever left gold out would take the second.
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
