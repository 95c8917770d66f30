//! The error of a table, and the search for the smallest table within an error. The error is that of the filtered lookup against
//! the reference, between texels as well as on them.

use super::axis::TableAxis;
use super::table::{Stored, Table, centre};
use super::texel::{Depth, Error, LEAST_TEXELS, MOST_TEXELS};
use crate::generator::fit::{ModelError, error_of};
use crate::generator::reference::ReferenceCurve;
use crate::language::ir::{Column, Value, Weights};
use crate::physics::num::each_channel;

/// The parameters that decide a table's error and size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TableKind {
    /// The axis of cosines.
    pub axis: TableAxis,
    /// The number type.
    pub depth: Depth,
    /// The number of texels.
    pub texels: usize,
}

impl TableKind {
    /// Bytes of a row in GPU memory.
    pub fn bytes(self) -> usize {
        self.texels * self.depth.bytes()
    }
}

/// The error mostly falls as the size grows, but not always. So this many sizes below the first good one are tried too.
const BELOW: usize = 8;

/// The kind with the fewest bytes whose filtered lookup, with weights of 1/256, has an error of at most `budget` for each of
/// these references. Of equally small ones, the first by axis, then by depth, in the order given.
///
/// # Errors
/// None is within the budget.
pub fn smallest(
    truths: &[&ReferenceCurve],
    budget: f64,
    axes: &[TableAxis],
    depths: &[Depth],
) -> Result<TableKind, Error> {
    let mut best: Option<TableKind> = None;
    let mut least = f64::INFINITY;
    let pairs = axes
        .iter()
        .flat_map(|axis| depths.iter().map(move |depth| (*axis, *depth)));
    for (axis, depth) in pairs {
        let mut family = TableFamily {
            truths,
            axis,
            depth,
            budget,
            least,
        };
        let found = match best {
            None => family.first(),
            Some(best) => family.below(((best.bytes() - 1) / depth.bytes()).min(MOST_TEXELS)),
        };
        least = family.least;
        if let Some(texels) = found {
            best = Some(TableKind {
                axis,
                depth,
                texels,
            });
        }
    }
    best.ok_or_else(|| {
        let axes: Vec<&str> = axes.iter().map(|axis| axis.name()).collect();
        let depths: Vec<&str> = depths.iter().map(|depth| depth.name()).collect();
        Error::Budget {
            budget,
            best: least,
            tried: format!("{} in {}", axes.join(", "), depths.join(", ")),
        }
    })
}

/// Tables that differ only in size.
struct TableFamily<'a> {
    truths: &'a [&'a ReferenceCurve],
    axis: TableAxis,
    depth: Depth,
    /// The largest error allowed.
    budget: f64,
    /// The least error that was found.
    least: f64,
}

impl TableFamily<'_> {
    /// The fewest texels within the budget: doubled until they are, then bisected.
    fn first(&mut self) -> Option<usize> {
        let (mut short, mut enough) = (LEAST_TEXELS - 1, LEAST_TEXELS);
        while !self.meets(enough) {
            if enough == MOST_TEXELS {
                return None;
            }
            short = enough;
            enough = (2 * enough).min(MOST_TEXELS);
        }
        Some(self.between(short, enough))
    }

    /// The fewest texels within the budget, up to `most`; none if `most` are too few.
    fn below(&mut self, most: usize) -> Option<usize> {
        let possible = most >= LEAST_TEXELS && self.meets(most);
        possible.then(|| self.between(LEAST_TEXELS - 1, most))
    }

    /// The fewest texels within the budget, between a number that is too small and one that is enough.
    fn between(&mut self, mut short: usize, mut enough: usize) -> usize {
        while enough - short > 1 {
            let middle = short.midpoint(enough);
            if self.meets(middle) {
                enough = middle;
            } else {
                short = middle;
            }
        }
        let mut lower = enough.saturating_sub(BELOW).max(LEAST_TEXELS)..enough;
        lower.find(|texels| self.meets(*texels)).unwrap_or(enough)
    }

    fn meets(&mut self, texels: usize) -> bool {
        let error = self.error(texels);
        self.least = self.least.min(error);
        error <= self.budget
    }

    /// The largest error over all references, which share a scale. It stops at the first error above the budget.
    fn error(&self, texels: usize) -> f64 {
        let made = |reference: &&ReferenceCurve| Table::new("", reference, self.axis, texels).ok();
        let Some(tables) = self.truths.iter().map(made).collect::<Option<Vec<Table>>>() else {
            return f64::INFINITY;
        };
        let scale = Table::shared_scale(&tables.iter().collect::<Vec<_>>(), self.depth);
        let mut worst = 0.0f64;
        for (reference, table) in self.truths.iter().zip(&tables) {
            let stored = Stored::scaled(table, self.depth, scale);
            let between = BetweenTexels::new(reference, self.axis, texels);
            let error = table_error(&stored, Weights::Steps256, reference, &between);
            worst = worst.max(error.max_abs);
            if worst > self.budget {
                break;
            }
        }
        worst
    }
}

/// Places between texels with the reference's values: the error of filtering is largest there.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenTexels {
    points: Vec<(f64, [f64; 3])>,
}

/// Shares between two texels: the middle, where a smooth curve is furthest from its chord, and others half a weight step away
/// from where weights of 1/256 are exact.
const SHARES: [f64; 4] = [
    0.5,
    0.5 + 1.0 / 512.1,
    0.3 + 1.0 / 512.1,
    0.75 - 1.0 / 512.1,
];

impl BetweenTexels {
    /// The reference between the texels of tables of this size.
    pub fn new(reference: &ReferenceCurve, axis: TableAxis, texels: usize) -> BetweenTexels {
        let place = |i: usize| SHARES.map(|share| centre(axis, i as f64 + share, texels));
        let places = (0..texels.saturating_sub(1)).flat_map(place);
        BetweenTexels {
            points: places.map(|c| (c, reference.at(c))).collect(),
        }
    }
}

/// The error of the lookup: the largest over angles, places between texels and channels, and the mean uniform in angle, as in
/// [`ModelError`].
pub fn table_error(
    stored: &Stored,
    weights: Weights,
    reference: &ReferenceCurve,
    between: &BetweenTexels,
) -> ModelError {
    let mut error = error_of(reference, &|cosines| looked_up(stored, weights, cosines));
    for (c, want) in &between.points {
        let got = stored.lookup(weights, *c as f32).map(f64::from);
        for (got, want) in got.iter().zip(want) {
            if (got - want).abs() > error.max_abs {
                (error.max_abs, error.worst_cos) = ((got - want).abs(), *c);
            }
        }
    }
    error
}

fn looked_up(stored: &Stored, weights: Weights, cosines: &[f64]) -> Value<f64> {
    let values: Vec<[f32; 3]> = cosines
        .iter()
        .map(|c| stored.lookup(weights, *c as f32))
        .collect();
    let channel = |i: usize| values.iter().map(|value| f64::from(value[i])).collect();
    Value::Rgb(each_channel(|i| Column::Each(channel(i))))
}
