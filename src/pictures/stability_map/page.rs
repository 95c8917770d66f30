//! The HTML page with all stability maps, and a sentence for each failure: how much of a region fails, where it is worst, and the
//! result there. Self-contained, for any browser.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde::Serialize;
use tera::Context;

use crate::lab::stability::{Failure, Finding, StabilityRow, short};
use crate::language::methods::Method;
use crate::pictures::html;

static TEMPLATE: &str = include_str!("../../../templates/stability.html.tera");

/// A method on the page.
#[derive(Serialize)]
struct MethodSection {
    method: &'static str,
    summary: &'static str,
    /// What goes wrong and where, a sentence for each failure.
    formula: Vec<String>,
    rounding: Vec<String>,
    arguments: Vec<String>,
    pictures: Vec<Picture>,
}

/// A picture with its caption.
#[derive(Serialize)]
struct Picture {
    about: String,
    data: String,
}

/// The page of these rows and pictures (method, second axis, PNG), or why it cannot be made.
///
/// # Errors
/// The page's template cannot be filled.
pub fn stability_page(
    rows: &[StabilityRow],
    pictures: &[(&'static str, &'static str, Vec<u8>)],
    command: &str,
) -> Result<String, String> {
    let mut methods: Vec<&'static Method> = rows.iter().map(|row| row.method).collect();
    methods.dedup_by_key(|method| method.name);
    let sections = methods.into_iter();
    let sections: Vec<MethodSection> = sections
        .map(|method| section(method, rows, pictures))
        .collect();
    let mut context = Context::new();
    context.insert("sections", &sections);
    context.insert("command", command);
    context.insert(
        "precision",
        rows.first().map_or("f32", |row| row.precision.name()),
    );
    html::fill(TEMPLATE, &context)
}

fn section(
    method: &'static Method,
    rows: &[StabilityRow],
    pictures: &[(&'static str, &'static str, Vec<u8>)],
) -> MethodSection {
    let own = rows.iter().filter(|row| row.method.name == method.name);
    let findings: Vec<&Finding> = own.filter_map(|row| row.finding.as_ref()).collect();
    let sentences = |wanted: fn(&Finding) -> bool| -> Vec<String> {
        let findings = findings.iter().filter(|finding| wanted(finding));
        findings.map(|finding| sentence(finding)).collect()
    };
    let own = pictures.iter().filter(|(of, _, _)| *of == method.name);
    let picture = |(_, over, png): &(&str, &str, Vec<u8>)| Picture {
        about: format!("Errors of {} over angle and {over}", method.name),
        data: BASE64_STANDARD.encode(png),
    };
    MethodSection {
        method: method.name,
        summary: method.summary,
        formula: sentences(|finding| finding.is_media && finding.failure.is_of_the_model()),
        rounding: sentences(|finding| finding.is_media && !finding.failure.is_of_the_model()),
        arguments: sentences(|finding| !finding.is_media),
        pictures: own.map(picture).collect(),
    }
}

/// A finding as a sentence.
fn sentence(finding: &Finding) -> String {
    let share = match finding.share {
        1.0.. => String::new(),
        share => format!(" ({} of it)", percent(share)),
    };
    format!(
        "{}: {}{share}; worst at {}",
        finding.region,
        finding.failure.words(),
        worst(finding)
    )
}

/// The share of a region that fails.
pub fn percent(share: f64) -> String {
    match share {
        1.0.. => "all".to_owned(),
        share => format!("{} %", (100.0 * share).round().clamp(1.0, 99.0)),
    }
}

/// Where it is worst, and the result there.
pub fn worst(finding: &Finding) -> String {
    let at = finding.worst.iter();
    let at: Vec<String> = at
        .map(|(name, x)| format!("{name} {}", short(*x)))
        .collect();
    let at = at.join(", ");
    let what = match (finding.failure, finding.point) {
        (Failure::Digits(_), _) => format!("{} ulp", rounded(finding.amount)),
        (Failure::Error(_), Some(shown)) => {
            let law = shown.law.map_or_else(String::new, number);
            format!("{}, the law {law}", number(shown.want))
        }
        (Failure::Monotony | Failure::Minimum, _) => format!("by {:.3}", finding.amount),
        (_, Some(shown)) => number(shown.got),
        (_, None) => String::new(),
    };
    if at.is_empty() {
        what
    } else {
        format!("{at}: {what}")
    }
}

/// A reflectance with four digits.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 || size >= 1e4 && size.is_finite() => format!("{x:.1e}"),
        size if size.is_finite() => format!("{x:.4}"),
        _ => x.to_string(),
    }
}

/// A number with two digits.
fn rounded(x: f64) -> String {
    if x >= 1e4 {
        format!("{x:.1e}")
    } else {
        format!("{x:.0}")
    }
}
