//! Shards: a verification dealt among machines like cards. The work has an order that all machines know, since they make the same
//! plan from the same flags; place p goes to shard p mod N.
//!
//! What is dealt is a file, since one process runs it and compilers judge it as a whole; of a run over all numbers it is a function.

use serde::{Deserialize, Serialize};

use crate::generator::reference::MaterialInMedium;
use crate::physics::digest::sha256;

use super::plan::{PlannedFile, VerifyPlan};
use super::row::VerifyRow;
use super::statement::MachineStatement;
use super::trial_case::case_materials;

/// A share of a verification: one of so many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// All of the work.
    pub const WHOLE: Shard = Shard { index: 0, count: 1 };

    /// The shard with this number, from 0, of so many; none where there are fewer.
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

/// What came of the work at one place of the whole run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PartStatement {
    /// The place.
    pub place: usize,
    /// The file that was run, relative to the output folder.
    pub file: String,
    /// How many rows came of it.
    pub rows: usize,
    /// Why none did.
    pub reason: Option<String>,
}

/// The rows that the whole run has at a place, as all its shards know them before it: hashes, since there are many.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(expecting = "an object")]
pub struct PlannedRows {
    /// The hash of the rows.
    pub rows: String,
    /// Of those that there are where the run of the file comes to no end: one of each function.
    pub unfinished: String,
}

impl PlannedRows {
    /// Of a file: these functions with their materials.
    pub fn new(file: &PlannedFile, rows: &[(&str, Option<&str>)]) -> PlannedRows {
        let path = &file.run_page().path;
        let functions = file.functions.iter();
        PlannedRows {
            rows: hash_of_rows(path, rows.iter().copied()),
            unfinished: hash_of_rows(path, functions.map(|one| (one.name.as_str(), None))),
        }
    }

    /// A plan in few words, which differ where plans do.
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

/// A row, and the place in the whole run of the work that it came of.
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

/// What came of a shard's work.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShardOutcome {
    /// The rows, in the order of their places.
    pub rows: Vec<PlacedRow>,
    /// What the machine has for that work; nothing where it is a whole run.
    pub machine: MachineStatement,
    /// What came of each place that was dealt to it, in order.
    pub parts: Vec<PartStatement>,
    /// What each place of the whole run has.
    pub plan: Vec<PlannedRows>,
}

impl ShardOutcome {
    /// Adds what came of a file at the next place.
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
    /// The rows of each file.
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

    /// The hash of what is run: of the files with their text, of what functions promise, and of the materials with their data. Shards of one run have the
    /// same, also where a command does not tell the difference.
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
}
