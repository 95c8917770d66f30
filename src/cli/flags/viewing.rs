//! Flags for viewing conditions.

use std::ops::RangeInclusive;

use clap::Args;

use crate::cli::error::Error;
use crate::cli::flags::choice::{in_any_case, one_of};
use crate::generator::command_line::path_again;
use crate::generator::error::RequestFault;
use crate::generator::request::source::{is_path, read};
use crate::physics::foreign::Foreign;
use crate::physics::materials::{Extrapolate, ViewingConditions};
use crate::physics::names::UnknownName;
use crate::physics::spectra::{Adaptation, Gamut, Illuminant, Integration, Observer, Space, Step};

/// How a spectrum becomes three channels.
#[derive(Args, Clone, Debug, Default)]
pub struct ColourFlags {
    /// Working space: srgb, p3, rec2020, acescg; all linear [default: srgb]
    #[arg(long, value_name = "NAME", value_parser = in_any_case(one_of("space", Space::ALL, Space::name)))]
    pub space: Option<Space>,
    /// The light: D65, E, A, F11, LED-B3, or a file of two columns, nm and power [default: D65]
    #[arg(long, value_name = "NAME", value_parser = Light::parse)]
    pub illuminant: Option<Light>,
    /// The eye: cie1931 or cie2015 [default: cie1931]
    #[arg(long, value_name = "NAME", value_parser = in_any_case(one_of("observer", Observer::ALL, Observer::name)))]
    pub observer: Option<Observer>,
    /// How the colour of a perfect mirror becomes (1, 1, 1): scale (divide each channel) or bradford [default: scale]
    #[arg(long, value_name = "NAME", value_parser = in_any_case(one_of("adaptation", Adaptation::ALL, Adaptation::name)))]
    pub adaptation: Option<Adaptation>,
    /// Steps of the spectrum: 5nm or 1nm [default: 5nm]
    #[arg(long, value_name = "STEP", value_parser = in_any_case(one_of("step", Step::ALL, Step::name)))]
    pub step: Option<Step>,
    /// Beyond the measured range: refuse, or hold the last value [default: refuse]
    #[arg(long, value_name = "HOW", value_parser = in_any_case(one_of("extrapolation", Extrapolate::ALL, Extrapolate::name)))]
    pub extrapolate: Option<Extrapolate>,
}

/// The viewing conditions: the flags of every command that makes functions of three channels.
#[derive(Args, Clone, Debug, Default)]
pub struct ViewingFlags {
    /// The way from a spectrum.
    #[command(flatten)]
    pub colour: ColourFlags,
    /// Use one wavelength per channel, in nm, in place of the spectrum (the thesis uses 685,535,475)
    #[arg(long, value_name = "R,G,B", value_parser = wavelengths, conflicts_with_all = ["space", "illuminant", "observer", "adaptation", "step"])]
    pub wavelengths: Option<[f64; 3]>,
}

impl ColourFlags {
    /// The viewing conditions over the spectrum, with colours clipped to the space. Reads the light's file if one is named.
    ///
    /// # Errors
    /// The light's file cannot be read, or has a fault.
    pub fn conditions(&self) -> Result<ViewingConditions, Error> {
        let light = self
            .illuminant
            .as_ref()
            .map(Light::illuminant)
            .transpose()?;
        Ok(ViewingConditions {
            integration: Integration {
                observer: self.observer.unwrap_or_default(),
                illuminant: light.unwrap_or_default(),
                space: self.space.unwrap_or_default(),
                adaptation: self.adaptation.unwrap_or_default(),
                step: self.step.unwrap_or_default(),
            },
            beyond: self.extrapolate.unwrap_or_default(),
            ..ViewingConditions::default()
        })
    }

    /// The path of the light's file, if one is named.
    pub fn path(&self) -> Option<&str> {
        match &self.illuminant {
            Some(Light::File(path)) => Some(path),
            Some(Light::Standard(_)) | None => None,
        }
    }
}

impl ViewingFlags {
    /// The viewing conditions, with colours clipped to the space. Reads the light's file if one is named.
    ///
    /// # Errors
    /// The light's file cannot be read, or has a fault.
    pub fn conditions(&self) -> Result<ViewingConditions, Error> {
        Ok(ViewingConditions {
            wavelengths_nm: self.wavelengths,
            ..self.colour.conditions()?
        })
    }

    /// The path of the light's file, if one is named.
    pub fn path(&self) -> Option<&str> {
        self.colour.path()
    }
}

/// The viewing conditions of a command that may keep colours outside the working space.
#[derive(Args, Clone, Debug, Default)]
pub struct GamutFlags {
    /// How materials are looked at.
    #[command(flatten)]
    pub viewing: ViewingFlags,
    /// Colours outside the working space: keep, clip to [0, 1], or scale [default: clip]
    #[arg(long, value_name = "NAME", value_parser = in_any_case(one_of("gamut policy", Gamut::ALL, Gamut::name)), conflicts_with = "wavelengths")]
    pub gamut: Option<Gamut>,
}

impl GamutFlags {
    /// The viewing conditions. Reads the light's file if one is named.
    ///
    /// # Errors
    /// The light's file cannot be read, or has a fault.
    pub fn conditions(&self) -> Result<ViewingConditions, Error> {
        Ok(ViewingConditions {
            gamut: self.gamut.unwrap_or_default(),
            ..self.viewing.conditions()?
        })
    }
}

/// A light by its name, or the path of its file.
#[derive(Clone, Debug)]
pub enum Light {
    /// A standard illuminant.
    Standard(Illuminant),
    /// The path of a file of two columns: wavelength in nm, and power.
    File(String),
}

impl Light {
    fn parse(word: &str) -> Result<Light, UnknownName> {
        if let Some(found) = Illuminant::find(word) {
            return Ok(Light::Standard(found));
        }
        if is_path(word) {
            return Ok(Light::File(word.to_owned()));
        }
        let all = Illuminant::NAMED;
        let all: Vec<&str> = all.iter().map(Illuminant::name).collect();
        Err(UnknownName::new("illuminant", word, &all))
    }

    fn illuminant(&self) -> Result<Illuminant, Error> {
        match self {
            Light::Standard(known) => Ok(known.clone()),
            Light::File(path) => {
                let own = Illuminant::parse(path, &read(path)?)?;
                if Illuminant::find(own.name()).is_some() {
                    let name = own.name().to_owned();
                    return Err(RequestFault::LightNameTaken { name }.into());
                }
                // Commands in outputs name this file in the same way as material files.
                Ok(own.named(&path_again(path)))
            }
        }
    }
}

/// The wavelengths that a flag takes.
const LIMITS_NM: RangeInclusive<f64> = 1.0..=1e6;

/// The wavelengths of red, green and blue in nm.
fn wavelengths(word: &str) -> Result<[f64; 3], String> {
    let numbers = numbers(word)?;
    let Ok(three) = <[f64; 3]>::try_from(numbers.as_slice()) else {
        let count = numbers.len();
        return Err(format!(
            "it has {count} numbers; it wants red, green and blue in nm, such as 685,535,475"
        ));
    };
    match three.iter().find(|nm| !LIMITS_NM.contains(nm)) {
        Some(nm) => Err(format!(
            "it has {nm}; wavelengths are in nm, between 1 and 1000000"
        )),
        None => Ok(three),
    }
}

/// Numbers: a list such as 0,30,60, or a range with its step such as 0..90:5.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberList {
    /// The word, without blanks.
    pub word: String,
    /// The numbers in their order.
    pub values: Vec<f64>,
}

/// The most numbers of a list.
const MOST_NUMBERS: usize = 10_000;

impl NumberList {
    /// Angles of incidence in degrees.
    pub fn angles(word: &str) -> Result<NumberList, String> {
        NumberList::parse(
            word,
            "angles are in degrees",
            0.0..=90.0,
            "0..90:5 or 0,30,60",
        )
    }

    /// Wavelengths in nanometres.
    pub fn wavelengths(word: &str) -> Result<NumberList, String> {
        NumberList::parse(
            word,
            "wavelengths are in nm",
            LIMITS_NM,
            "400..700:10 or 450,550",
        )
    }

    fn parse(
        word: &str,
        what: &str,
        limits: RangeInclusive<f64>,
        such_as: &str,
    ) -> Result<NumberList, String> {
        let allowed = || {
            let (low, high) = (limits.start(), limits.end());
            format!("{what}, between {low} and {high}, such as {such_as}")
        };
        let said = |why: String| format!("{why}; {}", allowed());
        let word: String = word.split_whitespace().collect();
        let values = match word.split_once("..") {
            Some((from, rest)) if from.contains(',') || rest.contains([',']) => {
                let why = format!("`{from}..{rest}` is a list and a range; one of them is wanted");
                return Err(said(why));
            }
            Some((_, rest)) if rest.starts_with('.') => {
                return Err(said(format!(
                    "`{word}` is no range; two dots stand between its ends"
                )));
            }
            Some((from, rest)) => {
                let (to, step) = rest.split_once(':').unwrap_or((rest, "1"));
                let ends = numbers(&format!("{from},{to},{step}")).map_err(said)?;
                range(ends[0], ends[1], ends[2]).map_err(said)?
            }
            None => numbers(&word).map_err(said)?,
        };
        match values.iter().find(|value| !limits.contains(value)) {
            Some(value) => Err(format!("it has {value}; {}", allowed())),
            None if values.len() > MOST_NUMBERS => Err(format!(
                "it has {} numbers; at most {MOST_NUMBERS} are allowed",
                values.len()
            )),
            None => Ok(NumberList { word, values }),
        }
    }
}

/// The numbers from one end to the other, a step apart, without the rounding of their sum.
fn range(from: f64, to: f64, step: f64) -> Result<Vec<f64>, String> {
    let steps = libm::floor((to - from) / step + 1e-9);
    if !(step > 0.0 && steps >= 0.0) {
        return Err(format!(
            "`{from}..{to}:{step}` holds nothing: the second number must not be below the first, and the step is above 0"
        ));
    }
    if steps >= MOST_NUMBERS as f64 {
        return Err(format!("it has more than {MOST_NUMBERS} numbers"));
    }
    let place = |i: usize| libm::round((from + step * i as f64) * 1e9) / 1e9;
    Ok((0..=steps as usize).map(place).collect())
}

/// Three reflectances, separated by commas.
pub fn colour(word: &str) -> Result<[f64; 3], &'static str> {
    let is_reflectance = |number: &f64| (0.0..=1.0).contains(number);
    let numbers = numbers(word).unwrap_or_default();
    let three = <[f64; 3]>::try_from(numbers).ok();
    let three = three.filter(|numbers| numbers.iter().all(is_reflectance));
    three.ok_or("it wants three reflectances from 0 to 1, linear: 0.9,0.6,0.3; a colour outside the space is clipped to them")
}

/// Numbers separated by commas and optional blanks.
pub fn numbers(word: &str) -> Result<Vec<f64>, String> {
    let number = |word: &str| {
        let word = word.trim();
        word.parse()
            .map_err(|_| format!("`{}` is not a number", Foreign(word)))
    };
    word.split(',').map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_in_lists_and_ranges() {
        let angles = |word: &str| NumberList::angles(word).map(|list| list.values);
        assert_eq!(angles("0, 30,60"), Ok(vec![0.0, 30.0, 60.0]));
        assert_eq!(angles("88..90"), Ok(vec![88.0, 89.0, 90.0]));
        assert_eq!(angles("0..0.3:0.1"), Ok(vec![0.0, 0.1, 0.2, 0.3]));
        assert_eq!(angles("0..9:5"), Ok(vec![0.0, 5.0]));
        assert_eq!(angles("45"), Ok(vec![45.0]));
        assert_eq!(angles("0..90:1").map(|all| all.len()), Ok(91));
    }

    #[test]
    fn what_is_no_list_says_what_is_allowed() {
        for (word, says) in [
            (
                "91",
                "it has 91; angles are in degrees, between 0 and 90, such as 0..90:5 or 0,30,60",
            ),
            ("nan", "it has NaN; angles"),
            ("x", "`x` is not a number; angles"),
            ("", "`` is not a number; angles"),
            ("0..90:0", "holds nothing"),
            ("0..90:-1", "holds nothing"),
            ("90..0:1", "holds nothing"),
            ("0..nan:1", "holds nothing"),
            ("0..90:1e-9", "more than 10000 numbers"),
            ("0..90:1:2", "`1:2` is not a number"),
        ] {
            let fault = NumberList::angles(word).expect_err(word);
            assert!(fault.contains(says), "{word}: {fault}");
        }
    }
}
