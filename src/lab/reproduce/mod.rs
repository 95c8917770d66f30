//! The thesis that this program began with, reproduced: its figures beside ours, its curves, its claims.
//!
//! Source: Štetić-Kozić, "Poređenje metoda za računanje koeficijenata Frenelove refleksije u programima za senčenje",
//! diploma thesis, University of Belgrade, 2014.
//!
//! Pure: no disk, no terminal. Each part is a file. To add one, write it and give it an entry in [`Part`].

mod claims;
pub mod comparison;
mod counts;
mod figures;
mod function_errors;
mod indices;
mod lookup_tables;
mod rendered;
mod section;
mod specialised;
mod three_wavelengths;
mod times;

use section::Meter;

pub use comparison::{ComparisonRow, ComparisonVerdict, Figure};
pub use figures::{DrawnCurve, POINTS as FIGURE_POINTS, ThesisFigure};
pub use section::ThesisSection;

/// A part of the thesis that can be reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The indices of refraction.
    Table1,
    /// Function errors, metals.
    Table2,
    /// Function errors, dielectrics.
    Table3,
    /// Rendered errors and lookup tables, metals.
    Table4,
    /// Rendered errors and lookup tables, dielectrics.
    Table5,
    /// Relative times, beside compilers' instruction counts.
    Table6,
    /// Absolute times: the check of the table's column heads.
    Table7,
    /// Three wavelengths in place of the spectrum.
    Table8,
    /// The claims of the text.
    Claims,
    /// The reflectance curves.
    Figures,
}

/// The parts of the thesis that have no rows here, and why.
pub const NOT_MEASURED: [(&str, &str); 1] = [(
    "the sculpture of tables 4 and 5",
    "its mesh is not part of this program: a relief of ours stands in its place, and scene-error --mesh takes any mesh",
)];

impl Part {
    /// All parts in the order of the report.
    pub const ALL: [Part; 10] = [
        Part::Table1,
        Part::Table2,
        Part::Table3,
        Part::Table4,
        Part::Table5,
        Part::Table6,
        Part::Table7,
        Part::Table8,
        Part::Claims,
        Part::Figures,
    ];

    /// The name on the command line and in every row.
    pub fn name(self) -> &'static str {
        match self {
            Part::Table1 => "table1",
            Part::Table2 => "table2",
            Part::Table3 => "table3",
            Part::Table4 => "table4",
            Part::Table5 => "table5",
            Part::Table6 => "table6",
            Part::Table7 => "table7",
            Part::Table8 => "table8",
            Part::Claims => "claims",
            Part::Figures => "figures",
        }
    }

    /// The number of angles that it evaluates, for progress.
    fn work(self, angles: usize) -> usize {
        match self {
            Part::Table2 => 4 * angles,
            Part::Table3 | Part::Table4 | Part::Table5 => 2 * angles,
            Part::Claims => claims::work(angles),
            Part::Table1 | Part::Table6 | Part::Table7 | Part::Table8 | Part::Figures => 0,
        }
    }

    fn section(self, angles: usize, meter: &mut Meter) -> ThesisSection {
        match self {
            Part::Table1 => indices::section(),
            Part::Table2 => function_errors::metals(angles, meter),
            Part::Table3 => function_errors::dielectrics(angles, meter),
            Part::Table4 => lookup_tables::metals(angles, meter),
            Part::Table5 => lookup_tables::dielectrics(angles, meter),
            Part::Table6 => counts::section(),
            Part::Table7 => times::section(),
            Part::Table8 => three_wavelengths::section(),
            Part::Claims => claims::section(angles, meter),
            Part::Figures => figures::section(),
        }
    }
}

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
    parts: &[Part],
    angles: usize,
    say: &mut dyn FnMut(u64, u64, &str),
) -> Reproduction {
    let whole = parts.iter().map(|part| part.work(angles)).sum();
    let mut meter = Meter::new(whole, say);
    let sections = parts
        .iter()
        .map(|part| part.section(angles, &mut meter))
        .collect();
    let figures = if parts.contains(&Part::Figures) {
        figures::figures()
    } else {
        Vec::new()
    };
    Reproduction { sections, figures }
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
