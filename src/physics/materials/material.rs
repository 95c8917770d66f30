//! A material ([`Material`]): its names and sources, and its index of refraction at any measured wavelength. Also a medium given
//! as a number ([`ConstantIndex`]).
//!
//! The latter has one refractive index at all wavelengths and no absorption. It is for media without a page: a coat of index 1.5,
//! an oil whose label states n. Without dispersion, colours differ slightly from those in a measured medium with the same index
//! in green.

use core::fmt;

use serde::{Deserialize, Deserializer, Serialize, de};
use thiserror::Error;

use super::decimal::short;
use super::film::Film;
use super::formula::{DispersionCurve, Extrapolate, Formula};
use crate::physics::names::named;

/// The least n. Below it the exact forms lose their last digits in f32.
pub const LEAST_N: f64 = 1e-3;
/// The greatest n and k: no index measured between 1 nm and 1 mm comes near it.
pub const GREATEST: f64 = 1e4;

/// A material as its file describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its one name, in snake_case.
    pub name: String,
    /// A description in one line.
    pub summary: String,
    /// Metal, semiconductor or dielectric.
    pub kind: MaterialKind,
    /// The substance, which alternative measurements share. The recommended one has it as its name.
    pub substance: String,
    /// The licence of the numbers.
    pub licence: String,
    /// Who measured it.
    pub reference: String,
    /// Where to read about it.
    pub link: String,
    /// The page of refractiveindex.info that the numbers are from; may be empty.
    pub page: String,
    /// Temperature, film thickness and the like; may be empty.
    pub conditions: String,
    /// What a user should know: why it is recommended, what was done to the numbers; may be empty.
    pub note: String,
    /// The wavelengths of red, green and blue in nanometres, if it is known only at these, as in the thesis.
    pub rgb_nm: Option<[f64; 3]>,
    /// Refractive index by wavelength.
    pub n: DispersionCurve,
    /// Extinction coefficient by wavelength; 0 where there is none.
    pub k: Option<DispersionCurve>,
    /// The films on it, outermost first; `n` and `k` are those of what lies below.
    pub films: Vec<Film>,
}

/// The class of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MaterialKind {
    /// It conducts; k is large.
    Metal,
    /// In between.
    Semiconductor,
    /// It is transparent; k is 0 or nearly.
    Dielectric,
}

impl MaterialKind {
    /// All classes.
    pub const ALL: [MaterialKind; 3] = [
        MaterialKind::Metal,
        MaterialKind::Semiconductor,
        MaterialKind::Dielectric,
    ];

    /// The name in files and reports.
    pub fn name(self) -> &'static str {
        match self {
            MaterialKind::Metal => "metal",
            MaterialKind::Semiconductor => "semiconductor",
            MaterialKind::Dielectric => "dielectric",
        }
    }
}

impl<'de> Deserialize<'de> for MaterialKind {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<MaterialKind, D::Error> {
        let word = String::deserialize(from)?;
        let all = MaterialKind::ALL.into_iter();
        let found = all.clone().find(|kind| kind.name() == word);
        named("class", &word, found, all.map(MaterialKind::name)).map_err(de::Error::custom)
    }
}

/// The index of refraction at one wavelength: n + ik.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// Real part.
    pub n: f64,
    /// Extinction coefficient.
    pub k: f64,
}

impl Index {
    /// The index relative to a medium: the complex quotient. In a medium that absorbs more than the material, k
    /// would be below 0. The law gives the same reflectance for m and its conjugate, so |k| is used.
    pub fn relative_to(self, medium: Index) -> Index {
        let square = medium.n * medium.n + medium.k * medium.k;
        Index {
            n: (self.n * medium.n + self.k * medium.k) / square,
            k: ((self.k * medium.n - self.n * medium.k) / square).abs(),
        }
    }
}

impl Material {
    /// The index at a wavelength, or why there is none, with the material's name.
    ///
    /// # Errors
    /// The wavelength lies outside the measured range and may not be extrapolated, or n or k lies outside its limits.
    pub fn index(&self, nm: f64, beyond: Extrapolate) -> Result<Index, String> {
        let value = |curve: &DispersionCurve, letter: &str| {
            let named = |why: String| format!("material `{}`: {letter} {why}", self.name);
            curve.at(nm, beyond).map_err(named)
        };
        // A page's table can hold rows beyond these limits: from a bad fit, or of a metamaterial.
        let within = |value: f64, letter: &str, least: f64| match value {
            value if (least..=GREATEST).contains(&value) => Ok(value),
            _ => Err(format!(
                "material `{}`: {letter} is {} at {nm} nm; it must lie between {least} and {GREATEST}",
                self.name,
                short(value)
            )),
        };
        let n = within(value(&self.n, "n")?, "n", LEAST_N)?;
        let k = self.k.as_ref().map(|k| value(k, "k")).transpose()?;
        let k = k.map_or(Ok(0.0), |k| within(k, "k", 0.0))?;
        Ok(Index { n, k })
    }

    /// The range of wavelengths in nanometres in which both n and k are known, those of its films too. The first is above the second if
    /// there is none.
    pub fn range_nm(&self) -> (f64, f64) {
        let k = self.k.as_ref().map(DispersionCurve::range_nm);
        let films = self.films.iter().map(|film| film.material.range_nm());
        let others = k.into_iter().chain(films);
        others.fold(self.n.range_nm(), |(from, to), (first, last)| {
            (from.max(first), to.min(last))
        })
    }

    /// Whether n and k are known over a range of wavelengths.
    pub fn covers(&self, from_nm: f64, to_nm: f64) -> bool {
        let whole = |curve: &DispersionCurve| curve.covers(from_nm) && curve.covers(to_nm);
        whole(&self.n) && self.k.as_ref().is_none_or(whole)
    }

    /// The wavelengths at which n or k was measured, ascending; none for formulas.
    pub fn measured_nm(&self) -> Vec<f64> {
        let curves = [Some(&self.n), self.k.as_ref()].into_iter().flatten();
        let mut places: Vec<f64> = curves.flat_map(DispersionCurve::measured_nm).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    }

    /// Whether it is of this substance, and known as a spectrum.
    pub fn is_spectrum_of(&self, substance: &str) -> bool {
        self.substance == substance && self.rgb_nm.is_none()
    }

    /// Whether it is the recommended measurement of its substance.
    pub fn is_recommended(&self) -> bool {
        self.name == self.substance
    }
}

/// The least index of a medium given as a number: a vacuum's.
pub const LEAST_INDEX: f64 = 1.0;
/// The greatest: above every transparent medium of the catalogue.
pub const GREATEST_INDEX: f64 = 10.0;

/// The range in nanometres of a medium given as a number: all that a material file may name.
const KNOWN_NM: (f64, f64) = (1.0, 1e6);

/// The refractive index of a medium without absorption and dispersion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantIndex(f64);

/// A number that is not a valid index of a medium.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "`{given}` is no refractive index of a medium; a number from {LEAST_INDEX} to {GREATEST_INDEX} is allowed, such as 1.5, or a material's name"
)]
pub struct IndexFault {
    given: String,
}

impl ConstantIndex {
    /// The index that a word states; none if the word is not a number.
    ///
    /// # Errors
    /// The number lies outside its limits.
    pub fn parse(word: &str) -> Option<Result<ConstantIndex, IndexFault>> {
        let index: f64 = word.parse().ok()?;
        let is_allowed = (LEAST_INDEX..=GREATEST_INDEX).contains(&index);
        Some(if is_allowed {
            Ok(ConstantIndex(index))
        } else {
            Err(IndexFault {
                given: word.to_owned(),
            })
        })
    }

    /// The number.
    pub fn value(self) -> f64 {
        self.0
    }

    /// The medium's record. Its name is `index_1_5` for 1.5: the shortest digits of the number, so that 1.50 is the same medium.
    pub fn material(self) -> Material {
        let name = format!("index_{}", self.to_string().replace('.', "_"));
        let (from_nm, to_nm) = KNOWN_NM;
        Material {
            substance: name.clone(),
            name,
            summary: format!("A medium of refractive index {self} at all wavelengths"),
            kind: MaterialKind::Dielectric,
            licence: "CC0-1.0".to_owned(),
            reference: "a number of the user's".to_owned(),
            link: String::new(),
            page: String::new(),
            conditions: String::new(),
            note: String::new(),
            rgb_nm: None,
            // Cauchy's formula with only its first coefficient is the number itself, without rounding.
            n: DispersionCurve::Formula(Formula {
                number: 5,
                coefficients: vec![self.0],
                from_nm,
                to_nm,
            }),
            k: None,
            films: Vec::new(),
        }
    }
}

impl fmt::Display for ConstantIndex {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::name_fault;
    use crate::physics::optics;

    #[test]
    fn relative_index_is_the_complex_quotient() {
        let gold = Index { n: 0.23, k: 3.94 };
        let water = Index { n: 1.33, k: 0.0 };
        assert_eq!(
            gold.relative_to(water),
            Index {
                n: 0.23 * 1.33 / (1.33 * 1.33),
                k: 3.94 * 1.33 / (1.33 * 1.33)
            }
        );
        let murky = Index { n: 1.33, k: 1e-3 };
        let glass = Index { n: 1.5, k: 0.0 };
        let seen = glass.relative_to(murky);
        let (n, k) = (1.5 - 1.33, 1e-3);
        let by_hand = (n * n + k * k) / ((1.5 + 1.33) * (1.5 + 1.33) + k * k);
        assert!((optics::normal_incidence(seen.n, seen.k) - by_hand).abs() < 1e-16);
        let same = murky.relative_to(murky);
        assert!((same.n - 1.0).abs() < 1e-15 && same.k == 0.0);
    }

    #[track_caller]
    fn check(word: &str, argument: &str, name: &str) {
        let index = ConstantIndex::parse(word).expect("a number").expect(word);
        assert_eq!(index.to_string(), argument);
        let material = index.material();
        assert_eq!(material.name, name);
        assert_eq!(name_fault(&material.name), None);
        assert_eq!(material.limits_fault(), None);
        for nm in [1.0, 380.0, 589.3, 830.0, 1e6] {
            let n = argument.parse().expect("a number");
            let index = material.index(nm, Extrapolate::Refuse);
            assert_eq!(index, Ok(Index { n, k: 0.0 }));
        }
    }

    #[test]
    fn one_number_is_one_medium() {
        for word in [
            "1.5",
            "1.50",
            "1.500",
            "+1.5",
            "15e-1",
            "1.5000000000000000001",
        ] {
            check(word, "1.5", "index_1_5");
        }
        check("1", "1", "index_1");
        check("1.0", "1", "index_1");
        check("10", "10", "index_10");
        check("1.05", "1.05", "index_1_05");
        check(
            "1.3333333333333333",
            "1.3333333333333333",
            "index_1_3333333333333333",
        );
    }

    #[test]
    fn other_numbers_are_refused() {
        for word in ["0", "0.999", "10.001", "-1.5", "inf", "nan", "NaN", "1e400"] {
            let fault = ConstantIndex::parse(word)
                .expect("a number")
                .expect_err(word);
            assert!(fault.to_string().contains("from 1 to 10"), "{fault}");
        }
    }

    #[test]
    fn words_are_no_numbers() {
        for word in ["water", "1.5.toml", "1,5", "", "1.5x", "./1.5"] {
            assert_eq!(ConstantIndex::parse(word), None, "{word}");
        }
    }
}
