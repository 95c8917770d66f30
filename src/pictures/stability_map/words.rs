//! A finding in words: how much of a region fails, where it is worst, and what comes there.

use crate::lab::stability::{Failure, Finding, short};

/// The share of a region that fails.
pub fn percent(share: f64) -> String {
    let percent = (100.0 * share).round();
    if share >= 1.0 {
        "all".to_owned()
    } else {
        format!("{} %", percent.clamp(1.0, 99.0))
    }
}

/// Where it is worst, and what comes there.
pub fn worst(finding: &Finding) -> String {
    let at = finding
        .worst
        .iter()
        .map(|(name, value)| format!("{name} {}", short(*value)));
    let at = at.collect::<Vec<_>>().join(", ");
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

/// A reflectance in four digits.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 || size >= 1e4 && size.is_finite() => format!("{x:.1e}"),
        size if size.is_finite() => format!("{x:.4}"),
        _ => x.to_string(),
    }
}

/// Two digits.
fn rounded(x: f64) -> String {
    if x >= 1e4 {
        format!("{x:.1e}")
    } else {
        format!("{x:.0}")
    }
}
