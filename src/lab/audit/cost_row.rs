//! What a user's function costs on a family of GPUs, as the report has it.

use serde::Serialize;

use crate::lab::cost::{CostFigures, Family};

/// What a function costs on a family of GPUs, or why that is not known.
#[derive(Clone, Debug, Serialize)]
#[serde(into = "AuditCostJson")]
pub struct AuditCost {
    /// The family.
    pub family: &'static Family,
    /// The compiler with its version, where one was asked.
    pub compiler: Option<String>,
    /// What is known, or why nothing is.
    pub figures: Result<CostFigures, String>,
}

/// The cost in a report's JSON.
#[derive(Serialize)]
struct AuditCostJson {
    gpu: &'static str,
    compiler: Option<String>,
    measure: &'static str,
    instructions: Option<f64>,
    latency: Option<f64>,
    inverse_throughput: Option<f64>,
    net_instructions: Option<f64>,
    net_inverse_throughput: Option<f64>,
    net: Option<f64>,
    reason: Option<String>,
}

impl From<AuditCost> for AuditCostJson {
    fn from(cost: AuditCost) -> AuditCostJson {
        let figures = cost.figures.as_ref().ok();
        AuditCostJson {
            gpu: cost.family.name,
            compiler: cost.compiler,
            measure: cost.family.columns.measure,
            instructions: figures.map(|figures| figures.shader.instructions),
            latency: figures.and_then(|figures| figures.shader.latency),
            inverse_throughput: figures.and_then(|figures| figures.shader.inverse_throughput),
            net_instructions: figures.map(|figures| figures.net.instructions),
            net_inverse_throughput: figures.and_then(|figures| figures.net.inverse_throughput),
            net: figures.map(CostFigures::cost),
            reason: cost.figures.err(),
        }
    }
}
