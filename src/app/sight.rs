//! How materials are looked at, as a user says it: from words to a [`ViewingConditions`].

use crate::materials::{Extrapolate, ViewingConditions};
use crate::spectra::{Adaptation, Gamut, Illuminant, Integration, Observer, Space, Step};

use super::error::Error;
use super::fault::RequestFault;
use super::names::unknown;
use super::source::{is_path, read};

/// The words of the command line; `None` where nothing was said.
#[derive(Clone, Debug, Default)]
pub struct Words<'a> {
    /// `srgb`, `p3`, `rec2020`, `acescg`.
    pub space: Option<&'a str>,
    /// `keep`, `clip`, `scale`.
    pub gamut: Option<&'a str>,
    /// A name, or the path of a two-column file.
    pub illuminant: Option<&'a str>,
    /// `cie1931`, `cie2015`.
    pub observer: Option<&'a str>,
    /// `scale`, `bradford`.
    pub adaptation: Option<&'a str>,
    /// `5nm`, `1nm`.
    pub step: Option<&'a str>,
    /// Red, green and blue in nanometres, in place of the spectrum.
    pub wavelengths: &'a [f64],
    /// `refuse`, `hold`.
    pub extrapolate: Option<&'a str>,
}

/// The sight that these words mean. Reads the illuminant's file where one is named.
///
/// # Errors
/// A word names nothing, wavelengths are not three numbers in range, or the illuminant's file cannot be read or has a fault.
pub fn sight(words: &Words) -> Result<ViewingConditions, Error> {
    Ok(ViewingConditions {
        integration: Integration {
            observer: choice(
                "observer",
                words.observer,
                Observer::find,
                &Observer::ALL.map(Observer::name),
            )?,
            illuminant: words
                .illuminant
                .map(illuminant)
                .transpose()?
                .unwrap_or_default(),
            space: choice(
                "space",
                words.space,
                Space::find,
                &Space::ALL.map(Space::name),
            )?,
            adaptation: choice(
                "adaptation",
                words.adaptation,
                Adaptation::find,
                &Adaptation::ALL.map(Adaptation::name),
            )?,
            step: choice("step", words.step, Step::find, &Step::ALL.map(Step::name))?,
        },
        gamut: choice(
            "gamut policy",
            words.gamut,
            Gamut::find,
            &Gamut::ALL.map(Gamut::name),
        )?,
        wavelengths_nm: wavelengths(words)?,
        beyond: choice(
            "extrapolation",
            words.extrapolate,
            extrapolation,
            &["refuse", "hold"],
        )?,
    })
}

/// What a word means; the usual where nothing was said.
fn choice<T: Default>(
    kind: &'static str,
    word: Option<&str>,
    find: impl Fn(&str) -> Option<T>,
    all: &[&str],
) -> Result<T, Error> {
    match word {
        None => Ok(T::default()),
        Some(word) => find(&word.to_lowercase()).ok_or_else(|| unknown(kind, word, all)),
    }
}

fn extrapolation(word: &str) -> Option<Extrapolate> {
    match word {
        "refuse" => Some(Extrapolate::Refuse),
        "hold" => Some(Extrapolate::Hold),
        _ => None,
    }
}

fn illuminant(name: &str) -> Result<Illuminant, Error> {
    if let Some(found) = Illuminant::find(name) {
        return Ok(found);
    }
    if !is_path(name) {
        let all = Illuminant::NAMED;
        let all: Vec<&str> = all.iter().map(Illuminant::name).collect();
        return Err(unknown("illuminant", name, &all));
    }
    let own = Illuminant::parse(name, &read(name)?)?;
    if Illuminant::find(own.name()).is_some() {
        let what = format!(
            "the light's file is named `{}`, as a standard light is; rename it",
            own.name()
        );
        return Err(Error::Usage { what });
    }
    Ok(own)
}

/// Three wavelengths, where any are given.
fn wavelengths(words: &Words) -> Result<Option<[f64; 3]>, Error> {
    const LIMITS_NM: std::ops::RangeInclusive<f64> = 1.0..=1e6;
    let Ok(three) = <[f64; 3]>::try_from(words.wavelengths) else {
        let what = format!(
            "--wavelengths has {} numbers; it wants red, green and blue in nm, such as 685,535,475",
            words.wavelengths.len()
        );
        return if words.wavelengths.is_empty() {
            Ok(None)
        } else {
            Err(Error::Usage { what })
        };
    };
    if let Some(nm) = three.iter().find(|nm| !LIMITS_NM.contains(nm)) {
        let what = format!("--wavelengths has {nm}; they are in nm, between 1 and 1000000");
        return Err(Error::Usage { what });
    }
    let spectral = [
        words.space,
        words.gamut,
        words.illuminant,
        words.observer,
        words.adaptation,
        words.step,
    ];
    if spectral.iter().any(Option::is_some) {
        return Err(RequestFault::Conflict { flag: "wavelengths", with: "space", why: "--wavelengths takes one wavelength a channel, so that observer, illuminant, space, gamut, adaptation and step say nothing beside it; leave one or the other out" }.into());
    }
    Ok(Some(three))
}

/// The file that these words name, if any: one of a run's inputs.
pub fn input<'a>(words: &Words<'a>) -> Option<&'a str> {
    words
        .illuminant
        .filter(|name| Illuminant::find(name).is_none())
}
