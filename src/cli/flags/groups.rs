//! The headings under which `--help` shows flags. A flag named here stands under its heading in every command. All others are
//! options of one command only.

use clap::{Arg, Command};

/// A heading and its flags.
const GROUPS: [(&str, &[&str]); 4] = [
    (
        "Everyday",
        &[
            "target",
            "flavour",
            "method",
            "effect",
            "material",
            "film",
            "coat",
            "catalogue",
            "medium",
            "output",
            "out_dir",
            "check",
            "quiet",
        ],
    ),
    (
        "Colour",
        &[
            "space",
            "illuminant",
            "observer",
            "adaptation",
            "step",
            "wavelengths",
            "extrapolate",
            "gamut",
        ],
    ),
    (
        "Precision",
        &[
            "precision",
            "force",
            "matching_angle",
            "budget",
            "gpu",
            "plan",
            "allow",
        ],
    ),
    (
        "Output",
        &[
            "prefix",
            "header",
            "overwrite",
            "depfile",
            "depfile_target",
            "list",
            "json",
            "junit",
        ],
    ),
];

/// The flag under its heading. A positional argument stays where it is.
pub fn in_group(arg: Arg) -> Arg {
    let id = arg.get_id().as_str();
    let group = GROUPS.iter().find(|(_, flags)| flags.contains(&id));
    match group {
        Some((heading, _)) if !arg.is_positional() => arg.help_heading(*heading),
        _ => arg,
    }
}

/// The command with its flags under headings, and its subcommands likewise.
pub fn with_groups(command: Command) -> Command {
    command.mut_args(in_group).mut_subcommands(with_groups)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use clap::CommandFactory;

    use super::*;
    use crate::cli::Cli;

    #[test]
    fn every_flag_of_generation_stands_under_a_heading() {
        let command = Cli::command();
        let generate = command.find_subcommand("generate").expect("it is there");
        for arg in generate.get_arguments().chain(command.get_arguments()) {
            assert!(
                arg.get_help_heading().is_some(),
                "{}: see GROUPS",
                arg.get_id()
            );
        }
    }

    #[test]
    fn every_heading_names_flags_that_are_there() {
        fn ids(command: &Command, found: &mut BTreeSet<String>) {
            found.extend(command.get_arguments().map(|arg| arg.get_id().to_string()));
            command
                .get_subcommands()
                .for_each(|below| ids(below, found));
        }
        let mut found = BTreeSet::new();
        ids(&Cli::command(), &mut found);
        for flag in GROUPS.iter().flat_map(|(_, flags)| *flags) {
            assert!(found.contains(*flag), "{flag}");
        }
    }
}
