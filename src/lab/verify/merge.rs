//! Merges the shards of one verification: the rows of their reports in the order of a whole run. Shards of different runs are
//! refused, since their rows together prove nothing.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::Value;

use crate::generator::envelope::{SCHEMA, TOOL};
use crate::lab::verify::VerifyRow;
use crate::lab::verify::error::{Error, MergeFault};
use crate::lab::verify::shard::{PartStatement, PlacedRow, PlannedRows, Shard, ShardReport};
use crate::physics::user_text::FileFault;

/// The beginning of the command of a verification.
const COMMAND: &str = "verify";
/// The most missing shards that are named.
const NAMED: usize = 20;
/// The most characters of a report's text that are shown.
const SHOWN: usize = 1000;

/// A shard's report, and its file.
#[derive(Clone, Debug)]
pub struct Part {
    file: PathBuf,
    report: ShardReport,
}

/// A whole run.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// The command.
    pub command: String,
    /// Whether checks that could not be made end it with exit code 3.
    pub require_all: bool,
    /// The rows in their order.
    pub rows: Vec<VerifyRow>,
    /// The outcome at each place, in order.
    pub parts: Vec<PartStatement>,
}

/// What every report begins with, in all versions of the schema.
#[derive(Deserialize)]
#[serde(expecting = "an object")]
struct Head {
    tool: Option<Value>,
    schema: Option<Value>,
    command: Option<Value>,
    shards: Option<Value>,
    version: Option<Value>,
}

/// A shard's report from its text.
///
/// # Errors
/// It is not JSON, or not such a report of this version of the program.
pub fn parsed(file: &Path, text: &str) -> Result<Part, Error> {
    let head: Head = serde_json::from_str(text).map_err(|why| json_fault(file, &why))?;
    if let Some(what) = head.refusal() {
        return Err(refused(file, what));
    }
    let report: ShardReport = serde_json::from_str(text).map_err(|why| json_fault(file, &why))?;
    let Some(shard) = Shard::new(report.shard, report.shards) else {
        let what = format!(
            "it says that it is shard {} of {}, and shards are counted from 0",
            report.shard, report.shards
        );
        return Err(refused(file, what));
    };
    if let Some(what) = row_fault(&report, shard) {
        return Err(refused(file, format!("{what}; run the shard again")));
    }
    let file = file.to_owned();
    Ok(Part { file, report })
}

/// What is wrong with the rows of a report: its places are not those dealt to the shard, or a place's rows are not those that it
/// states.
fn row_fault(report: &ShardReport, shard: Shard) -> Option<String> {
    let (index, count) = (shard.index(), shard.count());
    if report.plan.len() != report.places {
        return Some(format!(
            "it says that the run has {} places, and plans rows of {}",
            report.places,
            report.plan.len()
        ));
    }
    let mut found: BTreeMap<usize, Vec<&PlacedRow>> = BTreeMap::new();
    for row in &report.rows {
        found.entry(row.place).or_default().push(row);
    }
    let spoken_of = report.parts.iter().map(|part| part.place);
    let is_own = |place: &usize| shard.takes(*place) && *place < report.places;
    let mut all = spoken_of.clone().chain(found.keys().copied());
    if let Some(place) = all.find(|place| !is_own(place)) {
        return Some(format!(
            "it has a row of place {place}, which is not dealt to shard {index} of {count}"
        ));
    }
    let dealt = (index..report.places).step_by(count);
    if !spoken_of.eq(dealt) {
        return Some("`parts` does not list each place that is dealt to it once, in order".into());
    }
    let counted = report.parts.iter().find_map(|part| {
        let rows = found.get(&part.place).map_or(&[][..], Vec::as_slice);
        part_fault(part, &report.plan[part.place], rows)
    });
    hidden_character(report).or(counted)
}

/// What is wrong with the rows at a place: some are missing, duplicated or not planned.
fn part_fault(part: &PartStatement, planned: &PlannedRows, found: &[&PlacedRow]) -> Option<String> {
    let PartStatement {
        place, file, rows, ..
    } = part;
    let there = found.len();
    if there != *rows {
        return Some(format!(
            "it says that place {place} has {rows} rows, and {there} are there"
        ));
    }
    if !found.iter().map(|row| row.number).eq(0..*rows) {
        return Some(format!(
            "the rows of place {place} are not numbered 0, 1, 2 and so on: one is missing, is there twice, or was moved"
        ));
    }
    let bare: Vec<&VerifyRow> = found.iter().map(|placed| &placed.row).collect();
    if let Some(row) = bare.iter().find(|row| row.contradicts_itself()) {
        return Some(format!(
            "{} passes, and a compiler refuses its file",
            shown(&row.function)
        ));
    }
    (!planned.are(file, &bare)).then(|| {
        format!("the rows of place {place} are not those that its `plan` has: other functions or materials, or fewer")
    })
}

/// A control character in a name of a report.
fn hidden_character(report: &ShardReport) -> Option<String> {
    let names = |row: &VerifyRow| {
        [
            Some(row.function.clone()),
            row.material.clone(),
            Some(row.method.clone()),
        ]
    };
    let of_rows = report.rows.iter().flat_map(|row| names(&row.row)).flatten();
    let of_parts = report.parts.iter().flat_map(|part| {
        let reason = part.reason.clone().unwrap_or_default();
        [part.file.clone(), reason]
    });
    let hidden = of_rows
        .chain(of_parts)
        .find(|name| name.chars().any(char::is_control))?;
    let hidden = shown(&hidden);
    Some(format!("the name {hidden:?} holds a control character"))
}

impl Head {
    /// Why it is not the head of a shard's report that this program can read.
    fn refusal(&self) -> Option<String> {
        let text =
            |value: &Option<Value>| value.as_ref().and_then(Value::as_str).map(str::to_owned);
        if text(&self.tool).as_deref() != Some(TOOL) {
            return Some("it is no report of fresnel-gen".to_owned());
        }
        let command = shown(&text(&self.command).unwrap_or_default());
        if command.split(' ').next() != Some(COMMAND) {
            return Some(format!(
                "it is the report of `{command}`; only reports of `{COMMAND}` have shards"
            ));
        }
        if self.shards.is_none() {
            return Some("it is the report of a whole run, and not of a shard".to_owned());
        }
        let own = env!("CARGO_PKG_VERSION");
        let version = shown(&text(&self.version).unwrap_or_default());
        let is_same_schema = self.schema.as_ref().and_then(Value::as_u64) == Some(SCHEMA.into());
        (version != own || !is_same_schema).then(|| {
            format!(
                "fresnel-gen {version} wrote it, and this is {own}; run that version's `merge`, or run the shard again with this one"
            )
        })
    }
}

/// The beginning of a text, or all of it.
fn shown(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

fn refused(file: &Path, what: String) -> Error {
    let file = file.to_owned();
    MergeFault::NotAShard { file, what }.into()
}

fn json_fault(file: &Path, why: &serde_json::Error) -> Error {
    let mut words = why.to_string();
    for rust in ["usize", "u64", "u32"] {
        words = words.replace(&format!("expected {rust}"), "expected a whole number");
    }
    let words = shown(words.split(" at line ").next().unwrap_or_default());
    let kind = if why.is_data() {
        "this is no shard's report"
    } else {
        "this cannot be read as JSON"
    };
    Error::File(FileFault {
        file: file.display().to_string(),
        line: why.line().max(1),
        column: why.column().max(1),
        what: format!(
            "{kind}: {words}; `fresnel-gen verify --shards N --shard I --json FILE` writes one"
        ),
    })
}

/// The whole run that these are the shards of.
///
/// # Errors
/// They are not of one run, one of them is there twice, or some are missing.
pub fn merged(parts: Vec<Part>) -> Result<Whole, Error> {
    for (i, part) in parts.iter().enumerate() {
        for other in &parts[..i] {
            part.is_beside(other)?;
        }
    }
    let shards = parts.first().map_or(0, |part| part.report.shards);
    let missing = shards - parts.len();
    if missing > 0 {
        return Err(absent(&parts, shards, missing).into());
    }
    let mut whole = Whole {
        command: String::new(),
        require_all: false,
        rows: Vec::new(),
        parts: Vec::new(),
    };
    let mut rows = Vec::new();
    for part in parts {
        whole.command = part.report.command;
        whole.require_all = part.report.require_all;
        whole.parts.extend(part.report.parts);
        rows.extend(part.report.rows);
    }
    // All rows of a place stand in one report, in order.
    rows.sort_by_key(|placed| placed.place);
    whole.rows = rows.into_iter().map(|placed| placed.row).collect();
    whole.parts.sort_by_key(|part| part.place);
    Ok(whole)
}

/// Which shards are missing.
fn absent(parts: &[Part], shards: usize, count: usize) -> MergeFault {
    let is_there = |shard: &usize| parts.iter().any(|part| part.report.shard == *shard);
    let first = (0..shards).filter(|shard| !is_there(shard)).take(NAMED);
    let mut names: Vec<String> = first.map(|shard| shard.to_string()).collect();
    if count > names.len() {
        names.push(format!("and {} more", count - names.len()));
    }
    MergeFault::Missing {
        count,
        shards,
        names: names.join(", "),
    }
}

impl Part {
    /// Whether it is another shard of the same run.
    fn is_beside(&self, other: &Part) -> Result<(), MergeFault> {
        let (own, its) = (&self.report, &other.report);
        let of_run = run_difference(own, its);
        let of_machine = || {
            let found = own.machine.difference(&its.machine)?;
            Some((format!("`{}` is", found.0), found.1, found.2))
        };
        if let Some((what, here, there)) = of_run.or_else(of_machine) {
            return Err(MergeFault::Differs {
                file: self.file.clone(),
                other: other.file.clone(),
                what: shown(&what),
                here: shown(&here),
                there: shown(&there),
            });
        }
        if own.shard == its.shard {
            return Err(MergeFault::Twice {
                file: self.file.clone(),
                other: other.file.clone(),
                shard: own.shard,
            });
        }
        Ok(())
    }
}

/// The first difference that shows that two shards are not of one run: its name, and its value in each.
fn run_difference(own: &ShardReport, its: &ShardReport) -> Option<(String, String, String)> {
    let differ = |what: &str, here: String, there: String| Some((what.to_owned(), here, there));
    if own.shards != its.shards {
        let [here, there] = [own, its].map(|one| one.shards.to_string());
        return differ("the number of shards is", here, there);
    }
    if own.command != its.command {
        let [here, there] = [own, its].map(|one| format!("`{}`", one.command));
        return differ("the command is", here, there);
    }
    if own.require_all != its.require_all {
        let [here, there] = [own, its].map(|one| {
            if one.require_all {
                "given"
            } else {
                "not given"
            }
        });
        return differ("--require-all is", here.to_owned(), there.to_owned());
    }
    if own.plan != its.plan {
        let [here, there] = [own, its].map(|one| PlannedRows::words(&one.plan));
        return differ("the planned rows differ: there are", here, there);
    }
    if own.inputs != its.inputs {
        let what = "files and materials differ (--out-dir and what lies there, files of your own): their hash is";
        return differ(what, own.inputs.clone(), its.inputs.clone());
    }
    None
}
