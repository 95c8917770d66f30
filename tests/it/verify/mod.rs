//! The verifier verified: what is right passes, what is wrong is seen, on every target.

mod command;
mod effects;
mod half;
mod jobs;
#[cfg(unix)]
mod machine;
mod mutants;
#[cfg(target_os = "linux")]
mod processes;
mod recorded;
mod shards;
mod share;
mod tampered;
#[cfg(unix)]
pub mod tools;

pub use crate::subjects;
