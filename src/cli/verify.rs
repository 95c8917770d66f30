//! `verify`: runs the generated functions on every target and compares the results with their exact meaning.

use core::time::Duration;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::flags::choice::{
    Choice, PrecisionFlags, effect_or_all, gpu_or_all, method_or_all, one_of, target_or_all,
};
use crate::cli::flags::material::{MaterialFlags, MediumFlags};
use crate::cli::flags::output::CheckReportFlags;
use crate::cli::flags::viewing::GamutFlags;
use crate::cli::junit::verify_junit;
use crate::cli::output::{Output, Progress, check_limit, report_beside};
use crate::cli::places::{refuse_place_of, try_places};
use crate::generator::command_line::CommandLine;
use crate::generator::emit::Naming;
use crate::generator::envelope::Report;
use crate::generator::error::RequestFault;
use crate::generator::output::manifest;
use crate::generator::output::write::OutputFile;
use crate::generator::request::Request;
use crate::lab::gpu::{Backend, Wanted};
use crate::lab::process::{Inbox, Pool};
use crate::lab::verify::merge::Whole;
use crate::lab::verify::requested::{VerifyPlan, plan_of_request};
use crate::lab::verify::run::Devices;
use crate::lab::verify::shard::{
    PartStatement, Shard, ShardOutcome, ShardReport, VARIABLES, devices, shard_of,
};
use crate::lab::verify::{
    AllowedError, MachineStatement, Status, VerifyRow, WITHIN, exhaustive_rows, machine, serve,
    supervise,
};
use crate::language::effects::Effect;
use crate::language::methods::{Gpu, Method};
use crate::language::targets::Target;
use crate::physics::foreign::{lines, one_line};
use crate::physics::materials::ViewingConditions;
use crate::physics::num::Precision;
use crate::pictures::table;

/// The flags of `verify`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  fresnel-gen verify\n  fresnel-gen verify --target gles --material gold --junit verify.xml\n  fresnel-gen verify --exhaustive --method schlick --material gold\n  fresnel-gen verify --shards 8 --shard 3 --json part-3.json\n\nFiles are taken from --out-dir as they lie there; what is not there is generated. Exit codes: 0 all is as promised, 1 something is not, 2 wrong input, 3 a compiler or a driver is missing here, or failed without a word about the files."
)]
pub struct VerifyFlags {
    /// Output language, see `fresnel-gen targets`; all means those written by default [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = target_or_all())]
    pub target: Vec<Choice<&'static Target>>,
    /// Method, see `fresnel-gen methods` [default: all; of a material's file those that it holds]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Effect, see `fresnel-gen effects`, or all: run its functions and nothing else, with R by --method, specialised to --material [default: all where nothing is named]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = effect_or_all(), conflicts_with = "exhaustive")]
    pub effect: Vec<Choice<&'static Effect>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// The medium.
    #[command(flatten)]
    pub medium: MediumFlags,
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: GamutFlags,
    /// Goes before every function's name
    #[arg(long, value_name = "TEXT", default_value = "fresnel_")]
    pub prefix: String,
    /// What functions compute in.
    #[command(flatten)]
    pub precision: PrecisionFlags,
    /// Degrees at which the corrected Schlick meets the exact law [default: that of cosine 0.15, 81.373]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub matching_angle: Option<f64>,
    /// GPU that files which are not there are written for; all: each form of each method too, on all targets [default: as the files say, else that of each target]
    #[arg(long, value_name = "NAME", value_parser = gpu_or_all(), conflicts_with = "exhaustive")]
    pub gpu: Option<Choice<Gpu>>,
    /// Folder whose files are run
    #[arg(long, value_name = "DIR", default_value = "shaders-generated")]
    pub out_dir: PathBuf,
    /// The graphics card, by a part of its name [default: the fastest there is]
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// What WGSL and SPIR-V run on: vulkan or gl (gl has no SPIR-V) [default: vulkan]
    #[arg(long, value_name = "NAME", value_parser = one_of("backend", [Backend::Vulkan, Backend::OpenGl], Backend::name))]
    pub backend: Option<Backend>,
    /// Cosines for each function and material, 100 to 10000000
    #[arg(long, value_name = "N", default_value_t = 20_000)]
    pub points: usize,
    /// Every f32, all 2^32 bit patterns, for the methods and materials named, in WGSL
    #[arg(long, requires_all = ["method", "material"])]
    pub exhaustive: bool,
    /// Folder of compilers, searched before PATH and the folder `tools` beside this program
    #[arg(long, value_name = "DIR")]
    pub tools: Option<PathBuf>,
    /// Seconds that one file may take
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    pub limit: u64,
    /// Run one of so many shares of the work; `fresnel-gen merge` puts their JSON reports together
    #[arg(long, value_name = "N")]
    pub shards: Option<usize>,
    /// Which share, 0 to N-1 [default: SLURM_ARRAY_TASK_ID or JOB_COMPLETION_INDEX]
    #[arg(long, value_name = "I", requires = "shards")]
    pub shard: Option<usize>,
    /// Exit with 3 where anything could not be checked
    #[arg(long)]
    pub require_all: bool,
    /// The report.
    #[command(flatten)]
    pub report: CheckReportFlags,
    /// Read numbers of files and answer with rows
    #[arg(long, hide = true)]
    pub worker: bool,
}

impl VerifyFlags {
    /// The command that makes this report again under these viewing conditions, without paths.
    pub fn command_line(&self, viewing: &ViewingConditions) -> CommandLine {
        let is_half = self.precision.precision == Some(Precision::F16);
        let points = (!self.exhaustive && !is_half).then_some(self.points);
        CommandLine::new("verify")
            .list("target", &self.target)
            .list("effect", &self.effect)
            .list("method", &self.method)
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
            .list("medium", &self.medium.medium)
            .list("prefix", Naming::flag_of_prefix(&self.prefix))
            .seen_as(viewing)
            .list("precision", self.precision.precision.map(Precision::name))
            .switch("force", self.precision.force)
            .list("gpu", &self.gpu)
            .list("matching-angle", self.matching_angle)
            .list("adapter", &self.adapter)
            .list("backend", self.backend.map(Backend::name))
            .switch("exhaustive", self.exhaustive)
            .list("points", points)
    }
}

/// The range of `--points`.
const POINTS: std::ops::RangeInclusive<usize> = 100..=10_000_000;

/// Verifies.
pub fn run(flags: &VerifyFlags, progress: Progress) -> Result<Output, Error> {
    // Opened before the work begins, so that a worker ends with its supervisor at any time.
    let inbox = flags.worker.then(Inbox::open);
    check_limit(flags.limit)?;
    let shard = shard(flags)?;
    let request = request(flags)?;
    let wanted = Wanted {
        backend: flags.backend,
        name: flags.adapter.clone(),
    };
    check_points(flags.points)?;
    let mut plan = plan_of_request(&request, &flags.out_dir)?;
    if matches!(flags.gpu, Some(Choice::All)) {
        plan.add_variants(&request)?;
    }
    if plan.files.is_empty() {
        return Err(RequestFault::NothingToDo {
            work: "run",
            why: "name a method or a material",
        }
        .into());
    }
    if let Some(inbox) = inbox {
        let devices = Devices::new(wanted);
        let served = serve(inbox, &plan, &devices, flags.points, shard.is_some());
        // The supervisor is gone.
        return Ok(Output {
            code: u8::from(served.is_err()),
            ..Output::default()
        });
    }
    if flags.exhaustive && request.precision.is_half() {
        let why = "--exhaustive runs every f32; a run of --precision f16 tries every f16 already";
        return Err(Error::usage(why));
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

/// The shard that this run takes.
fn shard(flags: &VerifyFlags) -> Result<Option<Shard>, Error> {
    let variables = VARIABLES.map(|name| (name, machine::variable(name)));
    Ok(shard_of(flags.shards, flags.shard, &variables)?)
}

fn request(flags: &VerifyFlags) -> Result<Request, Error> {
    Ok(Request {
        targets: Choice::targets(&flags.target),
        methods: Choice::requested(&flags.method),
        effects: Choice::effects(&flags.effect),
        materials: flags.materials.materials()?,
        medium: flags.medium.source()?,
        viewing: flags.viewing.conditions()?,
        prefix: flags.prefix.clone(),
        matching_angle: flags.matching_angle,
        precision: flags.precision.precision(),
        force: flags.precision.force,
        gpu: match flags.gpu {
            Some(Choice::One(_, gpu)) => Some(gpu),
            _ => None,
        },
        ..Request::default()
    })
}

fn check_points(points: usize) -> Result<(), Error> {
    if POINTS.contains(&points) {
        return Ok(());
    }
    Err(RequestFault::OutOfRange {
        flag: "points",
        value: points.to_string(),
        allowed: "is 100 to 10000000".to_owned(),
    }
    .into())
}

/// The report and the exit code.
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
            let (inputs, require_all) = (plan.hash(), flags.require_all);
            let report = ShardReport::new(command, inputs, require_all, shard, outcome);
            shard_report(&report, shard, &flags.report)?
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

/// The remark on files that the run leaves out.
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

/// The report of a shard, and its exit code.
fn shard_report(
    report: &ShardReport,
    shard: Shard,
    files: &CheckReportFlags,
) -> Result<Output, Error> {
    let rows: Vec<VerifyRow> = report.rows.iter().map(|one| one.row.clone()).collect();
    let (dealt, places) = (report.parts.len(), report.places);
    let mut output = in_all_formats(&rows, report, files)?;
    let unrun = remarks_on_parts_without_rows(&report.parts);
    output.remarks.extend(unrun);
    output.remarks.push(format!(
        "shard {} of {}: {dealt} of {places} parts of the run; `fresnel-gen merge` puts the JSON reports of all shards together",
        shard.index(),
        shard.count()
    ));
    output.code = code(&rows, report.require_all, Some(&report.machine));
    Ok(output)
}

/// The report of a whole run, and its exit code.
pub(super) fn whole_report(whole: Whole, files: &CheckReportFlags) -> Result<Output, Error> {
    let rows = whole.rows;
    let full = Report::new(whole.command, rows.clone()).with_device(devices(&rows));
    let mut output = in_all_formats(&rows, &full, files)?;
    let unrun = remarks_on_parts_without_rows(&whole.parts);
    output.remarks.extend(unrun);
    output.code = code(&rows, whole.require_all, None);
    Ok(output)
}

/// The remarks on files without rows: a line for each reason.
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

/// A report in all its formats.
fn in_all_formats<T: Serialize>(
    rows: &[VerifyRow],
    full: &T,
    files: &CheckReportFlags,
) -> Result<Output, Error> {
    let mut junit = Vec::new();
    if let Some(file) = &files.junit {
        junit.push(OutputFile::named(
            file,
            verify_junit(rows).map_err(Error::usage)?,
        ));
    }
    let mut output = report_beside(verify_text(rows), full, files.report.json(), junit)?;
    let is_github = machine::is_github();
    output.remarks.extend(verify_remarks(rows, is_github));
    Ok(output)
}

/// The exit code: 1 for findings; 3 where a target could not be run at all or, with `--require-all`, where anything was not
/// checked. A shard has few rows of a target, and possibly none of them can run anywhere. So it ends with 3 where its machine
/// lacks something.
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

/// How many findings are shown in full; the JSON has all.
const SHOWN: usize = 20;

/// A line for each row, and the share of all numbers that was run.
pub fn verify_text(rows: &[VerifyRow]) -> String {
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
    table::text_table(&head, &rows.iter().map(cells).collect::<Vec<_>>()) + &covered(rows)
}

fn cells(row: &VerifyRow) -> Vec<String> {
    let model = row.model_error.as_ref();
    let most = model.and_then(|error| error.max_abs);
    let mean = model.and_then(|error| error.mean_rel);
    let shown = |cell: Option<String>| cell.unwrap_or_else(|| "-".to_owned());
    vec![
        row.target.clone(),
        match &row.effect {
            Some(_) => row.function.clone(),
            None => row.method.clone(),
        },
        row.material.clone().unwrap_or_default(),
        row.form.name().to_owned(),
        shown(row.points.map(|points| points.to_string())),
        shown(code_error(row)),
        shown(allowed(row)),
        shown(most.map(|most| format!("{most:.5}"))),
        shown(mean.map(|mean| format!("{:.3}", 100.0 * mean))),
        row.status.words().to_owned(),
    ]
}

/// In half precision the absolute error, otherwise ulp.
fn code_error(row: &VerifyRow) -> Option<String> {
    let error = row.code_error.as_ref()?;
    match (error.max_ulp, error.max_abs) {
        (Some(ulp), _) => Some(format!("{ulp:.2}")),
        (None, Some(most)) if row.effect.is_some() => Some(format!("{most:.1e} abs")),
        (None, Some(most)) if row.precision.is_half() => Some(format!("{most:.5} abs")),
        _ => None,
    }
}

fn allowed(row: &VerifyRow) -> Option<String> {
    Some(match row.bound.as_ref()? {
        AllowedError::Ulp { ulp: Some(0.0), .. } => "2^-22".to_owned(),
        AllowedError::Ulp { ulp, .. } => format!("{:.1}", (*ulp)?),
        AllowedError::Absolute { max_abs, .. } => {
            let max_abs = (*max_abs)?;
            if row.effect.is_some() {
                format!("{max_abs:.0e} abs")
            } else if row.precision.is_half() {
                format!("{max_abs:.5} abs")
            } else {
                format!("{max_abs:.1e} abs")
            }
        }
    })
}

/// The share of all numbers that was tried. A sample finds a result that is wrong at a single number only by luck.
fn covered(rows: &[VerifyRow]) -> String {
    let shares = |precision: Precision| {
        let rows = rows.iter().filter(move |row| row.precision == precision);
        rows.filter_map(|row| row.share).reduce(f64::max)
    };
    let mut text = String::new();
    if let Some(share) = shares(Precision::F32) {
        text += "\nA difference within 2^-22 passes, however many ulp it is.";
        let cosines = (share * WITHIN as f64).round();
        let percent = 100.0 * share;
        text += &format!(
            "\nFrom 0 to 1 each function was run at {cosines} cosines at most, {percent:.6} % of the {WITHIN} f32 there are.\n"
        );
        if share < 0.5 {
            text += "A result that is wrong at a single f32 is found by luck only; --exhaustive tries all of them.\n";
        }
    }
    if rows.iter().any(|row| row.effect.is_some()) {
        text += "\nFunctions of effects were run at points of their domains and at their ends. Their error is what lies beyond what the \
                 last bits of the arguments and the steps of a sampler's weights turn.\n";
    }
    if shares(Precision::F16).is_some() {
        text += "\nIn half precision each function was run at every f16 from 0 to 1.\n";
    }
    text
}

fn with_status(rows: &[VerifyRow], status: Status) -> impl Iterator<Item = &VerifyRow> {
    rows.iter().filter(move |row| row.status == status)
}

/// The reasons why something was not checked, each once.
pub fn not_checked(rows: &[VerifyRow]) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for row in rows {
        let target = &row.target;
        let reason = |reason: &Option<String>| reason.clone().unwrap_or_default();
        if row.status == Status::NotChecked {
            all.insert(format!("{target}: {}", reason(&row.reason)));
        }
        let opinions = row.second_opinions.iter();
        for opinion in opinions.filter(|opinion| opinion.status == Status::NotChecked) {
            let why = reason(&opinion.reason);
            all.insert(format!("{target} by {}: {why}", opinion.execution_path));
        }
        for (name, why) in &row.not_asked {
            all.insert(format!("{target} by {name}: {why}"));
        }
    }
    all
}

/// Findings, and what was not checked, for stderr. On GitHub, findings are shown beside the file.
pub fn verify_remarks(rows: &[VerifyRow], is_github: bool) -> Vec<String> {
    // A fault of a file is repeated in all of its rows.
    let mut findings: Vec<String> = Vec::new();
    for row in with_status(rows, Status::Fail) {
        let finding = finding(row, is_github);
        if !findings.contains(&finding) {
            findings.push(finding);
        }
    }
    let more = findings.len().saturating_sub(SHOWN);
    let mut remarks: Vec<String> = findings.into_iter().take(SHOWN).collect();
    if more > 0 {
        remarks.push(format!("… and {more} more, all in the JSON"));
    }
    let own: BTreeSet<&str> = rows
        .iter()
        .filter_map(|row| row.remark.as_deref())
        .collect();
    remarks.extend(
        own.into_iter()
            .map(|remark| format!("remark: {}", lines(remark))),
    );
    let missing = not_checked(rows).into_iter();
    remarks.extend(missing.map(|what| format!("not checked: {}", lines(&what))));
    let count = |status| with_status(rows, status).count();
    remarks.push(format!(
        "{} functions run: {} pass, {} fail, {} not checked",
        rows.len(),
        count(Status::Pass),
        count(Status::Fail),
        count(Status::NotChecked)
    ));
    remarks
}

fn finding(row: &VerifyRow, is_github: bool) -> String {
    let reason = row.reason.as_deref().unwrap_or_default();
    if !is_github {
        return format!("FAIL {}", lines(reason));
    }
    let reason: Vec<String> = reason.lines().map(one_line).collect();
    let (file, reason) = (one_line(&row.file), reason.join("\n"));
    // Escaped as GitHub's own tool escapes a property and a message.
    let line = reason.replace('%', "%25").replace('\n', "%0A");
    let file = file
        .replace('%', "%25")
        .replace(':', "%3A")
        .replace(',', "%2C");
    format!("::error file={file},title=fresnel-gen verify::{line}")
}
