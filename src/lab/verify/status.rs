//! What to think of a function that was checked, or could not be.

use serde::{Deserialize, Serialize};

/// What to think of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It does what it should.
    Pass,
    /// It does not.
    Fail,
    /// It was not run.
    NotChecked,
}

impl Status {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Status::Pass => "pass",
            Status::Fail => "fail",
            Status::NotChecked => "not checked",
        }
    }
}
