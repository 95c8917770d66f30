//! The forms in which a method's functions are written.

use serde::{Deserialize, Serialize};

/// What a function of a method takes and gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FunctionForm {
    /// It takes its arguments at run time, and gives three channels.
    Library,
    /// The same for one channel.
    Scalar,
    /// A material's constants are folded in.
    Specialised,
    /// The mean over the hemisphere of a fitted method, three channels.
    Average,
    /// The same for one channel.
    AverageScalar,
}

impl FunctionForm {
    /// As reports and the manifest spell it.
    pub fn name(self) -> &'static str {
        match self {
            FunctionForm::Library => "library",
            FunctionForm::Scalar => "scalar",
            FunctionForm::Specialised => "specialised",
            FunctionForm::Average => "average",
            FunctionForm::AverageScalar => "average_scalar",
        }
    }

    /// What stands behind the method's name in the name of a library function.
    pub(super) fn suffix(self) -> String {
        match self {
            FunctionForm::Library | FunctionForm::Specialised => String::new(),
            other => format!("_{}", other.name()),
        }
    }

    /// Whether it gives the mean over the hemisphere.
    pub fn is_mean(self) -> bool {
        matches!(self, FunctionForm::Average | FunctionForm::AverageScalar)
    }
}
