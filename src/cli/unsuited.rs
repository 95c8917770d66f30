//! Fitted methods that were asked for by name, for materials that the one of their own class follows far better: `fitted` for water.

use crate::cli::error::Error;
use crate::generator::emit::fitted_error;
use crate::generator::fit::{ModelError, rounded_up};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request};
use crate::language::methods::{self, Method};
use crate::physics::foreign::Foreign;

/// How many times the error of the class's own method is told.
const FAR: f64 = 2.0;

/// A sentence for each such method, with the figures of one material. One that errs little more is none of them.
///
/// # Errors
/// The request names what does not exist, or a material's file has a fault.
pub fn unsuited(request: &Request) -> Result<Vec<String>, Error> {
    let named = request.resolved_methods()?.unwrap_or_default();
    let named: Vec<&Method> = named
        .into_iter()
        .filter(|method| method.is_fitted() && !method.claims.by_class.is_empty())
        .collect();
    let is_of_materials = !matches!(request.materials, Materials::None | Materials::Default);
    if named.is_empty() || !is_of_materials || !request.effects.is_empty() {
        return Ok(Vec::new());
    }
    let subjects = request.subjects()?.materials();
    Ok(named
        .into_iter()
        .filter_map(|method| sentence(method, &subjects))
        .collect())
}

/// What is said of a method and the materials that want another.
fn sentence(method: &'static Method, subjects: &[MaterialInMedium]) -> Option<String> {
    let other = |subject: &MaterialInMedium| {
        // With as many coefficients, and so at about the same cost.
        let other = methods::find(subject.fitted_with_four()?)?;
        (other.class != method.class).then_some(other)
    };
    let mut unsuited = subjects
        .iter()
        .filter_map(|subject| Some((subject, other(subject)?)));
    let (subject, other) = unsuited.next()?;
    let [own, better] = [method, other].map(|method| fitted_error(subject, method));
    let (own, better) = (own?, better?);
    if own.max_abs < FAR * better.max_abs {
        return None;
    }
    let more = match unsuited.count() {
        0 => String::new(),
        count => format!("; {count} more of these materials are of such a class"),
    };
    let (name, class) = (Foreign(&subject.name), subject.material.kind.name());
    Some(format!(
        "for {name}, a {class}, {} errs by {}, and {} by {}{more}",
        method.name,
        words(&own),
        other.name,
        words(&better)
    ))
}

/// `0.00349 (6.48 % in the mean)`.
fn words(error: &ModelError) -> String {
    let mean = error.mean_rel.map(|share| 100.0 * share);
    let mean = mean.map_or_else(String::new, |mean| format!(" ({mean:.2} % in the mean)"));
    rounded_up(error.max_abs) + &mean
}
