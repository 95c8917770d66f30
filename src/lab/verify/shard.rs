//! Shards: a verification divided among machines, and the report of each shard. All machines make the same plan from the same
//! flags, so they agree on the order of the work. Place p goes to shard p mod N.
//!
//! A place is a file, since one process runs it and compilers judge it as a whole. In a run over all numbers it is a function.
//!
//! A shard's report holds its rows and what shows whether other shards are of the same run. `merge` reads it again, so it owns
//! its text and flattens no [`Origin`](crate::generator::envelope::Origin), which is written only.
//!
//! The number of a shard comes from `--shard`, or from a scheduler's variable. The number of shards comes from the command line
//! only: in an array that is run again in part, a scheduler counts the tasks of that part.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::cases::case_materials;
use super::machine::MachineStatement;
use super::requested::{PlannedFile, VerifyPlan};
use super::row::VerifyRow;
use crate::generator::envelope::{SCHEMA, TOOL};
use crate::generator::error::RequestFault;
use crate::generator::reference::MaterialInMedium;
use crate::physics::digest::sha256;

/// One of `count` shards of a verification.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// All of the work.
    pub const WHOLE: Shard = Shard { index: 0, count: 1 };

    /// The shard with this number, from 0, of so many. None where there are fewer.
    pub fn new(index: usize, count: usize) -> Option<Shard> {
        (index < count).then_some(Shard { index, count })
    }

    /// Its number, from 0.
    pub fn index(self) -> usize {
        self.index
    }

    /// How many there are.
    pub fn count(self) -> usize {
        self.count
    }

    /// Whether the work at this place is dealt to it.
    pub fn takes(self, place: usize) -> bool {
        place % self.count == self.index
    }
}

/// The outcome of the work at one place of the whole run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PartStatement {
    /// The place.
    pub place: usize,
    /// The file that was run, relative to the output folder.
    pub file: String,
    /// The number of its rows.
    pub rows: usize,
    /// Why there are none.
    pub reason: Option<String>,
}

/// The rows that the whole run will have at a place, which all shards know beforehand. They are hashes, since there are many.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(expecting = "an object")]
pub struct PlannedRows {
    /// The hash of the rows.
    pub rows: String,
    /// The hash of the rows where the run of the file times out or crashes: one for each function.
    pub unfinished: String,
}

impl PlannedRows {
    /// The planned rows of a file: these functions with their materials.
    pub fn new(file: &PlannedFile, rows: &[(&str, Option<&str>)]) -> PlannedRows {
        let path = &file.run_page().path;
        let functions = file.functions.iter();
        PlannedRows {
            rows: hash_of_rows(path, rows.iter().copied()),
            unfinished: hash_of_rows(path, functions.map(|one| (one.name.as_str(), None))),
        }
    }

    /// A summary of a plan that differs where plans do.
    pub fn words(plan: &[PlannedRows]) -> String {
        let hashes = plan.iter().flat_map(|one| [&one.rows, &one.unfinished]);
        let all: Vec<&str> = hashes.map(String::as_str).collect();
        let hash = sha256(all.concat().as_bytes());
        format!("{} places of hash {hash}", plan.len())
    }

    /// Whether these rows of a file are the planned ones.
    pub fn are(&self, file: &str, rows: &[&VerifyRow]) -> bool {
        let named = rows.iter();
        let named = named.map(|row| (row.function.as_str(), row.material.as_deref()));
        let hash = hash_of_rows(file, named);
        hash == self.rows || hash == self.unfinished
    }
}

fn hash_of_rows<'a>(file: &str, rows: impl Iterator<Item = (&'a str, Option<&'a str>)>) -> String {
    let mut all = format!("{file}\n");
    for row in rows {
        all += &format!("{row:?}\n");
    }
    sha256(all.as_bytes())
}

/// A row, and its place in the whole run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlacedRow {
    /// The place.
    pub place: usize,
    /// Its number among the rows of that place, from 0.
    pub number: usize,
    /// The row.
    #[serde(flatten)]
    pub row: VerifyRow,
}

/// The outcome of a shard's work.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShardOutcome {
    /// The rows, in the order of their places.
    pub rows: Vec<PlacedRow>,
    /// What the machine has for that work. Empty for a whole run.
    pub machine: MachineStatement,
    /// The outcome at each place that was dealt to it, in order.
    pub parts: Vec<PartStatement>,
    /// The planned rows of each place of the whole run.
    pub plan: Vec<PlannedRows>,
}

impl ShardOutcome {
    /// Adds the rows of a file at a place.
    pub fn add(&mut self, place: usize, file: &PlannedFile, rows: Vec<VerifyRow>) {
        self.parts.push(PartStatement {
            place,
            file: file.run_page().path.clone(),
            rows: rows.len(),
            reason: rows.is_empty().then(|| file.why_no_row().to_owned()),
        });
        let numbered = rows.into_iter().enumerate();
        self.rows
            .extend(numbered.map(|(number, row)| PlacedRow { place, number, row }));
    }

    /// The rows without their places.
    pub fn bare_rows(&self) -> Vec<VerifyRow> {
        self.rows.iter().map(|placed| placed.row.clone()).collect()
    }
}

impl VerifyPlan {
    /// The planned rows of each file.
    pub fn planned_rows(&self) -> Vec<PlannedRows> {
        let of_file = |file: &PlannedFile| {
            let mut rows = Vec::new();
            for emitted in &file.functions {
                if emitted.effect.is_some() {
                    rows.push((emitted.name.as_str(), None));
                    continue;
                }
                let materials = case_materials(self, file, emitted).into_iter();
                rows.extend(materials.map(|material| (emitted.name.as_str(), Some(material))));
            }
            PlannedRows::new(file, &rows)
        };
        self.files.iter().map(of_file).collect()
    }

    /// The hash of what is run: the files with their text, what functions promise, and the materials with their data. Shards of
    /// one run share it, and it differs between runs even where the commands are equal.
    pub fn hash(&self) -> String {
        let mut all = String::new();
        for page in self.files.iter().flat_map(|file| &file.pages) {
            let hash = sha256(&page.bytes);
            all += &format!("{} {hash} {}\n", page.path, page.is_shipped);
        }
        for function in self.files.iter().flat_map(|file| &file.functions) {
            all += &format!("{} {:?}\n", function.name, function.code);
        }
        for subject in self.subjects.iter().chain(&self.others) {
            all += &of_material(subject);
        }
        sha256(all.as_bytes())
    }
}

fn of_material(subject: &MaterialInMedium) -> String {
    let MaterialInMedium {
        argument,
        material,
        medium,
        derivation,
        ..
    } = subject;
    format!("{argument} {material:?} {medium:?} {derivation:?}\n")
}

/// The report of a shard.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(expecting = "an object")]
pub struct ShardReport {
    /// The program.
    pub tool: String,
    /// The version of the report's schema.
    pub schema: u32,
    /// The command of the whole run.
    pub command: String,
    /// The number of the shard, from 0.
    pub shard: usize,
    /// How many there are.
    pub shards: usize,
    /// The version of the program.
    pub version: String,
    /// The hash of the files and materials that the whole run is about.
    pub inputs: String,
    /// Whether checks that could not be made end the run with exit code 3.
    pub require_all: bool,
    /// What the machine has, for the files that were dealt to the shard.
    pub machine: MachineStatement,
    /// The devices of the rows.
    pub device: Option<String>,
    /// How many places the whole run has.
    pub places: usize,
    /// The planned rows of each place.
    pub plan: Vec<PlannedRows>,
    /// The outcome at each place that was dealt to the shard. It shows whether a report has lost rows.
    pub parts: Vec<PartStatement>,
    /// Its rows with their places in the whole run.
    pub rows: Vec<PlacedRow>,
}

impl ShardReport {
    /// The report of a shard's outcome. `command` is that of the whole run, without the flags of shards, and `inputs` the hash of
    /// the files and materials that it is about.
    pub fn new(
        command: String,
        inputs: String,
        require_all: bool,
        shard: Shard,
        outcome: ShardOutcome,
    ) -> ShardReport {
        ShardReport {
            tool: TOOL.to_owned(),
            schema: SCHEMA,
            command,
            shard: shard.index(),
            shards: shard.count(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            inputs,
            require_all,
            device: devices(&outcome.bare_rows()),
            machine: outcome.machine,
            places: outcome.plan.len(),
            plan: outcome.plan,
            parts: outcome.parts,
            rows: outcome.rows,
        }
    }
}

/// The devices of all rows, each once; none where nothing ran.
pub fn devices(rows: &[VerifyRow]) -> Option<String> {
    let names: BTreeSet<&str> = rows
        .iter()
        .filter_map(|row| row.device.as_deref())
        .collect();
    let names: Vec<&str> = names.into_iter().collect();
    (!names.is_empty()).then(|| names.join("; "))
}

/// An environment variable, and its value where it is set.
pub type Variable = (&'static str, Option<String>);

/// The variables in which schedulers number tasks from 0: Slurm's arrays, and Indexed Jobs of Kubernetes.
pub const VARIABLES: [&str; 2] = ["SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"];

/// The shard of a run. None where the run is whole. Variables count only where `--shards` stands without `--shard`.
///
/// # Errors
/// There is no such shard, or nothing says which one it is, or two variables contradict each other.
pub fn shard_of(
    shards: Option<usize>,
    shard: Option<usize>,
    variables: &[Variable],
) -> Result<Option<Shard>, RequestFault> {
    let Some(count) = shards else {
        return Ok(None);
    };
    if count == 0 {
        return Err(RequestFault::OutOfRange {
            flag: "shards",
            value: "0".to_owned(),
            allowed: "is 1 or more".to_owned(),
        });
    }
    let (said_by, index) = match shard {
        Some(index) => ("--shard", index),
        None => said(count, variables)?,
    };
    let found = Shard::new(index, count);
    found.map(Some).ok_or_else(|| {
        RequestFault::refused(format!(
            "{said_by} is {index}; shards are counted from 0, so that with --shards {count} it is 0 to {}",
            count - 1
        ))
    })
}

/// The number of the task by the variables that are set.
fn said(count: usize, variables: &[Variable]) -> Result<(&'static str, usize), RequestFault> {
    let mut said: Vec<(&'static str, usize)> = Vec::new();
    for (name, value) in variables {
        if let Some(value) = value {
            said.push((name, number(name, value)?));
        }
    }
    let Some(first) = said.first() else {
        return Err(RequestFault::refused(format!(
            "--shards {count} does not say which shard this is. Add --shard I, where I is 0 to {}, or run it in a Slurm array or in an \
             Indexed Job of Kubernetes: those set {}",
            count - 1,
            VARIABLES.join(" and ")
        )));
    };
    match said.iter().find(|other| other.1 != first.1) {
        None => Ok(*first),
        Some(other) => Err(RequestFault::refused(format!(
            "{} is {} and {} is {}, so that this could be either shard; say which with --shard I",
            first.0, first.1, other.0, other.1
        ))),
    }
}

fn number(name: &str, value: &str) -> Result<usize, RequestFault> {
    let digits = !value.is_empty() && value.bytes().all(|byte| byte.is_ascii_digit());
    let number = digits.then(|| value.parse().ok()).flatten();
    number.ok_or_else(|| {
        RequestFault::refused(format!(
            "{name} is `{value}`, which is not the number of a shard; unset it, or say which shard this is with --shard I"
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_goes_to_one_shard() {
        for count in [1, 2, 3, 7, 64, 1000] {
            let shards: Vec<Shard> = (0..count)
                .map(|index| Shard::new(index, count).unwrap())
                .collect();
            for place in 0..200 {
                let takers = shards.iter().filter(|shard| shard.takes(place));
                assert_eq!(takers.count(), 1, "place {place} of {count} shards");
            }
        }
    }

    #[test]
    fn shares_are_as_equal_as_can_be() {
        for count in [2, 3, 7] {
            let sizes = (0..count).map(|index| {
                let shard = Shard::new(index, count).unwrap();
                (0..100).filter(|place| shard.takes(*place)).count()
            });
            let sizes: Vec<usize> = sizes.collect();
            let (least, most) = (sizes.iter().min(), sizes.iter().max());
            assert!(most.unwrap() - least.unwrap() <= 1, "{sizes:?}");
        }
    }

    #[test]
    fn numbers_begin_at_0() {
        assert!((0..100).all(|place| Shard::WHOLE.takes(place)));
        assert_eq!(Shard::new(4, 4), None);
        assert_eq!(Shard::new(0, 0), None);
        assert!(Shard::new(usize::MAX - 1, usize::MAX).is_some());
    }

    const SLURM: &str = VARIABLES[0];
    const KUBERNETES: &str = VARIABLES[1];

    fn variables(slurm: Option<&str>, kubernetes: Option<&str>) -> [Variable; 2] {
        [
            (SLURM, slurm.map(str::to_owned)),
            (KUBERNETES, kubernetes.map(str::to_owned)),
        ]
    }

    #[track_caller]
    fn check(shards: usize, shard: Option<usize>, set: [Variable; 2], expected: usize) {
        let found = shard_of(Some(shards), shard, &set).unwrap().unwrap();
        assert_eq!((found.index(), found.count()), (expected, shards));
    }

    #[track_caller]
    fn refused(shards: usize, shard: Option<usize>, set: [Variable; 2], says: &[&str]) {
        let why = shard_of(Some(shards), shard, &set).unwrap_err().to_string();
        for text in says {
            assert!(why.contains(text), "{text} is not in {why}");
        }
    }

    #[test]
    fn the_flag_is_believed_before_any_variable() {
        check(4, Some(2), variables(None, None), 2);
        check(4, Some(2), variables(Some("3"), Some("nonsense")), 2);
        check(4, None, variables(Some("3"), None), 3);
        check(4, None, variables(None, Some("0")), 0);
        check(4, None, variables(Some("1"), Some("01")), 1);
    }

    #[test]
    fn without_shards_no_variable_counts() {
        let set = variables(Some("x"), Some("9"));
        assert_eq!(shard_of(None, None, &set).unwrap(), None);
    }

    #[test]
    fn what_names_no_shard_is_refused() {
        let none = || variables(None, None);
        refused(4, None, none(), &["--shard I", "0 to 3", SLURM, KUBERNETES]);
        refused(0, Some(0), none(), &["--shards is 0", "1 or more"]);
        refused(4, Some(4), none(), &["--shard is 4", "0 to 3"]);
        refused(4, None, variables(Some("4"), None), &[SLURM, "0 to 3"]);
        for value in ["", "-1", "+1", " 1", "1.0", "one", "99999999999999999999"] {
            refused(4, None, variables(None, Some(value)), &[KUBERNETES, value]);
        }
        let both = variables(Some("1"), Some("2"));
        refused(4, None, both, &[SLURM, KUBERNETES, "--shard I"]);
    }
}
