//! The verifier verified: what is right passes, what is wrong is seen, on every target.

mod command;
mod half;
mod mutants;
mod recorded;

pub use crate::subjects;
