//! Remarks on methods: why a budget chose one, and which named ones suit a material badly. A fitted method suits it badly where the
//! method of the material's own class fits it far better: `fitted` for water.

use crate::cli::error::Error;
use crate::generator::emit::fitted_error;
use crate::generator::fit::{ModelError, rounded_up};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request};
use crate::lab::budget::{BudgetCandidate, BudgetRow, Spread, rounded_error};
use crate::language::methods::{self, Method};
use crate::physics::foreign::Foreign;

/// Below this share of the difference between published measurements, a smaller error does not matter.
const NEGLIGIBLE: f64 = 0.1;

/// The remarks on a material's choice, a line each.
pub fn budget_remarks(row: &BudgetRow) -> Vec<String> {
    let (name, choice) = (Foreign(&row.material), &row.choice);
    let mut lines = vec![format!(
        "{name}: {} is the cheapest within {}: {} ({} on {}, as a {} function)",
        choice.chosen.method.name,
        row.budget.max_error,
        error_and_cost(&choice.chosen),
        row.budget.family.columns.measure,
        row.budget.family.name,
        row.form.name()
    )];
    lines.push(match &choice.cheaper {
        Some(cheaper) => format!(
            "{name}: {} is the most accurate of those that cost less: {}",
            cheaper.method.name,
            error_and_cost(cheaper)
        ),
        None => format!("{name}: nothing costs less"),
    });
    lines.extend(choice.textured.as_ref().map(|table| {
        let figures = error_and_cost(table);
        format!(
            "{name}: {} is within the budget too: {figures}",
            table.method.name
        )
    }));
    lines.push(format!(
        "{name}: {}",
        measurements(choice.chosen.point.error, row.spread)
    ));
    lines
}

fn error_and_cost(candidate: &BudgetCandidate) -> String {
    let fetch = if candidate.method.is_textured() {
        " and a texture fetch, which the count does not include"
    } else {
        ""
    };
    format!(
        "error {}, cost {}{fetch}",
        rounded_error(candidate.point.error),
        candidate.point.cost
    )
}

/// How well the material is known.
fn measurements(error: f64, spread: Option<Spread>) -> String {
    let Some(Spread {
        max_difference,
        sources,
    }) = spread
    else {
        return "how far its measurements differ is not known: the catalogue says so only of materials with two spectra or more"
            .to_owned();
    };
    let differ = format!(
        "its {sources} measurements differ by up to {}",
        rounded_error(max_difference)
    );
    if error < NEGLIGIBLE * max_difference {
        format!("{differ}, more than ten times the error: a smaller error gains nothing")
    } else {
        differ
    }
}

/// A method is reported if its error is at least this many times that of the class's own method.
const FAR: f64 = 2.0;

/// A sentence for each such method, with the figures of one material. Methods with only slightly larger errors are not reported.
///
/// # Errors
/// The request names something that does not exist, or a material's file has a fault.
pub fn unsuited(request: &Request) -> Result<Vec<String>, Error> {
    let mut named = request.methods.named().unwrap_or_default();
    named.retain(|method| method.is_fitted() && !method.claims.by_class.is_empty());
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

/// The sentence on a method and the materials that another method suits.
fn sentence(method: &'static Method, subjects: &[MaterialInMedium]) -> Option<String> {
    let other = |subject: &MaterialInMedium| {
        // A method with as many coefficients, and so of about the same cost.
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
    let (name, class) = (Foreign(&subject.name), subject.class());
    Some(format!(
        "for {name}, a {class}, {} errs by {}, and {} by {}{more}",
        method.name,
        words(&own),
        other.name,
        words(&better)
    ))
}

/// An error in words: `0.00349 (6.48 % in the mean)`.
fn words(error: &ModelError) -> String {
    let mean = error.mean_rel.map(|share| 100.0 * share);
    let mean = mean.map_or_else(String::new, |mean| format!(" ({mean:.2} % in the mean)"));
    rounded_up(error.max_abs) + &mean
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smaller_error_gains_nothing_below_a_tenth_of_what_is_known() {
        let spread = |max_difference: f64| {
            Some(Spread {
                max_difference,
                sources: 3,
            })
        };
        assert!(measurements(0.0019, spread(0.02)).ends_with("gains nothing"));
        assert!(measurements(0.002, spread(0.02)).ends_with("up to 0.02000"));
        assert!(measurements(0.002, None).contains("not known"));
    }
}
