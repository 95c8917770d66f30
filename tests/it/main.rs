//! The integration tests, one binary.

#[cfg(feature = "cli")]
mod cli;
mod compilers;
mod oracle;
mod tree;
