//! Converts a page to a material. A page states no name, class or summary: these are derived from its contents.

use super::Page;
use crate::physics::foreign::is_hidden;
use crate::physics::materials::decimal::short;
use crate::physics::materials::formula::{DispersionCurve, Extrapolate};
use crate::physics::materials::print::NOT_GIVEN;
use crate::physics::materials::{Index, Material, MaterialKind, name_fault};
use crate::physics::user_text::FileFault;

/// The wavelength at which the class is guessed: near the middle of the visible range.
pub(super) const GUESS_NM: f64 = 580.0;

/// The k from which a non-metal is taken for a semiconductor rather than a dielectric. Visible light falls by a factor e
/// over some 50 micrometres of it.
const ABSORBING_K: f64 = 1e-3;

impl Page {
    /// The material of this page, under the given name or else [`Page::default_name`]. The fields are public, so you can
    /// replace those that you know better.
    ///
    /// # Errors
    /// The name is not a legal one, the page gives no n, or n and k share no range.
    pub fn material(&self, name: Option<&str>) -> Result<Material, FileFault> {
        let name = name.map_or_else(|| self.default_name(), str::to_owned);
        if let Some(why) = name_fault(&name) {
            return Err(self.fault(format!("`{name}` is no name: {why}")));
        }
        let Some(n) = self.n.clone() else {
            let what = "the page gives k only, no n: there is no reflectance without n";
            return Err(self.fault(what.to_owned()));
        };
        let mut material = Material {
            substance: name.clone(),
            name,
            // It contains the file's name, and must be one line.
            summary: self.summary().replace(is_hidden, " "),
            kind: MaterialKind::Dielectric,
            licence: or(&self.licence, NOT_GIVEN),
            reference: or(&self.reference, NOT_GIVEN),
            link: or(&self.link, NOT_GIVEN),
            page: self.path(),
            conditions: self.conditions.clone(),
            note: String::new(),
            rgb_nm: None,
            n,
            k: self.k.clone(),
            films: Vec::new(),
        };
        let mut remarks = self.remarks.clone();
        let (from, to) = material.range_nm();
        if from > to {
            if !material.k.as_ref().is_some_and(is_zero) {
                let what = "n and k have no wavelength in common";
                return Err(self.fault(what.to_owned()));
            }
            // Two glasses of a catalogue have k = 0 at two wavelengths in the ultraviolet, where n is not given.
            material.k = None;
            remarks.push(
                "k is 0 at all of its wavelengths, where n is not given: left out".to_owned(),
            );
        }
        let guess;
        (material.kind, guess) = guessed(&material);
        remarks.push(guess);
        material.note = remarks.join("; ");
        Ok(material)
    }

    /// `Au, Olmon-ts: Template-stripped gold`, not too long.
    fn summary(&self) -> String {
        const LONGEST: usize = 100;
        let (book, title) = self.book_and_title();
        let parts = [book, or(&title, "a page")];
        let named: Vec<&str> = parts
            .iter()
            .map(String::as_str)
            .filter(|part| !part.is_empty())
            .collect();
        let named = named.join(", ");
        let whole = format!("{named}: {}", self.comments);
        if self.comments.is_empty() || whole.chars().count() > LONGEST {
            named
        } else {
            whole
        }
    }

    fn fault(&self, what: String) -> FileFault {
        FileFault::new(&self.file, 1, 1, what)
    }
}

fn is_zero(curve: &DispersionCurve) -> bool {
    match curve {
        DispersionCurve::Table(table) => table.points().iter().all(|(_, value)| *value == 0.0),
        DispersionCurve::Formula(_) => false,
    }
}

fn or(text: &str, other: &str) -> String {
    let text = if text.trim().is_empty() { other } else { text };
    text.to_owned()
}

/// The class that n and k suggest, and the remark that says so.
fn guessed(material: &Material) -> (MaterialKind, String) {
    let (from, to) = material.range_nm();
    let middle = (from + to) / 2.0;
    let index = |nm: f64| {
        let index = material.index(nm, Extrapolate::Refuse).ok()?;
        Some((nm, index))
    };
    let places = [GUESS_NM, middle, from, to];
    match places.into_iter().find_map(index) {
        Some((nm, Index { n, k })) => {
            let kind = kind(n, k);
            let name = kind.name();
            let [n, k, nm] = [n, k, nm].map(short);
            let guess = format!("class {name} guessed from n = {n}, k = {k} at {nm} nm");
            (kind, guess)
        }
        None => (
            MaterialKind::Dielectric,
            "class dielectric guessed".to_owned(),
        ),
    }
}

/// A negative real part of the permittivity is a metal's.
fn kind(n: f64, k: f64) -> MaterialKind {
    if n < k {
        MaterialKind::Metal
    } else if k > ABSORBING_K {
        MaterialKind::Semiconductor
    } else {
        MaterialKind::Dielectric
    }
}
