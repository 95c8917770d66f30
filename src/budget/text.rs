//! What is said of a choice: which and why, what cheaper ones err, and when finer is pointless.

use crate::cost::Family;
use crate::fit::rounded_up;

use super::choice::{BudgetCandidate, CheapestFunction};
use super::spread::Spread;

/// An error below this share of what measurements differ by is not worth making smaller.
const POINTLESS: f64 = 0.1;

/// Where figures come from.
#[derive(Clone, Copy, Debug)]
pub struct CostBasis {
    /// On which GPUs.
    pub family: &'static Family,
    /// `specialised`, or `library` where the record has no specialised functions of the material.
    pub form: &'static str,
}

/// What is said of a material's choice, a line each.
pub fn choice_remarks(
    name: &str,
    choice: &CheapestFunction,
    spread: Option<Spread>,
    budget: f64,
    measured: CostBasis,
) -> Vec<String> {
    let chosen = &choice.chosen;
    let fetch = if chosen.is_textured {
        " and a texture fetch, which no count holds"
    } else {
        ""
    };
    let mut lines = vec![format!(
        "{name}: {}, the cheapest within {budget}: it errs by {} and costs {}{fetch} ({} on {}, as a {} function)",
        chosen.method,
        error(chosen.error),
        chosen.cost,
        measured.family.columns.measure,
        measured.family.name,
        measured.form
    )];
    lines.push(match &choice.cheaper {
        Some(cheaper) => format!("{name}: of those that cost less {}", figures(cheaper)),
        None => format!("{name}: nothing costs less"),
    });
    lines.extend(choice.textured.as_ref().map(|table| {
        format!(
            "{name}: {} is within the budget too: it errs by {} and costs {}, and a texture fetch that no count holds",
            table.method,
            error(table.error),
            table.cost
        )
    }));
    lines.push(format!("{name}: {}", known(chosen.error, spread)));
    lines
}

fn figures(candidate: &BudgetCandidate) -> String {
    format!(
        "{} errs least, by {}, at {}",
        candidate.method,
        error(candidate.error),
        candidate.cost
    )
}

/// How well the material is known.
fn known(error_made: f64, spread: Option<Spread>) -> String {
    let Some(Spread { most, sources }) = spread else {
        return "how far measurements of it lie apart is not known: the catalogue tells it where it has two spectra or more"
            .to_owned();
    };
    let apart = format!(
        "{sources} measurements of it lie up to {} apart",
        error(most)
    );
    if error_made < POINTLESS * most {
        format!("{apart}, more than ten times the error: finer is pointless")
    } else {
        apart
    }
}

/// Why nothing is chosen.
pub fn no_choice(name: &str, best: Option<&BudgetCandidate>, family: &Family) -> String {
    let Some(best) = best else {
        return format!(
            "{name}: no method describes it whose cost on {} is known",
            family.name
        );
    };
    format!(
        "{name}: the best there is is {}, which errs by {} and costs {} on {}",
        best.method,
        error(best.error),
        best.cost,
        family.name
    )
}

/// An error, rounded up where it is not small.
fn error(value: f64) -> String {
    if value < 1e-4 {
        return format!("{value:.1e}");
    }
    rounded_up(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finer_is_pointless_below_a_tenth_of_what_is_known() {
        let spread = |most: f64| Some(Spread { most, sources: 3 });
        assert!(known(0.0019, spread(0.02)).ends_with("finer is pointless"));
        assert!(known(0.002, spread(0.02)).ends_with("0.02000 apart"));
        assert!(known(0.002, None).contains("not known"));
    }

    #[test]
    fn errors_are_not_told_smaller_than_they_are() {
        assert_eq!(error(0.001_931), "0.00194");
        assert_eq!(error(6.0e-8), "6.0e-8");
    }
}
