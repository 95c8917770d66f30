//! Films on a material ([`Film`]), the word that names one (`titanium_dioxide:60nm`), and the file of a stack.
//!
//! ```toml
//! name = "oil_on_water"             # snake_case, as of a material
//! summary = "A film of oil on water"
//! base = "water"                    # a material of the catalogue
//! films = ["1.45:300nm"]            # outermost first; materials of the catalogue, or refractive indices
//! licence = "CC0-1.0"               # of these numbers
//! reference = "Author, Title, Journal, Year"
//! link = "https://doi.org/..."
//! note = "where the thickness is from" # may be left out
//! ```

use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

use super::catalogue;
use super::file::{check_name, name_fault};
use super::formula::DispersionCurve;
use super::material::{ConstantIndex, Material, MaterialKind};
use crate::physics::names::UnknownName;
use crate::physics::user_text::{FileFault, FileText};

/// A layer of stated thickness on a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// What it consists of.
    pub material: Material,
    /// Its thickness in nanometres.
    pub thickness_nm: f64,
    /// The word of `--film` that names it again; empty where the file of the stack names it.
    pub argument: String,
}

/// The greatest thickness of a film in nanometres. Fringes of a film of index 1.5 are 16 nm apart in wavelength there, at 380 nm, and
/// each third of the spectrum holds several. Of a thicker one only a mean is seen.
pub const THICKEST_NM: f64 = 3000.0;
/// The most films of a stack.
pub const MOST_FILMS: usize = 100;

/// Why a word is no film.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FilmFault {
    /// It has no thickness.
    #[error(
        "`{0}` is no film; a material and its thickness are wanted, such as titanium_dioxide:60nm, or an index and its thickness, such as 1.38:0.1um"
    )]
    NoThickness(String),
    /// The thickness has no unit, or is no number.
    #[error("`{0}` is no thickness; a number with its unit is wanted: nm or um, such as 60nm")]
    NoLength(String),
    /// Two films in one word.
    #[error(
        "`{0}` are several films; each wants a --film of its own, or a string of its own in the list of a file, the outermost first"
    )]
    Several(String),
    /// The thickness is negative, or no number.
    #[error("no film has a thickness of {0}: 0 to {THICKEST_NM} nm are allowed")]
    Negative(String),
    /// The film is too thick.
    #[error(
        "a film of {0} is none: 0 to {THICKEST_NM} nm are allowed. A thicker layer shows no colours of interference: it is a coat, and what lies below it has it as its --medium"
    )]
    Length(String),
}

/// The material and the thickness in nanometres that a word names.
///
/// # Errors
/// The word has no thickness, or one without a unit, or outside of its limits.
///
/// ```
/// use fresnel_gen::physics::materials::film_of_word;
///
/// assert_eq!(film_of_word("titanium_dioxide:0.06um"), Ok(("titanium_dioxide", 60.0)));
/// ```
pub fn film_of_word(word: &str) -> Result<(&str, f64), FilmFault> {
    let mut each = word.split(',');
    if word.contains(',') && each.all(|part| part.contains(':') && part.ends_with('m')) {
        return Err(FilmFault::Several(word.to_owned()));
    }
    let parts = word.rsplit_once(':').filter(|(name, _)| !name.is_empty());
    let (name, length) = parts.ok_or_else(|| FilmFault::NoThickness(word.to_owned()))?;
    Ok((name, length_nm(length)?))
}

/// The thickness in nanometres that a word such as `60nm` or `.06um` says.
///
/// # Errors
/// It has no unit, or lies outside of its limits.
pub fn length_nm(length: &str) -> Result<f64, FilmFault> {
    let units = [("nm", 1.0), ("um", 1000.0), ("µm", 1000.0), ("μm", 1000.0)];
    let with_unit = units
        .iter()
        .find_map(|(unit, nm)| Some((length.strip_suffix(unit)?.trim_end(), nm)));
    let number = with_unit.and_then(|(number, nm)| Some((number.parse::<f64>().ok()?, nm)));
    let (number, nm) = number.ok_or_else(|| FilmFault::NoLength(length.to_owned()))?;
    // A thickness in micrometres has as few digits as in nanometres: .06 × 1000 is 60.
    let thickness_nm = (number * nm * 1e6).round() / 1e6;
    if (0.0..=THICKEST_NM).contains(&thickness_nm) {
        Ok(thickness_nm.abs())
    } else if thickness_nm > THICKEST_NM {
        Err(FilmFault::Length(length.to_owned()))
    } else {
        Err(FilmFault::Negative(length.to_owned()))
    }
}

impl Film {
    /// The film in names of functions and files: `titanium_dioxide_60nm`.
    fn name(&self) -> String {
        let thickness = self.thickness_nm.to_string().replace('.', "_");
        format!("{}_{thickness}nm", self.material.name)
    }
}

impl Material {
    /// This material under films, outermost first. Films that it has already lie below.
    ///
    /// # Errors
    /// There are too many films, or the name becomes too long.
    pub fn under_films(mut self, films: Vec<Film>) -> Result<Material, String> {
        if films.is_empty() {
            return Ok(self);
        }
        let count = self.films.len() + films.len();
        if count > MOST_FILMS {
            return Err(format!(
                "{count} films lie on `{}`; at most {MOST_FILMS} are allowed",
                self.name
            ));
        }
        if self.name == AIR {
            self.n = one();
        }
        for film in &films {
            self.name = format!("{}_film_{}", self.name, film.name());
        }
        if let Some(why) = name_fault(&self.name) {
            return Err(format!(
                "`{}` is no name: {why}; write these films into a file with a name of its own, and pass it as --material FILE.toml",
                self.name
            ));
        }
        self.substance.clone_from(&self.name);
        self.add_sources(&films);
        self.films.splice(0..0, films);
        let own = self.summary.split(UNDER).next().unwrap_or_default();
        self.summary = format!("{own}{UNDER}{}", self.films_in_words().unwrap_or_default());
        Ok(self)
    }

    /// Adds the sources and licences of films to its own.
    fn add_sources(&mut self, films: &[Film]) {
        for Film { material, .. } in films {
            let source = format!("{}: {}", material.name, material.reference);
            if !self.reference.contains(&source) {
                self.reference = format!("{}; {source}", self.reference);
            }
            if !self.licence.contains(&material.licence) {
                self.licence = format!("{}, {}", self.licence, material.licence);
            }
        }
    }

    /// The name of its class: film where films lie on it, else metal, semiconductor or dielectric.
    pub fn class_name(&self) -> &'static str {
        if self.films.is_empty() {
            self.kind.name()
        } else {
            "film"
        }
    }

    /// The class whose laws it follows: under films none is without k, since films absorb or shift colours as if they did.
    pub fn optical_kind(&self) -> MaterialKind {
        if self.films.is_empty() {
            self.kind
        } else {
            MaterialKind::Semiconductor
        }
    }

    /// Its films in words, outermost first; none if it has none.
    pub fn films_in_words(&self) -> Option<String> {
        let film = |film: &Film| format!("{} nm of {}", film.thickness_nm, film.material.name);
        let films: Vec<String> = self.films.iter().map(film).collect();
        (!films.is_empty()).then(|| films.join(", then "))
    }

    /// The words of `--film` that name its films again, outermost first.
    pub fn film_arguments(&self) -> Vec<&str> {
        let words = self.films.iter().map(|film| film.argument.as_str());
        words.filter(|word| !word.is_empty()).collect()
    }

    /// Reads the file of a stack. `file` is only for messages.
    pub(super) fn parse_stack(file: &str, text: &str) -> Result<Material, FileFault> {
        let place = FileText { file, text };
        let raw: RawStack = toml::from_str(text)
            .map_err(|error| place.syntax(&error, &FIELDS, &FIELDS[..REQUIRED]))?;
        check_name("name", &raw.name, &place)?;
        for (field, value) in [
            ("summary", &raw.summary),
            ("licence", &raw.licence),
            ("reference", &raw.reference),
            ("link", &raw.link),
        ] {
            place.one_line(field, value)?;
        }
        let base =
            named(raw.base.get_ref()).map_err(|why| place.fault(raw.base.span().start, why))?;
        let film = |word: &Spanned<String>| {
            let at = |why: String| place.fault(word.span().start, why);
            let (name, thickness_nm) =
                film_of_word(word.get_ref()).map_err(|fault| at(fault.to_string()))?;
            Ok(Film {
                material: named(name).map_err(at)?,
                thickness_nm,
                argument: String::new(),
            })
        };
        let films = raw.films.get_ref().iter().map(film);
        let films = films.collect::<Result<Vec<Film>, FileFault>>()?;
        if films.is_empty() || films.len() > MOST_FILMS {
            let what = format!("field `films`: 1 to {MOST_FILMS} films are wanted");
            return Err(place.fault(raw.films.span().start, what));
        }
        let name = raw.name.into_inner();
        let reference = raw.reference.into_inner();
        let mut stack = Material {
            substance: name.clone(),
            reference: format!("{reference}; {}: {}", base.name, base.reference),
            name,
            summary: raw.summary.into_inner(),
            licence: raw.licence.into_inner(),
            link: raw.link.into_inner(),
            page: String::new(),
            conditions: format!("films on {}", base.name),
            note: raw.note.unwrap_or_default(),
            ..base
        };
        stack.add_sources(&films);
        stack.films = films;
        if raw.base.get_ref() == AIR {
            stack.n = one();
        }
        Ok(stack)
    }
}

/// The base of a free film. Where no medium is named, light comes from an index of 1, and the same lies below: 1.00028 there would
/// reflect near grazing.
const AIR: &str = "air";

fn one() -> DispersionCurve {
    let vacuum = ConstantIndex::parse("1").and_then(Result::ok);
    vacuum.expect("1 is an index").material().n
}

/// What stands between the summary of a material and its films.
const UNDER: &str = ", under ";

/// A material of the catalogue, or a medium that is a number.
fn named(word: &str) -> Result<Material, String> {
    if let Some(index) = ConstantIndex::parse(word) {
        return Ok(index.map_err(|fault| fault.to_string())?.material());
    }
    let found = catalogue::find(word).transpose();
    match found.map_err(|fault| fault.to_string())? {
        Some(bare) if bare.films.is_empty() => Ok(bare),
        Some(_) => Err(format!(
            "`{word}` has films itself; name the material of one layer"
        )),
        None => Err(UnknownName::new("material", word, &catalogue::names()).to_string()),
    }
}

/// The fields of a stack, those that it must have first.
const FIELDS: [&str; 8] = [
    "name",
    "summary",
    "base",
    "films",
    "licence",
    "reference",
    "link",
    "note",
];

const REQUIRED: usize = 7;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStack {
    name: Spanned<String>,
    summary: Spanned<String>,
    base: Spanned<String>,
    films: Spanned<Vec<Spanned<String>>>,
    licence: Spanned<String>,
    reference: Spanned<String>,
    link: Spanned<String>,
    note: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_a_material_and_a_length() {
        for (word, want) in [
            ("titanium_dioxide:60nm", ("titanium_dioxide", 60.0)),
            ("1.38:0.1um", ("1.38", 100.0)),
            ("1.38:.1um", ("1.38", 100.0)),
            ("./a:b.csv:62.5nm", ("./a:b.csv", 62.5)),
            ("gold:0nm", ("gold", 0.0)),
            ("gold:-0nm", ("gold", 0.0)),
        ] {
            assert_eq!(film_of_word(word), Ok(want));
        }
        let two = film_of_word("titanium_dioxide:60nm,1.47:0.1um");
        assert!(matches!(two, Err(FilmFault::Several(_))), "{two:?}");
        for word in [
            "gold",
            ":60nm",
            "gold:",
            "gold:60",
            "gold:nm",
            "gold:60mm",
            "gold:1m",
        ] {
            assert!(film_of_word(word).is_err(), "{word}");
        }
        for word in ["gold:-1nm", "gold:NaNnm"] {
            let fault = film_of_word(word).unwrap_err();
            assert!(matches!(fault, FilmFault::Negative(_)), "{word}: {fault}");
        }
        for word in ["gold:infnm", "gold:1000000um", "gold:4um"] {
            let fault = film_of_word(word).unwrap_err();
            assert!(matches!(fault, FilmFault::Length(_)), "{word}: {fault}");
        }
    }

    fn film(word: &str) -> Film {
        let (name, thickness_nm) = film_of_word(word).unwrap();
        Film {
            material: named(name).unwrap(),
            thickness_nm,
            argument: word.to_owned(),
        }
    }

    #[test]
    fn names_follow_the_films() {
        let titanium = named("titanium").unwrap();
        let anodised = titanium
            .under_films(vec![film("titanium_dioxide:62.5nm")])
            .unwrap();
        assert_eq!(anodised.name, "titanium_film_titanium_dioxide_62_5nm");
        let oiled = anodised
            .clone()
            .under_films(vec![film("1.45:300nm")])
            .unwrap();
        let below: Vec<&str> = oiled
            .films
            .iter()
            .map(|film| &*film.material.name)
            .collect();
        assert_eq!(below, ["index_1_45", "titanium_dioxide"]);
        assert_eq!(
            oiled.film_arguments(),
            ["1.45:300nm", "titanium_dioxide:62.5nm"]
        );
        let many = vec![film("1.45:300nm"); 5];
        let fault = anodised.clone().under_films(many).unwrap_err();
        assert!(fault.contains("a file with a name of its own"), "{fault}");
        let too_many = vec![film("1.45:300nm"); MOST_FILMS];
        assert!(
            anodised
                .under_films(too_many)
                .unwrap_err()
                .contains("101 films")
        );
    }

    #[test]
    fn a_stack_is_a_file() {
        let text = "name = \"purple\"\nsummary = \"x\"\nbase = \"titanium\"\nfilms = [\"titanium_dioxide:50nm\"]\n\
                    licence = \"CC0-1.0\"\nreference = \"r\"\nlink = \"l\"\n";
        let purple = Material::parse("purple.toml", text).unwrap();
        assert_eq!((purple.name.as_str(), purple.films.len()), ("purple", 1));
        assert_eq!(purple.film_arguments(), [""; 0]);
        let wrong = text.replace("titanium_dioxide:50nm", "titanium_dioxid:50nm");
        let fault = Material::parse("purple.toml", &wrong)
            .unwrap_err()
            .to_string();
        assert!(
            fault.contains("purple.toml:4:") && fault.contains("titanium_dioxide"),
            "{fault}"
        );
    }
}
