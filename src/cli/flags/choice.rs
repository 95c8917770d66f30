//! Parsers of names on the command line, and the flags for the precision that functions compute in.

use core::fmt;

use clap::Args;

use crate::generator::error::RequestFault;
use crate::generator::exchange::{self, Format};
use crate::generator::flavours::{self, Flavour};
use crate::generator::request::Methods;
use crate::lab::cost::{self, FAMILIES, Family, GpuCompiler};
use crate::language::effects::{self, Effect};
use crate::language::methods::{self, Gpu, Method};
use crate::language::targets::{self, Target};
use crate::physics::names::UnknownName;
use crate::physics::num::Precision;

/// A word in a list of names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Choice<T> {
    /// `all`: every item of the list.
    All,
    /// `none`, where choosing nothing is allowed.
    None,
    /// A name, and what it names.
    One(String, T),
}

impl<T> Choice<T> {
    /// Whether these words mean everything: `all`, or no words at all.
    pub fn is_all(words: &[Choice<T>]) -> bool {
        words.is_empty() || words.iter().any(|word| matches!(word, Choice::All))
    }

    /// Whether these words choose nothing.
    ///
    /// # Errors
    /// `none` stands beside another word.
    pub fn is_none(words: &[Choice<T>], what: &str) -> Result<bool, RequestFault> {
        let is_none = words.iter().any(|word| matches!(word, Choice::None));
        if is_none && words.len() > 1 {
            return Err(RequestFault::refused(format!(
                "`none` leaves all {what} out, so that no other can be named beside it"
            )));
        }
        Ok(is_none)
    }

    /// The chosen item, if the word is a name.
    pub fn named(&self) -> Option<&T> {
        match self {
            Choice::One(_, named) => Some(named),
            Choice::All | Choice::None => None,
        }
    }

    /// The items of a list that these words choose, in the list's order.
    pub fn chosen(
        words: &[Choice<T>],
        list: impl IntoIterator<Item = T>,
        name: fn(&T) -> &'static str,
    ) -> Vec<T> {
        let is_named = |one: &T| {
            let mut words = words.iter();
            words.any(|word| matches!(word, Choice::One(word, _) if word == name(one)))
        };
        let is_all = Choice::is_all(words);
        let list = list.into_iter();
        list.filter(|one| is_all || is_named(one)).collect()
    }
}

impl<T: Copy> Choice<T> {
    /// The items that these words name, in their order; for `all`, these.
    pub fn items(words: &[Choice<T>], all: impl Iterator<Item = T> + Clone) -> Vec<T> {
        let item = |word: &Choice<T>| match word {
            Choice::All => all.clone().collect(),
            Choice::None => Vec::new(),
            Choice::One(_, item) => vec![*item],
        };
        words.iter().flat_map(item).collect()
    }
}

impl Choice<&'static Target> {
    /// The targets that these words name. `all` means those written by default.
    pub fn targets(words: &[Choice<&'static Target>]) -> Vec<&'static Target> {
        let all = targets::ALL.iter().copied();
        Choice::items(words, all.filter(|target| target.by_default))
    }
}

impl Choice<&'static Effect> {
    /// The effects that these words name.
    pub fn effects(words: &[Choice<&'static Effect>]) -> Vec<&'static Effect> {
        Choice::items(words, effects::ALL.iter().copied())
    }
}

impl Choice<&'static Method> {
    /// The choice of methods for a request.
    pub fn requested(words: &[Choice<&'static Method>]) -> Methods {
        match words {
            [] => Methods::Default,
            words if Choice::is_all(words) => Methods::All,
            words => Methods::These(words.iter().filter_map(Choice::named).copied().collect()),
        }
    }

    /// The methods that these words choose, sorted by name.
    pub fn methods(words: &[Choice<&'static Method>]) -> Vec<&'static Method> {
        Choice::chosen(words, methods::ALL.iter().copied(), |method| method.name)
    }
}

impl<T> fmt::Display for Choice<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Choice::All => "all",
            Choice::None => "none",
            Choice::One(name, _) => name,
        })
    }
}

/// The parser of a flag whose values are names in a list.
pub fn one_of<T: Copy>(
    kind: &'static str,
    list: impl IntoIterator<Item = T>,
    name: fn(T) -> &'static str,
) -> impl Fn(&str) -> Result<T, UnknownName> + Clone {
    let list: Vec<(&str, T)> = list.into_iter().map(|one| (name(one), one)).collect();
    move |word: &str| {
        // A quoted list may have a blank after a comma.
        let word = word.trim();
        let found = list.iter().find(|(name, _)| *name == word);
        let names = || list.iter().map(|(name, _)| *name).collect::<Vec<_>>();
        found
            .map(|(_, one)| *one)
            .ok_or_else(|| UnknownName::new(kind, word, &names()))
    }
}

/// The parser of a flag whose values are names in a list, or `all`.
pub fn one_or_all<T: Copy>(
    kind: &'static str,
    list: impl IntoIterator<Item = T>,
    name: fn(T) -> &'static str,
) -> impl Fn(&str) -> Result<Choice<T>, UnknownName> + Clone {
    let named = list.into_iter().map(|one| (name(one), Some(one)));
    let words: Vec<(&str, Option<T>)> = named.chain([("all", None)]).collect();
    let parse = one_of(kind, words, |(name, _)| name);
    move |word: &str| {
        Ok(match parse(word)? {
            (name, Some(one)) => Choice::One(name.to_owned(), one),
            (_, None) => Choice::All,
        })
    }
}

/// A parser that ignores the case of letters.
pub fn in_any_case<T, E>(
    parse: impl Fn(&str) -> Result<T, E> + Clone,
) -> impl Fn(&str) -> Result<T, E> + Clone {
    move |word: &str| parse(&word.to_lowercase())
}

/// The parser of a method's name, or `all`.
pub fn method_or_all() -> impl Fn(&str) -> Result<Choice<&'static Method>, UnknownName> + Clone {
    one_or_all("method", methods::ALL.iter().copied(), |method| method.name)
}

/// The parser of an effect's name, or `all`.
pub fn effect_or_all() -> impl Fn(&str) -> Result<Choice<&'static Effect>, UnknownName> + Clone {
    one_or_all("effect", effects::ALL.iter().copied(), |effect| effect.name)
}

/// The parser of a target's name, or `all`.
pub fn target_or_all() -> impl Fn(&str) -> Result<Choice<&'static Target>, UnknownName> + Clone {
    one_or_all("target", targets::ALL.iter().copied(), |target| target.name)
}

/// The parser of a flavour's name. A format's name leads to the flag for formats.
pub fn flavour() -> impl Fn(&str) -> Result<&'static Flavour, String> + Clone {
    let parse = one_of("flavour", flavours::ALL.iter().copied(), |one| one.name);
    or_elsewhere(parse, |word| {
        let name = exchange::find(word)?.name;
        Some(format!(
            "{name} takes numbers, and no adapter: fresnel-gen materials params NAME --as {name}"
        ))
    })
}

/// The parser of the name of a format of engines. A flavour's name leads to the flag for adapters.
pub fn format_of_engines() -> impl Fn(&str) -> Result<&'static Format, String> + Clone {
    let parse = one_of("format", exchange::ALL.iter().copied(), |one| one.name);
    or_elsewhere(parse, |word| {
        let name = flavours::find(word)?.name;
        Some(format!(
            "{name} takes functions in an adapter: fresnel-gen --flavour {name} --material NAME"
        ))
    })
}

/// The same parser, with another message for an unknown word that is known elsewhere.
fn or_elsewhere<T>(
    parse: impl Fn(&str) -> Result<T, UnknownName> + Clone,
    elsewhere: fn(&str) -> Option<String>,
) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |word: &str| {
        let said = |unknown: UnknownName| elsewhere(word.trim()).unwrap_or(unknown.to_string());
        parse(word).map_err(said)
    }
}

/// The parser of a precision's name.
pub fn precision() -> impl Fn(&str) -> Result<Precision, UnknownName> + Clone {
    one_of("precision", Precision::ALL, Precision::name)
}

/// The parser of the name of a GPU family.
pub fn family() -> impl Fn(&str) -> Result<&'static Family, UnknownName> + Clone {
    one_of("GPU family", FAMILIES, |family| family.name)
}

/// The parser of the name of what functions are written for.
pub fn gpu() -> impl Fn(&str) -> Result<Gpu, String> + Clone {
    |name| {
        name.parse()
            .map_err(|unknown: UnknownName| no_gpu(name, &unknown))
    }
}

/// Why there is no such GPU. Of some families nothing is recorded.
fn no_gpu(name: &str, unknown: &UnknownName) -> String {
    match cost::find(name).map(|family| family.compiler) {
        Some(GpuCompiler::None(why)) => format!("no costs are recorded of {name}: {why}"),
        _ => unknown.to_string(),
    }
}

/// The same, or `all`.
pub fn gpu_or_all() -> impl Fn(&str) -> Result<Choice<Gpu>, String> + Clone {
    |word| match word {
        "all" => Ok(Choice::All),
        name => Ok(Choice::One(name.to_owned(), gpu()(name)?)),
    }
}

/// The parser of the name of a GPU family, or `all`.
pub fn family_or_all() -> impl Fn(&str) -> Result<Choice<&'static Family>, UnknownName> + Clone {
    one_or_all("GPU family", FAMILIES, |family| family.name)
}

/// The flags of every command that writes or runs functions.
#[derive(Args, Clone, Debug, Default)]
pub struct PrecisionFlags {
    /// What functions compute in: f32, or f16, whose names end in _f16 [default: f32]
    #[arg(long, value_name = "NAME", value_parser = precision())]
    pub precision: Option<Precision>,
    /// Also write methods that f16 cannot compute accurately, without an error bound
    #[arg(long, requires = "precision")]
    pub force: bool,
}

impl PrecisionFlags {
    /// The precision that functions compute in.
    pub fn precision(&self) -> Precision {
        self.precision.unwrap_or_default()
    }
}

/// These precisions, each once and in order; both if none is named.
pub fn each_once(named: &[Precision]) -> Vec<Precision> {
    let all = Precision::ALL.into_iter();
    all.filter(|precision| named.is_empty() || named.contains(precision))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::lut::{Format, TableAxis};
    use crate::physics::spectra::{Gamut, Observer, Space};

    #[track_caller]
    fn check<T: Copy + PartialEq + fmt::Debug, const N: usize>(
        all: [T; N],
        name: fn(T) -> &'static str,
    ) {
        let parse = one_of("name", all, name);
        for one in all {
            assert_eq!(parse(name(one)), Ok(one));
        }
        assert!(parse("other").is_err());
    }

    #[test]
    fn names_are_found_again() {
        check(Space::ALL, Space::name);
        check(Observer::ALL, Observer::name);
        check(Gamut::ALL, Gamut::name);
        check(TableAxis::ALL, TableAxis::name);
        check(Format::ALL, Format::name);
        check(Precision::ALL, Precision::name);
    }

    #[test]
    fn all_and_nothing_mean_all() {
        let parse = one_or_all("precision", Precision::ALL, Precision::name);
        let chosen = |words: &[&str]| {
            let words: Vec<_> = words.iter().map(|word| parse(word).unwrap()).collect();
            Choice::chosen(&words, Precision::ALL, |one| one.name())
        };
        assert_eq!(chosen(&[]), Precision::ALL);
        assert_eq!(chosen(&["f16", "all"]), Precision::ALL);
        assert_eq!(chosen(&["f16", "f32", "f16"]), Precision::ALL);
        assert_eq!(chosen(&["f16"]), [Precision::F16]);
    }

    #[test]
    fn none_stands_alone() {
        let none: [Choice<()>; 2] = [Choice::None, Choice::All];
        assert_eq!(Choice::is_none(&none[..1], "materials"), Ok(true));
        assert!(Choice::is_none(&none, "materials").is_err());
    }
}
