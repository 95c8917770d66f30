//! The report of a plan: text for people, and JSON that `--plan` reads back. A row has the function that a material gets, and why
//! nothing cheaper will do.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::candidate::SHARED;
use super::choice::{Choosable, total_cost};
use super::gltf::Unplanned;
use super::planned::{JudgedMaterial, Judgement};
use super::proof::Proof;
use super::request::PlanRequest;
use crate::generator::emit::FunctionForm;
use crate::generator::envelope::Origin;
use crate::generator::fit::values_for_material_in;
use crate::lab::cost::CostBasis;
use crate::lab::verify::Status;
use crate::physics::foreign::{self, Foreign, one_line};
use crate::physics::num::Precision;
use crate::pictures::table::{short_number, text_table};

/// A plan as JSON.
#[derive(Debug, Serialize)]
pub struct PlanReport {
    #[serde(flatten)]
    pub(super) origin: Origin,
    device: Option<String>,
    /// The GPU family whose costs decide.
    pub(super) gpu: &'static str,
    /// What a cost counts.
    pub(super) cost_of: &'static str,
    /// The metric of errors.
    metric: &'static str,
    /// The metric's unit in words.
    #[serde(skip)]
    pub(super) unit: &'static str,
    /// The reference that functions are compared with.
    reference: &'static str,
    /// The colour space of the pictures and of the functions.
    space: &'static str,
    /// How many frames the scene has.
    frames: usize,
    total: PlanTotal,
    /// Materials that are not planned, with the reasons.
    pub(super) unplanned: Vec<Unplanned>,
    /// What the scene states and this program does not read.
    pub(super) remarks: Vec<String>,
    /// The results of running the functions' text, where it was run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    proofs: Vec<Proof>,
    pub(super) rows: Vec<PlanRow>,
}

impl PlanReport {
    /// The report that this command writes. `proofs` are the results of running the functions' text, where it was run, and the
    /// name of the device.
    pub fn new(
        command: String,
        request: &PlanRequest,
        judged: &[JudgedMaterial],
        frames: usize,
        (unplanned, remarks): (Vec<Unplanned>, Vec<String>),
        (device, proofs): (Option<String>, Vec<Proof>),
    ) -> PlanReport {
        PlanReport {
            origin: Origin::new(command),
            device,
            gpu: request.family.name,
            cost_of: request.family.columns.measure,
            metric: request.metric.name(),
            unit: request.metric.unit(),
            reference: request.truth.name(),
            space: request.space.name(),
            frames,
            total: PlanTotal::of(judged, request.price, frames),
            unplanned,
            remarks,
            proofs,
            rows: judged.iter().map(|one| one.row(request, frames)).collect(),
        }
    }

    /// The exit code: 1 where a material has nothing within the budget or a proof fails, 3 where a proof could not be made.
    pub fn exit_code(&self) -> u8 {
        let has = |status| self.proofs.iter().any(|proof| proof.status == status);
        let is_beyond = self.rows.iter().any(|row| !row.is_within);
        if has(Status::NotChecked) && !has(Status::Fail) {
            3
        } else {
            u8::from(is_beyond || has(Status::Fail))
        }
    }

    /// The report as text: the functions, the reason for each, and what they cost together.
    pub fn text(&self) -> String {
        let columns = [
            "material",
            "method",
            "form",
            "channels",
            "error",
            "cost",
            "exact",
            "pixels",
            "judged by",
        ];
        let cells: Vec<Vec<String>> = self.rows.iter().map(cells).collect();
        let mut lines = vec![text_table(&columns, &cells)];
        for row in &self.rows {
            lines.push(one_line(&format!("{}: {}", named(row), row.why)) + "\n");
        }
        if self.rows.iter().any(|row| !row.is_within) {
            lines.push("! means over the budget.\n".to_owned());
        }
        for one in &self.unplanned {
            let (name, reason) = (Foreign(&one.name), one_line(&one.reason));
            lines.push(format!("{name}: not planned: {reason}\n"));
        }
        lines.extend(self.remarks.iter().map(|remark| format!("{remark}.\n")));
        lines.push(self.total());
        lines.extend(self.proofs.iter().map(proof_line));
        lines.push(format!(
            "Costs are {} on {}, of one evaluation. Light is taken as it comes: an error changes what a surface shows, and not what it sends to others.\n",
            self.cost_of, self.gpu
        ));
        let (cells, rest) = lines.split_at(1);
        format!("{}\n{}", cells.concat(), rest.concat())
    }

    pub(super) fn total(&self) -> String {
        let PlanTotal {
            cost,
            cost_exact,
            shared,
            ..
        } = &self.total;
        let beside = |other: f64| {
            let times = short_number(other / cost);
            match *cost > 0.0 {
                true if times == "1" => format!("{}, as much", short_number(other)),
                true => format!("{} ({times} times as much)", short_number(other)),
                false => short_number(other),
            }
        };
        let mut parts = vec![format!(
            "All together {} units × pixels of a frame",
            short_number(*cost)
        )];
        parts.extend(cost_exact.map(|exact| format!("the exact laws {}", beside(exact))));
        parts.extend(shared.as_ref().map(|shared| {
            let is_beyond = self.rows.iter().any(|row| shared.error > row.budget);
            format!(
                "one library function `{}` for all {}, with an error of {}{}",
                shared.method,
                beside(shared.cost),
                short_number(shared.error),
                if is_beyond {
                    ", which is over the budget"
                } else {
                    ""
                }
            )
        }));
        parts.join("; ") + ".\n"
    }
}

/// A material, and what the scene calls it where that is something else.
pub(super) fn named(row: &PlanRow) -> String {
    let others = row.names.iter().filter(|name| **name != row.material);
    let others: Vec<&str> = others.map(String::as_str).collect();
    if others.is_empty() {
        row.material.clone()
    } else {
        format!("{} ({})", row.material, others.join(", "))
    }
}

/// What the exact law costs, in words.
pub(super) fn cost_exact(row: &PlanRow) -> String {
    let cost = row.cost_exact.map(short_number);
    cost.unwrap_or_else(|| "not known".to_owned())
}

/// The line on the result of a function's text.
fn proof_line(proof: &Proof) -> String {
    let Proof {
        material,
        target,
        function,
        ..
    } = proof;
    let head = format!("{}: {function} in {target}", Foreign(material));
    let (Some(error), Some(codes), Some(code_abs)) = (proof.error, proof.codes, proof.code_abs)
    else {
        let why = proof.reason.as_deref().unwrap_or_default();
        return format!(
            "{head}: {}: {}\n",
            proof.status.words(),
            foreign::lines(why)
        );
    };
    let bound = match proof.is_within_code_bound {
        Some(true) => "within its bound",
        _ => "beyond its bound",
    };
    let coded = proof.error_8bit.map_or_else(String::new, |error| {
        format!(", {error:.4} in 8 bits, codes differ by {codes} at most")
    });
    format!(
        "{head}: {}: the picture errs {error:.4}{coded}; the numbers are {code_abs:.1e} off, {bound}\n",
        proof.status.words()
    )
}

fn cells(row: &PlanRow) -> Vec<String> {
    let judged = match row.judged_by {
        "percentile" => "99.9 % of pixels",
        "largest" => "the worst pixel",
        _ => "every angle",
    };
    vec![
        named(row),
        row.method.to_owned(),
        row.form.name().to_owned(),
        row.channels.to_string(),
        format!("{:.4}{}", row.error, if row.is_within { "" } else { " !" }),
        short_number(row.cost),
        cost_exact(row),
        format!("{:.0}", row.pixels),
        judged.to_owned(),
    ]
}

/// The function that a material gets.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlanRow {
    /// The material, as a user names it.
    pub material: String,
    /// The scene's names for it.
    pub names: Vec<String>,
    /// The method's name.
    pub method: &'static str,
    /// The form of its function.
    pub form: FunctionForm,
    /// How many channels it returns.
    pub channels: usize,
    /// The precision that it computes in.
    pub precision: Precision,
    /// The arguments of a library function after `cos_theta`: three channels each, or green alone for a scalar function. Empty
    /// where the material's constants are folded in.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub values: BTreeMap<String, Vec<f64>>,
    /// Its error in the frame where it is worst.
    pub error: f64,
    /// The largest error that is allowed.
    pub budget: f64,
    /// Whether the error is within the budget.
    pub is_within: bool,
    /// The cost of one evaluation.
    pub cost: f64,
    /// How the cost is known: `function` (it was compiled), `shape` (the same text with other constants was), `nothing` (it computes
    /// nothing), `operations` (they were counted).
    pub cost_by: CostBasis,
    /// The cost of the exact law.
    pub cost_exact: Option<f64>,
    /// Pixels that show the material, averaged over all frames.
    pub pixels: f64,
    /// How many frames show it.
    pub frames: usize,
    /// The frame where the error is largest, from 0.
    pub worst_frame: usize,
    /// `percentile`, `largest`, or `every_angle` where too few pixels show it.
    pub judged_by: &'static str,
    /// The reason for the choice, in a sentence.
    pub why: String,
    /// The functions that cost less, with the errors by which they fail, the most accurate first.
    pub cheaper: Vec<CheaperFunction>,
}

/// A function that costs less than the chosen one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheaperFunction {
    /// The method's name.
    pub method: &'static str,
    /// The form of its function.
    pub form: FunctionForm,
    /// How many channels it returns.
    pub channels: usize,
    /// The cost of one evaluation.
    pub cost: f64,
    /// Its error in the frame where it is worst.
    pub error: f64,
}

/// The cost of all functions of a plan together, in units × pixels of a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlanTotal {
    /// The cost of the plan.
    pub cost: f64,
    /// The cost if every material took its exact law.
    pub cost_exact: Option<f64>,
    /// The cost if all materials took one library function.
    pub shared: Option<SharedFunction>,
    /// The price of each further function, in units × pixels.
    pub price: f64,
}

/// One library function for all materials.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SharedFunction {
    /// The method's name.
    pub method: &'static str,
    /// Its total cost.
    pub cost: f64,
    /// Its largest error over all materials.
    pub error: f64,
}

/// A plan file, read back: the functions that it consists of.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PlanFile {
    /// The program that made it.
    pub tool: String,
    /// The version of the file's schema.
    pub schema: u32,
    /// `plan` and its flags.
    pub command: String,
    /// The GPU whose costs decided.
    #[serde(default)]
    pub gpu: String,
    /// The colour space of the functions.
    pub space: String,
    /// The functions.
    pub rows: Vec<PlanFileRow>,
}

/// A function of a plan file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PlanFileRow {
    /// The material, as a user names it.
    pub material: String,
    /// The method's name.
    pub method: String,
    /// The form of its function.
    pub form: FunctionForm,
    /// The precision that it computes in.
    pub precision: Precision,
}

impl Judgement {
    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Judgement::Percentile => "percentile",
            Judgement::Largest => "largest",
            Judgement::EveryAngle => "every_angle",
        }
    }
}

impl JudgedMaterial {
    /// The row of the report, given the number of frames in all.
    pub fn row(&self, request: &PlanRequest, frames: usize) -> PlanRow {
        let chosen = self.chosen();
        let cheaper = self.cheaper().into_iter().map(|one| CheaperFunction {
            method: one.method.name,
            form: one.form,
            channels: one.channels(),
            cost: one.cost,
            error: one.error,
        });
        PlanRow {
            material: self.material.argument.clone(),
            names: self.material.names.clone(),
            method: chosen.method.name,
            form: chosen.form,
            channels: chosen.channels(),
            precision: request.precision,
            values: self.values(request.precision),
            error: chosen.error,
            budget: request.budget,
            is_within: chosen.error <= request.budget,
            cost: chosen.cost,
            cost_by: chosen.basis,
            cost_exact: self.cost_exact,
            pixels: self.pixels as f64 / frames.max(1) as f64,
            frames: self.frames,
            worst_frame: chosen.worst_frame,
            judged_by: self.judgement.name(),
            why: self.why(request),
            cheaper: cheaper.collect(),
        }
    }

    /// The arguments of its library function.
    fn values(&self, precision: Precision) -> BTreeMap<String, Vec<f64>> {
        let candidate = self.chosen();
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

    /// The reason for the chosen function, in a sentence.
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
        let name = chosen.name();
        if chosen.error > budget {
            return format!(
                "nothing is within {budget} {unit}{angles}: of {count} functions {name} errs least"
            );
        }
        let Some(next) = self.cheaper().first().copied() else {
            return format!("{name} is within {budget} {unit}{angles}, and nothing costs less");
        };
        let next_name = next.name();
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

impl PlanTotal {
    /// The total of all materials over this many frames.
    pub fn of(judged: &[JudgedMaterial], price: f64, frames: usize) -> PlanTotal {
        let pixels = |material: &JudgedMaterial| material.pixels as f64 / frames.max(1) as f64;
        let exact =
            |material: &JudgedMaterial| Some(material.cost_exact? * pixels(material) + price);
        let chosen = judged.iter();
        let chosen = chosen.map(|material| material.chosen().choosable(pixels(material)));
        let chosen: Vec<Choosable> = chosen.collect();
        PlanTotal {
            cost: total_cost(chosen.iter(), price),
            cost_exact: judged.iter().map(exact).sum(),
            shared: SharedFunction::of(judged, price, &pixels),
            price,
        }
    }
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
            let one = all.find(|one| one.is_shared())?;
            shared.cost += one.cost * pixels(material);
            shared.error = shared.error.max(one.error);
        }
        Some(shared)
    }
}
