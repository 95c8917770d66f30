//! What section 5.3.2 says of Table 6, tested by Table 6 itself. Our own times are another matter.

use crate::lab::reproduce::comparison::{ComparisonRow, ComparisonVerdict};
use crate::lab::reproduce::thesis;

use super::statement;

const TIMES: &str = "table6_relative_time_percent";

/// The claims about speed.
pub fn speed_claims() -> Vec<ComparisonRow> {
    vec![schlick(), table(), conductor()]
}

/// One method's times on all devices, over another's.
fn ratios(method: &str, other: &str) -> Vec<f64> {
    let columns = thesis::names(&[TIMES, "columns"]);
    let place = |name: &str| columns.iter().position(|column| *column == name);
    let devices = thesis::devices(TIMES).into_iter();
    let rows = devices.map(|device| thesis::numbers(&[TIMES, device]));
    rows.filter_map(|row| Some(row[place(method)?] / row[place(other)?]))
        .collect()
}

fn schlick() -> ComparisonRow {
    let mut gains = ratios("dielectric_exact", "schlick_dielectric");
    gains.extend(ratios("conductor_exact", "schlick_conductor"));
    let twice = gains.iter().filter(|gain| **gain >= 2.0).count();
    let ours = format!(
        "by Table 6 in {twice} of {} cases, on five devices for dielectrics and for metals; the least gain is {:.2} times",
        gains.len(),
        least(&gains)
    );
    let claim = "Schlick is at least twice as fast as the exact law it stands for, in all cases";
    let verdict = if twice == gains.len() {
        ComparisonVerdict::Holds
    } else {
        ComparisonVerdict::InPart
    };
    statement("Schlick's speed", "section 5.3.2", claim, ours).verdict(verdict)
}

fn table() -> ComparisonRow {
    let gains = ratios("dielectric_exact", "table");
    let (low, high) = (least(&gains), most(&gains));
    let ours = format!("by Table 6 {low:.1} to {high:.1} times");
    let claim = "the table lookup is 2 to 4 times as fast as the exact law for dielectrics";
    statement("the table's speed", "section 5.3.2", claim, ours)
        .verdict(ComparisonVerdict::of_claim(low >= 2.0 && high < 4.0))
}

fn conductor() -> ComparisonRow {
    let costs = ratios("conductor_exact", "dielectric_exact");
    let others: Vec<f64> = costs.iter().copied().filter(|cost| *cost < 2.0).collect();
    let ours = format!(
        "by Table 6 {:.0} to {:.0} % slower on four devices, {:.0} % on the Mali 400",
        100.0 * (least(&others) - 1.0),
        100.0 * (most(&others) - 1.0),
        100.0 * (most(&costs) - 1.0)
    );
    // "50 %" to the tens and one ten about it.
    let near = others
        .iter()
        .filter(|cost| (1.4..=1.6).contains(*cost))
        .count();
    let verdict = match near {
        0 => ComparisonVerdict::Fails,
        near if near == others.len() => ComparisonVerdict::Holds,
        _ => ComparisonVerdict::InPart,
    };
    let claim = "the exact law for metals is only 50 % slower than that for dielectrics, except on the Mali 400";
    statement("the conductor's speed", "section 5.3.2", claim, ours).verdict(verdict)
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}
