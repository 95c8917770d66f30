//! What an audit found of a user's function for a material, for people.

use crate::generator::fit::ModelError;
use crate::lab::audit::{AuditCost, AuditRow, ConditionRow, ExactFit};
use crate::lab::verify::Status;
use crate::physics::foreign::{Foreign, lines as lines_of, one_line};

/// A row for people.
pub fn audit_text(row: &AuditRow) -> String {
    let [function, file, material] = [&row.function, &row.file, &row.material].map(Foreign);
    let mut text = format!("{function} in {file} (line {}), {material}\n", row.line);
    for (head, line) in lines(row) {
        text += &format!("  {head:<12} {}\n", lines_of(&line));
    }
    text
}

fn lines(row: &AuditRow) -> Vec<(&'static str, String)> {
    let taken = row.cosine_words.as_ref();
    let taken = taken.map_or(String::new(), |words| format!(", taken as {words}"));
    let mut lines = vec![("cosine", format!("`{}`{taken}", row.cosine))];
    if let Some(words) = &row.language_remark {
        lines.push(("run as", words.clone()));
    }
    if !row.conditions.is_empty() {
        lines.push(("conditions", conditions(&row.conditions)));
    }
    if !row.initialised.is_empty() {
        let values = row.initialised.join("; ");
        lines.push(("initialised", format!("{values}, as the file has it")));
    }
    if row.precision == "f16" {
        let words = "16 bits where its types say so";
        lines.push(("precision", words.to_owned()));
    }
    if !row.filled.is_empty() {
        let filled = row.filled.join("; ");
        lines.push(("filled in", format!("{filled}, as the material has it")));
    }
    let accepts = row.accepts.iter();
    let accepts: Vec<String> = accepts
        .map(|(name, answer)| format!("{name}: {}", answer.words()))
        .collect();
    lines.push(("accepted", accepts.join("; ")));
    if let (Some(device), Some(points)) = (&row.device, row.points) {
        lines.push(("run on", format!("{device}, at {points} cosines")));
        lines.push(("edges", edges(row)));
        lines.extend(
            row.model_error
                .iter()
                .map(|error| ("model error", model_error(error))),
        );
        lines.extend(computes(row).map(|words| ("computes", words)));
    }
    lines.push(("inputs", inputs(row)));
    let costs = row.cost.iter();
    lines.extend(costs.map(|cost| ("cost", cost_line(row, cost))));
    lines.push(("checked", row.checked.words(row.status)));
    lines
}

/// How the conditions around a function and in it were decided.
fn conditions(all: &[ConditionRow]) -> String {
    let words = |one: &ConditionRow| {
        let taken = if one.is_taken { "taken" } else { "not taken" };
        format!("line {} `{}`: {taken}", one.line, one.text)
    };
    let all: Vec<String> = all.iter().map(words).collect();
    all.join("; ")
}

/// What the function computes, where it is a method of ours or would be with another quantity.
fn computes(row: &AuditRow) -> Option<String> {
    if let Some(method) = row.computes {
        return Some(format!("{method}, as it is bound"));
    }
    let fit = row.fits_exactly_with.as_ref()?;
    let ExactFit {
        argument,
        quantity,
        method,
        max_abs,
    } = fit;
    Some(format!(
        "fits exactly with {quantity} for `{argument}`: it is {method} then, with an error of {max_abs:.6} at most; bind it with --arg {argument}={quantity}"
    ))
}

/// How much it takes, and how much it gives.
fn inputs(row: &AuditRow) -> String {
    let numbers = match row.input_numbers {
        0 => "no numbers".to_owned(),
        1 => "1 number".to_owned(),
        count => format!("{count} numbers"),
    };
    let channels = match row.channels {
        1 => "; one channel, and costs are those of one",
        _ => "",
    };
    format!("{numbers} of a material{channels}")
}

fn edges(row: &AuditRow) -> String {
    let counted = || row.edges.iter().flatten().filter(|edge| edge.counts);
    let wrong = counted().filter(|edge| edge.fault.is_some()).count();
    let beyond = match row.beyond.as_deref() {
        None | Some([]) => String::new(),
        Some(beyond) => format!("; beyond them, {}", beyond.join(", ")),
    };
    match wrong {
        0 => format!("a reflectance at all of them{beyond}"),
        _ => format!(
            "{wrong} of {} results are no reflectance{beyond}",
            counted().count()
        ),
    }
}

fn model_error(error: &ModelError) -> String {
    let mean = error.mean_rel.map_or("no mean".to_owned(), |mean| {
        format!("{:.3} % in the mean", 100.0 * mean)
    });
    // What is not finite is no number, here as in the JSON.
    let number = |figure: f64| if figure.is_finite() { figure } else { f64::NAN };
    format!(
        "{:.6} at most, at {:.1} degrees; {:.6} in the mean; relative {mean}",
        number(error.max_abs),
        libm::acos(error.worst_cos).to_degrees(),
        number(error.mean_abs),
    )
}

fn cost_line(row: &AuditRow, cost: &AuditCost) -> String {
    let gpu = cost.family.name;
    match &cost.figures {
        Err(why) => format!("{gpu}: not checked: {why}"),
        Ok(figures) => {
            let (net, measure) = (figures.cost(), cost.family.columns.measure);
            let sentence = row.sentence_on(gpu).unwrap_or("ours are not known there");
            format!("{gpu}: {net} ({measure}): {sentence}")
        }
    }
}

/// What is wrong, for stderr.
pub fn audit_remarks(row: &AuditRow) -> Vec<String> {
    let head = match row.status {
        Status::Fail => "FAIL ",
        Status::NotChecked => "not checked: ",
        Status::Pass => "",
    };
    let reasons = row.reason.as_deref().unwrap_or_default().lines();
    reasons
        .map(|reason| format!("{head}{}", one_line(reason)))
        .collect()
}
