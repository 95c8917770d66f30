//! A material as the text of its file.

use super::dispersion::DispersionCurve;
use super::formula::Formula;
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

/// A field of text: TOML's basic strings escape as JSON's do. What a terminal obeys is escaped too.
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

/// Numbers in the fewest digits that give them back; very small ones with an exponent, and very large ones, which
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
