//! The output folder: what lies in it, which of its files are ours, and how a run's files get there.
//!
//! [`tree::plan`] compares a run's artifacts with the folder, [`tree::report`] says what differs, and [`write::write`] writes.
//! Only [`write`](mod@write) changes the disk, except for the file of the [`lock`].

pub mod contents;
pub mod depfile;
mod earlier_runs;
pub mod folder;
pub mod lock;
pub mod manifest;
pub mod ownership;
mod stage;
pub mod tree;
pub mod write;
