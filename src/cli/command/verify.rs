//! `verify`: what is generated, run on every target and held against what it means.

use core::time::Duration;
use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::cli::args::{CheckReportFlags, VerifyFlags};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::generator::output::manifest;
use crate::lab::verify::merge::Whole;
use crate::generator::request::Request;
use crate::lab::verify::dealt::{VARIABLES, shard_of};
use crate::lab::verify::requested::plan_of_request;
use crate::generator::output::write::OutputFile;
use crate::lab::gpu::Wanted;
use crate::lab::process::{Inbox, Pool};
use crate::lab::verify::file::VerifyEffort;
use crate::lab::verify::plan::VerifyPlan;
use crate::lab::verify::run::Devices;
use crate::lab::verify::shard::{PartStatement, Shard, ShardOutcome};
use crate::lab::verify::{MachineStatement, Status, VerifyRow, exhaustive_rows, machine, serve, supervise};
use crate::physics::foreign::one_line;
use crate::generator::envelope::Report;
use crate::cli::junit::verify_junit;
use crate::lab::verify::shard_report::{ShardReport, WholeRun};
use crate::cli::verify_text::{devices, not_checked, verify_remarks, verify_text};

use crate::cli::command::{Output, Progress, check_limit, not_drawn, refuse_place_of, report_beside, try_places};

/// Cosines that a run may ask for.
const POINTS: std::ops::RangeInclusive<usize> = 100..=10_000_000;

/// Verifies.
pub fn run(flags: &VerifyFlags, progress: Progress) -> Result<Output, Error> {
    // Before the work begins, so that a worker ends with its supervisor at any time.
    let inbox = flags.worker.then(Inbox::open);
    check_limit(flags.limit)?;
    let shard = shard(flags)?;
    let request = request(flags)?;
    let wanted = Wanted {
        backend: flags.backend,
        name: flags.adapter.clone(),
    };
    let effort = effort(flags)?;
    let plan = plan_of_request(&request, &flags.out_dir)?;
    if plan.files.is_empty() {
        return Err(RequestFault::NothingToDo {
            work: "run",
            why: "name a method or a material",
        }
        .into());
    }
    if let Some(inbox) = inbox {
        let devices = Devices::new(wanted);
        let served = serve(inbox, &plan, &devices, effort, shard.is_some());
        // The supervisor has gone: nobody is there to be told.
        return Ok(Output {
            code: u8::from(served.is_err()),
            ..Output::default()
        });
    }
    if flags.exhaustive && request.precision.is_half() {
        let why = "--exhaustive runs every f32; a run of --precision f16 tries every f16 already";
        return Err(RequestFault::conflict(why).into());
    }
    for report in flags.report.files() {
        refuse_place_of(&plan.places, report)?;
    }
    try_places(flags.report.report.json(), flags.report.junit.as_deref())?;
    let dealt = shard.unwrap_or(Shard::WHOLE);
    let (outcome, speeds) = if flags.exhaustive {
        exhaustive_rows(&plan, dealt, &Devices::new(wanted), progress)?
    } else {
        let pool = Pool {
            limit: Duration::from_secs(flags.limit),
            workers: machine::cores(),
        };
        let tools = flags.tools.as_deref();
        (supervise(&plan, dealt, pool, tools, progress)?, Vec::new())
    };
    let mut output = reported(flags, &request, &plan, shard, outcome)?;
    output.remarks.extend(speeds);
    if !flags.out_dir.is_dir() {
        output.remarks.push(format!(
            "there is no folder {}: what would be written was run",
            crate::physics::foreign::path(&flags.out_dir)
        ));
    }
    Ok(output)
}

/// The shard that this run is.
fn shard(flags: &VerifyFlags) -> Result<Option<Shard>, Error> {
    let variables = VARIABLES.map(|name| (name, machine::variable(name)));
    Ok(shard_of(flags.shards, flags.shard, &variables)?)
}

fn request(flags: &VerifyFlags) -> Result<Request, Error> {
    Ok(Request {
        targets: flags.target.iter().map(ToString::to_string).collect(),
        methods: flags.method.iter().map(ToString::to_string).collect(),
        effects: flags.effect.iter().map(ToString::to_string).collect(),
        materials: flags.materials.materials()?,
        medium: flags.medium.source()?,
        viewing: flags.viewing.conditions()?,
        prefix: flags.prefix.clone(),
        matching_angle: flags.matching_angle,
        precision: flags.precision.precision(),
        force: flags.precision.force,
        ..Request::default()
    })
}

fn effort(flags: &VerifyFlags) -> Result<VerifyEffort, Error> {
    if !POINTS.contains(&flags.points) {
        return Err(RequestFault::OutOfRange {
            flag: "points",
            value: flags.points.to_string(),
            allowed: "is 100 to 10000000".to_owned(),
        }
        .into());
    }
    Ok(VerifyEffort {
        points: flags.points,
    })
}

/// The report, and how the run ends.
fn reported(
    flags: &VerifyFlags,
    request: &Request,
    plan: &VerifyPlan,
    shard: Option<Shard>,
    outcome: ShardOutcome,
) -> Result<Output, Error> {
    let command = String::from(flags.command_line(&request.viewing));
    let mut output = match shard {
        None => {
            let whole = Whole {
                rows: outcome.bare_rows(),
                parts: outcome.parts,
                require_all: flags.require_all,
                command,
            };
            whole_report(whole, &flags.report)?
        }
        Some(shard) => {
            let whole = WholeRun {
                command,
                inputs: plan.hash(),
                require_all: flags.require_all,
            };
            shard_report(whole, shard, outcome, &flags.report)?
        }
    };
    let left_out = plan
        .left_out
        .iter()
        .map(|why| format!("left out: {}", one_line(&why.to_string())));
    output.remarks.splice(0..0, left_out);
    if !plan.unasked.is_empty() {
        output.remarks.push(unasked_words(&plan.unasked));
        if flags.require_all && output.code == 0 {
            output.code = 3;
        }
    }
    Ok(output)
}

/// What is said of files that the run leaves out.
fn unasked_words(files: &[String]) -> String {
    const NAMED: usize = 3;
    let names: Vec<String> = files
        .iter()
        .take(NAMED)
        .map(|file| one_line(file))
        .collect();
    let more = match files.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "not run: {}{more}, which {} lists: name what they hold, with --material, --method, --effect or --precision",
        names.join(", "),
        manifest::FILE
    )
}

/// The report of a shard, and how it ends.
fn shard_report(
    whole: WholeRun,
    shard: Shard,
    outcome: ShardOutcome,
    files: &CheckReportFlags,
) -> Result<Output, Error> {
    let rows = outcome.bare_rows();
    let code = code(&rows, whole.require_all, Some(&outcome.machine));
    let (dealt, places) = (outcome.parts.len(), outcome.plan.len());
    let unrun = remarks_on_parts_without_rows(&outcome.parts);
    let full = ShardReport::new(whole, shard, outcome);
    let mut output = told(&rows, &full, files)?;
    output.remarks.extend(unrun);
    output.remarks.push(format!(
        "shard {} of {}: {dealt} of {places} parts of the run; `fresnel-gen merge` puts the JSON reports of all shards together",
        shard.index(),
        shard.count()
    ));
    output.code = code;
    Ok(output)
}

/// The report of a whole run, and how it ends.
pub(super) fn whole_report(whole: Whole, files: &CheckReportFlags) -> Result<Output, Error> {
    let rows = whole.rows;
    let full = Report::new(whole.command, rows.clone()).with_device(devices(&rows));
    let mut output = told(&rows, &full, files)?;
    let unrun = remarks_on_parts_without_rows(&whole.parts);
    output.remarks.extend(unrun);
    output.code = code(&rows, whole.require_all, None);
    Ok(output)
}

/// What people are told of files without rows: a line for each reason.
fn remarks_on_parts_without_rows(parts: &[PartStatement]) -> Vec<String> {
    let mut by_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for part in parts {
        if let Some(reason) = &part.reason {
            by_reason.entry(reason).or_default().push(&part.file);
        }
    }
    let line = |(reason, files): (&str, Vec<&str>)| {
        let files = files.join(", ");
        format!("not run: {reason}: {files}")
    };
    by_reason.into_iter().map(line).collect()
}

/// A report in all its forms.
fn told<T: Serialize>(
    rows: &[VerifyRow],
    full: &T,
    files: &CheckReportFlags,
) -> Result<Output, Error> {
    let mut junit = Vec::new();
    if let Some(file) = &files.junit {
        junit.push(OutputFile::named(
            file,
            verify_junit(rows).map_err(not_drawn)?,
        ));
    }
    let mut output = report_beside(verify_text(rows), full, files.report.json(), junit)?;
    let is_github = machine::is_github();
    output.remarks.extend(verify_remarks(rows, is_github));
    Ok(output)
}

/// 1 for findings; 3 where a target could not be run at all, or, if all is asked for, anything was not checked. A shard has few rows of
/// a target, and all of them may be such as are run nowhere: it ends with 3 where its machine lacks something.
fn code(rows: &[VerifyRow], require_all: bool, shard: Option<&MachineStatement>) -> u8 {
    if rows.iter().any(|row| row.status == Status::Fail) {
        return 1;
    }
    let targets: BTreeSet<&str> = rows.iter().map(|row| row.target.as_str()).collect();
    let has_run = |target: &&str| {
        let mut own = rows.iter().filter(|row| row.target == *target);
        own.any(|row| row.status == Status::Pass)
            || shard.is_some_and(|machine| !machine.lacks_for(target))
    };
    let lacks = !targets.iter().all(has_run);
    if lacks || require_all && !not_checked(rows).is_empty() {
        3
    } else {
        0
    }
}
