//! The command that makes a file or a report again, as a user types it: in headers, in JSON, in manifests.

use core::fmt::Display;

use crate::materials::{Extrapolate, Surface, ViewingConditions};
use crate::spectra::Integration;

/// A command that grows flag by flag, in the order in which its flags are given here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandLine(String);

impl CommandLine {
    /// The command without flags.
    pub fn new(words: &str) -> CommandLine {
        CommandLine(words.to_owned())
    }

    /// A word without a flag.
    #[must_use]
    pub fn argument(self, word: &str) -> CommandLine {
        CommandLine(format!("{} {}", self.0, quoted(word)))
    }

    /// A flag with these words, commas between; nothing where there are none.
    #[must_use]
    pub fn list<T: Display>(self, name: &str, words: impl IntoIterator<Item = T>) -> CommandLine {
        let words: Vec<String> = words
            .into_iter()
            .map(|word| quoted(&word.to_string()))
            .collect();
        if words.is_empty() {
            return self;
        }
        CommandLine(format!("{} --{name} {}", self.0, words.join(",")))
    }

    /// A flag with a number, which is written as it is.
    #[must_use]
    pub fn number(self, name: &str, value: impl Display) -> CommandLine {
        CommandLine(format!("{} --{name} {value}", self.0))
    }

    /// A flag without a value, where it is set.
    #[must_use]
    pub fn switch(self, name: &str, is_set: bool) -> CommandLine {
        match is_set {
            true => CommandLine(format!("{} --{name}", self.0)),
            false => self,
        }
    }

    /// The flags of these viewing conditions.
    #[must_use]
    pub fn seen_as(self, viewing: &ViewingConditions) -> CommandLine {
        CommandLine(self.0 + &viewing_condition_flags(viewing))
    }

    /// The same command with more flags, each with a space before it.
    #[must_use]
    pub fn with(self, flags: &str) -> CommandLine {
        CommandLine(self.0 + flags)
    }
}

impl From<CommandLine> for String {
    fn from(command: CommandLine) -> String {
        command.0
    }
}

/// A word of a shell's command line.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// A file without the folders of this machine.
pub fn file_name(file: &str) -> &str {
    file.rsplit(['/', '\\']).next().unwrap_or(file)
}

/// The flags that say again how a surface was seen, each with a space before it; nothing where all is as usual. Where each
/// channel is one wavelength, the rest of the viewing conditions says nothing.
pub fn surface_flags(viewing: &ViewingConditions, surface: &Surface) -> String {
    if surface.channels().is_none() {
        return viewing_condition_flags(viewing);
    }
    viewing_condition_flags(&ViewingConditions {
        wavelengths_nm: viewing.wavelengths_nm,
        beyond: viewing.beyond,
        ..ViewingConditions::default()
    })
}

/// The flags that say these viewing conditions again, each with a space before it.
fn viewing_condition_flags(viewing: &ViewingConditions) -> String {
    let (own, usual) = (&viewing.integration, Integration::default());
    let choices = [
        ("space", own.space.name(), usual.space.name()),
        (
            "gamut",
            viewing.gamut.name(),
            ViewingConditions::default().gamut.name(),
        ),
        ("illuminant", own.illuminant.name(), usual.illuminant.name()),
        ("observer", own.observer.name(), usual.observer.name()),
        ("adaptation", own.adaptation.name(), usual.adaptation.name()),
        ("step", own.step.name(), usual.step.name()),
    ];
    let mut command = CommandLine::new("");
    for (flag, value, usual) in choices {
        command = command.list(flag, (value != usual).then_some(value));
    }
    if let Some([red, green, blue]) = viewing.wavelengths_nm {
        command = command.number("wavelengths", format!("{red},{green},{blue}"));
    }
    let holds = viewing.beyond == Extrapolate::Hold;
    let hold = holds.then_some(viewing.beyond.name());
    command.list("extrapolate", hold).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_holds_its_flags_in_order() {
        let command = CommandLine::new("bake")
            .list("material", ["gold", "my file.toml"])
            .list("target", Vec::<String>::new())
            .number("size", 64)
            .switch("atlas", true)
            .switch("dfg", false);
        assert_eq!(
            String::from(command),
            "bake --material gold,'my file.toml' --size 64 --atlas"
        );
    }

    #[test]
    fn usual_viewing_conditions_need_no_flags() {
        assert_eq!(viewing_condition_flags(&ViewingConditions::default()), "");
    }
}
