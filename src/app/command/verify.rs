//! `verify`: what is generated, run on every target and held against what it means.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::app::args::VerifyFlags;
use crate::app::error::Error;
use crate::app::names::{flag, unknown};
use crate::app::request::Request;
use crate::app::sight::{flags as sight_flags, sight};
use crate::app::source::{materials, source};
use crate::app::verify::plan_of_request;
use crate::app::write::write_file;
use crate::gpu::{Backend, Wanted};
use crate::process::Inbox;
use crate::report::Report;
use crate::report::table;
use crate::verify::file::Effort;
use crate::verify::plan::Plan;
use crate::verify::run::Devices;
use crate::verify::{Limits, WITHIN, exhaustive, junit, machine, serve, supervise};

use super::{Output, Progress, check_limit, refuse_place_of, report, try_places};

/// Cosines that a run may ask for.
const POINTS: std::ops::RangeInclusive<usize> = 100..=10_000_000;
/// How many findings are told in full; the JSON has all.
const TOLD: usize = 20;

/// Verifies.
pub fn run(flags: &VerifyFlags, progress: Progress) -> Result<Output, Error> {
    // Before the work begins, so that a worker ends with its supervisor at any time.
    let inbox = flags.worker.then(Inbox::open);
    check_limit(flags.limit)?;
    let request = request(flags)?;
    let wanted = wanted(flags)?;
    let effort = effort(flags)?;
    let plan = plan_of_request(&request, &flags.out_dir)?;
    if plan.files.is_empty() {
        return Err(Error::Usage {
            what: "there is nothing to run: name a method or a material".to_owned(),
        });
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
        let what = "--exhaustive runs every f32; a run of --precision f16 tries every f16 already";
        return Err(Error::Usage {
            what: what.to_owned(),
        });
    }
    for report in flags.json.iter().chain(&flags.junit) {
        refuse_place_of(&plan.places, report)?;
    }
    try_places(flags.json.as_deref(), flags.junit.as_deref())?;
    let (rows, speeds) = if flags.exhaustive {
        exhaustive::rows(&plan, &Devices::new(wanted), progress)?
    } else {
        let limits = Limits {
            seconds: flags.limit,
            workers: machine::cores(),
        };
        (
            supervise(&plan, limits, flags.tools.as_deref(), progress)?,
            Vec::new(),
        )
    };
    let mut output = told(flags, &request, &plan, &rows)?;
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
    let sight = sight(&flags.sight.words(flags.gamut.as_deref()))?;
    Ok(Request {
        targets: flags.target.clone(),
        methods: flags.method.clone(),
        materials: materials(&flags.material)?,
        medium: flags.medium.as_deref().map(source).transpose()?,
        sight,
        prefix: flags.prefix.clone(),
        matching_angle: flags.matching_angle,
        precision: flags.precision.read()?,
        force: flags.precision.force,
        ..Request::default()
    })
}

fn wanted(flags: &VerifyFlags) -> Result<Wanted, Error> {
    let backend = match flags.backend.as_deref() {
        None => None,
        Some("vulkan") => Some(Backend::Vulkan),
        Some("gl") => Some(Backend::OpenGl),
        Some(name) => return Err(unknown("backend", name, &["vulkan", "gl"])),
    };
    Ok(Wanted {
        backend,
        name: flags.adapter.clone(),
    })
}

fn effort(flags: &VerifyFlags) -> Result<Effort, Error> {
    if !POINTS.contains(&flags.points) {
        let what = format!("--points is {}; it is 100 to 10000000", flags.points);
        return Err(Error::Usage { what });
    }
    Ok(Effort {
        points: flags.points,
    })
}

/// The report, and how the run ends.
fn told(
    flags: &VerifyFlags,
    request: &Request,
    plan: &Plan,
    rows: &[Value],
) -> Result<Output, Error> {
    if let Some(file) = &flags.junit {
        let xml = junit("fresnel-gen verify", rows).map_err(|what| Error::Usage { what })?;
        write_file(file, xml.as_bytes())?;
    }
    let full = Report::new(canonical(flags, request), rows.to_vec()).with_device(devices(rows));
    let mut output = report(text(rows), &full, flags.json.as_deref())?;
    output
        .remarks
        .extend(plan.left_out.iter().map(|why| format!("left out: {why}")));
    output.remarks.extend(remarks(rows));
    output.code = code(flags, rows);
    Ok(output)
}

fn word<'a>(row: &'a Value, key: &str) -> &'a str {
    row[key].as_str().unwrap_or_default()
}

fn with_status<'a>(rows: &'a [Value], status: &'a str) -> impl Iterator<Item = &'a Value> {
    rows.iter().filter(move |row| word(row, "status") == status)
}

/// 1 for findings; 3 where a target could not be run at all, or, if all is asked for, anything was not checked.
fn code(flags: &VerifyFlags, rows: &[Value]) -> u8 {
    if with_status(rows, "fail").next().is_some() {
        return 1;
    }
    let targets: BTreeSet<&str> = rows.iter().map(|row| word(row, "target")).collect();
    let ran = |target: &&str| with_status(rows, "pass").any(|row| word(row, "target") == *target);
    let lacks = !targets.iter().all(ran);
    if lacks || flags.require_all && !unchecked(rows).is_empty() {
        3
    } else {
        0
    }
}

/// What was not checked, each once.
fn unchecked(rows: &[Value]) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for row in rows {
        let target = word(row, "target");
        if word(row, "status") == "not_checked" {
            all.insert(format!("{target}: {}", word(row, "reason")));
        }
        let opinions = row["second_opinions"].as_array().into_iter().flatten();
        for opinion in opinions.filter(|opinion| word(opinion, "status") == "not_checked") {
            all.insert(format!(
                "{target} by {}: {}",
                word(opinion, "way"),
                word(opinion, "reason")
            ));
        }
        for (name, why) in row["not_asked"].as_object().into_iter().flatten() {
            all.insert(format!(
                "{target} by {name}: {}",
                why.as_str().unwrap_or_default()
            ));
        }
    }
    all
}

/// Findings and what was not checked, for stderr; GitHub shows findings beside the file.
fn remarks(rows: &[Value]) -> Vec<String> {
    let failed: Vec<&Value> = with_status(rows, "fail").collect();
    // What is wrong with a file stands in all of its rows.
    let mut findings: Vec<String> = Vec::new();
    for finding in failed.iter().map(|row| finding(row)) {
        if !findings.contains(&finding) {
            findings.push(finding);
        }
    }
    let more = findings.len().saturating_sub(TOLD);
    let mut remarks: Vec<String> = findings.into_iter().take(TOLD).collect();
    if more > 0 {
        remarks.push(format!("… and {more} more, all in the JSON"));
    }
    let said: BTreeSet<&str> = rows
        .iter()
        .filter_map(|row| row["remark"].as_str())
        .collect();
    remarks.extend(said.into_iter().map(|remark| format!("remark: {remark}")));
    remarks.extend(
        unchecked(rows)
            .into_iter()
            .map(|what| format!("not checked: {what}")),
    );
    let count = |status| with_status(rows, status).count();
    remarks.push(format!(
        "{} functions run: {} pass, {} fail, {} not checked",
        rows.len(),
        count("pass"),
        count("fail"),
        count("not_checked")
    ));
    remarks
}

fn finding(row: &Value) -> String {
    let reason = word(row, "reason");
    if machine::is_github() {
        let line = reason
            .replace('%', "%25")
            .replace('\r', "%0D")
            .replace('\n', "%0A");
        format!(
            "::error file={},title=fresnel-gen verify::{line}",
            word(row, "file")
        )
    } else {
        format!("FAIL {reason}")
    }
}

/// The devices of all rows, each once.
fn devices(rows: &[Value]) -> Option<String> {
    let names: BTreeSet<&str> = rows
        .iter()
        .filter_map(|row| row["device"].as_str())
        .collect();
    let names: Vec<&str> = names.into_iter().collect();
    (!names.is_empty()).then(|| names.join("; "))
}

/// The run's flags in one order, without places.
fn canonical(flags: &VerifyFlags, request: &Request) -> String {
    let one = |name: &str, word: &Option<String>| flag(name, word.as_slice());
    let mut command = "verify".to_owned();
    command += &flag("target", &flags.target);
    command += &flag("method", &flags.method);
    command += &flag("material", &flags.material);
    command += &one("medium", &flags.medium);
    command += &sight_flags(&request.sight);
    command += &flags.precision.words();
    command += &one("adapter", &flags.adapter);
    command += &one("backend", &flags.backend);
    command
        + &if flags.exhaustive {
            " --exhaustive".to_owned()
        } else if request.precision.is_half() {
            String::new()
        } else {
            format!(" --points {}", flags.points)
        }
}

/// In half precision the absolute error, else ulp.
fn code_error(row: &Value) -> String {
    let (ulp, most) = (&row["code_error"]["max_ulp"], &row["code_error"]["max_abs"]);
    match (ulp.as_f64(), most.as_f64()) {
        (Some(ulp), _) => format!("{ulp:.2}"),
        (None, Some(most)) if word(row, "precision") == "f16" => format!("{most:.5} abs"),
        _ => "-".to_owned(),
    }
}

fn allowed(row: &Value) -> String {
    match (
        row["bound"]["ulp"].as_f64(),
        row["bound"]["max_abs"].as_f64(),
    ) {
        (Some(0.0), _) => "2^-22".to_owned(),
        (Some(ulp), _) => format!("{ulp:.1}"),
        (None, Some(most)) => format!("{most:.5} abs"),
        _ => "-".to_owned(),
    }
}

/// A line for each row.
fn text(rows: &[Value]) -> String {
    let cells = |row: &Value| {
        let figure = |key: &str, inner: &str, digits: usize| {
            row[key][inner]
                .as_f64()
                .map_or("-".to_owned(), |value| format!("{value:.digits$}"))
        };
        let percent = row["model_error"]["mean_rel"].as_f64();
        vec![
            word(row, "target").to_owned(),
            word(row, "method").to_owned(),
            word(row, "material").to_owned(),
            word(row, "form").to_owned(),
            row["points"]
                .as_u64()
                .map_or("-".to_owned(), |points| points.to_string()),
            code_error(row),
            allowed(row),
            figure("model_error", "max_abs", 5),
            percent.map_or("-".to_owned(), |mean| format!("{:.3}", 100.0 * mean)),
            word(row, "status").replace('_', " "),
        ]
    };
    let head = [
        "target",
        "method",
        "material",
        "form",
        "points",
        "code error, ulp",
        "allowed",
        "model error",
        "in the mean, %",
        "status",
    ];
    table::text(&head, &rows.iter().map(cells).collect::<Vec<_>>()) + &covered(rows)
}

/// What share of all numbers was tried: a sample finds what is wrong at a single number by luck only.
fn covered(rows: &[Value]) -> String {
    let shares = |precision: &str| {
        let rows = rows
            .iter()
            .filter(move |row| word(row, "precision") == precision);
        let most = rows.filter_map(|row| row["share"].as_f64());
        most.reduce(f64::max)
    };
    let mut told = String::new();
    if let Some(share) = shares("f32") {
        told += "\nA difference within 2^-22 passes, however many ulp it is.";
        let cosines = (share * WITHIN as f64).round();
        let percent = 100.0 * share;
        told += &format!(
            "\nFrom 0 to 1 each function was run at {cosines} cosines at most, {percent:.6} % of the {WITHIN} f32 there are.\n"
        );
        if share < 0.5 {
            told += "A result that is wrong at a single f32 is found by luck only; --exhaustive tries all of them.\n";
        }
    }
    if shares("f16").is_some() {
        told += "\nIn half precision each function was run at every f16 from 0 to 1.\n";
    }
    told
}
