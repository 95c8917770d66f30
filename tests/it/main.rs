//! The integration tests, one binary.
#![allow(clippy::unwrap_used, clippy::print_stdout, clippy::print_stderr)]

mod bless;
mod claims;
mod code_bounds;
mod golden;
mod oracle;
mod physics;
mod readme;
mod tidy;
mod tree;
