//! The material file: TOML, checked field by field.
//!
//! ```toml
//! name = "my_gold"                  # snake_case: it becomes part of function and file names
//! summary = "Gold, evaporated film" # one line
//! class = "metal"                   # metal, semiconductor or dielectric
//! licence = "CC0-1.0"               # of these numbers
//! reference = "Author, Title, Journal, Year"
//! link = "https://doi.org/..."
//! conditions = "room temperature"   # may be left out
//! # wavelength in nm (ascending), n, k
//! data = [
//!   [475, 1.39, 1.72],
//!   [535, 0.57, 2.18],
//!   [685, 0.23, 3.94],
//! ]
//! ```

use serde::Deserialize;
use toml::Spanned;

use crate::ir::identifier_fault;
pub use crate::spectra::Fault;

/// A material as its file tells it.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its one name.
    pub name: String,
    /// One line.
    pub summary: String,
    /// Metal, semiconductor or dielectric.
    pub kind: Kind,
    /// The licence of the numbers.
    pub licence: String,
    /// Who measured it.
    pub reference: String,
    /// Where to read about it.
    pub link: String,
    /// Temperature, film thickness and the like; may be empty.
    pub conditions: String,
    /// The measured points, by ascending wavelength.
    pub samples: Vec<Sample>,
}

/// The class of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// It conducts, and k is large.
    Metal,
    /// In between.
    Semiconductor,
    /// It is transparent, k is 0 or nearly.
    Dielectric,
}

impl Kind {
    /// The name in files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Metal => "metal",
            Kind::Semiconductor => "semiconductor",
            Kind::Dielectric => "dielectric",
        }
    }
}

/// The index of refraction at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Vacuum wavelength in nanometres.
    pub nm: f64,
    /// Real part.
    pub n: f64,
    /// Extinction coefficient.
    pub k: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    name: Spanned<String>,
    summary: Spanned<String>,
    class: Kind,
    licence: Spanned<String>,
    reference: Spanned<String>,
    link: Spanned<String>,
    #[serde(default)]
    conditions: String,
    data: Spanned<Vec<Spanned<Vec<Spanned<f64>>>>>,
}

const FIELDS: [&str; 8] = [
    "name",
    "summary",
    "class",
    "licence",
    "reference",
    "link",
    "conditions",
    "data",
];

/// A row's columns: name, least value, greatest value. 1 nm to 1 mm covers all of optics; no index measured
/// there comes near 1e4. Below n = 0.001 the exact forms lose their last digits in f32.
const COLUMNS: [(&str, f64, f64); 3] = [
    ("wavelength_nm", 1.0, 1e6),
    ("n", 1e-3, 1e4),
    ("k", 0.0, 1e4),
];

impl Material {
    /// Reads a material file. `file` is only for messages.
    pub fn parse(file: &str, text: &str) -> Result<Material, Fault> {
        let at = |offset: usize, what: String| fault(file, text, offset, what);
        let raw: Raw = toml::from_str(text).map_err(|error| syntax_fault(file, text, &error))?;
        if let Some(why) = name_fault(raw.name.get_ref()) {
            let what = format!("field `name`: `{}` is no name: {why}", raw.name.get_ref());
            return Err(at(raw.name.span().start, what));
        }
        let texts = [&raw.summary, &raw.licence, &raw.reference, &raw.link];
        for (name, field) in ["summary", "licence", "reference", "link"]
            .into_iter()
            .zip(texts)
        {
            if field.get_ref().trim().is_empty() {
                return Err(at(
                    field.span().start,
                    format!("field `{name}` is empty; it wants text"),
                ));
            }
        }
        let samples = samples(&raw, &at)?;
        Ok(Material {
            name: raw.name.into_inner(),
            summary: raw.summary.into_inner(),
            kind: raw.class,
            licence: raw.licence.into_inner(),
            reference: raw.reference.into_inner(),
            link: raw.link.into_inner(),
            conditions: raw.conditions,
            samples,
        })
    }
}

/// Why a material cannot have this name: it becomes part of the names of functions and files.
fn name_fault(name: &str) -> Option<&'static str> {
    const LONGEST: usize = 64;
    if name.len() > LONGEST {
        Some("it has more than 64 letters")
    } else if ["aux", "con", "nul", "prn"].contains(&name)
        || name.starts_with("com") && name.len() == 4
    {
        Some("Windows cannot have files of this name")
    } else if name.chars().any(|c| c.is_ascii_uppercase()) {
        Some("capital letters are not allowed: on some systems `Gold` and `gold` are one file")
    } else {
        identifier_fault(name)
    }
}

fn samples(raw: &Raw, at: &impl Fn(usize, String) -> Fault) -> Result<Vec<Sample>, Fault> {
    if raw.data.get_ref().is_empty() {
        return Err(at(
            raw.data.span().start,
            "field `data` is empty; it wants rows of [nm, n, k]".to_owned(),
        ));
    }
    let mut samples: Vec<Sample> = Vec::with_capacity(raw.data.get_ref().len());
    for row in raw.data.get_ref() {
        if row.get_ref().len() != COLUMNS.len() {
            let what = format!(
                "field `data`: a row of {} numbers; it wants [nm, n, k]",
                row.get_ref().len()
            );
            return Err(at(row.span().start, what));
        }
        for (value, (name, low, high)) in row.get_ref().iter().zip(COLUMNS) {
            let number = *value.get_ref();
            if !(low..=high).contains(&number) {
                let what = format!(
                    "field `data`: {name} is {number}; it must lie between {low} and {high}"
                );
                return Err(at(value.span().start, what));
            }
        }
        let [nm, n, k] = [0, 1, 2].map(|i| *row.get_ref()[i].get_ref());
        if let Some(last) = samples.last().filter(|last| last.nm >= nm) {
            let what = format!(
                "field `data`: {nm} nm after {} nm; wavelengths must ascend, each once",
                last.nm
            );
            return Err(at(row.span().start, what));
        }
        samples.push(Sample { nm, n, k });
    }
    Ok(samples)
}

fn syntax_fault(file: &str, text: &str, error: &toml::de::Error) -> Fault {
    let mut what = error.message().trim().replace('\n', "; ");
    if let Some(unknown) = what
        .strip_prefix("unknown field `")
        .and_then(|rest| rest.split('`').next())
    {
        let near = FIELDS.iter().max_by(|a, b| {
            strsim::jaro_winkler(unknown, a).total_cmp(&strsim::jaro_winkler(unknown, b))
        });
        what += &near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
    }
    fault(file, text, error.span().map_or(0, |span| span.start), what)
}

fn fault(file: &str, text: &str, offset: usize, what: String) -> Fault {
    let before = text.get(..offset).unwrap_or("");
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
    Fault {
        file: file.to_owned(),
        line,
        column,
        what,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "name = \"m\"\nsummary = \"s\"\nclass = \"metal\"\nlicence = \"CC0-1.0\"\nreference = \"r\"\nlink = \"l\"\ndata = [\n  [475, 1.4, 1.7],\n  [685, 0.2, 3.9],\n]\n";

    #[track_caller]
    fn check(from: &str, to: &str, line: usize, says: &str) {
        let fault = Material::parse("m.toml", &GOOD.replacen(from, to, 1)).expect_err("a fault");
        assert!(fault.what.contains(says), "{fault}");
        assert_eq!(fault.line, line, "{fault}");
    }

    #[test]
    fn a_good_file_is_read() {
        let material = Material::parse("m.toml", GOOD).expect("it is good");
        assert_eq!(material.samples.len(), 2);
        assert_eq!(material.kind, Kind::Metal);
    }

    #[test]
    fn each_fault_names_its_line_and_field() {
        check("licence = \"CC0-1.0\"\n", "", 1, "missing field `licence`");
        check("0.2,", "-0.2,", 9, "n is -0.2");
        check("3.9]", "nan]", 9, "k is NaN");
        check("1.7]", "inf]", 8, "k is inf");
        check("1.7]", "-1.7]", 8, "k is -1.7");
        check("685", "475", 9, "must ascend");
        check("685", "1.7e-17x", 9, "");
        check("link", "lnik", 6, "did you mean `link`?");
        check("\"metal\"", "\"metall\"", 3, "metal");
        check("\"m\"", "\"Gold 1\"", 1, "field `name`");
        check("\"m\"", "\"Gold\"", 1, "capital letters");
        check("\"r\"", "\" \"", 5, "field `reference` is empty");
        check("1.4, ", "", 8, "a row of 2 numbers");
        check("1.4, ", "1.4, 0, ", 8, "a row of 4 numbers");
        check("\"m\"", "\"con\"", 1, "Windows");
        check(
            "[\n  [475, 1.4, 1.7],\n  [685, 0.2, 3.9],\n]",
            "[]",
            7,
            "is empty",
        );
    }

    #[test]
    fn nothing_in_a_file_makes_it_panic() {
        for end in 0..GOOD.len() {
            let _ = Material::parse("m.toml", &GOOD[..end]);
            let _ = Material::parse("m.toml", &GOOD.replacen(&GOOD[end..=end], "\0", 1));
            let _ = Material::parse("m.toml", &GOOD.replacen(&GOOD[end..=end], "é", 1));
        }
    }
}
