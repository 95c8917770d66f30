//! The errors of a method for a material, in every measure that is charted.

use super::best_inputs::{best_inputs, values_at};
use super::derive::values_for_material;
use super::model_error::{SharedReference, model_error};
use super::perceived::SeenReference;
use super::problem::FitCurve;
use crate::generator::reference::MaterialInMedium;
use crate::language::ir::{Checked, Value};
use crate::language::methods::{Method, Values};
use crate::physics::spectra::Space;

/// Errors over all angles. Each is none where it is unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MethodErrors {
    /// The largest absolute error of reflectance.
    pub max_abs: Option<f64>,
    /// The mean relative error of reflectance.
    pub mean_rel: Option<f64>,
    /// The largest error of luminance.
    pub luminance: Option<f64>,
    /// The largest colour difference, by CIEDE2000.
    pub de2000: Option<f64>,
}

/// The inputs with which a method is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputChoice {
    /// Those that the method's authors intended.
    Intended,
    /// Those that minimise the largest error.
    Best,
}

impl InputChoice {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            InputChoice::Intended => "intended",
            InputChoice::Best => "best",
        }
    }
}

const BUILT: &str = "a test builds every method";

/// What the methods for a material are held against, computed once for all of them.
pub struct MaterialTruth<'a> {
    subject: &'a MaterialInMedium,
    curve: FitCurve,
    shared: SharedReference<'a>,
    seen: SeenReference,
}

impl<'a> MaterialTruth<'a> {
    /// The truth of a material, with colours in this space.
    pub fn new(subject: &'a MaterialInMedium, space: Space) -> MaterialTruth<'a> {
        let shared = SharedReference::new(&subject.reference);
        MaterialTruth {
            subject,
            curve: FitCurve::of(subject),
            seen: SeenReference::new(&shared.table, space),
            shared,
        }
    }
}

impl MethodErrors {
    /// The errors of a method's library function, which is given too, for a material. Angles at which it gives no number are left out.
    pub fn new(
        (method, function): (&Method, &Checked),
        inputs: InputChoice,
        truth: &MaterialTruth,
    ) -> MethodErrors {
        let subject = truth.subject;
        let values = values_for_material(subject, method);
        if method.is_textured() {
            return MethodErrors::of_texture(method, &values, subject);
        }
        let best = || best_inputs((method, function), &values, &truth.curve);
        let best = (inputs == InputChoice::Best).then(best).flatten();
        let values = best.unwrap_or(values);
        let run = |cosines: &[f64]| -> Value<f64> {
            values_at(function, method.inputs, &values, cosines)
        };
        let error = truth.shared.error_of(&run);
        let perceived = truth.seen.perceived(&run);
        MethodErrors {
            max_abs: Some(error.max_abs),
            mean_rel: error.mean_rel,
            luminance: Some(perceived.luminance),
            de2000: Some(perceived.de2000),
        }
    }

    /// For a function that reads a texture, the perceived errors are not measured.
    fn of_texture(method: &Method, values: &Values, subject: &MaterialInMedium) -> MethodErrors {
        let function = method.specialise(values).expect(BUILT);
        let error = model_error(&function, &subject.truth_for(method));
        MethodErrors {
            max_abs: Some(error.max_abs),
            mean_rel: error.mean_rel,
            ..MethodErrors::default()
        }
    }

    /// The same in six digits, as they are recorded.
    pub fn in_six_digits(self) -> MethodErrors {
        let digits = |error: f64| format!("{error:.5e}").parse().expect("it is a number");
        MethodErrors {
            max_abs: self.max_abs.map(digits),
            mean_rel: self.mean_rel.map(digits),
            luminance: self.luminance.map(digits),
            de2000: self.de2000.map(digits),
        }
    }

    /// The errors of many materials combined, each measure by the same statistic. A measure is none where it is unknown for one
    /// of them.
    pub fn together(all: &[MethodErrors], statistic: &dyn Fn(&[f64]) -> f64) -> MethodErrors {
        let take = |measure: fn(&MethodErrors) -> Option<f64>| {
            let known: Option<Vec<f64>> = all.iter().map(measure).collect();
            known.map(|known| statistic(&known))
        };
        MethodErrors {
            max_abs: take(|errors| errors.max_abs),
            mean_rel: take(|errors| errors.mean_rel),
            luminance: take(|errors| errors.luminance),
            de2000: take(|errors| errors.de2000),
        }
    }
}
