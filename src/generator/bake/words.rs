//! A bake as a user types it.

use crate::generator::command_line::CommandLine;
use crate::generator::emit::Naming;
use crate::language::targets::Target;
use crate::physics::materials::ViewingConditions;
use crate::physics::spectra::Gamut;

use super::{BakeRequest, TableMaterial, TableSize};

/// The materials as a user types them.
pub fn material_words(subjects: &[TableMaterial]) -> Vec<String> {
    subjects.iter().map(|one| one.argument.clone()).collect()
}

/// The flags of the medium and the viewing conditions, each with a space before it.
pub fn viewing_flags(subjects: &[TableMaterial], viewing: &ViewingConditions) -> String {
    let medium = subjects.first().and_then(|subject| subject.medium.as_ref());
    // Tables keep colours outside the space unless asked otherwise; for functions it is the other way round.
    let clips = viewing.gamut == Gamut::Clip && viewing.wavelengths_nm.is_none();
    CommandLine::new("")
        .list("medium", medium)
        .seen_as(viewing)
        .list("gamut", clips.then_some(Gamut::Clip.name()))
        .into()
}

impl BakeRequest {
    /// The command that reports this again, without the output's place.
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

/// The same command, which writes functions beside the tables.
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
