//! What was checked of a function, and how it came out. A check that was not made is not passed.

use serde::Serialize;

use crate::generator::fit::ModelError;
use crate::lab::verify::Status;
use crate::lab::verify::compilers::Verdict;

use super::row::Ran;
use super::runner::Trouble;

/// The checks; none where one was not made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Checked {
    /// Whether compilers accept it.
    pub accepted: Option<bool>,
    /// Whether its results are reflectances: numbers from 0 to 1, or to an F0 above 1.
    pub within_range: Option<bool>,
    /// The error that it may have.
    pub max_error: Option<f64>,
    /// Whether its error is no larger.
    pub within_max_error: Option<bool>,
}

impl Checked {
    /// What was checked of a function.
    pub fn new(
        verdicts: &[(String, Verdict)],
        ran: &Result<Ran, Trouble>,
        max_error: Option<f64>,
    ) -> Checked {
        let refuses = |(_, verdict): &(String, Verdict)| matches!(verdict, Verdict::No(_));
        let accepts = |(_, verdict): &(String, Verdict)| *verdict == Verdict::Yes;
        let accepted = if verdicts.iter().any(refuses) {
            Some(false)
        } else {
            verdicts.iter().any(accepts).then_some(true)
        };
        let ran = ran.as_ref().ok();
        Checked {
            accepted,
            within_range: ran.map(|ran| ran.edges.findings.is_empty() && ran.error.undefined == 0),
            max_error,
            within_max_error: ran
                .zip(max_error)
                .map(|(ran, most)| is_within(&ran.error, most)),
        }
    }

    /// In words, for a function that has this status.
    pub fn words(&self, status: Status) -> String {
        let parts = [
            self.accepted.map(|accepted| {
                if accepted {
                    "compilers accept it".to_owned()
                } else {
                    "a compiler refuses it".to_owned()
                }
            }),
            self.within_range.map(|within| {
                if within {
                    "all results are reflectances".to_owned()
                } else {
                    "a result is no reflectance".to_owned()
                }
            }),
            self.error_words(),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        let checks = parts.join("; ");
        match status {
            Status::Pass => checks,
            _ if parts.is_empty() => status.words().to_owned(),
            Status::Fail | Status::NotChecked => format!("{}: {checks}", status.words()),
        }
    }

    fn error_words(&self) -> Option<String> {
        match (self.within_range, self.max_error, self.within_max_error) {
            (_, Some(most), Some(true)) => Some(format!("its error is at most {most}")),
            (_, Some(most), Some(false)) => Some(format!("its error is above {most}")),
            (Some(_), None, _) => {
                Some("its error is not judged (--max-error sets a limit)".to_owned())
            }
            _ => None,
        }
    }
}

/// Whether an error is no larger than it may be. One that is no number is.
pub fn is_within(error: &ModelError, most: f64) -> bool {
    error.max_abs <= most
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: Checked = Checked {
        accepted: Some(true),
        within_range: Some(true),
        max_error: None,
        within_max_error: None,
    };

    #[test]
    fn words_say_what_was_checked() {
        assert_eq!(
            ALL.words(Status::Pass),
            "compilers accept it; all results are reflectances; its error is not judged (--max-error sets a limit)"
        );
        let above = Checked {
            max_error: Some(0.01),
            within_max_error: Some(false),
            ..ALL
        };
        assert_eq!(
            above.words(Status::Fail),
            "fail: compilers accept it; all results are reflectances; its error is above 0.01"
        );
        let within = Checked {
            within_max_error: Some(true),
            ..above
        };
        assert!(
            within
                .words(Status::Pass)
                .ends_with("its error is at most 0.01")
        );
    }

    /// What never ran has no word about its results or its error.
    #[test]
    fn what_was_not_checked_is_not_said() {
        let refused = Checked {
            accepted: Some(false),
            max_error: Some(0.01),
            ..Checked::default()
        };
        assert_eq!(refused.words(Status::Fail), "fail: a compiler refuses it");
        assert_eq!(Checked::default().words(Status::NotChecked), "not checked");
        let failed = Checked::default().words(Status::Fail);
        assert_eq!(failed, "fail");
    }
}
