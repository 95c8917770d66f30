//! `plan`: of each material of a scene the cheapest function whose error nobody sees.

use std::path::PathBuf;

use crate::cli::args::{Choice, PlanFlags};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::cli::plan_input::{PlanInput, plan_input};
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::lab::cost::{self, Family, GpuCompiler};
use crate::language::methods;
use crate::physics::materials::ViewingConditions;
use crate::pictures::plan::{FramePixels, JudgedMaterial, PlanFault, PlanRequest, PlanRow, PlanTotal, Proof, material_view, plan, ProofCase, prove};
use crate::pictures::scene::Display;
use crate::pictures::plan::report::{PlanReport, plan_page};

use crate::cli::command::{Output, Progress, not_drawn, refuse_read, report_beside, try_places};

/// Whose costs decide where none is named.
const USUAL_GPU: &str = "rdna2";

/// The page in the folder asked for.
const PAGE: &str = "plan.html";

/// Reads the scene, judges, chooses.
pub fn run(flags: &PlanFlags, progress: Progress) -> Result<Output, Error> {
    check(flags)?;
    let page = flags.pictures.folder().map(|folder| folder.join(PAGE));
    try_places(flags.report.json(), page.as_deref())?;
    try_places_of_ours(page.as_slice(), flags.pictures.overwrite)?;
    let viewing = viewing(flags);
    let PlanInput {
        materials,
        unplanned,
        remarks,
        read,
        nothing_is_seen,
        display,
        frames,
        mut frame,
    } = plan_input(flags, &viewing)?;
    let outputs = flags.report.json().into_iter().chain(page.as_deref());
    refuse_read(read.iter().map(PathBuf::as_path), outputs)?;
    let request = request(flags, &viewing, display)?;
    let judged = plan(
        &request,
        materials,
        frames,
        &mut *frame,
        &mut |done, whole| {
            progress(done, whole, "frames");
        },
    )
    .map_err(fault)?;
    if judged.iter().all(|material| material.pixels == 0) {
        return Err(Error::usage(nothing_is_seen));
    }
    let rows: Vec<PlanRow> = judged.iter().map(|one| one.row(&request, frames)).collect();
    let code = u8::from(rows.iter().any(|row| !row.is_within));
    let total = PlanTotal::of(&judged, request.price, frames);
    let command: String = flags.command_line().into();
    let mut made = PlanReport::new(command, &request, frames, total, unplanned, remarks, rows);
    if flags.prove {
        let (device, proofs) = proofs(&request, &judged, &mut *frame, progress)?;
        made = made.with_proofs(device, proofs);
    }
    let page = page.map(|page| paged(flags, &request, &judged, &made, &mut *frame, page));
    let page = page.transpose()?;
    let said = page.as_ref().map(|page| {
        format!(
            "{}: angles, errors, pictures and reasons",
            crate::physics::foreign::path(page.path())
        )
    });
    let files = page.into_iter().collect();
    let mut output = report_beside(made.text(), &made, flags.report.json(), files)?;
    output.remarks.extend(said);
    output.code = code.max(made.proof_code());
    Ok(output)
}

/// The page, as a file that is to be written, with pictures of the frames where functions are worst.
fn paged(
    flags: &PlanFlags,
    request: &PlanRequest,
    judged: &[JudgedMaterial],
    made: &PlanReport,
    frame: &mut dyn FnMut(usize) -> Result<FramePixels, Error>,
    page: PathBuf,
) -> Result<OutputFile, Error> {
    let mut views = Vec::new();
    for (i, material) in judged.iter().enumerate() {
        let pixels = frame(material.chosen().worst_frame)?;
        views.push(material_view(request, material, i, &pixels));
    }
    let text = plan_page(made, &views).map_err(not_drawn)?;
    Ok(OutputFile::of_report(page, text, flags.pictures.overwrite))
}

/// Runs the chosen functions in the frames where each is worst.
fn proofs(
    request: &PlanRequest,
    judged: &[JudgedMaterial],
    frame: &mut dyn FnMut(usize) -> Result<FramePixels, Error>,
    progress: Progress,
) -> Result<(Option<String>, Vec<Proof>), Error> {
    let mut worst = Vec::new();
    for (i, material) in judged.iter().enumerate() {
        let mut frame = frame(material.chosen().worst_frame)?;
        worst.push(std::mem::take(&mut frame.of_material[i]));
    }
    let cases: Vec<ProofCase> = judged
        .iter()
        .zip(&worst)
        .map(|(judged, pixels)| ProofCase { judged, pixels })
        .collect();
    let proven = prove(request, &cases, &mut |done, whole| {
        progress(done, whole, "functions");
    });
    Ok(proven?)
}

fn check(flags: &PlanFlags) -> Result<(), Error> {
    let numbers = [
        ("budget", Some(flags.budget()), 0.0..=1e6),
        ("exposure", flags.exposure, -16.0..=16.0),
        ("exposure-range", Some(flags.exposure_range), 0.0..=8.0),
        ("fetch-cost", flags.fetch_cost, 0.0..=1e6),
        ("variant-cost", Some(flags.variant_cost), 0.0..=1e15),
    ];
    for (flag, value, range) in numbers {
        let beyond = value.filter(|value| !range.contains(value));
        if let Some(value) = beyond {
            let allowed = format!("is {} to {}", range.start(), range.end());
            let value = value.to_string();
            return Err(RequestFault::OutOfRange {
                flag,
                value,
                allowed,
            }
            .into());
        }
    }
    Ok(())
}

fn viewing(flags: &PlanFlags) -> ViewingConditions {
    let mut viewing = ViewingConditions::default();
    viewing.integration.space = flags.space.unwrap_or_default();
    viewing
}

/// What the flags ask for; what they leave open the scene says.
fn request(
    flags: &PlanFlags,
    viewing: &ViewingConditions,
    display: Display,
) -> Result<PlanRequest, Error> {
    let methods = match flags.method.is_empty() {
        true => methods::ALL.to_vec(),
        false => Choice::methods(&flags.method),
    };
    Ok(PlanRequest {
        budget: flags.budget(),
        metric: flags.metric,
        display: Display {
            exposure: flags.exposure.unwrap_or(display.exposure),
            curve: flags.tone_curve.unwrap_or(display.curve),
        },
        space: viewing.integration.space,
        exposure_range: flags.exposure_range,
        min_pixels: flags.min_pixels,
        truth: flags.reference,
        family: family(flags)?,
        precision: flags.precision.unwrap_or_default(),
        channels: flags
            .channels
            .iter()
            .filter_map(|word| word.parse().ok())
            .collect(),
        methods,
        fetch: flags.fetch_cost,
        price: flags.variant_cost,
    })
}

fn family(flags: &PlanFlags) -> Result<&'static Family, Error> {
    let usual = || cost::find(USUAL_GPU).expect("a test names it");
    let family = flags.gpu.unwrap_or_else(usual);
    if let GpuCompiler::None(reason) = family.compiler {
        let gpu = family.name;
        return Err(crate::lab::budget::Error::NoCosts { gpu, reason }.into());
    }
    Ok(family)
}

fn fault(fault: PlanFault<Error>) -> Error {
    match fault {
        PlanFault::Frame(error) => error,
        PlanFault::Function(error) => error.into(),
        PlanFault::NoCost { .. } => Error::usage(fault.to_string()),
    }
}
