//! `time`: what functions cost on the device at hand.

use core::fmt::Display;
use core::time::Duration;
use std::collections::BTreeSet;

use crate::cli::args::{Choice, TimeFlags, each_once};
use crate::cli::error::Error;
use crate::generator::fault::RequestFault;
use crate::lab::overdraw::request::TimeRequest;
use crate::lab::gpu::Wanted;
use crate::lab::overdraw::{Clock, DeviceFacts, DrawingEffort, DrawingWorker, MeasuredDrawings, Stop, TimeRow, TimedFunctions, measure, serve, time_rows, usual_operations};
use crate::lab::process::Inbox;
use crate::physics::foreign::{lines, one_line};
use crate::cli::time_text::TimeReport;

use crate::cli::command::{Output, Progress, report, try_places};

/// Pixels a side that a run may ask for, operations in a chain, rounds, and seconds of a submission.
const SIZES: std::ops::RangeInclusive<u32> = 16..=8192;
const OPERATIONS: std::ops::RangeInclusive<usize> = 100..=20_000;
const ROUNDS: std::ops::RangeInclusive<usize> = 1..=1000;
const SECONDS: std::ops::RangeInclusive<f64> = 1e-6..=3600.0;

/// Measures.
pub fn run(flags: &TimeFlags, progress: Progress) -> Result<Output, Error> {
    // Before the work begins, so that a worker ends with its supervisor at any time.
    let inbox = flags.worker.then(Inbox::open);
    check(flags)?;
    let wanted = Wanted {
        backend: flags.backend,
        name: flags.adapter.clone(),
    };
    let mut timed = timed_functions(flags, false)?;
    if let Some(inbox) = inbox {
        let plan = |is_software| {
            let again = timed_functions(flags, is_software);
            again.map_or_else(|_| timed.plan.clone(), |timed| timed.plan)
        };
        let served = serve(inbox, &plan, &wanted, flags.size);
        // The supervisor has gone: nobody is there to be told.
        return Ok(Output {
            code: u8::from(served.is_err()),
            ..Output::default()
        });
    }
    try_places(flags.report.json(), None)?;
    let limit = Duration::from_secs_f64(flags.limit);
    let mut worker = DrawingWorker::start(limit)?;
    check_device(flags, &worker.device, &wanted)?;
    if worker.device.is_software {
        timed = timed_functions(flags, true)?;
    }
    worker.takes(&timed.plan);
    let effort = DrawingEffort {
        rounds: flags.rounds,
        clock: flags.clock,
        is_software: worker.device.is_software,
        limit: limit.as_nanos() as f64,
    };
    let measured = measure(&timed.plan, &effort, &mut worker, progress).map_err(|stop| {
        let (Stop::One(why) | Stop::All(why)) = stop;
        let what = format!("{}: {why}", worker.device.device);
        Error::lacking(what)
    })?;
    let rows = time_rows(&timed, &worker.device, &measured);
    let times = TimeReport::new(
        flags.command_line().into(),
        &timed,
        &worker.device,
        &measured,
        &rows,
    );
    let mut output = report(times.text(), &times, flags.report.json())?;
    output.remarks = remarks(&timed, &measured, &rows, flags.clock);
    output.code = code(flags, &rows);
    Ok(output)
}

/// What is drawn; in software chains are shorter where nothing is said.
fn timed_functions(flags: &TimeFlags, is_software: bool) -> Result<TimedFunctions, Error> {
    let usual = usual_operations(is_software);
    let request = TimeRequest {
        methods: Choice::methods(&flags.method),
        materials: flags.materials.materials()?,
        precisions: each_once(&flags.precision),
        operations: flags.operations.unwrap_or(usual),
    };
    Ok(request.timed_functions()?)
}

fn check_device(flags: &TimeFlags, facts: &DeviceFacts, wanted: &Wanted) -> Result<(), Error> {
    if flags.hardware && facts.is_software {
        return Err(no_hardware(facts, wanted));
    }
    if flags.clock == Some(Clock::Cpu) && !facts.is_software {
        let device = &facts.device;
        let why =
            format!("--clock cpu is for software; {device} does not compute on the processor");
        return Err(RequestFault::conflict(why).into());
    }
    Ok(())
}

fn check(flags: &TimeFlags) -> Result<(), Error> {
    if let Some(size) = flags.size.filter(|size| !SIZES.contains(size)) {
        return out_of_range("size", size, "is 16 to 8192 pixels a side");
    }
    if !ROUNDS.contains(&flags.rounds) {
        return out_of_range("rounds", flags.rounds, "is 1 to 1000");
    }
    if let Some(operations) = flags.operations.filter(|one| !OPERATIONS.contains(one)) {
        return out_of_range("operations", operations, "is 100 to 20000");
    }
    if !SECONDS.contains(&flags.limit) {
        return out_of_range("limit", flags.limit, "is 0.000001 to 3600 seconds");
    }
    Ok(())
}

fn out_of_range(flag: &'static str, value: impl Display, allowed: &str) -> Result<(), Error> {
    Err(RequestFault::OutOfRange {
        flag,
        value: value.to_string(),
        allowed: allowed.to_owned(),
    }
    .into())
}

fn no_hardware(facts: &DeviceFacts, wanted: &Wanted) -> Error {
    let device = &facts.device;
    let what = if wanted.name.is_some() {
        format!(
            "no hardware adapter: what --adapter names is software, {device}; leave --adapter or --hardware out"
        )
    } else {
        format!(
            "no hardware adapter: there is only software, {device}; install the driver of the graphics card, on Debian mesa-vulkan-drivers or the maker's, or leave --hardware out"
        )
    };
    Error::lacking(what)
}

/// What failed, each reason once; what was left out; and how the time was taken where that was not asked for.
fn remarks(
    timed: &TimedFunctions,
    measured: &MeasuredDrawings,
    rows: &[TimeRow],
    clock: Option<Clock>,
) -> Vec<String> {
    let faults = |lacking: bool, word: &str| -> BTreeSet<String> {
        let wanted = rows.iter().filter(|row| row.is_lacking == lacking);
        let whys = wanted.filter_map(|row| row.figure.as_ref().err());
        whys.map(|why| format!("{word}: {}", lines(why))).collect()
    };
    let mut remarks: Vec<String> = faults(false, "FAIL").into_iter().collect();
    remarks.extend(faults(true, "not measured"));
    let left_out = timed.left_out.iter();
    remarks.extend(left_out.map(|why| format!("left out: {}", one_line(why))));
    remarks.extend(clock.map_or_else(|| chosen(measured), |_| None));
    remarks
}

/// What the time was taken by, where that was not asked for and is not the device's own clock.
fn chosen(measured: &MeasuredDrawings) -> Option<String> {
    let why = match measured.clock {
        Clock::Gpu => return None,
        Clock::Cpu => {
            "the device is software: measured by the processor's time, in which other programs are not; --clock gpu takes its timestamps"
        }
        Clock::Wall => {
            "the device's timestamps do not advance, or it has none: measured by wall time"
        }
    };
    Some(why.to_owned())
}

/// 1 where a shader failed, 3 where this machine cannot run some and all was asked for.
fn code(flags: &TimeFlags, rows: &[TimeRow]) -> u8 {
    let missing = |row: &&TimeRow| row.figure.is_err();
    if rows.iter().filter(missing).any(|row| !row.is_lacking) {
        1
    } else if flags.require_all && rows.iter().any(|row| row.is_lacking) {
        3
    } else {
        0
    }
}
