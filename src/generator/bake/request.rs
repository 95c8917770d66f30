//! The request for lookup tables, and the command that makes it again.

use super::subject::{DEFAULT_AXIS, DEFAULT_FORMATS, TableMaterial, material_words, viewing_flags};
use crate::generator::command_line::CommandLine;
use crate::generator::emit::Naming;
use crate::generator::lut::{Format, TableAxis};
use crate::language::methods::TEXELS;
use crate::language::targets::Target;
use crate::physics::materials::ViewingConditions;

/// The name of the picture with all materials.
pub const ATLAS: &str = "atlas";

/// The request for lookup tables.
#[derive(Clone, Debug)]
pub struct BakeRequest {
    /// The materials, sorted by name.
    pub subjects: Vec<TableMaterial>,
    /// The arguments that name all of them again: names, or `all`.
    pub typed: Vec<String>,
    /// The files wanted.
    pub formats: Vec<Format>,
    /// The size of the tables.
    pub shape: TableSize,
    /// Whether to write a picture with one row per material, too.
    pub atlas: bool,
    /// The languages that get a function for each picture.
    pub targets: Vec<&'static Target>,
    /// The prefix of these functions' names.
    pub prefix: String,
    /// The flags of the viewing conditions and the medium, each with a space before it.
    pub flags: String,
}

/// The size of tables.
#[derive(Clone, Debug, PartialEq)]
pub enum TableSize {
    /// This many texels along this axis.
    Fixed {
        /// The axis.
        axis: TableAxis,
        /// The number of texels.
        texels: usize,
    },
    /// The fewest bytes within this error, along one of these axes.
    Within {
        /// The largest error of the filtered lookup.
        budget: f64,
        /// The axes.
        axes: Vec<TableAxis>,
    },
}

impl BakeRequest {
    /// The command that reports this again, without the output path.
    pub fn command_line(&self) -> CommandLine {
        let command = CommandLine::new("bake")
            .list("material", &self.typed)
            .with(&self.flags);
        let command = match &self.shape {
            TableSize::Fixed { axis, texels } => {
                command.list("size", [texels]).list("axis", [axis.name()])
            }
            TableSize::Within { budget, axes } => {
                let only = axes.first().filter(|_| axes.len() == 1);
                command
                    .number("budget", format_args!("{budget:?}"))
                    .list("axis", only.map(|axis| axis.name()))
            }
        };
        let command = command
            .list("format", self.formats.iter().map(|format| format.name()))
            .switch("atlas", self.atlas);
        with_functions(command, &self.targets, &self.prefix)
    }
}

/// The same command, with the functions beside the tables.
pub fn with_functions(
    command: CommandLine,
    targets: &[&'static Target],
    prefix: &str,
) -> CommandLine {
    if targets.is_empty() {
        return command;
    }
    command
        .list("target", targets.iter().map(|target| target.name))
        .list("prefix", Naming::flag_of_prefix(prefix))
}

/// The request for the tables of these materials and an atlas that a run without flags makes.
pub fn usual_request(subjects: Vec<TableMaterial>, viewing: &ViewingConditions) -> BakeRequest {
    BakeRequest {
        typed: material_words(&subjects),
        flags: viewing_flags(&subjects, viewing),
        subjects,
        formats: DEFAULT_FORMATS.to_vec(),
        shape: TableSize::Fixed {
            axis: DEFAULT_AXIS,
            texels: TEXELS,
        },
        atlas: true,
        targets: Vec::new(),
        prefix: Naming::default().prefix,
    }
}
