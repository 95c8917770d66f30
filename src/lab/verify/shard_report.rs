//! The report of a shard of a verification: what the report of a whole run says of it, and what tells whether other shards are of
//! the same run. `merge` reads it again, so that it owns its text and flattens no [`Origin`](crate::generator::envelope::Origin), which is written only.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::generator::envelope::{SCHEMA, TOOL};
use crate::lab::verify::shard::{PartStatement, PlacedRow, PlannedRows, Shard, ShardOutcome};
use crate::lab::verify::{MachineStatement, VerifyRow};

/// The report of a shard.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(expecting = "an object")]
pub struct ShardReport {
    /// The program.
    pub tool: String,
    /// The version of the form.
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
    /// Whether what could not be checked ends the run with 3.
    pub require_all: bool,
    /// What the machine has, for the files that were dealt to the shard.
    pub machine: MachineStatement,
    /// The devices of the rows.
    pub device: Option<String>,
    /// How many places the whole run has.
    pub places: usize,
    /// The rows of each of them.
    pub plan: Vec<PlannedRows>,
    /// What came of each place that was dealt to the shard, so that a report that lost rows is told from a whole one.
    pub parts: Vec<PartStatement>,
    /// Its rows with their places in the whole run.
    pub rows: Vec<PlacedRow>,
}

/// What a shard is a part of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WholeRun {
    /// The command, without the flags of shards.
    pub command: String,
    /// The hash of the files and materials that it is about.
    pub inputs: String,
    /// Whether what could not be checked ends it with 3.
    pub require_all: bool,
}

impl ShardReport {
    /// The report of what came of a shard.
    pub fn new(whole: WholeRun, shard: Shard, outcome: ShardOutcome) -> ShardReport {
        ShardReport {
            tool: TOOL.to_owned(),
            schema: SCHEMA,
            command: whole.command,
            shard: shard.index(),
            shards: shard.count(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            inputs: whole.inputs,
            require_all: whole.require_all,
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
