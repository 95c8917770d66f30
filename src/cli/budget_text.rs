//! What a budget chose for people: which function and why, what cheaper ones would err by, and whether a smaller error would matter.

use crate::lab::budget::{BudgetCandidate, BudgetRow, Spread, rounded_error};

/// A smaller error does not matter below this share of the difference between published measurements.
const NEGLIGIBLE: f64 = 0.1;

/// The remarks on a material's choice, a line each.
pub fn budget_remarks(row: &BudgetRow) -> Vec<String> {
    let (name, choice) = (crate::physics::foreign::Foreign(&row.material), &row.choice);
    let mut lines = vec![format!(
        "{name}: {} is the cheapest within {}: {} ({} on {}, as a {} function)",
        choice.chosen.method,
        row.budget.most,
        error_and_cost(&choice.chosen),
        row.budget.family.columns.measure,
        row.budget.family.name,
        row.form.name()
    )];
    lines.push(match &choice.cheaper {
        Some(cheaper) => format!(
            "{name}: {} is the most accurate of those that cost less: {}",
            cheaper.method,
            error_and_cost(cheaper)
        ),
        None => format!("{name}: nothing costs less"),
    });
    lines.extend(choice.textured.as_ref().map(|table| {
        let figures = error_and_cost(table);
        format!(
            "{name}: {} is within the budget too: {figures}",
            table.method
        )
    }));
    lines.push(format!(
        "{name}: {}",
        measurements(choice.chosen.point.error, row.spread)
    ));
    lines
}

fn error_and_cost(candidate: &BudgetCandidate) -> String {
    let fetch = match candidate.is_textured {
        true => " and a texture fetch, which the count does not include",
        false => "",
    };
    format!(
        "error {}, cost {}{fetch}",
        rounded_error(candidate.point.error),
        candidate.point.cost
    )
}

/// How well the material is known.
fn measurements(error: f64, spread: Option<Spread>) -> String {
    let Some(Spread { most, sources }) = spread else {
        return "how far its measurements differ is not known: the catalogue says so only of materials with two spectra or more"
            .to_owned();
    };
    let differ = format!(
        "its {sources} measurements differ by up to {}",
        rounded_error(most)
    );
    if error < NEGLIGIBLE * most {
        format!("{differ}, more than ten times the error: a smaller error gains nothing")
    } else {
        differ
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smaller_error_gains_nothing_below_a_tenth_of_what_is_known() {
        let spread = |most: f64| Some(Spread { most, sources: 3 });
        assert!(measurements(0.0019, spread(0.02)).ends_with("gains nothing"));
        assert!(measurements(0.002, spread(0.02)).ends_with("up to 0.02000"));
        assert!(measurements(0.002, None).contains("not known"));
    }
}
