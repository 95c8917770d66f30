//! The verifier verified: what is right passes, what is wrong is seen, on every target.

mod command;
mod half;
mod mutants;
mod recorded;
mod tampered;

pub use crate::subjects;
