//! The material file, TOML checked field by field, and the place of faults in it.
//!
//! ```toml
//! name = "my_gold"                  # snake_case: it becomes part of function and file names
//! summary = "Gold, evaporated film" # one line, as all texts but the note are
//! class = "metal"                   # metal, semiconductor or dielectric
//! licence = "CC0-1.0"               # of these numbers
//! reference = "Author, Title, Journal, Year"
//! link = "https://doi.org/..."
//! # These may be left out:
//! substance = "gold"                # what it is an alternative measurement of
//! page = "main/Au/nk/Mine.yml"      # the page of refractiveindex.info that it was taken from
//! conditions = "room temperature"
//! note = "why, and what was done to the numbers"
//! rgb_nm = [685, 535, 475]          # known at these wavelengths of red, green and blue only
//! # wavelength in nm (ascending), n, k
//! data = [
//!   [380, 1.68, 1.94],
//!   [780, 0.15, 4.74],
//! ]
//! ```
//!
//! Instead of `data`, n and k can be given separately: `n = [[nm, n], …]`, or `n_formula = { number = 2, from_nm = 300,
//! to_nm = 2500, coefficients = [0, 1.04, …] }` with the formulas of [`super::formula`], which take micrometres; and
//! `k = [[nm, k], …]`, or nothing where k is 0.

use serde::Deserialize;
use toml::Spanned;

use super::decimal::short;
use super::formula::{DispersionCurve, Formula, NUMBERS};
use super::material::{GREATEST, LEAST_N, Material, MaterialKind};
use crate::physics::foreign::is_hidden;
use crate::physics::names::identifier_fault;
use crate::physics::user_text::{FileFault, FileText};

type RawRow = Spanned<Vec<Spanned<f64>>>;
type RawRows = Spanned<Vec<RawRow>>;
type Curves = (DispersionCurve, Option<DispersionCurve>);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    name: Spanned<String>,
    summary: Spanned<String>,
    class: MaterialKind,
    licence: Spanned<String>,
    reference: Spanned<String>,
    link: Spanned<String>,
    substance: Option<Spanned<String>>,
    page: Option<Spanned<String>>,
    conditions: Option<Spanned<String>>,
    note: Option<Spanned<String>>,
    rgb_nm: Option<Spanned<[f64; 3]>>,
    data: Option<RawRows>,
    n: Option<RawRows>,
    k: Option<RawRows>,
    n_formula: Option<Spanned<Formula>>,
}

/// The fields of a material, those that it must have first.
const FIELDS: [&str; 15] = [
    "name",
    "summary",
    "class",
    "licence",
    "reference",
    "link",
    "substance",
    "page",
    "conditions",
    "note",
    "rgb_nm",
    "data",
    "n",
    "k",
    "n_formula",
];
const REQUIRED: usize = 6;

/// A column of a row: name, least value, greatest value.
type Column = (&'static str, f64, f64);
/// 1 nm to 1 mm covers all of optics.
const NM: Column = ("wavelength_nm", 1.0, 1e6);
const N: Column = ("n", LEAST_N, GREATEST);
/// A k below 0 would mean gain.
const K: Column = ("k", 0.0, GREATEST);
/// More than any formula of refractiveindex.info has: 17.
pub const MOST_COEFFICIENTS: usize = 64;

impl Material {
    /// Reads a material file. `file` is only for messages.
    ///
    /// ```
    /// use fresnel_gen::physics::materials::{Material, source};
    ///
    /// let text = source("water").expect("the catalogue has it");
    /// assert_eq!(Material::parse("water.toml", text).map(|water| water.name), Ok("water".to_owned()));
    /// ```
    ///
    /// # Errors
    /// The text is not TOML, a field is missing or unknown, or a value lies outside its limits.
    pub fn parse(file: &str, text: &str) -> Result<Material, FileFault> {
        let place = FileText { file, text };
        if names_base(text) {
            return Material::parse_stack(file, text);
        }
        let raw: Raw = toml::from_str(text)
            .map_err(|error| place.syntax(&error, &FIELDS, &FIELDS[..REQUIRED]))?;
        check_name("name", &raw.name, &place)?;
        if let Some(substance) = &raw.substance {
            check_name("substance", substance, &place)?;
        }
        let texts = [
            ("summary", &raw.summary),
            ("licence", &raw.licence),
            ("reference", &raw.reference),
            ("link", &raw.link),
        ];
        for (name, field) in texts {
            if field.get_ref().trim().is_empty() {
                let what = format!("field `{name}` is empty; it wants text");
                return Err(place.fault(field.span().start, what));
            }
            place.one_line(name, field)?;
        }
        for (name, field) in [("page", &raw.page), ("conditions", &raw.conditions)] {
            if let Some(field) = field {
                place.one_line(name, field)?;
            }
        }
        let rgb_nm = raw.rgb_nm.as_ref();
        let rgb_nm = rgb_nm.map(|rgb| place.three(rgb)).transpose()?;
        let (n, k) = curves(&raw, &place)?;
        let name = raw.name.into_inner();
        let text =
            |field: Option<Spanned<String>>| field.map_or(String::new(), Spanned::into_inner);
        Ok(Material {
            substance: raw.substance.map_or(name.clone(), Spanned::into_inner),
            name,
            summary: raw.summary.into_inner(),
            kind: raw.class,
            licence: raw.licence.into_inner(),
            reference: raw.reference.into_inner(),
            link: raw.link.into_inner(),
            page: text(raw.page),
            conditions: text(raw.conditions),
            note: text(raw.note),
            rgb_nm,
            n,
            k,
            films: Vec::new(),
        })
    }
}

impl Material {
    /// The first of its numbers that a material file does not allow, if any, in words.
    pub fn limits_fault(&self) -> Option<String> {
        let curve = |curve: &DispersionCurve, column| match curve {
            DispersionCurve::Table(table) => table
                .points()
                .iter()
                .find_map(|point| point_fault(*point, column)),
            DispersionCurve::Formula(formula) => formula_fault(formula),
        };
        curve(&self.n, N).or_else(|| curve(self.k.as_ref()?, K))
    }
}

/// Whether a file names a base, as that of a stack does.
fn names_base(text: &str) -> bool {
    let table = text.contains("base").then(|| text.parse::<toml::Table>());
    table.is_some_and(|table| table.is_ok_and(|table| table.contains_key("base")))
}

fn point_fault((nm, value): (f64, f64), (name, low, high): Column) -> Option<String> {
    let (_, shortest, longest) = NM;
    if !(shortest..=longest).contains(&nm) {
        return Some(format!(
            "a wavelength is {nm:e} nm; it must lie between {shortest} and {longest}{}",
            if nm < shortest {
                "; are these micrometres, in a column named nm?"
            } else {
                "; are these nanometres, in a column named um?"
            }
        ));
    }
    let fault = || format!("{name} is {value:e} at {nm} nm; it must lie between {low} and {high}");
    (!(low..=high).contains(&value)).then(fault)
}

fn formula_fault(formula: &Formula) -> Option<String> {
    let (_, low, high) = NM;
    let Formula {
        number,
        coefficients,
        from_nm,
        to_nm,
    } = formula;
    if !NUMBERS.contains(number) {
        Some(format!("there is no formula {number}; there are 1 to 9"))
    } else if !(low <= *from_nm && from_nm < to_nm && *to_nm <= high) {
        Some(format!(
            "the range of a formula must ascend between {low} and {high} nm"
        ))
    } else if coefficients.len() > MOST_COEFFICIENTS || coefficients.iter().any(|c| !c.is_finite())
    {
        Some(format!(
            "coefficients must be finite, and at most {MOST_COEFFICIENTS}"
        ))
    } else if let Some(what) = formula.missing_partner() {
        Some(what)
    } else {
        let outlier = formula.outlier(*from_nm, *to_nm, LEAST_N, GREATEST)?;
        Some(format!(
            "{} at {} nm; n must lie between {LEAST_N} and {GREATEST} all over its range, {from_nm} to {to_nm} nm",
            outlier.gives,
            short(outlier.nm)
        ))
    }
}

pub(super) fn check_name(
    field: &str,
    name: &Spanned<String>,
    place: &FileText,
) -> Result<(), FileFault> {
    name_fault(name.get_ref()).map_or(Ok(()), |why| {
        let what = format!("field `{field}`: `{}` is no name: {why}", name.get_ref());
        Err(place.fault(name.span().start, what))
    })
}

/// Why a material cannot have this name: it becomes part of the names of functions and files.
pub fn name_fault(name: &str) -> Option<&'static str> {
    const LONGEST: usize = 64;
    if name.len() > LONGEST {
        Some("it has more than 64 letters")
    } else if is_device(name) {
        Some("Windows cannot have files of this name")
    } else if name.chars().any(|c| c.is_ascii_uppercase()) {
        Some("capital letters are not allowed: on some systems `Gold` and `gold` are one file")
    } else {
        identifier_fault(name)
    }
}

/// Whether Windows reserves a name for a device, with any extension: COM1 to COM9 and LPT1 to LPT9 are ports.
fn is_device(name: &str) -> bool {
    let port = name
        .strip_prefix("com")
        .or_else(|| name.strip_prefix("lpt"));
    ["aux", "con", "nul", "prn"].contains(&name)
        || port.is_some_and(|port| matches!(port.as_bytes(), [b'1'..=b'9']))
}

/// n and k: together in `data`, or separate.
fn curves(raw: &Raw, place: &FileText) -> Result<Curves, FileFault> {
    let table =
        |rows: &RawRows, field, column| Ok(pick(&place.rows(rows, field, &[NM, column])?, 1));
    let k = || raw.k.as_ref().map(|k| table(k, "k", K)).transpose();
    match (&raw.data, &raw.n, &raw.n_formula) {
        (Some(data), None, None) if raw.k.is_none() => {
            let rows = place.rows(data, "data", &[NM, N, K])?;
            Ok((pick(&rows, 1), Some(pick(&rows, 2))))
        }
        (None, Some(n), None) => Ok((table(n, "n", N)?, k()?)),
        (None, None, Some(formula)) => {
            Ok((DispersionCurve::Formula(place.formula(formula)?), k()?))
        }
        _ => {
            let what = "the index is wanted once: `data` alone, or one of `n` and `n_formula`, with `k` where it absorbs";
            Err(place.fault(0, what.to_owned()))
        }
    }
}

/// One column of checked rows, by wavelength.
fn pick(rows: &[Vec<f64>], column: usize) -> DispersionCurve {
    let points = rows.iter().map(|row| (row[0], row[column])).collect();
    DispersionCurve::table(points).expect("rows are checked to ascend")
}

impl FileText<'_> {
    /// Rows of numbers, checked to lie within their columns' limits and to ascend in wavelength.
    fn rows(
        &self,
        rows: &RawRows,
        field: &str,
        columns: &[Column],
    ) -> Result<Vec<Vec<f64>>, FileFault> {
        let names: Vec<&str> = columns.iter().map(|(name, ..)| *name).collect();
        let wanted = names.join(", ");
        if rows.get_ref().is_empty() {
            let what = format!("field `{field}` is empty; it wants rows of [{wanted}]");
            return Err(self.fault(rows.span().start, what));
        }
        let mut read: Vec<Vec<f64>> = Vec::with_capacity(rows.get_ref().len());
        for row in rows.get_ref() {
            let numbers = self.row(row, field, columns, &wanted)?;
            if let Some(last) = read.last().filter(|last| last[0] >= numbers[0]) {
                let what = format!(
                    "field `{field}`: {} nm after {} nm; wavelengths must ascend, each once",
                    numbers[0], last[0]
                );
                return Err(self.fault(row.span().start, what));
            }
            read.push(numbers);
        }
        Ok(read)
    }

    fn row(
        &self,
        row: &RawRow,
        field: &str,
        columns: &[Column],
        wanted: &str,
    ) -> Result<Vec<f64>, FileFault> {
        if row.get_ref().len() != columns.len() {
            let found = row.get_ref().len();
            let what = format!("field `{field}`: a row of {found} numbers; it wants [{wanted}]");
            return Err(self.fault(row.span().start, what));
        }
        for (value, (name, low, high)) in row.get_ref().iter().zip(columns) {
            let number = *value.get_ref();
            if !(*low..=*high).contains(&number) {
                let what = format!(
                    "field `{field}`: {name} is {number}; it must lie between {low} and {high}"
                );
                return Err(self.fault(value.span().start, what));
            }
        }
        Ok(row.get_ref().iter().map(|value| *value.get_ref()).collect())
    }

    /// Checks that a field has no line breaks, and nothing that a terminal obeys.
    pub(super) fn one_line(&self, name: &str, field: &Spanned<String>) -> Result<(), FileFault> {
        let Some(hidden) = field.get_ref().chars().find(|c| is_hidden(*c)) else {
            return Ok(());
        };
        let what = match hidden {
            '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}' => {
                "a line break".to_owned()
            }
            _ => format!("the control character U+{:04X}", u32::from(hidden)),
        };
        let what = format!("field `{name}` holds {what}; it wants one line of plain text");
        Err(self.fault(field.span().start, what))
    }

    /// A formula, checked to have all its numbers.
    fn formula(&self, raw: &Spanned<Formula>) -> Result<Formula, FileFault> {
        match formula_fault(raw.get_ref()) {
            None => Ok(raw.get_ref().clone()),
            Some(what) => Err(self.fault(raw.span().start, format!("field `n_formula`: {what}"))),
        }
    }

    /// Three wavelengths, checked to lie within limits.
    fn three(&self, rgb: &Spanned<[f64; 3]>) -> Result<[f64; 3], FileFault> {
        let (_, low, high) = NM;
        if rgb.get_ref().iter().all(|nm| (low..=high).contains(nm)) {
            return Ok(*rgb.get_ref());
        }
        let what = format!("field `rgb_nm`: wavelengths must lie between {low} and {high} nm");
        Err(self.fault(rgb.span().start, what))
    }

    /// The parser's error, with the nearest of these fields for an unknown one, and with all that is missing of the required ones.
    pub(super) fn syntax(
        &self,
        error: &toml::de::Error,
        fields: &[&str],
        required: &[&str],
    ) -> FileFault {
        let mut what = error.message().trim().replace('\n', "; ");
        if let Some(unknown) = what
            .strip_prefix("unknown field `")
            .and_then(|rest| rest.split('`').next())
        {
            let near = fields.iter().max_by(|a, b| {
                strsim::jaro_winkler(unknown, a).total_cmp(&strsim::jaro_winkler(unknown, b))
            });
            what += &near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
        }
        let table: toml::Table = toml::from_str(self.text).unwrap_or_default();
        let missing = required.iter().filter(|field| !table.contains_key(**field));
        let missing: Vec<String> = missing.map(|field| format!("`{field}`")).collect();
        if what.starts_with("missing field") && missing.len() > 1 {
            what = format!("missing fields {}", missing.join(", "));
        }
        self.fault(error.span().map_or(0, |span| span.start), what)
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
        assert_eq!(material.range_nm(), (475.0, 685.0));
        assert_eq!(material.kind, MaterialKind::Metal);
        assert_eq!(material.substance, "m");
        assert_eq!(Material::parse("m.toml", &material.to_toml()), Ok(material));
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
        check("\"m\"", "\"lpt1\"", 1, "Windows");
        check("\"m\"", "\"com9\"", 1, "Windows");
        for (text, says) in [
            ("\"a\\nb\"", "field `summary` holds a line break"),
            ("\"\"\"a\n b\"\"\"", "field `summary` holds a line break"),
            ("\"a\\u2028b\"", "field `summary` holds a line break"),
            ("\"a\\u001b[31m\"", "control character U+001B"),
            ("\"a\\u009d\"", "control character U+009D"),
            ("\"a\\u202e\"", "control character U+202E"),
        ] {
            check("\"s\"", text, 2, says);
        }
        check(
            "\"r\"",
            "\"a\\nb\"",
            5,
            "field `reference` holds a line break",
        );
        check(
            "data",
            "conditions = \"a\\rb\"\ndata",
            7,
            "field `conditions` holds a line break",
        );
        check(
            "[\n  [475, 1.4, 1.7],\n  [685, 0.2, 3.9],\n]",
            "[]",
            7,
            "is empty",
        );
    }

    #[test]
    fn a_name_that_only_looks_like_a_port_is_free() {
        for name in ["comb", "com0", "lpt", "lpta", "com10", "coma"] {
            assert_eq!(name_fault(name), None, "{name}");
        }
    }

    /// Each is finite, but none gives a valid index: it is too large, has a pole between two samples, or is 0 or below.
    #[test]
    fn a_formula_must_give_an_index_all_over_its_range() {
        let apart = GOOD.split("data").next().expect("a head").to_owned();
        for (number, coefficients, says) in [
            (1, "[1e155]", "formula 1 gives n^2 = "),
            (5, "[1e155]", "formula 5 gives n = "),
            (5, "[-1e300]", "formula 5 gives n = "),
            (5, "[20000]", "n must lie between 0.001 and 10000"),
            (5, "[1e-4]", "formula 5 gives n = 0.0001 at 300 nm"),
            (5, "[0]", "formula 5 gives n = 0 at 300 nm"),
            (3, "[1e308, 1e308, 300]", "formula 3 gives n^2 = "),
            (3, "[2, -1, 2]", "formula 3 gives n^2 = "),
            // A pole, with n^2 below 0 before it. Then poles so narrow that no sample comes near them.
            (1, "[0, 1, 0.600123]", " at 424.35 nm"),
            (2, "[0, 1e-12, 0.36]", "formula 2 gives n^2 = "),
            (4, "[2, 1e-9, 0, 0.6, 2]", "formula 4 gives n^2 = "),
            (6, "[0, 1e-9, 2.5]", "formula 6 gives n = "),
            (8, "[0, 0.5, 0.36]", "formula 8 gives n^2 = "),
            (9, "[2, 1e-9, 0.36]", "formula 9 gives n^2 = "),
        ] {
            let more = format!(
                "n_formula = {{ number = {number}, from_nm = 300, to_nm = 2500, coefficients = {coefficients} }}\n"
            );
            let fault = Material::parse("m.toml", &(apart.clone() + &more)).expect_err(&more);
            assert!(fault.what.contains(says), "{fault}");
            assert_eq!(fault.line, 7, "{fault}");
        }
        // The pole of formula 7 lies at 167.3 nm.
        for (from, is_read) in [(168, true), (100, false)] {
            let more = format!(
                "n_formula = {{ number = 7, from_nm = {from}, to_nm = 2500, coefficients = [1.5, 1e-6] }}\n"
            );
            let read = Material::parse("m.toml", &(apart.clone() + &more));
            assert_eq!(read.is_ok(), is_read, "{read:?}");
        }
    }

    #[test]
    fn n_and_k_can_stand_apart() {
        let apart = GOOD.split("data").next().expect("a head").to_owned();
        let glass = apart.clone()
            + "n_formula = { number = 2, from_nm = 300, to_nm = 2500, coefficients = [0, 1.04, 0.006] }\nk = [[400, 1e-8]]\n";
        let material = Material::parse("m.toml", &glass).expect("it is good");
        assert_eq!(material.range_nm(), (400.0, 400.0));
        assert_eq!(Material::parse("m.toml", &material.to_toml()), Ok(material));
        let table = apart.clone() + "n = [[400, 1.5], [700, 1.4]]\n";
        let material = Material::parse("m.toml", &table).expect("it is good");
        assert_eq!(material.k, None);
        assert_eq!(Material::parse("m.toml", &material.to_toml()), Ok(material));
        for (more, says) in [
            ("", "the index is wanted once"),
            ("k = [[400, 1]]\n", "the index is wanted once"),
            (
                "data = [[400, 1, 1]]\nn = [[400, 1]]\n",
                "the index is wanted once",
            ),
            (
                "data = [[400, 1, 1]]\nk = [[400, 1]]\n",
                "the index is wanted once",
            ),
            (
                "n_formula = { number = 10, from_nm = 300, to_nm = 400, coefficients = [] }\n",
                "no formula 10",
            ),
            (
                "n_formula = { number = 1, from_nm = 400, to_nm = 300, coefficients = [] }\n",
                "must ascend",
            ),
            (
                "n_formula = { number = 1, from_nm = 300, to_nm = 400, coefficients = [nan] }\n",
                "must be finite",
            ),
            ("n = [[400, 1]]\nrgb_nm = [0, 500, 600]\n", "`rgb_nm`"),
            (
                "n = [[400, 1]]\nsubstance = \"Gold\"\n",
                "field `substance`",
            ),
        ] {
            let fault = Material::parse("m.toml", &(apart.clone() + more)).expect_err("a fault");
            assert!(fault.what.contains(says), "{fault}");
        }
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
