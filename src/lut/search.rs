//! The smallest table that is good enough.

use crate::fit::Truth;

use super::axis::Axis;
use super::depth::{Depth, Stored};
use super::error::Error;
use super::filter::Weights;
use super::measure::{Between, table_error};
use super::table::{LEAST_TEXELS, MOST_TEXELS, Table};

/// A kind of table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// How cosines are spread.
    pub axis: Axis,
    /// The kind of number.
    pub depth: Depth,
    /// How many texels.
    pub texels: usize,
}

impl Choice {
    /// Bytes of a row in the memory of a GPU.
    pub fn bytes(self) -> usize {
        self.texels * self.depth.bytes()
    }
}

/// How many sizes below the first that is good enough are tried as well: the error falls with the size but for ripples.
const BELOW: usize = 8;

/// The choice with the fewest bytes of which the filtered lookup, with weights of 1/256, errs by at most `budget` for
/// each of these truths; of equally small ones the first by axis, then by depth, in the order given.
///
/// # Errors
/// None is good enough.
pub fn smallest(
    truths: &[&Truth],
    budget: f64,
    axes: &[Axis],
    depths: &[Depth],
) -> Result<Choice, Error> {
    let mut best: Option<Choice> = None;
    let mut least = f64::INFINITY;
    for axis in axes {
        for depth in depths {
            let kind = Kind {
                truths,
                axis: *axis,
                depth: *depth,
            };
            let most = best.map_or(MOST_TEXELS, |best| {
                ((best.bytes() - 1) / depth.bytes()).min(MOST_TEXELS)
            });
            let Some(texels) = kind.fewest(budget, most, &mut least) else {
                continue;
            };
            best = Some(kind.of(texels));
        }
    }
    best.ok_or_else(|| Error::Budget {
        budget,
        best: least,
        tried: tried(axes, depths),
    })
}

fn tried(axes: &[Axis], depths: &[Depth]) -> String {
    let axes: Vec<&str> = axes.iter().map(|axis| axis.name()).collect();
    let depths: Vec<&str> = depths.iter().map(|depth| depth.name()).collect();
    format!("{} in {}", axes.join(", "), depths.join(", "))
}

/// Tables that differ in size only.
struct Kind<'a> {
    truths: &'a [&'a Truth],
    axis: Axis,
    depth: Depth,
}

impl Kind<'_> {
    fn of(&self, texels: usize) -> Choice {
        Choice {
            axis: self.axis,
            depth: self.depth,
            texels,
        }
    }

    /// The fewest texels that are good enough, up to `most`: doubled until they are, then halved in between.
    fn fewest(&self, budget: f64, most: usize, least: &mut f64) -> Option<usize> {
        if most < LEAST_TEXELS {
            return None;
        }
        let mut meets = |texels: usize| {
            let error = self.error(texels, budget);
            *least = least.min(error);
            error <= budget
        };
        let mut short = LEAST_TEXELS - 1;
        let mut enough = LEAST_TEXELS;
        while !meets(enough) {
            if enough == most {
                return None;
            }
            short = enough;
            enough = (2 * enough).min(most);
        }
        while enough - short > 1 {
            let middle = short.midpoint(enough);
            if meets(middle) {
                enough = middle;
            } else {
                short = middle;
            }
        }
        let below = enough.saturating_sub(BELOW).max(LEAST_TEXELS)..enough;
        below
            .into_iter()
            .find(|texels| meets(*texels))
            .or(Some(enough))
    }

    /// The largest error over all truths, which share a scale; once it is past the budget, of those looked at.
    fn error(&self, texels: usize, budget: f64) -> f64 {
        let made = |truth: &&Truth| Table::new("", truth, self.axis, texels).ok();
        let Some(tables) = self.truths.iter().map(made).collect::<Option<Vec<Table>>>() else {
            return f64::INFINITY;
        };
        let scale = self.depth.scale(&tables.iter().collect::<Vec<_>>());
        let mut worst = 0.0f64;
        for (truth, table) in self.truths.iter().zip(&tables) {
            let stored = Stored::scaled(table, self.depth, scale);
            let between = Between::new(truth, self.axis, texels);
            let error = table_error(&stored, Weights::Steps256, truth, &between);
            worst = worst.max(error.max_abs);
            if worst > budget {
                break;
            }
        }
        worst
    }
}
