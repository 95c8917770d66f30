//! A page of the refractiveindex.info database: YAML, made by hand over twenty years. It is read for what it says,
//! refused where it cannot be meant, and what was done to its numbers is said in remarks.
//!
//! ```yaml
//! REFERENCES: |            # HTML or Markdown
//!     P. B. Johnson and R. W. Christy. Optical constants ...
//! COMMENTS: |
//!     Room temperature
//! DATA:
//!   - type: tabulated nk   # or: tabulated n, tabulated k, formula 1 to formula 9; several items add up
//!     data: |
//!         0.1879 1.28 1.188
//!   - type: formula 2
//!     wavelength_range: 0.3 2.5
//!     coefficients: 0 1.03961212 0.00600069867
//! CONDITIONS:
//!     temperature: 293
//! PROPERTIES:
//!     nd: 1.5168
//! ```
//!
//! Wavelengths are in micrometres there. The formulas are those of [`super::Formula`]. Source: M. N. Polyanskiy,
//! *Refractiveindex.info database of optical constants*, Scientific Data 11, 94 (2024),
//! <https://doi.org/10.1038/s41597-023-02898-2>.

mod item;
mod material;
mod name;
mod plain;
mod yaml;

use super::dispersion::Curve;
use super::file::Fault;

/// What a page of refractiveindex.info says, or a table that someone measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Page {
    /// The file, as the user named it.
    pub file: String,
    /// Refractive index by wavelength.
    pub n: Option<Curve>,
    /// Extinction coefficient by wavelength, not below 0.
    pub k: Option<Curve>,
    /// Who measured it, as one line of plain text; may be empty.
    pub reference: String,
    /// Where to read about it: its DOI as a link, or the first link; may be empty.
    pub link: String,
    /// One line of plain text; may be empty.
    pub comments: String,
    /// Temperature, film thickness and the like, as `key: value, ...`, in SI units, keys as they are spelt; may be empty.
    pub conditions: String,
    /// The index at the d line of helium, 587.5618 nm, that a glass's maker prints.
    pub nd: Option<f64>,
    /// What was done to the numbers.
    pub remarks: Vec<String>,
}

/// The longest text that is read: more than all pages together.
pub(super) const MOST_BYTES: usize = 64 << 20;

impl Page {
    /// Reads a page. `file` is for messages, and for the page's own name.
    pub fn parse(file: &str, text: &str) -> Result<Page, Fault> {
        check_text(file, text)?;
        let raw = yaml::read(file, text)?;
        let mut page = Page {
            file: file.to_owned(),
            reference: plain::line(raw.references.as_deref().unwrap_or("")),
            link: plain::link(raw.references.as_deref().unwrap_or("")),
            comments: plain::line(raw.comments.as_deref().unwrap_or("")),
            conditions: plain::line(&raw.conditions.unwrap_or_default().said()),
            nd: raw.properties.and_then(|properties| properties.nd()),
            ..Page::default()
        };
        for item in item::read(file, text, raw.data)? {
            page.add(item.n, item.k, item.remarks);
        }
        Ok(page)
    }

    /// Adds what one table or formula gives. Where two give the same quantity, the first counts: on the one page that
    /// does so (PVP, Konig) the formula goes before a table that was computed from it.
    pub(super) fn add(&mut self, n: Option<Curve>, k: Option<Curve>, remarks: Vec<String>) {
        let mut take = |own: &mut Option<Curve>, curve: Option<Curve>, letter: &str| {
            if own.is_some() && curve.is_some() {
                let what = format!("{letter} is given twice: the first was taken");
                self.remarks.push(what);
            } else if curve.is_some() {
                *own = curve;
            }
        };
        take(&mut self.n, n, "n");
        take(&mut self.k, k, "k");
        self.remarks.extend(remarks);
    }
}

/// Whether a text can be read at all.
pub(super) fn check_text(file: &str, text: &str) -> Result<(), Fault> {
    let fault = |at: usize, what: String| {
        let before = &text[..at];
        Fault {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before.rsplit('\n').next().unwrap_or("").chars().count() + 1,
            what,
        }
    };
    if text.len() > MOST_BYTES {
        let what = format!(
            "the file has {} bytes; at most {MOST_BYTES} are read",
            text.len()
        );
        return Err(fault(0, what));
    }
    match text.find('\0') {
        Some(at) => Err(fault(at, "a NUL byte: this is no text".to_owned())),
        None => Ok(()),
    }
}
