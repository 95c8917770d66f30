//! The report of times: a row for each function, and what is known of the machine.

use serde::Serialize;

use crate::lab::overdraw::{Clock, DeviceFacts, MeasuredDrawings, Noise, TimeRow, TimedFunctions};

use crate::generator::envelope::Origin;
use crate::pictures::table;

/// What was measured, with what is known of it.
#[derive(Serialize)]
pub struct TimeReport<'a> {
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

/// What the two shaders without a function vary by.
#[derive(Serialize)]
struct NoiseOfShaders {
    heavy: Noise,
    empty: Noise,
}

impl<'a> TimeReport<'a> {
    /// The report that this command writes.
    pub fn new(
        command: String,
        timed: &'a TimedFunctions,
        device: &'a DeviceFacts,
        measured: &MeasuredDrawings,
        rows: &'a [TimeRow],
    ) -> TimeReport<'a> {
        let [heavy, empty] = measured.noise();
        TimeReport {
            origin: Origin::new(command),
            device: &device.device,
            adapter: &device.name,
            driver: &device.driver,
            software: device.is_software,
            clock: measured.clock,
            pixels: device.pixels,
            noise: NoiseOfShaders { heavy, empty },
            left_out: &timed.left_out,
            rows,
            operations: timed.plan.operations,
            rounds: measured.rounds.len(),
        }
    }

    /// The report as a table, the cheapest first; what was not measured comes last.
    pub fn text(&self) -> String {
        let share = |row: &TimeRow| {
            let figure = row.figure.as_ref();
            figure.map_or(f64::INFINITY, |figure| figure.share)
        };
        let mut sorted: Vec<&TimeRow> = self.rows.iter().collect();
        sorted.sort_by(|a, b| share(a).total_cmp(&share(b)));
        let cells: Vec<Vec<String>> = sorted.into_iter().map(cells).collect();
        self.head() + &table::text_table(&COLUMNS, &cells)
    }

    /// What a reader must know of the table.
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

/// What a shader's readings vary by.
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
    let mut cells = vec![
        row.method.to_owned(),
        row.material.as_deref().unwrap_or("-").to_owned(),
        row.form.name().to_owned(),
        row.channels.to_string(),
        row.precision.name().to_owned(),
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
