//! `audit`: a user's own function held against the exact law and against ours.

use std::path::{Path, PathBuf};

use crate::cli::args::{AuditFlags, Choice};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::request::{Materials, Request};
use crate::generator::request::source::shader;
use crate::generator::output::write::{OutputFile, try_places_of_ours};
use crate::generator::reference::MaterialInMedium;
use crate::lab::audit::{Audit, AuditRow, AuditRows, Define, Given, Language, serve};
use crate::lab::chart::{ChartView, CostAxis, STATISTICS, chart_data, charted_function};
use crate::lab::cost::{self, FAMILIES, Family};
use crate::lab::verify::{Status, machine};
use crate::physics::foreign::lines;
use crate::physics::spectra::Space;
use crate::generator::envelope::Report;
use crate::cli::audit_text::{audit_remarks, audit_text};
use crate::cli::junit::audit_junit;

use crate::cli::command::{Output, Progress, chart, check_limit, not_drawn, report_beside, try_files};

/// The GPUs that are asked unless others are named: one of a desktop, one of a phone.
const USUAL: [&str; 2] = ["rdna2", "adreno330"];

/// Audits.
pub fn run(flags: &AuditFlags, progress: Progress) -> Result<Output, Error> {
    if flags.worker {
        let served = serve();
        // The supervisor has gone: nobody is there to be told.
        return Ok(Output {
            code: u8::from(served.is_err()),
            ..Output::default()
        });
    }
    check_limit(flags.limit)?;
    check_max_error(flags.max_error)?;
    let request = request(flags)?;
    let audit = audit(flags, request.viewing.integration.space)?;
    let subjects = request.subjects()?.materials();
    let charts = chart::files(flags.pictures.folder());
    let all = flags.report.files().chain(&charts);
    try_files(&all.map(PathBuf::as_path).collect::<Vec<_>>())?;
    try_places_of_ours(&charts, flags.pictures.overwrite)?;
    let AuditRows { rows, skipped } = audit.rows(&subjects, progress)?;
    let command = String::from(flags.command_line(&request.viewing));
    let device = rows.first().and_then(|row| row.device.clone());
    let full = Report::new(command.clone(), rows.clone()).with_device(device);
    let (mut files, mut charted) = match flags.pictures.folder() {
        Some(folder) => {
            let place = (folder, flags.pictures.overwrite);
            let subjects = audited(subjects, &rows);
            charted(place, &rows, &subjects, audit.space, command, progress)?
        }
        None => (Vec::new(), Vec::new()),
    };
    if let Some(file) = &flags.report.junit {
        files.push(OutputFile::named(
            file,
            audit_junit(&rows).map_err(not_drawn)?,
        ));
    }
    let texts: Vec<String> = rows.iter().map(audit_text).collect();
    let json = flags.report.report.json();
    let mut output = report_beside(texts.join("\n"), &full, json, files)?;
    charted.splice(0..0, output.remarks);
    let skipped = skipped
        .iter()
        .map(|why| format!("not audited: {}", lines(&why.to_string())));
    let remarks = rows.iter().flat_map(audit_remarks);
    output.remarks = remarks.chain(skipped).chain(charted).collect();
    output.code = code(&rows);
    Ok(output)
}

/// The materials that have a row.
fn audited(subjects: Vec<MaterialInMedium>, rows: &[AuditRow]) -> Vec<MaterialInMedium> {
    let has_row = |one: &MaterialInMedium| rows.iter().any(|row| row.material == one.argument);
    subjects.into_iter().filter(has_row).collect()
}

/// The charts of these materials with the function as one more point; and where they are, and what lacks. The place is a
/// folder, and whether files of others are replaced there.
fn charted(
    (folder, overwrite): (&Path, bool),
    rows: &[AuditRow],
    subjects: &[MaterialInMedium],
    space: Space,
    command: String,
    progress: Progress,
) -> Result<(Vec<OutputFile>, Vec<String>), Error> {
    let Some(own) = charted_function(rows) else {
        return Ok((Vec::new(), Vec::new()));
    };
    let data = chart_data(subjects, space, Some(&own), command, progress);
    let is_known = |cost: &CostAxis| own.costs.contains_key(cost.name);
    let cost = data.costs.iter().position(is_known);
    let cost = cost.or_else(|| data.costs.iter().position(|cost| cost.name == USUAL[0]));
    let (set, cost) = (chart::usual_set(&data, STATISTICS[0]), cost.unwrap_or(0));
    let view = ChartView {
        data: &data,
        set: &data.sets[set],
        cost: &data.costs[cost],
        error: 0,
    };
    let files = chart::drawn_files(folder, overwrite, &view, [set, cost, 0])?;
    let mut remarks = chart::drawn_remarks(&files);
    remarks.extend(view.lacks());
    Ok((files, remarks))
}

fn request(flags: &AuditFlags) -> Result<Request, Error> {
    let materials = flags.materials.materials()?;
    if materials == Materials::None {
        return Err(RequestFault::NoMaterial {
            why: "--material is none; an audit holds a function against a material",
        }
        .into());
    }
    Ok(Request {
        materials,
        medium: flags.medium.source()?,
        viewing: flags.viewing.conditions()?,
        ..Request::default()
    })
}

fn audit(flags: &AuditFlags, space: Space) -> Result<Audit, Error> {
    let file = flags.file.clone().unwrap_or_default();
    let language = match flags.language {
        Some((_, language)) => language,
        None => Language::of_file(&file)?,
    };
    let given = flags.arg.iter().map(|word| Given::read(word));
    let given = given.collect::<Result<Vec<Given>, _>>()?;
    for (place, one) in given.iter().enumerate() {
        if given[..place].iter().any(|other| other.name == one.name) {
            let why = format!("--arg gives `{}` two values; leave one", one.name);
            return Err(RequestFault::conflict(why).into());
        }
    }
    let defines = flags.define.iter().map(|word| Define::read(word));
    Ok(Audit {
        defines: defines.collect::<Result<_, _>>()?,
        given,
        space,
        families: families(&flags.gpu)?,
        text: shader(&file)?,
        function: flags.function.clone(),
        max_error: flags.max_error,
        max_inputs: flags.max_inputs,
        tools: flags.tools.clone(),
        seconds: flags.limit,
        workers: machine::cores(),
        file,
        language,
    })
}

/// Refuses a limit of errors that says nothing.
fn check_max_error(most: Option<f64>) -> Result<(), Error> {
    match most {
        Some(most) if !(0.0..=1.0).contains(&most) => Err(RequestFault::OutOfRange {
            flag: "max-error",
            value: most.to_string(),
            allowed: "is 0 to 1, a difference of reflectance".to_owned(),
        }
        .into()),
        _ => Ok(()),
    }
}

fn families(asked: &[Choice<&'static Family>]) -> Result<Vec<&'static Family>, Error> {
    if asked.is_empty() {
        return Ok(USUAL.into_iter().filter_map(cost::find).collect());
    }
    if Choice::is_none(asked, "families")? {
        return Ok(Vec::new());
    }
    if Choice::is_all(asked) {
        return Ok(FAMILIES.iter().collect());
    }
    let named = asked.iter().filter_map(Choice::named);
    Ok(named.copied().collect())
}

/// 1 for findings; 3 where nothing could be run.
fn code(rows: &[AuditRow]) -> u8 {
    let any = |status| rows.iter().any(|row| row.status == status);
    match (any(Status::Fail), any(Status::NotChecked)) {
        (true, _) => 1,
        (_, true) => 3,
        _ => 0,
    }
}
