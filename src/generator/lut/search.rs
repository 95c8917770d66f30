//! The smallest table that is good enough.

use crate::generator::reference::ReferenceCurve;

use super::axis::TableAxis;
use super::depth::{Depth, Stored};
use super::error::Error;
use super::measure::{BetweenTexels, table_error};
use super::table::{LEAST_TEXELS, MOST_TEXELS, Table};
use crate::language::ir::Weights;

/// A kind of table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TableKind {
    /// How cosines are spread.
    pub axis: TableAxis,
    /// The kind of number.
    pub depth: Depth,
    /// How many texels.
    pub texels: usize,
}

impl TableKind {
    /// Bytes of a row in the memory of a GPU.
    pub fn bytes(self) -> usize {
        self.texels * self.depth.bytes()
    }
}

/// The error mostly falls as the size grows, but ripples. So this many sizes below the first good one are tried too.
const BELOW: usize = 8;

/// The choice with the fewest bytes of which the filtered lookup, with weights of 1/256, errs by at most `budget` for
/// each of these truths; of equally small ones the first by axis, then by depth, in the order given.
///
/// # Errors
/// None is good enough.
pub fn smallest(
    truths: &[&ReferenceCurve],
    budget: f64,
    axes: &[TableAxis],
    depths: &[Depth],
) -> Result<TableKind, Error> {
    let mut best: Option<TableKind> = None;
    let mut least = f64::INFINITY;
    for axis in axes {
        for depth in depths {
            let kind = TableFamily {
                truths,
                axis: *axis,
                depth: *depth,
            };
            let below = best.map(|best| (best.bytes() - 1) / depth.bytes());
            let found = match below {
                None => kind.first(budget, &mut least),
                Some(most) => kind.below(budget, most.min(MOST_TEXELS), &mut least),
            };
            let Some(texels) = found else { continue };
            best = Some(kind.of(texels));
        }
    }
    best.ok_or_else(|| Error::Budget {
        budget,
        best: least,
        tried: tried(axes, depths),
    })
}

fn tried(axes: &[TableAxis], depths: &[Depth]) -> String {
    let axes: Vec<&str> = axes.iter().map(|axis| axis.name()).collect();
    let depths: Vec<&str> = depths.iter().map(|depth| depth.name()).collect();
    format!("{} in {}", axes.join(", "), depths.join(", "))
}

/// Tables that differ in size only.
struct TableFamily<'a> {
    truths: &'a [&'a ReferenceCurve],
    axis: TableAxis,
    depth: Depth,
}

impl TableFamily<'_> {
    fn of(&self, texels: usize) -> TableKind {
        TableKind {
            axis: self.axis,
            depth: self.depth,
            texels,
        }
    }

    /// The fewest texels that are good enough: doubled until they are, then halved in between.
    fn first(&self, budget: f64, least: &mut f64) -> Option<usize> {
        let (mut short, mut enough) = (LEAST_TEXELS - 1, LEAST_TEXELS);
        while !self.meets(enough, budget, least) {
            if enough == MOST_TEXELS {
                return None;
            }
            short = enough;
            enough = (2 * enough).min(MOST_TEXELS);
        }
        Some(self.between(short, enough, budget, least))
    }

    /// The fewest texels that are good enough, where `most` are.
    fn below(&self, budget: f64, most: usize, least: &mut f64) -> Option<usize> {
        let possible = most >= LEAST_TEXELS && self.meets(most, budget, least);
        possible.then(|| self.between(LEAST_TEXELS - 1, most, budget, least))
    }

    /// The fewest texels that are good enough, between some that are not and some that are.
    fn between(&self, mut short: usize, mut enough: usize, budget: f64, least: &mut f64) -> usize {
        while enough - short > 1 {
            let middle = short.midpoint(enough);
            if self.meets(middle, budget, least) {
                enough = middle;
            } else {
                short = middle;
            }
        }
        let mut lower = enough.saturating_sub(BELOW).max(LEAST_TEXELS)..enough;
        let found = lower.find(|texels| self.meets(*texels, budget, least));
        found.unwrap_or(enough)
    }

    fn meets(&self, texels: usize, budget: f64, least: &mut f64) -> bool {
        let error = self.error(texels, budget);
        *least = least.min(error);
        error <= budget
    }

    /// The largest error over all truths, which share a scale. It stops at the first error above the budget.
    fn error(&self, texels: usize, budget: f64) -> f64 {
        let made = |reference: &&ReferenceCurve| Table::new("", reference, self.axis, texels).ok();
        let Some(tables) = self.truths.iter().map(made).collect::<Option<Vec<Table>>>() else {
            return f64::INFINITY;
        };
        let scale = self.depth.scale(&tables.iter().collect::<Vec<_>>());
        let mut worst = 0.0f64;
        for (reference, table) in self.truths.iter().zip(&tables) {
            let stored = Stored::scaled(table, self.depth, scale);
            let between = BetweenTexels::new(reference, self.axis, texels);
            let error = table_error(&stored, Weights::Steps256, reference, &between);
            worst = worst.max(error.max_abs);
            if worst > budget {
                break;
            }
        }
        worst
    }
}
