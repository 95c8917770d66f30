//! What a verification found: a line for each row, what is wrong, and what was not checked.

use std::collections::BTreeSet;

use crate::pictures::table;
use crate::lab::verify::{AllowedError, Status, VerifyRow, WITHIN};
use crate::physics::foreign::{lines, one_line};
use crate::physics::num::Precision;

/// How many findings are shown in full; the JSON has all.
const SHOWN: usize = 20;

/// A line for each row, and what share of all numbers was run.
pub fn verify_text(rows: &[VerifyRow]) -> String {
    let head = [
        "target",
        "method",
        "material",
        "form",
        "points",
        "code error, ulp",
        "allowed",
        "model error",
        "in the mean, %",
        "status",
    ];
    table::text_table(&head, &rows.iter().map(cells).collect::<Vec<_>>()) + &covered(rows)
}

fn cells(row: &VerifyRow) -> Vec<String> {
    let model = row.model_error.as_ref();
    let most = model.and_then(|error| error.max_abs);
    let mean = model.and_then(|error| error.mean_rel);
    let shown = |cell: Option<String>| cell.unwrap_or_else(|| "-".to_owned());
    vec![
        row.target.clone(),
        match &row.effect {
            Some(_) => row.function.clone(),
            None => row.method.clone(),
        },
        row.material.clone().unwrap_or_default(),
        row.form.name().to_owned(),
        shown(row.points.map(|points| points.to_string())),
        shown(code_error(row)),
        shown(allowed(row)),
        shown(most.map(|most| format!("{most:.5}"))),
        shown(mean.map(|mean| format!("{:.3}", 100.0 * mean))),
        row.status.words().to_owned(),
    ]
}

/// In half precision the absolute error, else ulp.
fn code_error(row: &VerifyRow) -> Option<String> {
    let error = row.code_error.as_ref()?;
    match (error.max_ulp, error.max_abs) {
        (Some(ulp), _) => Some(format!("{ulp:.2}")),
        (None, Some(most)) if row.effect.is_some() => Some(format!("{most:.1e} abs")),
        (None, Some(most)) if row.precision.is_half() => Some(format!("{most:.5} abs")),
        _ => None,
    }
}

fn allowed(row: &VerifyRow) -> Option<String> {
    match row.bound.as_ref()? {
        AllowedError::Ulp(allowed) if allowed.ulp == Some(0.0) => Some("2^-22".to_owned()),
        AllowedError::Ulp(allowed) => allowed.ulp.map(|ulp| format!("{ulp:.1}")),
        AllowedError::Absolute(allowed) if row.effect.is_some() => {
            allowed.max_abs.map(|most| format!("{most:.0e} abs"))
        }
        AllowedError::Absolute(allowed) if row.precision.is_half() => {
            allowed.max_abs.map(|most| format!("{most:.5} abs"))
        }
        AllowedError::Absolute(allowed) => allowed.max_abs.map(|most| format!("{most:.1e} abs")),
    }
}

/// What share of all numbers was tried: a sample finds what is wrong at a single number by luck only.
fn covered(rows: &[VerifyRow]) -> String {
    let shares = |precision: Precision| {
        let rows = rows.iter().filter(move |row| row.precision == precision);
        rows.filter_map(|row| row.share).reduce(f64::max)
    };
    let mut text = String::new();
    if let Some(share) = shares(Precision::F32) {
        text += "\nA difference within 2^-22 passes, however many ulp it is.";
        let cosines = (share * WITHIN as f64).round();
        let percent = 100.0 * share;
        text += &format!(
            "\nFrom 0 to 1 each function was run at {cosines} cosines at most, {percent:.6} % of the {WITHIN} f32 there are.\n"
        );
        if share < 0.5 {
            text += "A result that is wrong at a single f32 is found by luck only; --exhaustive tries all of them.\n";
        }
    }
    if rows.iter().any(|row| row.effect.is_some()) {
        text += "\nFunctions of effects were run at points of their domains and at their ends. Their error is what lies beyond what the \
                 last bits of the arguments and the steps of a sampler's weights turn.\n";
    }
    if shares(Precision::F16).is_some() {
        text += "\nIn half precision each function was run at every f16 from 0 to 1.\n";
    }
    text
}

fn with_status(rows: &[VerifyRow], status: Status) -> impl Iterator<Item = &VerifyRow> {
    rows.iter().filter(move |row| row.status == status)
}

/// What was not checked, each once.
pub fn not_checked(rows: &[VerifyRow]) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for row in rows {
        let target = &row.target;
        let reason = |reason: &Option<String>| reason.clone().unwrap_or_default();
        if row.status == Status::NotChecked {
            all.insert(format!("{target}: {}", reason(&row.reason)));
        }
        let opinions = row.second_opinions.iter();
        for opinion in opinions.filter(|opinion| opinion.status == Status::NotChecked) {
            let why = reason(&opinion.reason);
            all.insert(format!("{target} by {}: {why}", opinion.execution_path));
        }
        for (name, why) in &row.not_asked {
            all.insert(format!("{target} by {name}: {why}"));
        }
    }
    all
}

/// Findings and what was not checked, for stderr; where GitHub reads them it shows findings beside the file.
pub fn verify_remarks(rows: &[VerifyRow], is_github: bool) -> Vec<String> {
    // What is wrong with a file stands in all of its rows.
    let mut findings: Vec<String> = Vec::new();
    for row in with_status(rows, Status::Fail) {
        let finding = finding(row, is_github);
        if !findings.contains(&finding) {
            findings.push(finding);
        }
    }
    let more = findings.len().saturating_sub(SHOWN);
    let mut remarks: Vec<String> = findings.into_iter().take(SHOWN).collect();
    if more > 0 {
        remarks.push(format!("… and {more} more, all in the JSON"));
    }
    let own: BTreeSet<&str> = rows
        .iter()
        .filter_map(|row| row.remark.as_deref())
        .collect();
    remarks.extend(
        own.into_iter()
            .map(|remark| format!("remark: {}", lines(remark))),
    );
    let missing = not_checked(rows).into_iter();
    remarks.extend(missing.map(|what| format!("not checked: {}", lines(&what))));
    let count = |status| with_status(rows, status).count();
    remarks.push(format!(
        "{} functions run: {} pass, {} fail, {} not checked",
        rows.len(),
        count(Status::Pass),
        count(Status::Fail),
        count(Status::NotChecked)
    ));
    remarks
}

fn finding(row: &VerifyRow, is_github: bool) -> String {
    let reason = row.reason.as_deref().unwrap_or_default();
    if !is_github {
        return format!("FAIL {}", lines(reason));
    }
    let reason: Vec<String> = reason.lines().map(one_line).collect();
    let (file, reason) = (one_line(&row.file), reason.join("\n"));
    // As GitHub's own tool escapes a property and a message.
    let line = reason.replace('%', "%25").replace('\n', "%0A");
    let file = file
        .replace('%', "%25")
        .replace(':', "%3A")
        .replace(',', "%2C");
    format!("::error file={file},title=fresnel-gen verify::{line}")
}

/// The devices of all rows, each once; none where nothing ran.
pub fn devices(rows: &[VerifyRow]) -> Option<String> {
    let names: BTreeSet<&str> = rows
        .iter()
        .filter_map(|row| row.device.as_deref())
        .collect();
    let names: Vec<&str> = names.into_iter().collect();
    (!names.is_empty()).then(|| names.join("; "))
}
