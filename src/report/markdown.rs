//! The tables of the README, written from the registries so that they cannot drift.

use crate::fit::{Derivation, Truth, model_error, values};
use crate::materials::{Channels, Material, THESIS_NM};
use crate::methods::{self, Class, Contract, Method};
use crate::targets;

/// Every method: what it takes, its cost in scalar operations for three channels, what it promises.
pub fn methods_table() -> String {
    let rows = methods::ALL.iter().map(|method| {
        let inputs: Vec<&str> = method.inputs.iter().map(|input| input.name).collect();
        let work = method.function(false).map_or(0, |function| function.work());
        let exempt = if method.contract == Contract::Kept {
            ""
        } else {
            " (exempt)"
        };
        vec![
            format!("`{}`{exempt}", method.name),
            method.summary.to_owned(),
            inputs.join(", "),
            work.to_string(),
            ulp_cell(method.claims.code_ulp),
            format!("{} {}", method.source.authors, method.source.year),
        ]
    });
    table(
        &[
            "method",
            "what it is",
            "takes",
            "operations",
            "code error, ulp",
            "source",
        ],
        rows,
    )
}

/// Model error of every method on these materials: largest absolute, and mean relative in per cent.
pub fn errors_table(materials: &[Material]) -> String {
    let mut head = vec!["method".to_owned()];
    head.extend(materials.iter().map(|material| material.name.clone()));
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let rows = methods::ALL
        .iter()
        .filter(|method| method.contract == Contract::Kept)
        .map(|method| {
            let errors = materials
                .iter()
                .map(|material| error_cell(method, material));
            [format!("`{}`", method.name)]
                .into_iter()
                .chain(errors)
                .collect()
        });
    table(&head, rows)
}

/// Every target.
pub fn targets_table() -> String {
    let rows = targets::ALL.iter().map(|target| {
        let validators: Vec<&str> = target
            .validators
            .iter()
            .map(|validator| validator.name)
            .collect();
        let by_default = if target.by_default { "yes" } else { "by name" };
        vec![
            format!("`{}`", target.name),
            target.summary.to_owned(),
            by_default.to_owned(),
            validators.join(", "),
        ]
    });
    table(
        &[
            "target",
            "what it is",
            "written by default",
            "compilers that can judge it",
        ],
        rows,
    )
}

/// A bound in ulp, or that the method stays within the absolute one.
fn ulp_cell(ulp: f64) -> String {
    if ulp > 0.0 {
        ulp.to_string()
    } else {
        "within 2⁻²²".to_owned()
    }
}

fn error_cell(method: &'static Method, material: &Material) -> String {
    let Ok(channels) = material.channels(THESIS_NM) else {
        return "outside its measured range".to_owned();
    };
    if method.class == Class::Dielectric && !channels.is_transparent() {
        return "dielectrics only".to_owned();
    }
    match specialised_error(method, &channels) {
        Some((max_abs, _)) if max_abs < 1e-9 => "exact".to_owned(),
        Some((max_abs, Some(mean_rel))) => format!("{max_abs:.4} ({:.2} %)", 100.0 * mean_rel),
        Some((max_abs, None)) => format!("{max_abs:.4}"),
        None => "not measured".to_owned(),
    }
}

fn specialised_error(method: &Method, channels: &Channels) -> Option<(f64, Option<f64>)> {
    let function = method
        .specialise(&values(method, channels, &Derivation::default()))
        .ok()?;
    let error = model_error(&function, &Truth::of(method, channels));
    Some((error.max_abs, error.mean_rel))
}

fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let head: Vec<String> = head.iter().map(|cell| (*cell).to_owned()).collect();
    let rule: Vec<String> = head.iter().map(|_| "---".to_owned()).collect();
    [line(&head), line(&rule)]
        .into_iter()
        .chain(rows.map(|row| line(&row)))
        .collect()
}
