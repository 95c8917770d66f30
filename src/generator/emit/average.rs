//! Means over the hemisphere, `2 ∫ F c dc`, for light that is reflected more than once between microfacets: functions of a
//! material's numbers beside those of a method, and the constants of a material.

use serde::{Deserialize, Serialize};

use super::function::EmittedFunction;
use crate::language::ir::{Checked, Value, evaluate};
use crate::language::methods::Basis;
use crate::physics::num::{Legendre, each_channel};

/// What the head of a file says about coefficients; none for other functions.
pub(super) fn coefficients_line(emitted: &EmittedFunction) -> Option<String> {
    emitted.form.coefficient()?;
    let method = emitted.method;
    let coefficients = method.coefficients?;
    let [median, tenth] = coefficients.model;
    Some(format!(
        "{m}_c0 to {m}_c3: the coefficients of {fitted}, for scenes with many lights: find them once a pixel and call {fitted} once a \
         light. Half of all metals are then off by less than {median}, nine of ten by less than {tenth}",
        m = method.name,
        fitted = coefficients.fitted,
    ))
}

/// What the head of a file says about a mean; none for other functions.
pub(super) fn mean_line(emitted: &EmittedFunction) -> Option<String> {
    let method = emitted.method;
    let what = match (method.basis(), method.average) {
        _ if !emitted.form.is_mean() => return None,
        (Some(basis), _) => format!(
            "{}, limited to [0, 1]. It is exact for F before its limit; where F meets the limit, the mean of the function differs",
            sum(&basis)
        ),
        (None, Some(average)) => format!(
            "a fit, off by at most {} for {}; {}",
            average.max_abs, average.over, average.published
        ),
        (None, None) => return None,
    };
    Some(format!(
        "{}: the mean of F over the hemisphere, twice the integral of F c dc, for compensation of multiple scattering: {what}",
        emitted.name
    ))
}

/// The mean as a formula.
fn sum(basis: &Basis) -> String {
    let numbers = basis.numbers().into_iter().zip(basis.averages());
    let term = |(i, (number, average)): (usize, (&str, f64))| match i {
        0 => number.to_owned(),
        _ if number.contains(' ') => format!("{average:.6} ({number})"),
        _ => format!("{average:.6} {number}"),
    };
    let terms: Vec<String> = numbers.enumerate().map(term).collect();
    terms.join(" + ")
}

/// The mean over the hemisphere of a material's fitted function, after its clamp to [0, 1] and before. None for other functions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Average {
    /// The mean of the function's values.
    pub given: [f64; 3],
    /// The mean of the form before its clamp, in closed form.
    pub unlimited: [f64; 3],
}

/// Pieces of [0, 1], each with a quadrature rule of `POINTS` points: a corner where the clamp sets in is integrated within 1e-7.
const PIECES: usize = 256;
const POINTS: usize = 8;

impl Average {
    /// The mean of a specialised function.
    pub fn of(emitted: &EmittedFunction) -> Option<Average> {
        let shape = emitted.method.shape?;
        let own = |name: &str| emitted.constants.get(name);
        let names = emitted.method.inputs.iter().map(|input| input.name);
        let coefficients: Vec<[f64; 3]> = names
            .map(|name| own(name).copied())
            .collect::<Option<_>>()?;
        let averages = Basis::Fitted(shape).averages();
        let sum = |channel: usize| {
            let terms = coefficients.iter().zip(&averages);
            terms.map(|(c, average)| c[channel] * average).sum()
        };
        Some(Average {
            given: hemispherical(&emitted.function),
            unlimited: each_channel(sum),
        })
    }

    /// The largest difference that the clamp makes.
    fn difference(&self) -> f64 {
        let pairs = self.given.iter().zip(self.unlimited);
        pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
    }

    /// The line about the mean above a specialised function.
    pub(super) fn line(&self) -> String {
        let before = if self.difference() > LEAST_DIFFERENCE {
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

/// Three numbers in parentheses, rounded to six decimals.
pub(super) fn triple(values: [f64; 3]) -> String {
    let numbers = values.map(|value| ((value * 1e6).round() / 1e6).to_string());
    format!("({})", numbers.join(", "))
}

/// The least difference that is reported.
const LEAST_DIFFERENCE: f64 = 1e-6;

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
