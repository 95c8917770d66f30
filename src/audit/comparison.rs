//! Whether a method of ours has no larger error and costs no more than a user's function, and the sentence that says so.

use crate::cost::{CostAndError, Multiples, TIE};

/// A method of ours for the same material.
#[derive(Clone, Debug)]
pub struct Competitor {
    /// Its name.
    pub method: &'static str,
    /// `library` or `specialised`.
    pub form: &'static str,
    /// Its cost on a GPU, and its largest error.
    pub point: CostAndError,
}

/// A user's function against a method of ours.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The method.
    pub method: &'static str,
    /// `library` or `specialised`.
    pub form: &'static str,
    /// The user's cost and error over the method's.
    pub times: Multiples,
}

/// The methods that dominate a user's function: those that are far better first.
pub fn dominating(own: &CostAndError, competitors: &[Competitor]) -> Vec<Comparison> {
    let all = competitors.iter().map(|other| compared(own, other));
    let mut found: Vec<Comparison> = all.filter(|other| other.times.is_dominated()).collect();
    let gain = |other: &Comparison| other.times.error * other.times.cost;
    found.sort_by(|a, b| gain(b).total_cmp(&gain(a)).then(a.method.cmp(b.method)));
    found
}

fn compared(own: &CostAndError, competitor: &Competitor) -> Comparison {
    Comparison {
        method: competitor.method,
        form: competitor.form,
        times: own.multiples_of(&competitor.point),
    }
}

/// Which method dominates a user's function, or that none does.
pub fn sentence(own: &CostAndError, competitors: &[Competitor]) -> String {
    if let Some(best) = dominating(own, competitors).first() {
        return format!(
            "dominated by {}: {} error at {} cost",
            best.method,
            times(best.times.error),
            times(best.times.cost)
        );
    }
    let mut all = competitors.iter().map(|other| compared(own, other));
    match all.find(|other| other.times.is_tie()) {
        Some(same) => format!("on the frontier, where {} is", same.method),
        None => "on the frontier: no method of ours errs less for as little".to_owned(),
    }
}

/// `9 times the`, `1.4 times the`, `the same`.
fn times(share: f64) -> String {
    if (share - 1.0).abs() <= TIE {
        return "the same".to_owned();
    }
    let text = match share {
        share if share < 1.1 => format!("{share:.2}"),
        share if share < 9.95 => format!("{share:.1}"),
        share => format!("{share:.0}"),
    };
    let short = text.strip_suffix(".0").unwrap_or(&text);
    format!("{short} times the")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn competitors() -> [Competitor; 3] {
        let competitor = |method, error, cost| Competitor {
            method,
            form: "specialised",
            point: CostAndError { cost, error },
        };
        [
            competitor("exact", 1e-7, 100.0),
            competitor("fitted", 0.01, 20.0),
            competitor("schlick", 0.1, 10.0),
        ]
    }

    #[track_caller]
    fn check(error: f64, cost: f64, expected: &str) {
        assert_eq!(
            sentence(&CostAndError { cost, error }, &competitors()),
            expected
        );
    }

    #[test]
    fn the_sentence_says_by_how_much() {
        check(
            0.09,
            28.0,
            "dominated by fitted: 9 times the error at 1.4 times the cost",
        );
        check(
            0.1,
            12.0,
            "dominated by schlick: the same error at 1.2 times the cost",
        );
        check(0.01, 20.0, "on the frontier, where fitted is");
        check(
            0.05,
            12.0,
            "on the frontier: no method of ours errs less for as little",
        );
        check(
            3e-7,
            130.0,
            "dominated by exact: the same error at 1.3 times the cost",
        );
    }

    #[test]
    fn all_that_dominate_are_told_the_farthest_first() {
        let found = dominating(
            &CostAndError {
                cost: 40.0,
                error: 0.2,
            },
            &competitors(),
        );
        let names: Vec<&str> = found.iter().map(|other| other.method).collect();
        assert_eq!(names, ["fitted", "schlick"]);
    }
}
