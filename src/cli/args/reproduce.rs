//! The flags of `reproduce`.

use clap::Args;

use crate::lab::reproduce::{NOT_MEASURED, Part};
use crate::physics::names::UnknownName;

use crate::cli::args::{ReportFlags, TreeFlags};

/// The flags of `reproduce`.
#[derive(Args, Debug)]
#[command(
    mut_arg("out_dir", |arg| arg.help("Folder for the figures").default_value("reproduced")),
    after_help = "Example:\n  fresnel-gen reproduce table2 --json -")]
pub struct ReproduceFlags {
    /// Only this: table1, table2, table3, table4, table5, table6, table7, table8, claims or figures [default: all]
    #[arg(value_parser = part)]
    pub table: Option<Part>,
    /// The folder for the figures.
    #[command(flatten)]
    pub figures: TreeFlags,
    /// The report.
    #[command(flatten)]
    pub report: ReportFlags,
}

/// A part by its name, or a table by its number alone.
fn part(name: &str) -> Result<Part, String> {
    let plain = name.trim().to_lowercase().replace([' ', '-'], "");
    let number = plain.strip_prefix("table").unwrap_or(&plain);
    let is_part =
        |part: &Part| part.name() == plain || part.name().strip_prefix("table") == Some(number);
    if let Some(part) = Part::ALL.into_iter().find(is_part) {
        return Ok(part);
    }
    let all = Part::ALL.map(Part::name);
    let is_named = |tables: &str| tables.split(' ').any(|word| word == number);
    let unmeasured = NOT_MEASURED.iter().find(|(tables, _)| is_named(tables));
    Err(match unmeasured.filter(|_| !number.is_empty()) {
        Some((tables, why)) => {
            let all = all.join(", ");
            format!("{tables} cannot be reproduced yet: {why}; there are {all}")
        }
        None => UnknownName::new("table", name, &all).to_string(),
    })
}
