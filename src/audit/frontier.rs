//! Whether a method of ours errs no more and costs no more: the sentence that matters.

use serde_json::{Value, json};

/// A method of ours for the same material.
#[derive(Clone, Debug)]
pub struct Rival {
    /// Its name.
    pub method: &'static str,
    /// `library` or `specialised`.
    pub form: &'static str,
    /// Its largest error.
    pub error: f64,
    /// Its cost on a GPU.
    pub cost: f64,
}

/// A method that dominates a user's function, and how far.
#[derive(Clone, Debug, PartialEq)]
pub struct Better {
    method: &'static str,
    form: &'static str,
    /// The user's error over ours.
    error_times: f64,
    /// The user's cost over ours.
    cost_times: f64,
}

/// Shares this close to 1 are the same: compilers and single precision differ by as much.
const SAME: f64 = 0.01;
/// Errors below this are those of single precision, and as good as none.
const FLOOR: f64 = 1e-6;

/// The methods that err no more and cost no more, and are better in one: those far better first.
pub fn better(error: f64, cost: f64, rivals: &[Rival]) -> Vec<Better> {
    let mut found: Vec<Better> = rivals
        .iter()
        .map(|rival| against(error, cost, rival))
        .filter(Better::dominates)
        .collect();
    let gain = |better: &Better| better.error_times * better.cost_times;
    found.sort_by(|a, b| gain(b).total_cmp(&gain(a)).then(a.method.cmp(b.method)));
    found
}

fn against(error: f64, cost: f64, rival: &Rival) -> Better {
    Better {
        method: rival.method,
        form: rival.form,
        error_times: error.max(FLOOR) / rival.error.max(FLOOR),
        // What costs nothing to the last count costs a count.
        cost_times: cost.max(1.0) / rival.cost.max(1.0),
    }
}

/// What is said of it where these dominate it.
pub fn sentence(error: f64, cost: f64, rivals: &[Rival]) -> String {
    if let Some(best) = better(error, cost, rivals).first() {
        return best.text();
    }
    let mut all = rivals.iter().map(|rival| against(error, cost, rival));
    match all.find(|rival| !rival.differs()) {
        Some(same) => format!("on the frontier, where {} is", same.method),
        None => "on the frontier: no method of ours errs less for as little".to_owned(),
    }
}

impl Better {
    fn dominates(&self) -> bool {
        self.error_times >= 1.0 - SAME && self.cost_times >= 1.0 - SAME && self.differs()
    }

    fn differs(&self) -> bool {
        let far = |times: f64| (times - 1.0).abs() > SAME;
        far(self.error_times) || far(self.cost_times)
    }

    fn text(&self) -> String {
        format!(
            "dominated by {}: {} error at {} cost",
            self.method,
            times(self.error_times),
            times(self.cost_times)
        )
    }

    /// For the report.
    pub fn json(&self) -> Value {
        json!({
            "method": self.method, "form": self.form, "error_times": self.error_times, "cost_times": self.cost_times,
        })
    }
}

/// `9 times the`, `1.4 times the`, `the same`.
fn times(share: f64) -> String {
    if (share - 1.0).abs() <= SAME {
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

    fn rivals() -> [Rival; 3] {
        let rival = |method, error, cost| Rival {
            method,
            form: "specialised",
            error,
            cost,
        };
        [
            rival("exact", 1e-7, 100.0),
            rival("fitted", 0.01, 20.0),
            rival("schlick", 0.1, 10.0),
        ]
    }

    #[track_caller]
    fn check(error: f64, cost: f64, expected: &str) {
        assert_eq!(sentence(error, cost, &rivals()), expected);
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
        let found = better(0.2, 40.0, &rivals());
        let names: Vec<&str> = found.iter().map(|better| better.method).collect();
        assert_eq!(names, ["fitted", "schlick"]);
    }
}
