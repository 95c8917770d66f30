//! The integration tests, one binary.
#![allow(clippy::unwrap_used, clippy::print_stdout, clippy::print_stderr)]

mod bless;
mod claims;
mod code_bounds;
mod golden;
mod graph;
mod oracle;
mod physics;
mod readme;
mod reproduce;
mod reread;
mod tidy;
mod tree;
