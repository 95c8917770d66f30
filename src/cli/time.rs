//! `time`: measures what functions cost on this machine's device.

use core::fmt::Display;
use core::time::Duration;
use std::collections::BTreeSet;

use clap::Args;
use serde::Serialize;

use crate::cli::error::Error;
use crate::cli::flags::choice::{Choice, each_once, method_or_all, one_of, precision};
use crate::cli::flags::material::MaterialFlags;
use crate::cli::flags::output::ReportFlags;
use crate::cli::output::{Output, Progress, report};
use crate::cli::places::try_places;
use crate::generator::command_line::CommandLine;
use crate::generator::envelope::Origin;
use crate::generator::error::RequestFault;
use crate::lab::gpu::{Backend, Wanted};
use crate::lab::overdraw::{
    Clock, DeviceFacts, DrawingEffort, DrawingWorker, Noise, Stop, TimeRequest, TimeRow, measure,
    serve, time_rows, usual_operations,
};
use crate::lab::process::Inbox;
use crate::language::methods::Method;
use crate::physics::foreign::{lines, one_line};
use crate::physics::num::Precision;
use crate::pictures::table;

/// The backends that can draw. OpenGL ES only runs vertex shaders here, and draws nothing.
const DRAWING_BACKENDS: [Backend; 4] = [
    Backend::Vulkan,
    Backend::Metal,
    Backend::Direct3d12,
    Backend::OpenGl,
];

/// The flags of `time`.
#[derive(Args, Debug)]
#[command(
    mut_arg("material", |arg| arg.help("Materials that methods are specialised to, beside the library: names, paths of files, all, or none [default: gold, water]")),
    after_help = "Examples:\n  fresnel-gen time\n  fresnel-gen time --method schlick,conductor_exact --material gold --json times.json\n  fresnel-gen time --hardware --size 2048\n\nA share is the cost of one evaluation over that of dielectric_exact's library function, both net of the empty shader. Exit codes: 0 done, 1 a shader failed or took longer than --limit, 2 wrong input, 3 something is missing here."
)]
pub struct TimeFlags {
    /// Method, see `fresnel-gen methods` [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = method_or_all())]
    pub method: Vec<Choice<&'static Method>>,
    /// Which materials.
    #[command(flatten)]
    pub materials: MaterialFlags,
    /// What functions compute in: f32, f16 [default: each]
    #[arg(long, value_delimiter = ',', value_name = "NAME", value_parser = precision())]
    pub precision: Vec<Precision>,
    /// The graphics card, by a part of its name [default: the fastest there is]
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// The interface: vulkan, metal, dx12 or gl [default: the first of these that is there]
    #[arg(long, value_name = "NAME", value_parser = one_of("backend", DRAWING_BACKENDS, Backend::name))]
    pub backend: Option<Backend>,
    /// Refuse an adapter that is software
    #[arg(long)]
    pub hardware: bool,
    /// Clock: gpu (the device's timestamps), cpu (CPU time, for software renderers) or wall [default: cpu of software, else gpu where its timestamps advance, else wall]
    #[arg(long, value_name = "NAME", value_parser = one_of("clock", Clock::ALL, Clock::name))]
    pub clock: Option<Clock>,
    /// Pixels a side of the square target, 16 to 8192 [default: 256 in software, else 1024]
    #[arg(long, value_name = "PIXELS")]
    pub size: Option<u32>,
    /// Operations in a draw, 100 to 20000, about: evaluations of a function, each from the result before, and of half as many. More where the cost of the draw itself hides a function [default: 400 in software, else 2000]
    #[arg(long, value_name = "N")]
    pub operations: Option<usize>,
    /// Rounds, 1 to 1000. Each draws every shader once, and the reference shader beside every sixth
    #[arg(long, value_name = "N", default_value_t = 75)]
    pub rounds: usize,
    /// Seconds that a single submission may take
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    pub limit: f64,
    /// Exit with 3 where anything could not be measured here
    #[arg(long)]
    pub require_all: bool,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
    /// Draw what is asked for, and answer with readings
    #[arg(long, hide = true)]
    pub worker: bool,
}

impl TimeFlags {
    /// The command that makes this report again, without paths.
    pub fn command_line(&self) -> CommandLine {
        CommandLine::new("time")
            .list("method", &self.method)
            .list("material", self.materials.choices())
            .each("film", &self.materials.film)
            .list(
                "precision",
                self.precision.iter().map(|precision| precision.name()),
            )
            .list("adapter", &self.adapter)
            .list("backend", self.backend.map(Backend::name))
            .switch("hardware", self.hardware)
            .list("clock", self.clock.map(Clock::name))
            .list("size", self.size)
            .list("operations", self.operations)
            .number("rounds", self.rounds)
    }
}

/// The limits of a run: pixels a side, operations in a chain, rounds, and seconds of a submission.
const SIZES: std::ops::RangeInclusive<u32> = 16..=8192;
const OPERATIONS: std::ops::RangeInclusive<usize> = 100..=20_000;
const ROUNDS: std::ops::RangeInclusive<usize> = 1..=1000;
const SECONDS: std::ops::RangeInclusive<f64> = 1e-6..=3600.0;

/// Measures.
pub fn run(flags: &TimeFlags, progress: Progress) -> Result<Output, Error> {
    // Opened before the work begins, so that a worker ends with its supervisor at any time.
    let inbox = flags.worker.then(Inbox::open);
    check(flags)?;
    let wanted = Wanted {
        backend: flags.backend,
        name: flags.adapter.clone(),
    };
    let timed = TimeRequest {
        methods: Choice::methods(&flags.method),
        materials: flags.materials.materials()?,
        precisions: each_once(&flags.precision),
    }
    .timed_functions()?;
    let plan = |is_software| {
        let usual = usual_operations(is_software);
        timed.plan(flags.operations.unwrap_or(usual))
    };
    if let Some(inbox) = inbox {
        let served = serve(inbox, &plan, &wanted, flags.size);
        // The supervisor is gone.
        return Ok(Output {
            code: u8::from(served.is_err()),
            ..Output::default()
        });
    }
    try_places(flags.report.json(), None)?;
    let limit = Duration::from_secs_f64(flags.limit);
    let mut worker = DrawingWorker::start(limit)?;
    check_device(flags, &worker.device, &wanted)?;
    let plan = plan(worker.device.is_software);
    worker.takes(&plan);
    let effort = DrawingEffort {
        rounds: flags.rounds,
        clock: flags.clock,
        is_software: worker.device.is_software,
        limit: limit.as_nanos() as f64,
    };
    let measured = measure(&plan, &effort, &mut worker, progress).map_err(|stop| {
        let (Stop::One(why) | Stop::All(why)) = stop;
        let what = format!("{}: {why}", worker.device.device);
        Error::lacking(what)
    })?;
    let rows = time_rows(&timed.functions, &plan, &worker.device, &measured);
    let [heavy, empty] = measured.noise();
    let times = TimeReport {
        origin: Origin::new(flags.command_line()),
        device: &worker.device.device,
        adapter: &worker.device.name,
        driver: &worker.device.driver,
        software: worker.device.is_software,
        clock: measured.clock,
        pixels: worker.device.pixels,
        noise: NoiseOfShaders { heavy, empty },
        left_out: &timed.left_out,
        rows: &rows,
        operations: plan.operations,
        rounds: flags.rounds,
    };
    let mut output = report(times.text(), &times, flags.report.json())?;
    output.remarks = remarks(&timed.left_out, &rows, flags.clock, measured.clock);
    output.code = code(flags, &rows);
    Ok(output)
}

fn check_device(flags: &TimeFlags, facts: &DeviceFacts, wanted: &Wanted) -> Result<(), Error> {
    if flags.hardware && facts.is_software {
        return Err(no_hardware(facts, wanted));
    }
    if flags.clock == Some(Clock::Cpu) && !facts.is_software {
        let device = &facts.device;
        let why =
            format!("--clock cpu is for software; {device} does not compute on the processor");
        return Err(Error::usage(why));
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

/// The failures, each reason once; what was left out; and the clock, where it was not requested.
fn remarks(
    left_out: &[String],
    rows: &[TimeRow],
    requested: Option<Clock>,
    clock: Clock,
) -> Vec<String> {
    let mut remarks = Vec::new();
    for (is_lacking, word) in [(false, "FAIL"), (true, "not measured")] {
        let wanted = rows.iter().filter(|row| row.is_lacking == is_lacking);
        let whys = wanted.filter_map(|row| row.figure.as_ref().err());
        let whys: BTreeSet<String> = whys.map(|why| format!("{word}: {}", lines(why))).collect();
        remarks.extend(whys);
    }
    let left_out = left_out.iter();
    remarks.extend(left_out.map(|why| format!("left out: {}", one_line(why))));
    if requested.is_none() {
        remarks.extend(chosen(clock).map(str::to_owned));
    }
    remarks
}

/// Why this clock was chosen, if it is not the device's own.
fn chosen(clock: Clock) -> Option<&'static str> {
    match clock {
        Clock::Gpu => None,
        Clock::Cpu => Some(
            "the device is software: measured by the processor's time, in which other programs are not; --clock gpu takes its timestamps",
        ),
        Clock::Wall => {
            Some("the device's timestamps do not advance, or it has none: measured by wall time")
        }
    }
}

/// The exit code: 1 where a shader failed; 3 where this machine cannot run some and all were required.
fn code(flags: &TimeFlags, rows: &[TimeRow]) -> u8 {
    let fails = |row: &TimeRow| row.figure.is_err() && !row.is_lacking;
    if rows.iter().any(fails) {
        1
    } else if flags.require_all && rows.iter().any(|row| row.is_lacking) {
        3
    } else {
        0
    }
}

/// The readings, with the facts about the measurement.
#[derive(Serialize)]
struct TimeReport<'a> {
    #[serde(flatten)]
    origin: Origin,
    device: &'a str,
    adapter: &'a str,
    driver: &'a str,
    software: bool,
    clock: Clock,
    pixels: u64,
    noise: NoiseOfShaders,
    left_out: &'a [String],
    rows: &'a [TimeRow],
    #[serde(skip)]
    operations: usize,
    #[serde(skip)]
    rounds: usize,
}

/// The noise of the two shaders without a function.
#[derive(Serialize)]
struct NoiseOfShaders {
    heavy: Noise,
    empty: Noise,
}

impl TimeReport<'_> {
    /// The report as a table, the cheapest first; what was not measured stands last.
    fn text(&self) -> String {
        let share = |row: &TimeRow| {
            let figure = row.figure.as_ref();
            figure.map_or(f64::INFINITY, |figure| figure.share)
        };
        let mut sorted: Vec<&TimeRow> = self.rows.iter().collect();
        sorted.sort_by(|a, b| share(a).total_cmp(&share(b)));
        let cells: Vec<Vec<String>> = sorted.into_iter().map(cells).collect();
        self.head() + &table::text_table(&COLUMNS, &cells)
    }

    /// What a reader must know before the table.
    fn head(&self) -> String {
        let clock = match self.clock {
            Clock::Gpu => "the device's timestamps",
            Clock::Cpu => "the processor's time of the process that draws",
            Clock::Wall => "wall time",
        };
        format!(
            "{}\n{} pixels, chains of about {} and {} operations, {} rounds, by {clock}\nnoise of this machine:\n  {}\n  {}\n\n",
            self.device,
            self.pixels,
            self.operations / 2,
            self.operations,
            self.rounds,
            noise_text("the heavy shader alone", &self.noise.heavy),
            noise_text("the empty shader over it", &self.noise.empty),
        )
    }
}

const COLUMNS: [&str; 9] = [
    "method",
    "material",
    "form",
    "channels",
    "precision",
    "ns a pixel",
    "share",
    "spread",
    "95 % interval",
];

/// The noise of a shader's readings.
fn noise_text(name: &str, noise: &Noise) -> String {
    if noise.readings == 0 {
        return format!("{name}: not read");
    }
    format!(
        "{name}: {} readings, half of them within {:.1} %, one in twenty slower than {:.2} times the median",
        noise.readings,
        100.0 * noise.spread,
        noise.slowest,
    )
}

fn percent(share: f64) -> String {
    if share.is_finite() {
        format!("{:.1}%", 100.0 * share)
    } else {
        "-".to_owned()
    }
}

fn cells(row: &TimeRow) -> Vec<String> {
    let id = &row.id;
    let mut cells = vec![
        id.method_name().unwrap_or_default().to_owned(),
        id.material.as_deref().unwrap_or("-").to_owned(),
        id.form.name().to_owned(),
        id.channels.to_string(),
        id.precision.name().to_owned(),
    ];
    match &row.figure {
        Ok(figure) => cells.extend([
            format!("{:.4}", figure.ns_per_pixel),
            format!("{:.3}", figure.share),
            percent(figure.spread),
            figure.interval.map_or("-".to_owned(), |(low, high)| {
                format!("{low:.3} to {high:.3}")
            }),
        ]),
        Err(_) => cells.extend(["-", "-", "-", "-"].map(str::to_owned)),
    }
    cells
}
