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
    /// The mean over the hemisphere, three channels.
    Average,
    /// The same for one channel.
    AverageScalar,
    /// The first coefficient of a fitted method, from the inputs of a method that finds it.
    C0,
    /// The second.
    C1,
    /// The third.
    C2,
    /// The fourth.
    C3,
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
            FunctionForm::C0 => "c0",
            FunctionForm::C1 => "c1",
            FunctionForm::C2 => "c2",
            FunctionForm::C3 => "c3",
        }
    }

    /// What stands behind the method's name in the name of a library function.
    pub(super) fn suffix(self) -> String {
        match self {
            FunctionForm::Library | FunctionForm::Specialised => String::new(),
            other => format!("_{}", other.name()),
        }
    }

    /// The forms that give coefficients, in their order.
    pub const COEFFICIENTS: [FunctionForm; 4] = [
        FunctionForm::C0,
        FunctionForm::C1,
        FunctionForm::C2,
        FunctionForm::C3,
    ];

    /// Which coefficient it gives.
    pub fn coefficient(self) -> Option<usize> {
        FunctionForm::COEFFICIENTS
            .iter()
            .position(|form| *form == self)
    }

    /// Whether it is of one channel.
    pub fn is_scalar(self) -> bool {
        matches!(self, FunctionForm::Scalar | FunctionForm::AverageScalar)
    }

    /// Whether it gives the mean over the hemisphere.
    pub fn is_mean(self) -> bool {
        matches!(self, FunctionForm::Average | FunctionForm::AverageScalar)
    }
}
