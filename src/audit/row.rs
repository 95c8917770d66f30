//! The row of the report, and what people read of it.

use serde_json::{Map, Value, json};

use crate::cost::CostAndError;
use crate::fit::{ModelError, Perceived};
use crate::reference::Subject;
use crate::verify::compilers::Verdict;

use super::Audit;
use super::bind::Bound;
use super::comparison::{Competitor, dominating, sentence};
use super::cost::Cost;
use super::edges::Edges;
use super::ours::Ours;
use super::runner::Trouble;

/// What came of running a function.
#[derive(Debug)]
pub struct Ran {
    /// On what.
    pub device: String,
    /// At how many cosines.
    pub points: usize,
    /// The ends of the domain.
    pub edges: Edges,
    /// Against the truth.
    pub error: ModelError,
    /// The same, as it is seen.
    pub seen: Perceived,
}

/// A row while it is made.
pub struct Row<'a> {
    /// What was asked.
    pub audit: &'a Audit,
    /// The function with its arguments.
    pub bound: &'a Bound,
    /// The material.
    pub subject: &'a Subject,
    /// What compilers say.
    pub verdicts: &'a [(String, Verdict)],
    /// What came of running it.
    pub ran: &'a Result<Ran, Trouble>,
    /// What it costs.
    pub costs: &'a [Cost],
    /// Our methods.
    pub ours: &'a [Ours],
}

impl Row<'_> {
    /// The row.
    pub fn json(&self) -> Value {
        let function = &self.bound.function.name;
        let ran = self.ran.as_ref().ok();
        let (status, reasons) = self.judged();
        let dominated: Vec<Value> = self
            .costs
            .iter()
            .enumerate()
            .flat_map(|(i, cost)| self.dominated(i, cost))
            .collect();
        json!({
            "target": self.audit.language.target(), "method": function, "material": self.subject.argument,
            "form": "user", "precision": "f32", "function": function, "file": file_name(&self.audit.file),
            "arguments": self.arguments(), "filled": self.bound.filled(), "device": ran.map(|ran| &ran.device), "points": ran.map(|ran| ran.points),
            "code_error": null, "code_error_reason": "there is no formula to hold it against but its own text",
            "model_error": ran.map(|ran| ran.error), "perceived": ran.map(seen), "accepts": self.accepts(),
            "edges": ran.map(|ran| &ran.edges.rows), "beyond": ran.map(|ran| &ran.edges.remarks),
            "cost": self.costs.iter().map(costed).collect::<Vec<Value>>(),
            "dominated_by": dominated, "says": self.sentences(), "status": status,
            "reason": (!reasons.is_empty()).then(|| reasons.join("\n")),
        })
    }

    fn arguments(&self) -> Value {
        let value = |argument: &super::bind::Argument| {
            let from = if argument.is_filled {
                "material"
            } else {
                "--arg"
            };
            (
                argument.name.clone(),
                json!({ "value": argument.value, "from": from }),
            )
        };
        Value::Object(self.bound.arguments.iter().map(value).collect())
    }

    /// What to think of it, and why.
    fn judged(&self) -> (&'static str, Vec<String>) {
        let place = format!("{}: {}", self.audit.file, self.bound.function.name);
        let mut reasons: Vec<String> = Vec::new();
        for (name, verdict) in self.verdicts {
            if let Verdict::No(words) = verdict {
                reasons.push(format!("{words} ({name})"));
            }
        }
        match self.ran {
            Ok(ran) => {
                let findings = ran.edges.findings.iter();
                reasons.extend(findings.map(|finding| format!("{place}: {finding}")));
                if ran.error.undefined > 0 {
                    let count = ran.error.undefined;
                    reasons.push(format!(
                        "{place}: it gives no number at {count} cosines, which no error counts"
                    ));
                }
            }
            Err(Trouble::Failed(why)) => reasons.push(format!("{place}: {why}")),
            Err(Trouble::Refused(..)) => {}
            Err(Trouble::Absent(why)) if reasons.is_empty() => {
                return ("not_checked", vec![why.clone()]);
            }
            Err(Trouble::Absent(_)) => {}
        }
        (if reasons.is_empty() { "pass" } else { "fail" }, reasons)
    }

    fn accepts(&self) -> Value {
        let word = |verdict: &Verdict| match verdict {
            Verdict::Yes => "yes",
            Verdict::No(_) => "no",
            Verdict::NotChecked(_) => "not checked",
        };
        let each = self.verdicts.iter();
        let each = each.map(|(name, verdict)| ((*name).to_owned(), json!(word(verdict))));
        Value::Object(each.collect::<Map<String, Value>>())
    }

    fn competitors(&self, place: usize) -> Vec<Competitor> {
        let each = self.ours.iter();
        each.filter_map(|ours| ours.competitor(place)).collect()
    }

    /// The cost on the family of this place and the error, where both are known.
    fn point(&self, cost: &Cost) -> Option<CostAndError> {
        Some(CostAndError {
            error: self.ran.as_ref().ok()?.error.max_abs,
            cost: cost.figures.as_ref().ok()?.cost(),
        })
    }

    fn dominated(&self, place: usize, cost: &Cost) -> Vec<Value> {
        let Some(own) = self.point(cost) else {
            return Vec::new();
        };
        let all = dominating(&own, &self.competitors(place)).into_iter();
        all.map(|other| {
            json!({
                "method": other.method, "form": other.form, "error_times": other.times.error,
                "cost_times": other.times.cost, "gpu": cost.family.name,
            })
        })
        .collect()
    }

    /// The sentence that matters, for each GPU.
    fn sentences(&self) -> Value {
        let each = self.costs.iter().enumerate().filter_map(|(place, cost)| {
            let own = self.point(cost)?;
            let others = self.competitors(place);
            let known = (!others.is_empty()).then(|| sentence(&own, &others));
            Some((cost.family.name.to_owned(), json!(known)))
        });
        Value::Object(each.collect())
    }
}

/// A file without the folders of this machine.
pub fn file_name(file: &str) -> &str {
    file.rsplit(['/', '\\']).next().unwrap_or(file)
}

fn seen(ran: &Ran) -> Value {
    json!({ "luminance": ran.seen.luminance, "de2000": ran.seen.de2000 })
}

fn costed(cost: &Cost) -> Value {
    let figures = cost.figures.as_ref().ok();
    json!({
        "gpu": cost.family.name, "compiler": cost.compiler, "measure": cost.family.columns.measure,
        "instructions": figures.map(|figures| figures.shader.instructions),
        "latency": figures.and_then(|figures| figures.shader.latency),
        "inverse_throughput": figures.and_then(|figures| figures.shader.inverse_throughput),
        "net_instructions": figures.map(|figures| figures.net.instructions),
        "net_inverse_throughput": figures.and_then(|figures| figures.net.inverse_throughput),
        "net": figures.map(crate::cost::Figures::cost),
        "reason": cost.figures.as_ref().err(),
    })
}

fn word<'a>(row: &'a Value, key: &str) -> &'a str {
    row[key].as_str().unwrap_or_default()
}

/// A row for people.
pub fn text(row: &Value) -> String {
    let mut text = format!(
        "{} in {}, {}\n",
        word(row, "function"),
        word(row, "file"),
        word(row, "material")
    );
    for (head, line) in lines(row) {
        text += &format!("  {head:<12} {line}\n");
    }
    text
}

fn lines(row: &Value) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    let filled: Vec<&str> = list(row, "filled")
        .iter()
        .filter_map(Value::as_str)
        .collect();
    if !filled.is_empty() {
        lines.push((
            "filled in",
            format!("{}, as the material has it", filled.join("; ")),
        ));
    }
    let accepts = row["accepts"].as_object().into_iter().flatten();
    let accepts: Vec<String> = accepts
        .map(|(name, verdict)| format!("{name}: {}", verdict.as_str().unwrap_or_default()))
        .collect();
    lines.push(("accepted", accepts.join("; ")));
    if let Some(device) = row["device"].as_str() {
        lines.push(("run on", format!("{device}, at {} cosines", row["points"])));
        lines.push(("edges", edges(row)));
        lines.push(("model error", model_error(&row["model_error"])));
    }
    let costs = list(row, "cost").iter();
    lines.extend(costs.map(|cost| ("cost", costs_line(row, cost))));
    lines.push(("status", word(row, "status").replace('_', " ")));
    lines
}

fn list<'a>(row: &'a Value, key: &str) -> &'a [Value] {
    row[key].as_array().map_or(&[], Vec::as_slice)
}

fn edges(row: &Value) -> String {
    let edges = list(row, "edges");
    let wrong = |edge: &&Value| edge["counts"] == true && edge["fault"].is_string();
    let wrong = edges.iter().filter(wrong).count();
    let beyond: Vec<&str> = list(row, "beyond")
        .iter()
        .filter_map(Value::as_str)
        .collect();
    let beyond = match beyond.is_empty() {
        true => String::new(),
        false => format!("; beyond them, {}", beyond.join(", ")),
    };
    match wrong {
        0 => format!("a reflectance at all of them{beyond}"),
        _ => format!(
            "{wrong} of {} results are no reflectance{beyond}",
            edges.iter().filter(|edge| edge["counts"] == true).count()
        ),
    }
}

fn model_error(error: &Value) -> String {
    let number = |key: &str| error[key].as_f64();
    let cos_theta = number("worst_cos").unwrap_or(0.0);
    let mean = number("mean_rel").map_or("no mean".to_owned(), |mean| {
        format!("{:.3} % in the mean", 100.0 * mean)
    });
    format!(
        "{:.6} at most, at {:.1} degrees; {:.6} in the mean; relative {mean}",
        number("max_abs").unwrap_or(f64::NAN),
        libm::acos(cos_theta).to_degrees(),
        number("mean_abs").unwrap_or(f64::NAN),
    )
}

fn costs_line(row: &Value, cost: &Value) -> String {
    let gpu = word(cost, "gpu");
    match cost["net"].as_f64() {
        None => format!("{gpu}: not checked: {}", word(cost, "reason")),
        Some(net) => {
            let says = row["says"][gpu]
                .as_str()
                .unwrap_or("ours are not known there");
            format!("{gpu}: {net} ({}): {says}", word(cost, "measure"))
        }
    }
}
