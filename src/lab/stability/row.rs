//! The rows of a scan: a failure of a method each, or that it has none.

use serde::Serialize;

use super::failure::Failure;
use super::scan::Finding;
use crate::lab::verify::as_object;

/// A failure of a method, with what it is about.
#[derive(Clone, Debug, Serialize)]
#[serde(into = "FlatRow")]
pub struct StabilityRow {
    /// The method.
    pub method: &'static str,
    /// The material that it is specialised to, and the channel.
    pub material: Option<(String, &'static str)>,
    /// What the function computes in.
    pub precision: &'static str,
    /// What goes wrong; none where nothing does.
    pub finding: Option<Finding>,
}

/// A row as scripts read it.
#[derive(Serialize)]
struct FlatRow {
    method: &'static str,
    material: Option<String>,
    channel: Option<&'static str>,
    precision: &'static str,
    failure: Option<String>,
    fault_of: Option<&'static str>,
    points: Option<&'static str>,
    region: Option<String>,
    share: Option<f64>,
    worst: Option<Worst>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
}

/// Where it is worst, and what comes there.
#[derive(Serialize)]
struct Worst {
    #[serde(serialize_with = "as_object")]
    at: Vec<(&'static str, f64)>,
    amount: f64,
    got: Option<f64>,
    expected: Option<f64>,
    law: Option<f64>,
}

impl From<StabilityRow> for FlatRow {
    fn from(row: StabilityRow) -> FlatRow {
        let (material, channel) = row.material.unzip();
        let finding = row.finding.as_ref();
        FlatRow {
            method: row.method,
            material,
            channel,
            precision: row.precision,
            failure: finding.map(|finding| finding.failure.words()),
            fault_of: finding.map(|finding| fault_of(finding.failure)),
            points: finding.map(kind_of_points),
            region: finding.map(|finding| finding.region.clone()),
            share: finding.map(|finding| finding.share),
            worst: finding.map(worst),
            reason: finding.is_none().then_some("nothing was found"),
        }
    }
}

fn worst(finding: &Finding) -> Worst {
    Worst {
        at: finding.worst.clone(),
        amount: finding.amount,
        got: finding.point.map(|point| point.got),
        expected: finding.point.map(|point| point.want),
        law: finding.point.and_then(|point| point.law),
    }
}

/// Whose fault it is.
fn fault_of(failure: Failure) -> &'static str {
    if failure.is_of_the_model() {
        "formula"
    } else {
        "rounding"
    }
}

fn kind_of_points(finding: &Finding) -> &'static str {
    if finding.is_media {
        "media"
    } else {
        "arguments"
    }
}
