//! The rows of a report, and the status of a function that was checked or could not be. A worker hands its rows to the supervisor
//! as JSON.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};

use super::compilers::Verdict;
use super::effect_trial::EffectOutcome;
use super::{CodeError, HalfError};
use crate::generator::emit::FunctionForm;
use crate::generator::fit::ModelError;
use crate::lab::fault::Fault;
use crate::physics::num::Precision;

/// Stands for a material where a function is run at the worst inputs known.
pub const WORST: &str = "worst cases";

/// A function on a target, with the values of a material: how far it is from what it means, and which compilers accept its file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VerifyRow {
    /// The target.
    pub target: String,
    /// For an effect's function: the effect.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effect: Option<String>,
    /// The method. For an effect's function, the one that computes R.
    pub method: String,
    /// The variant of the method; empty for the usual form.
    #[serde(default)]
    pub variant: String,
    /// The material, as a user types it. None where the run timed out or crashed, and for an effect's function.
    pub material: Option<String>,
    /// Its form.
    pub form: FunctionForm,
    /// The precision that the function computes in.
    pub precision: Precision,
    /// The function.
    pub function: String,
    /// Its file, relative to the output folder.
    pub file: String,
    /// The hash of the function's graph.
    pub fingerprint: String,
    /// Whether the file lies in the output folder.
    pub shipped: bool,
    /// Whether the file is what would be written today.
    pub current: bool,
    /// The device that it ran on.
    pub device: Option<String>,
    /// The number of cosines.
    pub points: Option<usize>,
    /// Their share of all numbers from 0 to 1.
    pub share: Option<f64>,
    /// The allowed difference.
    pub bound: Option<AllowedError>,
    /// The measured difference.
    pub code_error: Option<CodeErrorFigures>,
    /// The method's error as it ran, where there is a law to compare with.
    pub model_error: Option<ModelErrorFigures>,
    /// What each compiler says of the file.
    #[serde(
        serialize_with = "as_object_or_null",
        deserialize_with = "from_object_or_null"
    )]
    pub accepts: Option<Vec<(String, Answer)>>,
    /// Why compilers were not asked.
    #[serde(serialize_with = "as_object", deserialize_with = "from_object")]
    pub not_asked: Vec<(String, String)>,
    /// The results of other execution paths of the same text.
    pub second_opinions: Vec<SecondOpinion>,
    /// The status.
    pub status: Status,
    /// Why it is not a pass.
    pub reason: Option<String>,
    /// What a reader should know of the file, where that is no fault.
    pub remark: Option<String>,
    /// In half precision, how far it is from f16 rounded after every operation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub emulation: Option<Emulation>,
}

impl VerifyRow {
    /// Whether it passes though a compiler refuses its file.
    pub fn contradicts_itself(&self) -> bool {
        let mut answers = self.accepts.iter().flatten();
        self.status == Status::Pass && answers.any(|(_, answer)| *answer == Answer::No)
    }
}

/// Whether a compiler accepts a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    /// It does.
    Yes,
    /// It refuses it.
    No,
    /// It was not asked.
    #[serde(rename = "not checked")]
    NotChecked,
}

impl Answer {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Answer::Yes => "yes",
            Answer::No => "no",
            Answer::NotChecked => "not checked",
        }
    }
}

impl From<&Verdict> for Answer {
    fn from(verdict: &Verdict) -> Answer {
        match verdict {
            Ok(()) => Answer::Yes,
            Err(Fault::Failed(_)) => Answer::No,
            Err(Fault::Absent(_)) => Answer::NotChecked,
        }
    }
}

/// The difference that a function is allowed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum AllowedError {
    /// In units of the last place.
    Ulp {
        /// How many. None where nothing is promised.
        ulp: Option<f64>,
        /// What is promised, in words.
        text: String,
    },
    /// As an absolute difference.
    Absolute {
        /// The difference. None where nothing is promised.
        max_abs: Option<f64>,
        /// What is promised, in words.
        text: String,
    },
}

/// A code error in a report. Figures that are not finite are none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CodeErrorFigures {
    /// Largest distance in units of the last place.
    pub max_ulp: Option<f64>,
    /// Why there is no distance in units of the last place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Largest absolute difference.
    pub max_abs: Option<f64>,
    /// The cosine of the largest distance.
    pub worst_cos: Option<f64>,
}

/// A model error in a report. Figures that are not finite are none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelErrorFigures {
    /// Largest absolute difference.
    pub max_abs: Option<f64>,
    /// Mean absolute difference.
    pub mean_abs: Option<f64>,
    /// Mean relative difference.
    pub mean_rel: Option<f64>,
    /// The cosine of the largest difference.
    pub worst_cos: Option<f64>,
    /// The number of angles at which the function gave NaN.
    pub undefined: usize,
}

/// How far half precision on a device is from f16 rounded after every operation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Emulation {
    /// Largest absolute difference.
    pub max_abs: Option<f64>,
    /// The cosine of the largest difference.
    pub worst_cos: Option<f64>,
    /// The precision that the device computes in, as far as its results tell.
    pub device_computes_in: Option<String>,
}

/// The same text run by another execution path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SecondOpinion {
    /// The execution path.
    #[serde(rename = "way")]
    pub execution_path: String,
    /// The device that it ran on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The number of cosines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// Their share of all numbers from 0 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// The allowed difference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<AllowedError>,
    /// The measured difference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code_error: Option<CodeErrorFigures>,
    /// In half precision, how far it is from f16 rounded after every operation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub emulation: Option<Emulation>,
    /// The method's error as it ran, where there is a law to compare with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model_error: Option<ModelErrorFigures>,
    /// The status.
    pub status: Status,
    /// Why it is not a pass.
    pub reason: Option<String>,
}

/// JSON has no numbers that are not finite.
pub(super) fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

/// Writes pairs of a name and a value as an object, in order.
///
/// # Errors
/// The writer refuses.
pub fn as_object<S: Serializer, K: Serialize, T: Serialize>(
    pairs: &[(K, T)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}

fn as_object_or_null<S: Serializer, T: Serialize>(
    pairs: &Option<Vec<(String, T)>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match pairs {
        None => serializer.serialize_none(),
        Some(pairs) => as_object(pairs, serializer),
    }
}

fn from_object<'de, D: Deserializer<'de>, T: DeserializeOwned>(
    deserializer: D,
) -> Result<Vec<(String, T)>, D::Error> {
    Ok(from_object_or_null(deserializer)?.unwrap_or_default())
}

fn from_object_or_null<'de, D: Deserializer<'de>, T: DeserializeOwned>(
    deserializer: D,
) -> Result<Option<Vec<(String, T)>>, D::Error> {
    let object: Option<Map<String, Value>> = Option::deserialize(deserializer)?;
    let pair = |(name, value)| {
        let value = serde_json::from_value(value).map_err(serde::de::Error::custom)?;
        Ok((name, value))
    };
    let pairs = object.map(|object| object.into_iter().map(pair).collect());
    pairs.transpose()
}

impl From<&CodeError> for CodeErrorFigures {
    fn from(error: &CodeError) -> CodeErrorFigures {
        CodeErrorFigures {
            max_ulp: finite(error.max_ulp),
            reason: None,
            max_abs: finite(error.max_abs),
            worst_cos: finite(error.worst_cos),
        }
    }
}

impl From<&HalfError> for CodeErrorFigures {
    fn from(error: &HalfError) -> CodeErrorFigures {
        CodeErrorFigures {
            max_ulp: None,
            reason: Some("half precision is judged by the absolute error".to_owned()),
            max_abs: finite(error.max_abs),
            worst_cos: finite(error.worst_cos),
        }
    }
}

impl From<&EffectOutcome> for CodeErrorFigures {
    fn from(outcome: &EffectOutcome) -> CodeErrorFigures {
        CodeErrorFigures {
            max_ulp: None,
            reason: Some("an effect's function is judged by the absolute error".to_owned()),
            max_abs: finite(outcome.max_abs),
            worst_cos: None,
        }
    }
}

impl From<&ModelError> for ModelErrorFigures {
    fn from(error: &ModelError) -> ModelErrorFigures {
        ModelErrorFigures {
            max_abs: finite(error.max_abs),
            mean_abs: finite(error.mean_abs),
            mean_rel: error.mean_rel.and_then(finite),
            worst_cos: finite(error.worst_cos),
            undefined: error.undefined,
        }
    }
}

/// The verdict on a function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It does what it should.
    Pass,
    /// It does not.
    Fail,
    /// It was not run.
    #[default]
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
