//! What functions cost on GPUs, as rows: for people, for scripts, as a document and as a page.

mod markdown;
#[cfg(feature = "cli")]
mod page;
mod text;

use serde_json::{Value, json};

use crate::cost::{Family, Figures};

pub use markdown::markdown;
#[cfg(feature = "cli")]
pub use page::page;
pub use text::text;

/// A function on a family.
#[derive(Clone, Debug)]
pub struct Row {
    /// The method.
    pub method: &'static str,
    /// The material that it is specialised to.
    pub material: Option<String>,
    /// `library`, `scalar` or `specialised`.
    pub form: &'static str,
    /// How many channels it gives.
    pub channels: usize,
    /// What it computes in.
    pub precision: &'static str,
    /// Texture fetches.
    pub fetches: usize,
    /// The family.
    pub family: &'static Family,
    /// The compiler with its version, where one spoke.
    pub compiler: Option<String>,
    /// Who says it.
    pub source: Source,
    /// What is known, or why nothing is.
    pub figures: Result<Figures, String>,
    /// The cost over that of the reference.
    pub share: Option<f64>,
    /// The shader by its hash.
    pub shader: Option<String>,
}

/// Who says what a function costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The compiler, now.
    Compiler,
    /// The compiler, when it was recorded.
    Record,
    /// The graph.
    Graph,
    /// Nobody.
    Nobody,
}

impl Source {
    fn name(self) -> Option<&'static str> {
        match self {
            Source::Compiler => Some("compiler"),
            Source::Record => Some("record"),
            Source::Graph => Some("graph"),
            Source::Nobody => None,
        }
    }
}

impl Row {
    /// The row in a report's JSON.
    pub fn json(&self) -> Value {
        let figures = self.figures.as_ref().ok();
        let shader = figures.map(|figures| figures.shader);
        let net = figures.map(|figures| figures.net);
        let constants = if self.material.is_some() {
            "folded"
        } else {
            "uniform"
        };
        let mut row = json!({
            "method": self.method, "material": self.material, "form": self.form, "channels": self.channels,
            "precision": self.precision, "constants": constants, "gpu": self.family.name,
            "vendor": self.family.vendor, "compiler": self.compiler, "measure": self.family.columns.measure,
            "instructions": shader.map(|of| of.instructions), "latency": shader.and_then(|of| of.latency),
            "inverse_throughput": shader.and_then(|of| of.inverse_throughput),
            "registers": figures.and_then(|of| of.registers), "fetches": self.fetches,
            "net_instructions": net.map(|of| of.instructions), "net_latency": net.and_then(|of| of.latency),
            "net_inverse_throughput": net.and_then(|of| of.inverse_throughput),
            "share": self.share, "shader": self.shader, "from": self.source.name(),
        });
        match &self.figures {
            Err(why) => row["reason"] = json!(why),
            Ok(_) => {
                let told = ["latency", "inverse_throughput", "registers"];
                let untold: Vec<&str> = told.into_iter().filter(|key| row[key].is_null()).collect();
                if !untold.is_empty() {
                    row["reason"] = json!(format!("not told here: {}", untold.join(", ")));
                }
            }
        }
        row
    }

    /// Which function it is, in a record: method, material, form, channels, precision.
    pub fn key(&self) -> String {
        let material = self.material.as_deref().unwrap_or("");
        let (method, form) = (self.method, self.form);
        format!(
            "{method},{material},{form},{},{}",
            self.channels, self.precision
        )
    }

    /// The function for people: `schlick`, `schlick, one channel`, `gold: schlick, f16`.
    pub fn label(&self) -> String {
        let of = self.material.as_ref().map(|name| format!("{name}: "));
        let channel = if self.channels == 1 {
            ", one channel"
        } else {
            ""
        };
        let half = if self.precision == "f16" { ", f16" } else { "" };
        format!("{}{}{channel}{half}", of.unwrap_or_default(), self.method)
    }
}

/// A figure as short as it can be told.
fn short(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| {
        let rounded = (100.0 * value).round() / 100.0;
        format!("{rounded}")
    })
}

/// The share, with a mark for each fetch.
fn percent(row: &Row) -> String {
    let fetches = "+".repeat(row.fetches);
    row.share.map_or_else(
        || "?".to_owned(),
        |share| format!("{:.0}{fetches}", 100.0 * share),
    )
}
