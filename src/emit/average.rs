//! Means over the hemisphere, `2 ∫ F c dc`: functions of coefficients beside those of a fitted method, and the constants of a
//! material, for what light does that is reflected more than once between microfacets.

use serde::{Deserialize, Serialize};

use crate::ir::{Checked, Value, evaluate};
use crate::methods::Method;
use crate::num::{Legendre, each_channel};

use super::error::Error;
use super::form::FunctionForm;
use super::function::{Emitted, Naming, library_function};

/// What stands beside a method's functions and takes no cosine: the means of a fitted method, three channels and one; the
/// coefficients that a method finds for a fitted one.
///
/// # Errors
/// A graph breaks a rule of the representation: a bug.
pub fn companions(method: &'static Method, naming: &Naming) -> Result<Vec<Emitted>, Error> {
    let forms = [
        (FunctionForm::Average, false),
        (FunctionForm::AverageScalar, true),
    ];
    let functions = forms.into_iter().filter_map(|(form, is_scalar)| {
        let function = method.average_in(naming.precision, is_scalar)?;
        Some(library_function(method, naming, form, function))
    });
    let coefficients = FunctionForm::COEFFICIENTS.into_iter().enumerate();
    let coefficients = coefficients.filter_map(|(place, form)| {
        let function = method.coefficient_in(naming.precision, place)?;
        Some(library_function(method, naming, form, function))
    });
    functions.chain(coefficients).collect()
}

/// What the head of a file says about coefficients; nothing of other functions.
pub(super) fn coefficients_line(emitted: &Emitted) -> Option<String> {
    emitted.form.coefficient()?;
    let method = emitted.method;
    let fitted = method.coefficients?.fitted;
    Some(format!(
        "{m}_c0 to {m}_c3: the coefficients of {fitted}, for scenes with many lights: find them once a pixel and call {fitted} once a \
         light. It gives the same",
        m = method.name
    ))
}

/// What the head of a file says about a mean; nothing of other functions.
pub(super) fn mean_line(emitted: &Emitted) -> Option<String> {
    let shape = emitted.method.shape.filter(|_| emitted.form.is_mean())?;
    let averages = shape.averages();
    let term = |(i, average): (usize, &f64)| match i {
        0 => "c0".to_owned(),
        _ => format!("{average:.6} c{i}"),
    };
    let terms: Vec<String> = averages.iter().enumerate().map(term).collect();
    Some(format!(
        "{}: the mean of F over the hemisphere, twice the integral of F c dc, for compensation of multiple scattering: {}, limited \
         to [0, 1]. It is exact for F before its limit; where F meets the limit, the mean of the function differs",
        emitted.name,
        terms.join(" + ")
    ))
}

/// The mean over the hemisphere of a material's fitted function, its limit to [0, 1] included, and before that limit; none for
/// other functions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Average {
    /// Of what the function gives.
    pub given: [f64; 3],
    /// Of the form before its limit, in closed form.
    pub unlimited: [f64; 3],
}

/// Pieces of [0, 1], each with a rule of so many points: a corner where the limit sets in is integrated within 1e-7.
const PIECES: usize = 256;
const POINTS: usize = 8;

impl Average {
    /// Of a specialised function.
    pub fn of(emitted: &Emitted) -> Option<Average> {
        let shape = emitted.method.shape?;
        let own = |name: &str| emitted.constants.get(name);
        let names = emitted.method.inputs.iter().map(|input| input.name);
        let coefficients: Vec<[f64; 3]> = names
            .map(|name| own(name).copied())
            .collect::<Option<_>>()?;
        let averages = shape.averages();
        let sum = |channel: usize| {
            let terms = coefficients.iter().zip(&averages);
            terms.map(|(c, average)| c[channel] * average).sum()
        };
        Some(Average {
            given: hemispherical(&emitted.function),
            unlimited: each_channel(sum),
        })
    }

    /// The furthest that the limit brings them apart.
    fn difference(&self) -> f64 {
        let pairs = self.given.iter().zip(self.unlimited);
        pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
    }

    /// What stands above a specialised function.
    pub(super) fn line(&self) -> String {
        let triple = |values: [f64; 3]| {
            let [red, green, blue] = values.map(|value| format!("{}", (value * 1e6).round() / 1e6));
            format!("({red}, {green}, {blue})")
        };
        let before = if self.difference() > TOLD {
            format!("; before the limit to [0, 1] {}", triple(self.unlimited))
        } else {
            String::new()
        };
        format!(
            "Average over the hemisphere, weighted by cosine: {}{before}.",
            triple(self.given)
        )
    }
}

/// Differences that are told.
const TOLD: f64 = 1e-6;

/// `2 ∫ F c dc` over c from 0 to 1 of a function of `cos_theta` alone.
fn hemispherical(function: &Checked) -> [f64; 3] {
    let rule = Legendre::new(POINTS);
    let end = |i: usize| i as f64 / PIECES as f64;
    let piece = |i: usize| rule.over(end(i), end(i + 1));
    let (cosines, weights): (Vec<f64>, Vec<f64>) = (0..PIECES).flat_map(piece).unzip();
    let values = evaluate(function, &[Value::each(cosines.clone())]);
    let weighed = cosines.iter().zip(weights).enumerate();
    weighed.fold([0.0; 3], |sum, (i, (c, weight))| {
        let value = values.at(i);
        each_channel(|channel| sum[channel] + 2.0 * c * weight * value[channel])
    })
}
