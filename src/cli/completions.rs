//! Completion scripts of shells, with the names that flags take.

use clap::builder::PossibleValuesParser;
use clap::{Args, Command, CommandFactory};
use clap_complete::Shell;

use crate::cli::Cli;
use crate::generator::emit::HeaderForm;
use crate::lab::cost::FAMILIES;
use crate::language::{effects, methods, targets};
use crate::physics::materials::{self, Extrapolate};
use crate::physics::num::Precision;
use crate::physics::spectra::{Adaptation, Gamut, Illuminant, Observer, Space, Step};

/// Which shell.
#[derive(Args, Debug)]
pub struct CompletionsFlags {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub shell: Shell,
}

/// The script that completes the words of a command line.
pub fn completions(shell: Shell) -> String {
    let mut script = Vec::new();
    let mut command = with_names(Cli::command(), "");
    clap_complete::generate(shell, &mut command, "fresnel-gen", &mut script);
    let script = String::from_utf8_lossy(&script);
    // clap_complete 4.6 spells a program's hyphen in two ways, so no subcommand is found (clap's issue 6421).
    script.replace("fresnel__subcmd__gen", "fresnel__gen")
}

/// The command with the names that its flags take. The list of a name is found by the command above: `methods show NAME`. Flags
/// parse their values themselves and accept paths beside names, so only the script uses these.
fn with_names(command: Command, above: &str) -> Command {
    let here = command.get_name().to_owned();
    let command = command.mut_args(|arg| {
        let list = match arg.get_id().as_str() {
            "name" => above,
            flag => flag,
        };
        match names(list) {
            Some(names) => arg.value_parser(PossibleValuesParser::new(names)),
            None => arg,
        }
    });
    command.mut_subcommands(|below| with_names(below, &here))
}

/// The names that a flag or a list accepts.
fn names(list: &str) -> Option<Vec<&'static str>> {
    let all = ["all"].into_iter();
    Some(match list {
        "method" => all.chain(methods::ALL.iter().map(|one| one.name)).collect(),
        "methods" => methods::ALL.iter().map(|one| one.name).collect(),
        "target" => all.chain(targets::ALL.iter().map(|one| one.name)).collect(),
        "targets" => targets::ALL.iter().map(|one| one.name).collect(),
        "effect" => all.chain(effects::ALL.iter().map(|one| one.name)).collect(),
        "effects" => effects::ALL.iter().map(|one| one.name).collect(),
        "material" => all.chain(materials::known()).collect(),
        "materials" => materials::known(),
        "medium" => materials::names(),
        "gpu" => FAMILIES.iter().map(|one| one.name).collect(),
        "space" => Space::ALL.map(Space::name).to_vec(),
        "illuminant" => Illuminant::NAMED.iter().map(Illuminant::name).collect(),
        "observer" => Observer::ALL.map(Observer::name).to_vec(),
        "adaptation" => Adaptation::ALL.map(Adaptation::name).to_vec(),
        "step" => Step::ALL.map(Step::name).to_vec(),
        "gamut" => Gamut::ALL.map(Gamut::name).to_vec(),
        "extrapolate" => Extrapolate::ALL.map(Extrapolate::name).to_vec(),
        "precision" => Precision::ALL.map(Precision::name).to_vec(),
        "header" => HeaderForm::ALL.map(HeaderForm::name).to_vec(),
        _ => return None,
    })
}
