//! A row of the report: the function that a material gets, and why nothing cheaper.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::candidate::Candidate;
use super::choice::{Choosable, total_cost};
use super::planned::{JudgedCandidate, JudgedMaterial, Judgement};
use super::request::PlanRequest;
use crate::generator::emit::FunctionForm;
use crate::generator::fit::values_for_material_in;
use crate::lab::cost::CostBasis;
use crate::lab::verify::Status;
use crate::physics::num::Precision;

/// The function that a material gets.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlanRow {
    /// The material, as a user types it.
    pub material: String,
    /// What the scene calls it.
    pub names: Vec<String>,
    /// The method.
    pub method: &'static str,
    /// Its form.
    pub form: FunctionForm,
    /// How many channels it gives.
    pub channels: usize,
    /// What it computes in.
    pub precision: Precision,
    /// What a library function is called with after `cos_theta`: three channels each, of a scalar function the green one. Empty where
    /// the material's constants are folded in.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub values: BTreeMap<String, Vec<f64>>,
    /// Its error in the frame where it is worst.
    pub error: f64,
    /// The largest error that was asked for.
    pub budget: f64,
    /// Whether the error is within the budget.
    pub is_within: bool,
    /// What an evaluation costs.
    pub cost: f64,
    /// How the cost is known: `function` (it was compiled), `shape` (the same text with other constants was), `nothing` (it computes
    /// nothing), `operations` (they were counted).
    pub cost_by: CostBasis,
    /// What the exact law costs.
    pub cost_exact: Option<f64>,
    /// Pixels that show the material, in the mean of all frames.
    pub pixels: f64,
    /// Frames that show it.
    pub frames: usize,
    /// The frame where the error is largest, from 0.
    pub worst_frame: usize,
    /// `percentile`, `largest`, or `every_angle` where too few pixels show it.
    pub judged_by: &'static str,
    /// Why it is chosen, in a sentence.
    pub why: String,
    /// All that cost less, with the errors by which they fail; the most accurate first.
    pub cheaper: Vec<CheaperFunction>,
}

/// A function that costs less than the chosen one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheaperFunction {
    /// The method.
    pub method: &'static str,
    /// Its form.
    pub form: FunctionForm,
    /// How many channels it gives.
    pub channels: usize,
    /// What an evaluation costs.
    pub cost: f64,
    /// Its error.
    pub error: f64,
}

/// What all functions of a plan cost together, in units × pixels of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlanTotal {
    /// The plan.
    pub cost: f64,
    /// The exact law of every material.
    pub cost_exact: Option<f64>,
    /// One library function for all.
    pub shared: Option<SharedFunction>,
    /// What another function costs, as so many units × pixels.
    pub price: f64,
}

/// One library function for all materials.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SharedFunction {
    /// Its method.
    pub method: &'static str,
    /// What it costs.
    pub cost: f64,
    /// Its largest error.
    pub error: f64,
}

/// What came of a function's text.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Proof {
    /// The material, as a user types it.
    pub material: String,
    /// The target.
    pub target: &'static str,
    /// The function that was called.
    pub function: String,
    /// The frame, from 0.
    pub frame: usize,
    /// How many cosines it was run at.
    pub points: usize,
    /// The error of the picture, as the plan measures it.
    pub error: Option<f64>,
    /// The same of both pictures in codes of 8 bits; none for screens of high dynamic range.
    pub error_8bit: Option<f64>,
    /// The largest difference of a code of 8 bits.
    pub codes: Option<u8>,
    /// The largest absolute difference from what the function means in f64.
    pub code_abs: Option<f64>,
    /// Whether that is within what the function promises.
    pub is_within_code_bound: Option<bool>,
    /// Whether the picture is within the budget and the numbers within the bound.
    pub status: Status,
    /// Why it was not checked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A plan as a file, read back: what functions it consists of.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PlanFile {
    /// What made it.
    pub tool: String,
    /// The version of its form.
    pub schema: u32,
    /// `plan` and its flags.
    pub command: String,
    /// The space of the functions.
    pub space: String,
    /// The functions.
    pub rows: Vec<PlanFileRow>,
}

/// A function of a plan that is read back.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PlanFileRow {
    /// The material, as a user types it.
    pub material: String,
    /// The method's name.
    pub method: String,
    /// Its form.
    pub form: FunctionForm,
    /// What it computes in.
    pub precision: Precision,
}

/// The library function that everything is compared with: it suits every material.
const SHARED: &str = "fitted";

impl Judgement {
    /// As reports spell it.
    pub fn name(self) -> &'static str {
        match self {
            Judgement::Percentile => "percentile",
            Judgement::Largest => "largest",
            Judgement::EveryAngle => "every_angle",
        }
    }
}

impl JudgedMaterial {
    /// The function that it gets.
    pub fn chosen(&self) -> &JudgedCandidate {
        &self.candidates[self.chosen]
    }

    /// The candidates that cost less than the chosen one, the most accurate first.
    pub fn cheaper(&self) -> Vec<&JudgedCandidate> {
        let most = self.chosen().candidate.cost;
        let all = self.candidates.iter();
        let mut cheaper: Vec<_> = all.filter(|one| one.candidate.cost < most).collect();
        cheaper.sort_by(|a, b| {
            let by_name = || a.candidate.name().cmp(&b.candidate.name());
            a.error.total_cmp(&b.error).then_with(by_name)
        });
        cheaper
    }

    /// Its row, of so many frames in all.
    pub fn row(&self, request: &PlanRequest, frames: usize) -> PlanRow {
        let JudgedCandidate {
            candidate,
            error,
            worst_frame,
        } = self.chosen();
        PlanRow {
            material: self.material.argument.clone(),
            names: self.material.names.clone(),
            method: candidate.method.name,
            form: candidate.form,
            channels: candidate.channels(),
            precision: request.precision,
            values: self.values(request.precision),
            error: *error,
            budget: request.budget,
            is_within: *error <= request.budget,
            cost: candidate.cost,
            cost_by: candidate.basis,
            cost_exact: self.cost_exact,
            pixels: self.pixels as f64 / frames.max(1) as f64,
            frames: self.frames,
            worst_frame: *worst_frame,
            judged_by: self.judgement.name(),
            why: self.why(request),
            cheaper: self
                .cheaper()
                .into_iter()
                .map(CheaperFunction::of)
                .collect(),
        }
    }

    /// What its library function is called with.
    fn values(&self, precision: Precision) -> BTreeMap<String, Vec<f64>> {
        let candidate = &self.chosen().candidate;
        if candidate.is_specialised() {
            return BTreeMap::new();
        }
        let values = values_for_material_in(precision, &self.material.subject, candidate.method);
        let numbers = |value: [f64; 3]| match candidate.channels() {
            1 => vec![value[1]],
            _ => value.to_vec(),
        };
        values
            .into_iter()
            .map(|(name, value)| (name, numbers(value)))
            .collect()
    }

    /// Why the chosen function, in a sentence.
    fn why(&self, request: &PlanRequest) -> String {
        let chosen = self.chosen();
        let (budget, unit) = (request.budget, request.metric.unit());
        let count = self.candidates.len();
        let angles = match (self.judgement, self.pixels) {
            (Judgement::EveryAngle, 0) => {
                " at every angle under white light, since no frame shows the material"
            }
            (Judgement::EveryAngle, _) => " at every angle, since too few pixels show the material",
            _ => "",
        };
        let name = chosen.candidate.name();
        if chosen.error > budget {
            return format!(
                "nothing is within {budget} {unit}{angles}: of {count} functions {name} errs least"
            );
        }
        let Some(next) = self.cheaper().first().copied() else {
            return format!("{name} is within {budget} {unit}{angles}, and nothing costs less");
        };
        let next_name = next.candidate.name();
        if next.error > budget {
            format!(
                "{name} is the cheapest of {count} functions within {budget} {unit}{angles}: of those that cost less {next_name} errs \
                 least, {:.4}",
                next.error
            )
        } else {
            format!(
                "{name} is within {budget} {unit}{angles}, and other materials take it too: {next_name} costs less, and would be \
                 another function"
            )
        }
    }
}

impl CheaperFunction {
    fn of(one: &JudgedCandidate) -> CheaperFunction {
        CheaperFunction {
            method: one.candidate.method.name,
            form: one.candidate.form,
            channels: one.candidate.channels(),
            cost: one.candidate.cost,
            error: one.error,
        }
    }
}

impl PlanTotal {
    /// Of all materials in so many frames.
    pub fn of(judged: &[JudgedMaterial], price: f64, frames: usize) -> PlanTotal {
        let pixels = |material: &JudgedMaterial| material.pixels as f64 / frames.max(1) as f64;
        let exact =
            |material: &JudgedMaterial| Some(material.cost_exact? * pixels(material) + price);
        let chosen: Vec<Choosable> = judged
            .iter()
            .map(|material| {
                let candidate = &material.chosen().candidate;
                Choosable {
                    cost: candidate.cost * pixels(material),
                    error: 0.0,
                    name: String::new(),
                    shared: (!candidate.is_specialised()).then(|| shared_place(judged, candidate)),
                }
            })
            .collect();
        PlanTotal {
            cost: total_cost(chosen.iter(), price),
            cost_exact: judged.iter().map(exact).sum(),
            shared: SharedFunction::of(judged, price, &pixels),
            price,
        }
    }
}

/// The first material that takes a library function: it tells functions apart.
fn shared_place(judged: &[JudgedMaterial], candidate: &Candidate) -> usize {
    let name = candidate.name();
    let takes = |material: &JudgedMaterial| material.chosen().candidate.name() == name;
    judged.iter().position(takes).unwrap_or(0)
}

/// Whether it is the library function that a plan is held against.
pub(super) fn is_shared(candidate: &Candidate) -> bool {
    candidate.method.name == SHARED && candidate.form == FunctionForm::Library
}

impl SharedFunction {
    fn of(
        judged: &[JudgedMaterial],
        price: f64,
        pixels: &dyn Fn(&JudgedMaterial) -> f64,
    ) -> Option<SharedFunction> {
        let mut shared = SharedFunction {
            method: SHARED,
            cost: price,
            error: 0.0,
        };
        for material in judged {
            let mut all = material.candidates.iter();
            let one = all.find(|one| is_shared(&one.candidate))?;
            shared.cost += one.candidate.cost * pixels(material);
            shared.error = shared.error.max(one.error);
        }
        Some(shared)
    }
}
