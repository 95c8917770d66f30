//! The program without its terminal: a request becomes artifacts, artifacts meet an output folder.
//!
//! The way through: [`Request`] → [`generate()`] → artifacts → [`tree::plan`] → [`check::report`] or [`write::write`].
//! [`source`] reads the files that a user names; [`tree`], [`folder`] and [`lock`] look at the output folder. Only
//! [`write`](mod@write) changes the disk, but for the lock's own file.

#[cfg(feature = "cli")]
pub mod args;
pub mod artifact;
pub mod atlas_rows;
pub mod catalogue;
pub mod check;
#[cfg(feature = "cli")]
pub mod command;
pub mod depfile;
pub mod error;
pub mod fault;
pub mod folder;
pub mod generate;
mod held;
#[cfg(feature = "cli")]
pub mod legible;
pub mod loaded;
pub mod lock;
pub mod manifest;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod merge;
pub mod names;
pub mod namesake;
pub mod ours;
#[cfg(feature = "cli")]
pub mod plan_file;
#[cfg(feature = "cli")]
mod plan_input;
mod reading;
mod removal;
pub mod request;
pub mod scope;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod shard;
pub mod source;
mod stage;
mod stays;
pub mod subjects;
#[cfg(feature = "cli")]
pub mod tables;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod time_request;
pub mod tree;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod verify;
pub mod write;

pub use artifact::Artifact;
pub use error::Error;
pub use generate::{Generated, generate};
pub use request::{Materials, Request, Source};
