//! A material as text: its file, and its source and licence in one line, as far as its file states them.

use super::formula::{DispersionCurve, Formula};
use super::material::Material;
use crate::physics::foreign::escaped;

impl Material {
    /// The file's text: what [`Material::parse`] reads back as the same material.
    pub fn to_toml(&self) -> String {
        let mut lines = vec![
            text("name", &self.name),
            text("summary", &self.summary),
            text("class", self.kind.name()),
        ];
        if !self.is_recommended() {
            lines.push(text("substance", &self.substance));
        }
        lines.push(text("licence", &self.licence));
        lines.push(text("reference", &self.reference));
        lines.push(text("link", &self.link));
        for (name, value) in [
            ("page", &self.page),
            ("conditions", &self.conditions),
            ("note", &self.note),
        ] {
            if !value.is_empty() {
                lines.push(text(name, value));
            }
        }
        lines.extend(self.rgb_nm.map(|rgb| format!("rgb_nm = {}", list(&rgb))));
        lines.extend(index(&self.n, self.k.as_ref()));
        lines.join("\n") + "\n"
    }
}

/// A text field: TOML's basic strings escape like JSON's. What a terminal obeys is escaped too.
fn text(name: &str, value: &str) -> String {
    let quoted = serde_json::Value::from(value).to_string();
    format!("{name} = {}", escaped(&quoted))
}

fn index(n: &DispersionCurve, k: Option<&DispersionCurve>) -> Vec<String> {
    if let (DispersionCurve::Table(n), Some(DispersionCurve::Table(k))) = (n, k)
        && n.points().len() == k.points().len()
        && n.points().iter().zip(k.points()).all(|(n, k)| n.0 == k.0)
    {
        let both = n.points().iter().zip(k.points());
        return rows(
            "data",
            "n, k",
            both.map(|((nm, n), (_, k))| vec![*nm, *n, *k]),
        );
    }
    let mut lines = curve("n", n);
    lines.extend(k.into_iter().flat_map(|k| curve("k", k)));
    lines
}

fn curve(name: &str, curve: &DispersionCurve) -> Vec<String> {
    match curve {
        DispersionCurve::Table(table) => {
            let row = |(nm, value): &(f64, f64)| vec![*nm, *value];
            rows(name, name, table.points().iter().map(row))
        }
        DispersionCurve::Formula(formula) => vec![formula_line(name, formula)],
    }
}

fn formula_line(name: &str, formula: &Formula) -> String {
    format!(
        "{name}_formula = {{ number = {}, from_nm = {}, to_nm = {}, coefficients = {} }}",
        formula.number,
        formula.from_nm,
        formula.to_nm,
        list(&formula.coefficients)
    )
}

fn rows(name: &str, columns: &str, rows: impl Iterator<Item = Vec<f64>>) -> Vec<String> {
    let mut lines = vec![
        format!("# wavelength in nm, {columns}"),
        format!("{name} = ["),
    ];
    lines.extend(rows.map(|row| format!("  {},", list(&row))));
    lines.push("]".to_owned());
    lines
}

/// Numbers with the fewest digits that read back the same. Very small ones get an exponent, and so do very large ones, which
/// would be integers that TOML cannot hold.
fn list(values: &[f64]) -> String {
    let number = |value: &f64| {
        if *value != 0.0 && !(1e-4..1e15).contains(&value.abs()) {
            format!("{value:e}")
        } else {
            value.to_string()
        }
    };
    format!(
        "[{}]",
        values.iter().map(number).collect::<Vec<_>>().join(", ")
    )
}

/// The text in a material's file for what its source does not state.
pub(super) const NOT_GIVEN: &str = "not given";

impl Material {
    /// `Data: reference. link. Licence CC0-1.0`, without the parts that are not given; none if all are missing.
    pub fn data_line(&self) -> Option<String> {
        let source = self.source_words(". ");
        let licence = given(&self.licence).map(|licence| format!("Licence {licence}"));
        let parts: Vec<String> = source.into_iter().chain(licence).collect();
        (!parts.is_empty()).then(|| format!("Data: {}", parts.join(". ")))
    }

    /// Reference and link, separated by `between`; none if neither is given.
    pub fn source_words(&self, between: &str) -> Option<String> {
        // The reference's own full stop is dropped.
        let reference = given(&self.reference).map(|text| {
            if between.starts_with('.') {
                text.trim_end_matches('.')
            } else {
                text
            }
        });
        let parts: Vec<&str> = reference.into_iter().chain(given(&self.link)).collect();
        (!parts.is_empty()).then(|| parts.join(between))
    }

    /// The year of the reference: the first in brackets, or the last number that can be one.
    pub fn year(&self) -> Option<u16> {
        let is_year = |year: &u16| (1800..=2100).contains(year);
        let number = |word: &str| {
            let is_number = word.len() == 4 && word.bytes().all(|byte| byte.is_ascii_digit());
            word.parse().ok().filter(|year| is_number && is_year(year))
        };
        let after_brackets = self.reference.split('(').skip(1);
        let mut in_brackets = after_brackets.filter_map(|rest| number(rest.split(')').next()?));
        let words = self.reference.split(|c: char| !c.is_alphanumeric());
        in_brackets.next().or_else(|| words.rev().find_map(number))
    }

    /// The licence of the numbers, if it is given.
    pub fn licence_words(&self) -> Option<&str> {
        given(&self.licence)
    }
}

fn given(text: &str) -> Option<&str> {
    let text = text.trim();
    (!text.is_empty() && text != NOT_GIVEN).then_some(text)
}

#[cfg(test)]
mod tests {
    use crate::physics::materials::find;

    #[track_caller]
    fn check(fields: [&str; 3], line: Option<&str>) {
        let mut material = find("gold").unwrap().unwrap();
        let [reference, link, licence] = fields.map(str::to_owned);
        material.reference = reference;
        material.link = link;
        material.licence = licence;
        assert_eq!(material.data_line().as_deref(), line);
    }

    #[test]
    fn a_line_says_what_is_given() {
        check(
            ["A. Author, group.", "https://example.org", "CC0-1.0"],
            Some("Data: A. Author, group. https://example.org. Licence CC0-1.0"),
        );
        check(
            ["A. Author", "not given", "MIT"],
            Some("Data: A. Author. Licence MIT"),
        );
        check(["not given", "not given", "MIT"], Some("Data: Licence MIT"));
        check(["not given", "not given", "not given"], None);
    }
}
