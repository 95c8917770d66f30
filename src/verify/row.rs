//! The rows of the report: both errors of a function on a target, never added, and who accepts its file.

use serde_json::{Map, Value, json};

use crate::emit::{CodeBound, Emitted, fingerprint};
use crate::fit::{Measured, ModelError};
use crate::num::Precision;
use crate::verify::compilers::Verdict;
use crate::verify::run::{Fault, Way};
use crate::verify::{CodeError, HalfError, Miss, Outcome};

use super::plan::Planned;

/// Stands for a material where a function is run at the worst inputs known.
pub const WORST: &str = "worst cases";

/// What came of running a function in one way.
#[derive(Clone, Debug)]
pub struct Run {
    /// At how many cosines.
    pub points: usize,
    /// What share of all numbers from 0 to 1 they are.
    pub share: f64,
    /// What it may differ by, in ulp; none where nothing is promised.
    pub bound: Option<f64>,
    /// What came of it.
    pub outcome: Outcome,
    /// In half precision: what came of it.
    pub half: Option<HalfRun>,
    /// Against the truth, where there is one.
    pub model_error: Option<ModelError>,
    /// On what.
    pub device: String,
}

/// What came of running a function in half precision.
#[derive(Clone, Copy, Debug)]
pub struct HalfRun {
    /// The device against f64.
    pub error: HalfError,
    /// The device against f16 rounded after every operation.
    pub emulation: HalfError,
    /// What it may differ by from f64: where nothing is promised, twice what its emulation does.
    pub allowed: f64,
}

impl HalfRun {
    /// What the device computes in, by what it gives: no f16 comes so near. Where nothing is rounded nothing is told.
    fn computes_in(&self) -> Option<Precision> {
        const NEARER: f64 = 1e-5;
        let rounds = self.error.max_abs.max(self.emulation.max_abs) > 0.0;
        rounds.then_some(if self.error.max_abs < NEARER {
            Precision::F32
        } else {
            Precision::F16
        })
    }

    fn json(&self) -> Value {
        json!({
            "max_abs": self.emulation.max_abs, "worst_cos": self.emulation.worst_cos,
            "device_computes_in": self.computes_in().map(Precision::name),
        })
    }
}

/// A row while it is made.
pub struct Row<'a> {
    /// The file.
    pub file: &'a Planned,
    /// The function.
    pub emitted: &'a Emitted,
    /// The material, as a user types it.
    pub material: &'a str,
    /// What compilers say of the file.
    pub accepts: &'a [(&'static str, Verdict)],
    /// Each way of running it: its own first.
    pub runs: &'a [(Way, Result<Run, Fault>)],
}

impl Row<'_> {
    /// The row.
    pub fn json(&self) -> Value {
        let (way, own) = &self.runs[0];
        let mut row = self.head();
        let (mut status, mut reasons) = self.judged(*way, own, &mut row);
        for (way, run) in &self.runs[1..] {
            let mut also = json!({ "way": way.name() });
            let (other, why) = self.judged(*way, run, &mut also);
            also["status"] = json!(other);
            also["reason"] = json!(why.first());
            if other == "fail" {
                status = "fail";
                reasons.extend(why);
            }
            if let Some(list) = row["second_opinions"].as_array_mut() {
                list.push(also);
            }
        }
        for (_, verdict) in self.accepts {
            if let Verdict::No(words) = verdict {
                status = "fail";
                reasons.push(words.clone());
            }
        }
        let findings: Vec<&String> = self
            .file
            .pages
            .iter()
            .flat_map(|page| &page.findings)
            .collect();
        if !findings.is_empty() {
            status = "fail";
            reasons.extend(findings.into_iter().cloned());
        }
        row["accepts"] = accepts(self.accepts);
        row["not_asked"] = not_asked(self.accepts);
        row["status"] = json!(status);
        row["reason"] = if reasons.is_empty() {
            Value::Null
        } else {
            json!(reasons.join("\n"))
        };
        row
    }

    /// The keys in their order.
    fn head(&self) -> Value {
        let page = self.file.run_page();
        json!({
            "target": self.file.target.name, "method": self.emitted.method.name, "material": self.material,
            "form": self.emitted.form, "precision": self.emitted.precision.name(), "function": self.emitted.name, "file": page.path,
            "fingerprint": fingerprint(&self.emitted.function),
            "shipped": page.is_shipped, "current": page.is_current, "device": null, "points": null, "share": null, "bound": null,
            "code_error": null, "model_error": null, "accepts": null, "not_asked": {}, "second_opinions": [], "status": null,
            "reason": null, "remark": self.file.pages.iter().find_map(|page| page.remark.as_ref()),
        })
    }

    /// Enters a run, and says what to think of it.
    fn judged(
        &self,
        way: Way,
        run: &Result<Run, Fault>,
        row: &mut Value,
    ) -> (&'static str, Vec<String>) {
        match run {
            Err(Fault::Absent(why)) => ("not_checked", vec![why.clone()]),
            Err(Fault::Failed(why)) => (
                "fail",
                vec![format!(
                    "{}: {}: {why}",
                    self.file.run_page().path,
                    self.emitted.name
                )],
            ),
            Ok(run) if run.half.is_some() => self.judged_in_half(run, row),
            Ok(run) => {
                row["device"] = json!(run.device);
                row["points"] = json!(run.points);
                row["share"] = json!(run.share);
                row["bound"] = json!({ "ulp": run.bound, "text": self.bound_text() });
                row["code_error"] = code_error(&run.outcome.error);
                if let Some(error) = &run.model_error {
                    row["model_error"] = json!(error);
                }
                match &run.outcome.miss {
                    None => ("pass", Vec::new()),
                    Some(miss) => ("fail", vec![self.missed(way, miss)]),
                }
            }
        }
    }

    /// Enters a run in half precision.
    fn judged_in_half(&self, run: &Run, row: &mut Value) -> (&'static str, Vec<String>) {
        let Some(half) = &run.half else {
            return ("not_checked", Vec::new());
        };
        row["device"] = json!(run.device);
        row["points"] = json!(run.points);
        row["share"] = json!(run.share);
        let promised = half.allowed.is_finite().then_some(half.allowed);
        row["bound"] = json!({ "max_abs": promised, "text": self.bound_text() });
        row["code_error"] = json!({
            "max_ulp": null, "reason": "half precision is judged by the absolute error",
            "max_abs": half.error.max_abs, "worst_cos": half.error.worst_cos,
        });
        row["emulation"] = half.json();
        if let Some(error) = &run.model_error {
            row["model_error"] = json!(error);
        }
        if half.error.max_abs <= half.allowed {
            return ("pass", Vec::new());
        }
        let words = format!(
            "{}: {}, {}: at cos_theta = {} it is {} off, and {} is allowed",
            self.file.run_page().path,
            self.emitted.name,
            self.material,
            half.error.worst_cos,
            half.error.max_abs,
            half.allowed
        );
        ("fail", vec![words])
    }

    /// What a function promises, in words.
    fn bound_text(&self) -> String {
        match &self.emitted.code {
            Measured::Yes(CodeBound::Ulp(ulp)) => {
                format!("{ulp} ulp or 2^-22; powers as Vulkan allows exp2 and log2")
            }
            Measured::Yes(CodeBound::Absolute(most)) => {
                format!("{most} absolute, and 2^-11 for what a device is free to do")
            }
            Measured::No(why) => why.clone(),
        }
    }

    /// A miss as people and editors read it.
    fn missed(&self, way: Way, miss: &Miss) -> String {
        let channel = ["red", "green", "blue"][miss.channel];
        let way = if way == Way::Own {
            String::new()
        } else {
            format!(", by {}", way.name())
        };
        let edited = if self.file.run_page().is_current {
            ""
        } else {
            " The file is not what would be written today."
        };
        let expected = if miss.cos_theta.is_nan() {
            "expected any reflectance, since the cosine is NaN".to_owned()
        } else {
            format!("expected {:?}: {:.1} ulp off", miss.expected, miss.ulp)
        };
        format!(
            "{}: {}, {}{way}: at cos_theta = {:?} (0x{:08x}) {channel} is {:?} (0x{:08x}), {expected}.{edited}",
            self.file.run_page().path,
            self.emitted.name,
            self.material,
            miss.cos_theta,
            miss.cos_theta.to_bits(),
            miss.got,
            miss.got.to_bits(),
        )
    }
}

/// A code error as reports have it; what is not finite has no number in JSON.
pub fn code_error(error: &CodeError) -> Value {
    json!({ "max_ulp": error.max_ulp, "max_abs": error.max_abs, "worst_cos": error.worst_cos })
}

fn accepts(verdicts: &[(&'static str, Verdict)]) -> Value {
    let mut all = Map::new();
    for (name, verdict) in verdicts {
        let word = match verdict {
            Verdict::Yes => "yes",
            Verdict::No(_) => "no",
            Verdict::NotChecked(_) => "not checked",
        };
        all.insert((*name).to_owned(), json!(word));
    }
    Value::Object(all)
}

/// Why compilers were not asked.
fn not_asked(verdicts: &[(&'static str, Verdict)]) -> Value {
    let reason = |(name, verdict): &(&'static str, Verdict)| match verdict {
        Verdict::NotChecked(why) => Some(((*name).to_owned(), json!(why))),
        Verdict::Yes | Verdict::No(_) => None,
    };
    Value::Object(verdicts.iter().filter_map(reason).collect())
}

/// The rows of a file whose run came to no end.
pub fn unfinished(file: &Planned, why: &str) -> Vec<Value> {
    let row = |emitted: &Emitted| {
        let mut row = Row {
            file,
            emitted,
            material: "",
            accepts: &[],
            runs: &[],
        }
        .head();
        row["material"] = Value::Null;
        row["status"] = json!("fail");
        row["reason"] = json!(format!("{}: {}: {why}", file.run_page().path, emitted.name));
        row
    };
    file.functions.iter().map(row).collect()
}
