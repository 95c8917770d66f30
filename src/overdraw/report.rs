//! The report: a row for each function, and what is told of the machine.

use serde_json::{Value, json};

use crate::ir::Ty;
use crate::overdraw::{Clock, Figure, Hello, Measured, Noise, Timed};
use crate::report::SCHEMA;
use crate::report::table;

use super::asked::Asked;

/// What was measured, with what is known of it.
pub struct Report<'a> {
    /// What was asked for.
    pub asked: &'a Asked,
    /// What it was drawn on.
    pub hello: &'a Hello,
    /// What was read.
    pub measured: &'a Measured,
}

/// A function and what it costs.
pub struct Row<'a> {
    method: &'static str,
    material: Option<&'a str>,
    form: &'static str,
    channels: u8,
    precision: &'static str,
    /// What it costs, or why that is not known.
    pub figure: Result<Figure, String>,
    /// Whether this machine cannot do it at all.
    pub is_lacking: bool,
}

impl<'a> Report<'a> {
    /// The rows, in the order of the plan.
    pub fn rows(&self) -> Vec<Row<'a>> {
        let asked = self.asked;
        let figures = self.measured.figures(&asked.plan, self.hello.pixels);
        let functions = asked.functions.iter().zip(figures);
        let row = |((timed, material), figure): (&'a (Timed, Option<String>), _)| {
            let emitted = &timed.emitted;
            let is_lacking = emitted.precision.is_half() && !self.hello.has_half;
            let figure = if is_lacking {
                Err(self.hello.no_half())
            } else {
                figure
            };
            Row {
                method: emitted.method.name,
                material: material.as_deref(),
                form: emitted.form,
                channels: if emitted.function.ty() == Ty::Scalar {
                    1
                } else {
                    3
                },
                precision: emitted.precision.name(),
                figure,
                is_lacking,
            }
        };
        functions.map(row).collect()
    }

    /// The whole as JSON.
    pub fn json(&self, command: &str, rows: &[Row]) -> Value {
        let [heavy, empty] = self.measured.noise();
        let rows: Vec<Value> = rows.iter().map(|row| self.row(row)).collect();
        json!({
            "tool": "fresnel-gen", "schema": SCHEMA, "command": command, "device": self.hello.device,
            "adapter": self.hello.name, "driver": self.hello.driver, "software": self.hello.is_software,
            "clock": self.measured.clock.name(), "pixels": self.hello.pixels,
            "noise": { "heavy": noise(&heavy), "empty": noise(&empty) },
            "left_out": self.asked.left_out, "rows": rows,
        })
    }

    fn row(&self, row: &Row) -> Value {
        let figure = row.figure.as_ref().ok();
        let number = |one: fn(&Figure) -> f64| figure.map(one).filter(|value| value.is_finite());
        let interval = figure.and_then(|figure| figure.interval);
        json!({
            "method": row.method, "material": row.material, "form": row.form, "channels": row.channels,
            "precision": row.precision,
            "ns_per_pixel": number(|f| f.ns_per_pixel), "share": number(|f| f.share), "spread": number(|f| f.spread),
            "low": interval.map(|(low, _)| low), "high": interval.map(|(_, high)| high),
            "net_ns_per_pixel": number(|f| f.net_ns_per_pixel),
            "empty_ns_per_pixel": number(|f| f.empty_ns_per_pixel),
            "gpu_ns_per_pixel": number(|f| f.gpu_ns_per_pixel),
            "wall_ns_per_pixel": number(|f| f.wall_ns_per_pixel),
            "clock": self.measured.clock.name(), "draws": figure.map(|f| f.draws),
            "evaluations": self.asked.plan.evaluations, "rounds": self.measured.rounds.len(),
            "reason": reason(row, interval.is_some()),
        })
    }

    /// What a reader must know of the table.
    fn head(&self) -> String {
        let [heavy, empty] = self.measured.noise();
        let clock = match self.measured.clock {
            Clock::Gpu => "the device's timestamps",
            Clock::Cpu => "the processor's time of the process that draws",
            Clock::Wall => "wall time",
        };
        format!(
            "{}\n{} pixels, {} evaluations a draw, {} rounds, by {clock}\nnoise of this machine:\n  {}\n  {}\n\n",
            self.hello.device,
            self.hello.pixels,
            self.asked.plan.evaluations,
            self.measured.rounds.len(),
            said("the heavy shader alone", &heavy),
            said("the empty shader over it", &empty),
        )
    }
}

/// What a shader's readings vary by.
fn said(name: &str, noise: &Noise) -> String {
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

fn noise(noise: &Noise) -> Value {
    let finite = |value: f64| Some(value).filter(|value| value.is_finite());
    json!({ "spread": finite(noise.spread), "slowest": finite(noise.slowest), "readings": noise.readings })
}

fn reason(row: &Row, has_interval: bool) -> Option<String> {
    match &row.figure {
        Err(why) => Some(why.clone()),
        Ok(_) if !has_interval => Some("an interval takes 29 rounds".to_owned()),
        Ok(_) => None,
    }
}

/// The report as a table, the cheapest first; what was not measured comes last.
pub fn text(report: &Report, rows: &[Row]) -> String {
    let share = |row: &Row| {
        row.figure
            .as_ref()
            .map_or(f64::INFINITY, |figure| figure.share)
    };
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by(|a, b| share(a).total_cmp(&share(b)));
    let cells: Vec<Vec<String>> = sorted.into_iter().map(cells).collect();
    let head = [
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
    report.head() + &table::text(&head, &cells)
}

fn percent(share: f64) -> String {
    if share.is_finite() {
        format!("{:.1}%", 100.0 * share)
    } else {
        "-".to_owned()
    }
}

fn cells(row: &Row) -> Vec<String> {
    let mut cells = vec![
        row.method.to_owned(),
        row.material.unwrap_or("-").to_owned(),
        row.form.to_owned(),
        row.channels.to_string(),
        row.precision.to_owned(),
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
