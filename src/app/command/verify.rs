//! `verify`: what is generated, run on every target and held against what it means.

use core::time::Duration;
use std::collections::BTreeSet;

use crate::app::args::VerifyFlags;
use crate::app::error::Error;
use crate::app::fault::RequestFault;
use crate::app::request::Request;
use crate::app::verify::plan_of_request;
use crate::app::write::write_file;
use crate::gpu::Wanted;
use crate::process::{Inbox, Pool};
use crate::report::Report;
use crate::report::junit::verify_junit;
use crate::report::verify::{devices, not_checked, verify_remarks, verify_text};
use crate::verify::file::VerifyEffort;
use crate::verify::plan::VerifyPlan;
use crate::verify::run::Devices;
use crate::verify::{Status, VerifyRow, exhaustive_rows, machine, serve, supervise};

use super::{Output, Progress, check_limit, not_drawn, refuse_place_of, report, try_places};

/// Cosines that a run may ask for.
const POINTS: std::ops::RangeInclusive<usize> = 100..=10_000_000;

/// Verifies.
pub fn run(flags: &VerifyFlags, progress: Progress) -> Result<Output, Error> {
    // Before the work begins, so that a worker ends with its supervisor at any time.
    let inbox = flags.worker.then(Inbox::open);
    check_limit(flags.limit)?;
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
        let served = serve(inbox, &plan, &Devices::new(wanted), effort);
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
    let (rows, speeds) = if flags.exhaustive {
        exhaustive_rows(&plan, &Devices::new(wanted), progress)?
    } else {
        let pool = Pool {
            limit: Duration::from_secs(flags.limit),
            workers: machine::cores(),
        };
        (
            supervise(&plan, pool, flags.tools.as_deref(), progress)?,
            Vec::new(),
        )
    };
    let mut output = reported(flags, &request, &plan, &rows)?;
    output.remarks.extend(speeds);
    if !flags.out_dir.is_dir() {
        output.remarks.push(format!(
            "there is no folder {}: what would be written was run",
            flags.out_dir.display()
        ));
    }
    Ok(output)
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
    rows: &[VerifyRow],
) -> Result<Output, Error> {
    if let Some(file) = &flags.report.junit {
        let xml = verify_junit(rows).map_err(not_drawn)?;
        write_file(file, xml.as_bytes())?;
    }
    let full =
        Report::new(flags.command_line(&request.viewing), rows.to_vec()).with_device(devices(rows));
    let mut output = report(verify_text(rows), &full, flags.report.report.json())?;
    output
        .remarks
        .extend(plan.left_out.iter().map(|why| format!("left out: {why}")));
    let is_github = machine::is_github();
    output.remarks.extend(verify_remarks(rows, is_github));
    output.code = code(flags, rows);
    Ok(output)
}

/// 1 for findings; 3 where a target could not be run at all, or, if all is asked for, anything was not checked.
fn code(flags: &VerifyFlags, rows: &[VerifyRow]) -> u8 {
    if rows.iter().any(|row| row.status == Status::Fail) {
        return 1;
    }
    let targets: BTreeSet<&str> = rows.iter().map(|row| row.target.as_str()).collect();
    let has_run = |target: &&str| {
        let mut own = rows.iter().filter(|row| row.target == *target);
        own.any(|row| row.status == Status::Pass)
    };
    let lacks = !targets.iter().all(has_run);
    if lacks || flags.require_all && !not_checked(rows).is_empty() {
        3
    } else {
        0
    }
}
