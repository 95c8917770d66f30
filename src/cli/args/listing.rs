//! The flags of `methods`, `effects` and `targets`.

use clap::{Args, Subcommand};

use crate::language::effects::{self, Effect};
use crate::language::methods::{self, Method};
use crate::language::targets::{self, Target};

use crate::cli::args::ReportFlags;
use crate::cli::args::choice::one_of;

/// The flags of `methods`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct MethodsFlags {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<MethodsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is listed of methods.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum MethodsCommand {
    /// Name and summary of each; with --json its source too
    List,
    /// All that is known of one
    Show {
        /// Its name
        #[arg(value_parser = one_of("method", methods::ALL.iter().copied(), |method| method.name))]
        name: &'static Method,
    },
}

/// The flags of `effects`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct EffectsFlags {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<EffectsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is listed of effects.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum EffectsCommand {
    /// Name and summary of each; with --json its source too
    List,
    /// All that is known of one
    Show {
        /// Its name
        #[arg(value_parser = one_of("effect", effects::ALL.iter().copied(), |effect| effect.name))]
        name: &'static Effect,
    },
}

/// The flags of `targets`.
#[derive(Args, Debug)]
#[command(mut_arg("json", |arg| arg.global(true)))]
pub struct TargetsFlags {
    /// `list`, or `show NAME`
    #[command(subcommand)]
    pub what: Option<TargetsCommand>,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// What is listed of targets.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum TargetsCommand {
    /// Name and summary of each; with --json its source too
    List,
    /// All that is known of one
    Show {
        /// Its name
        #[arg(value_parser = one_of("target", targets::ALL.iter().copied(), |target| target.name))]
        name: &'static Target,
    },
}
