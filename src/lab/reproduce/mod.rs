//! The thesis that this program began with, reproduced: its figures beside ours, its curves, its claims.
//!
//! Source: Štetić-Kozić, "Poređenje metoda za računanje koeficijenata Frenelove refleksije u programima za senčenje",
//! diploma thesis, University of Belgrade, 2014.
//!
//! Pure: no disk, no terminal. Each part is a file. To add one, write it and give it an entry in [`PARTS`].

mod claims;
pub mod comparison;
mod counts;
mod figures;
mod function_errors;
mod indices;
mod lookup_tables;
mod rendered;
mod specialised;
mod thesis_measure;
mod three_wavelengths;
mod times;

use comparison::Meter;

pub use comparison::{ComparisonRow, ComparisonVerdict, Figure, ThesisSection};
pub use figures::{DrawnCurve, POINTS as FIGURE_POINTS, ThesisFigure};

/// A part of the thesis that can be reproduced.
#[derive(Debug)]
pub struct Part {
    /// The name on the command line and in every row.
    pub name: &'static str,
    /// How often it evaluates all angles, for progress.
    passes: usize,
    section: fn(usize, &mut Meter) -> ThesisSection,
}

/// All parts in the order of the report.
pub static PARTS: [Part; 10] = [
    part("table1", 0, |_, _| indices::section()),
    part("table2", 4, function_errors::metals),
    part("table3", 2, function_errors::dielectrics),
    part("table4", 2, lookup_tables::metals),
    part("table5", 2, lookup_tables::dielectrics),
    part("table6", 0, |_, _| counts::section()),
    part("table7", 0, |_, _| times::section()),
    part("table8", 0, |_, _| three_wavelengths::section()),
    part("claims", claims::PASSES, claims::section),
    part(FIGURES, 0, |_, _| figures::section()),
];

/// The part whose curves are drawn too.
const FIGURES: &str = "figures";

const fn part(
    name: &'static str,
    passes: usize,
    section: fn(usize, &mut Meter) -> ThesisSection,
) -> Part {
    Part {
        name,
        passes,
        section,
    }
}

/// The parts of the thesis that have no rows here, and why.
pub const NOT_MEASURED: [(&str, &str); 1] = [(
    "the sculpture of tables 4 and 5",
    "its mesh is not part of this program: a relief of ours stands in its place, and scene-error --mesh takes any mesh",
)];

/// Parts reproduced.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    /// The parts, in the requested order.
    pub sections: Vec<ThesisSection>,
    /// The curves, where they were requested.
    pub figures: Vec<ThesisFigure>,
}

/// Reproduces parts. Function errors are taken at `angles` angles ([`comparison::ANGLES`] in the thesis). `say` is told the
/// progress: how much is done, of how much, and of what.
pub fn reproduce(
    parts: &[&Part],
    angles: usize,
    say: &mut dyn FnMut(u64, u64, &str),
) -> Reproduction {
    let whole = parts.iter().map(|part| part.passes * angles).sum();
    let mut meter = Meter::new(whole, say);
    let section = |part: &&Part| (part.section)(angles, &mut meter);
    Reproduction {
        sections: parts.iter().map(section).collect(),
        figures: if parts.iter().any(|part| part.name == FIGURES) {
            figures::figures()
        } else {
            Vec::new()
        },
    }
}

impl Reproduction {
    /// All rows, part by part.
    pub fn comparisons(&self) -> impl Iterator<Item = &ComparisonRow> {
        self.sections.iter().flat_map(|section| &section.rows)
    }

    /// Whether a figure that must agree differs.
    pub fn has_findings(&self) -> bool {
        self.comparisons()
            .any(|row| row.verdict == ComparisonVerdict::Differs)
    }
}
