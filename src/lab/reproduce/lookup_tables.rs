//! Tables 4 and 5: the rendered rows, followed by the mean relative error of the filtered lookup by the thesis's measure of
//! functions (section 5.2).
//!
//! The thesis measured its tables only in rendered pictures of a cube and of a sculpture. The smaller of the two figures stands
//! beside ours. Both are means of relative errors, but the pictures' angles are those that a camera saw.

use super::comparison::{self, ComparisonRow, ComparisonVerdict, Figure, Meter, ThesisSection};
use super::thesis_measure::{ThesisMeasure, thesis_table_errors};
use super::{rendered, specialised};
use crate::generator::lut::{Depth, LEAST_TEXELS, Stored, Table, TableAxis};
use crate::generator::reference::ReferenceCurve;
use crate::language::methods::Light;
use crate::physics::materials::Surface;

const METALS: &str = "table4_rendered_error_metals_percent";
const DIELECTRICS: &str = "table5_rendered_error_dielectrics_percent";

/// The texels of the tables that stand beside the thesis's.
const TEXELS: usize = 256;
/// The formats of texels, with their names.
const DEPTHS: [(Depth, &str); 3] = [
    (Depth::Float, "float"),
    (Depth::Half, "half"),
    (Depth::Unorm16, "png16"),
];
/// Axes and sizes are searched at this many times fewer angles, where errors are accurate to a hundredth of themselves.
const COARSER: usize = 100;
/// How many sizes below the first sufficient one are tried as well, since the error falls with ripples.
const BELOW: usize = 8;
/// The largest size that is tried.
const MOST_TEXELS: usize = 4096;

const MEASURE: &str = "the thesis's figure is of rendered pictures (the smaller of cube and sculpture), ours of the function: \
    the lookup with weights of 1/256 against the exact law at the thesis's indices. In floats the straight line between \
    two texels is what errs";
const HALF: &str = "as above; the rounding of the texels is nearly all of it: half precision has eleven bits, which is .01 to \
    .02 % in the mean at any size. Where the thesis prints .01 %, only more bits come below it";
const INTEGERS: &str = "as above, and 16-bit integers have steps of 1/65535: nothing for what is bright, most of the error for \
    water, which is dark";
const BETTER: &str =
    "the axis with the smallest error in floats, of all that `bake` knows; the rows above have it";
const SMALLEST: &str = "in floats; the fewest texels with an error below the thesis's figure, searched at a hundredth of the \
    angles";

/// Table 4.
pub fn metals(angles: usize, meter: &mut Meter) -> ThesisSection {
    section("table4", METALS, ["gold", "platinum"], angles, meter)
}

/// Table 5.
pub fn dielectrics(angles: usize, meter: &mut Meter) -> ThesisSection {
    section("table5", DIELECTRICS, ["water", "diamond"], angles, meter)
}

fn section(
    table: &'static str,
    record: &'static str,
    names: [&str; 2],
    angles: usize,
    meter: &mut Meter,
) -> ThesisSection {
    let number = table.trim_start_matches("table");
    let mut rows = Vec::new();
    for name in names {
        rows.extend(rendered::rows(table, record, name, meter));
    }
    for name in names {
        let material = ThesisMaterial::new(table, record, name);
        rows.extend(material.material_rows(angles, meter));
    }
    ThesisSection {
        title: format!(
            "Table {number}: error in pictures, mean over pixels, frames and three channels; then error of a lookup table, mean \
             over {angles} angles and three channels"
        ),
        rows,
    }
}

/// A material of the thesis, and the error of its table.
struct ThesisMaterial<'a> {
    table: &'static str,
    name: &'a str,
    /// The smaller figure of both objects, in per cent.
    printed: f64,
    reference: ReferenceCurve,
}

impl ThesisMaterial<'_> {
    fn new<'a>(table: &'static str, record: &str, name: &'a str) -> ThesisMaterial<'a> {
        let printed = |object| comparison::number(&[record, name, object, "table"]);
        let surface = Surface::of_channels(&specialised::channels(name));
        ThesisMaterial {
            table,
            name,
            printed: printed("cube").min(printed("sculpture")),
            reference: ReferenceCurve::new(surface, Light::Unpolarised),
        }
    }

    fn material_rows(&self, angles: usize, meter: &mut Meter) -> Vec<ComparisonRow> {
        let coarse = ThesisMeasure::new(&self.reference, angles.div_ceil(COARSER));
        let error = |axis: &TableAxis| coarse.error(&self.stored(*axis, TEXELS, Depth::Float));
        let best = least(TableAxis::ALL, error);
        let (mut columns, mut tables) = (Vec::new(), Vec::new());
        for (axis, name) in [(TableAxis::Cos, "cos"), (best, "best axis")] {
            for (depth, format) in DEPTHS {
                columns.push((format!("{TEXELS} texels, {name}, {format}"), depth));
                tables.push(self.stored(axis, TEXELS, depth));
            }
        }
        let mut progress = |done| meter.add(done, &format!("lookup tables of {}", self.name));
        let errors = thesis_table_errors(&self.reference, &tables, angles, &mut progress);
        let compared = columns.iter().zip(errors);
        compared
            .map(|((column, depth), error)| self.compared(column, *depth, error))
            .chain(self.searched(best, &coarse))
            .collect()
    }

    /// A table's error beside the thesis's.
    fn compared(&self, column: &str, depth: Depth, error: f64) -> ComparisonRow {
        let is_worse = error > self.printed && depth != Depth::Half;
        ComparisonRow::new(self.table, self.name, column)
            .thesis(Figure::percent(self.printed))
            .ours(Figure::Number(error, 4, " %"))
            .remark(match depth {
                Depth::Half => HALF,
                Depth::Float => MEASURE,
                Depth::Unorm8 | Depth::Unorm16 => INTEGERS,
            })
            .verdict(if is_worse {
                ComparisonVerdict::Differs
            } else {
                ComparisonVerdict::Explained
            })
    }

    /// Rows without figures in the thesis: the best axis, and the smallest tables.
    fn searched(&self, best: TableAxis, coarse: &ThesisMeasure) -> [ComparisonRow; 4] {
        let sizes = TableAxis::ALL.map(|axis| (axis, self.smallest(axis, coarse)));
        let size = |axis: TableAxis| {
            let mut all = sizes.iter();
            all.find(|(own, _)| *own == axis)
                .and_then(|(_, size)| *size)
        };
        let fewest = least(TableAxis::ALL, |axis| {
            size(*axis).unwrap_or(usize::MAX) as f64
        });
        let ours = |column: &str, figure: Figure, remark: &str| {
            let row = ComparisonRow::new(self.table, self.name, column);
            row.thesis(Figure::Missing("the thesis has one table a material"))
                .ours(figure)
                .remark(remark)
        };
        let texels = |axis: TableAxis| match size(axis) {
            Some(texels) => Figure::Number(texels as f64, 0, " texels"),
            None => Figure::Missing("no table of up to 4096 texels errs less"),
        };
        let named = |axis: TableAxis| Figure::Words(axis.name().to_owned());
        [
            ours("best axis", named(best), BETTER),
            ours("enough on cos", texels(TableAxis::Cos), SMALLEST),
            ours("fewest", texels(fewest), SMALLEST),
            ours("on the axis", named(fewest), SMALLEST),
        ]
    }

    /// The fewest texels of a table with a smaller error than the thesis's.
    fn smallest(&self, axis: TableAxis, coarse: &ThesisMeasure) -> Option<usize> {
        let beats =
            |texels: &usize| coarse.error(&self.stored(axis, *texels, Depth::Float)) < self.printed;
        let doubled = std::iter::successors(Some(LEAST_TEXELS), |texels| Some(2 * texels));
        let mut enough = doubled
            .take_while(|texels| *texels <= MOST_TEXELS)
            .find(beats)?;
        let mut short = enough / 2;
        while enough - short > 1 {
            let middle = short.midpoint(enough);
            if beats(&middle) {
                enough = middle;
            } else {
                short = middle;
            }
        }
        let mut below = enough.saturating_sub(BELOW).max(LEAST_TEXELS)..enough;
        below.find(beats).or(Some(enough))
    }

    fn stored(&self, axis: TableAxis, texels: usize, depth: Depth) -> Stored {
        let table = Table::new(self.name, &self.reference, axis, texels);
        Stored::new(&table.expect("these sizes are sizes of textures"), depth)
    }
}

/// The first of these axes with the smallest figure.
fn least(axes: [TableAxis; 6], figure: impl Fn(&TableAxis) -> f64) -> TableAxis {
    let [first, ..] = axes;
    let figures = axes.map(|axis| (figure(&axis), axis));
    let least = figures.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    least.map_or(first, |(_, axis)| axis)
}
