//! The command that makes a file or a report again, as a user would type it. It appears in headers, JSON and manifests.

use core::fmt::Display;

use crate::physics::materials::{Extrapolate, Surface, ViewingConditions};
use crate::physics::spectra::Integration;

/// A command that is built flag by flag. Flags appear in the order of the calls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandLine(String);

impl CommandLine {
    /// The command without flags.
    pub fn new(words: &str) -> CommandLine {
        CommandLine(words.to_owned())
    }

    /// Adds a word without a flag.
    #[must_use]
    pub fn argument(self, word: &str) -> CommandLine {
        CommandLine(format!("{} {}", self.0, quoted(word)))
    }

    /// Adds a flag with these words, separated by commas; nothing if there are none. If a word itself has a comma, each word gets
    /// the flag.
    #[must_use]
    pub fn list<T: Display>(self, name: &str, words: impl IntoIterator<Item = T>) -> CommandLine {
        let words: Vec<String> = words
            .into_iter()
            .map(|word| quoted(&word.to_string()))
            .collect();
        if words.is_empty() {
            return self;
        }
        let separator = if words.iter().any(|word| word.contains(',')) {
            format!(" --{name} ")
        } else {
            ",".to_owned()
        };
        CommandLine(format!("{} --{name} {}", self.0, words.join(&separator)))
    }

    /// Adds the flag once for each of these words.
    #[must_use]
    pub fn each<T: Display>(self, name: &str, words: impl IntoIterator<Item = T>) -> CommandLine {
        let words = words.into_iter();
        words.fold(self, |command, word| command.list(name, [word]))
    }

    /// Adds a flag with a number, unquoted.
    #[must_use]
    pub fn number(self, name: &str, value: impl Display) -> CommandLine {
        CommandLine(format!("{} --{name} {value}", self.0))
    }

    /// Adds a flag without a value, if it is set.
    #[must_use]
    pub fn switch(self, name: &str, is_set: bool) -> CommandLine {
        if is_set {
            CommandLine(format!("{} --{name}", self.0))
        } else {
            self
        }
    }

    /// Adds the flags of these viewing conditions; nothing for the default ones.
    #[must_use]
    pub fn seen_as(self, viewing: &ViewingConditions) -> CommandLine {
        let (own, usual) = (&viewing.integration, Integration::default());
        let usual_gamut = ViewingConditions::default().gamut.name();
        let choices = [
            ("space", own.space.name(), usual.space.name()),
            ("gamut", viewing.gamut.name(), usual_gamut),
            ("illuminant", own.illuminant.name(), usual.illuminant.name()),
            ("observer", own.observer.name(), usual.observer.name()),
            ("adaptation", own.adaptation.name(), usual.adaptation.name()),
            ("step", own.step.name(), usual.step.name()),
        ];
        let mut command = self;
        for (flag, value, usual) in choices {
            command = command.list(flag, (value != usual).then_some(value));
        }
        if let Some([red, green, blue]) = viewing.wavelengths_nm {
            command = command.number("wavelengths", format!("{red},{green},{blue}"));
        }
        let holds = viewing.beyond == Extrapolate::Hold;
        command.list("extrapolate", holds.then_some(viewing.beyond.name()))
    }

    /// Adds the flags of the viewing conditions of a surface, if there is one. Where each channel is one wavelength, the other
    /// viewing conditions have no effect.
    #[must_use]
    pub fn seen_on(self, viewing: &ViewingConditions, surface: Option<&Surface>) -> CommandLine {
        match surface {
            None => self,
            Some(surface) if surface.is_spectral() => self.seen_as(viewing),
            Some(_) => self.seen_as(&ViewingConditions {
                wavelengths_nm: viewing.wavelengths_nm,
                beyond: viewing.beyond,
                ..ViewingConditions::default()
            }),
        }
    }

    /// Adds more flags, each with a space before it.
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

/// A word quoted for a shell, in ASCII and on one line, since it stands in comments of shaders. `printf` writes other characters,
/// since POSIX has no other escape.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./:".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else if word.chars().all(|c| c == ' ' || c.is_ascii_graphic()) {
        format!("'{}'", word.replace('\'', "'\\''"))
    } else {
        let bytes: String = word.bytes().map(printed).collect();
        format!("\"$(printf '{bytes}')\"")
    }
}

/// A byte as in the format string of `printf`, within single quotes.
fn printed(byte: u8) -> String {
    match byte {
        b'%' => "%%".to_owned(),
        b'\\' => "\\\\".to_owned(),
        b' ' => " ".to_owned(),
        b'\'' => "\\047".to_owned(),
        byte if byte.is_ascii_graphic() => char::from(byte).to_string(),
        byte => format!("\\{byte:03o}"),
    }
}

/// A path as a user would type it again. A relative one is unchanged. Of an absolute one only the last part is given, since no
/// output names a folder of this machine. The result is neither a catalogue name nor a flag: `gold` is a material of the
/// catalogue, and `./gold` a file.
pub fn path_again(path: &str) -> String {
    let is_of_windows = cfg!(windows) && (path.contains(':') || path.starts_with('\\'));
    let typed = if path.starts_with('/') || is_of_windows {
        last_part(path)
    } else {
        path
    };
    let bare = typed.trim_start_matches("./").trim_start_matches('/');
    let is_name = !bare.contains(['.', '/']);
    if bare.starts_with('-') || is_name && bare != typed || is_name && typed != path {
        format!("./{bare}")
    } else {
        bare.to_owned()
    }
}

fn last_part(path: &str) -> &str {
    let separators: &[char] = if cfg!(windows) { &['/', '\\'] } else { &['/'] };
    path.rsplit(separators).next().unwrap_or(path)
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
    fn a_word_with_a_comma_has_a_flag_of_its_own() {
        let command = CommandLine::new("fit").list("material", ["gold", "a,b.csv"]);
        assert_eq!(
            String::from(command),
            "fit --material gold --material 'a,b.csv'"
        );
    }

    #[test]
    fn a_relative_path_is_said_as_it_was_typed_and_names_no_other_thing() {
        for (typed, again) in [
            ("sub/m.toml", "sub/m.toml"),
            ("../m.toml", "../m.toml"),
            ("./m.toml", "m.toml"),
            ("./gold", "./gold"),
            ("/home/me/m.toml", "m.toml"),
            ("/home/me/gold", "./gold"),
            ("./-m.toml", "./-m.toml"),
            ("/home/me/-m.toml", "./-m.toml"),
            (".hidden", ".hidden"),
        ] {
            assert_eq!(path_again(typed), again, "{typed}");
        }
    }

    #[test]
    fn a_word_is_one_word_of_ascii() {
        for (word, shown) in [
            ("a'b $c.csv", "'a'\\''b $c.csv'"),
            ("Gl\u{e4}ser.csv", "\"$(printf 'Gl\\303\\244ser.csv')\""),
            ("a\n%\\'.csv", "\"$(printf 'a\\012%%\\\\\\047.csv')\""),
        ] {
            assert_eq!(quoted(word), shown);
        }
    }

    #[test]
    fn usual_viewing_conditions_need_no_flags() {
        let command = CommandLine::new("fit").seen_as(&ViewingConditions::default());
        assert_eq!(String::from(command), "fit");
    }
}
