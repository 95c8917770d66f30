//! Flags for viewing conditions.

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

/// The viewing conditions: the flags of every command that makes three channels of a spectrum.
#[derive(Args, Clone, Debug, Default)]
pub struct ViewingFlags {
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
    /// Use one wavelength per channel, in nm, in place of the spectrum (the thesis uses 685,535,475)
    #[arg(long, value_name = "R,G,B", value_parser = wavelengths, conflicts_with_all = ["space", "illuminant", "observer", "adaptation", "step"])]
    pub wavelengths: Option<[f64; 3]>,
    /// Beyond the measured range: refuse, or hold the last value [default: refuse]
    #[arg(long, value_name = "HOW", value_parser = in_any_case(one_of("extrapolation", Extrapolate::ALL, Extrapolate::name)))]
    pub extrapolate: Option<Extrapolate>,
}

impl ViewingFlags {
    /// The viewing conditions, with colours clipped to the space. Reads the light's file if one is named.
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
            wavelengths_nm: self.wavelengths,
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

/// The wavelengths of red, green and blue in nm.
fn wavelengths(word: &str) -> Result<[f64; 3], String> {
    const LIMITS_NM: std::ops::RangeInclusive<f64> = 1.0..=1e6;
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
