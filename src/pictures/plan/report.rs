//! The report of a plan: text for people, and JSON that `--plan` reads back.

use serde::Serialize;

use super::gltf::Unplanned;
use super::planned::JudgedMaterial;
use super::proof::Proof;
use super::request::PlanRequest;
use super::row::{PlanRow, PlanTotal};
use crate::generator::envelope::Origin;
use crate::lab::verify::Status;
use crate::physics::foreign::{self, Foreign, one_line};
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
