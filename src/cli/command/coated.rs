//! `materials coat`: the colours of a surface under a clear coat.

use std::path::Path;

use crate::cli::args::CoatFlags;
use crate::cli::error::Error;
use crate::generator::command_line::CommandLine;
use crate::generator::fit::CoatedRow;
use crate::generator::envelope::Report;
use crate::cli::coated_text::coated_text;

use crate::cli::command::{Output, report};

/// `fresnel-gen materials coat --f0 R,G,B --f82 R,G,B`.
pub fn run(flags: &CoatFlags, json: Option<&Path>) -> Result<Output, Error> {
    let row = CoatedRow::new(flags.f0, flags.f82, flags.index.value());
    let command = CommandLine::new("materials coat")
        .list("f0", flags.f0)
        .list("f82", flags.f82)
        .list("index", [flags.index]);
    let text = coated_text(&row);
    report(text, &Report::new(command, vec![row]), json)
}
