//! The errors of candidates in some pixels, the cheapest candidate first. What costs more than a candidate within the budget cannot be
//! chosen, and no report says its error: then it is not judged, and its error is infinite.

use crate::physics::num::in_parallel;

use super::curve::{Curve, PixelPlace, RoughRule, curves};
use super::metric::Screen;
use super::picture_error::JudgedPixels;
use super::pixels::ScenePixel;
use super::planned::{JudgedCandidate, JudgedMaterial};
use super::row::is_shared;

/// Functions that are judged together. The truth is the first: with three channels each they fill two blocks of columns.
const TOGETHER: usize = 5;

/// What all candidates of all materials are judged with.
pub(super) struct Judge {
    pub rule: RoughRule,
    pub screen: Screen,
    /// In stops.
    pub exposures: Vec<f64>,
}

/// A function in its turn: its values, and the least cost of its candidates.
struct Turn<'a> {
    cost: f64,
    place: usize,
    values: &'a [[f64; 3]],
}

impl Judge {
    /// The errors in some pixels, by this measure. Candidates with the same values, as a method's forms have them, err alike.
    /// `is_enough` says of a candidate with this error whether what costs more may be left out.
    pub fn errors(
        &self,
        judged: &JudgedMaterial,
        pixels: &[ScenePixel],
        is_enough: &dyn Fn(&JudgedCandidate, f64) -> bool,
        measure: impl Fn(&JudgedPixels, &Curve) -> f64 + Sync,
    ) -> Vec<f64> {
        let places: Vec<PixelPlace> = pixels.iter().map(PixelPlace::of).collect();
        let (distinct, place_of) = distinct_values(&judged.candidates);
        let turns = turns(judged, &distinct, &place_of);
        let mut errors = vec![f64::INFINITY; distinct.len()];
        let mut enough = f64::INFINITY;
        let mut seen = None;
        for batch in turns.chunks(TOGETHER) {
            if batch[0].cost > enough {
                break;
            }
            let functions: Vec<&[[f64; 3]]> = batch.iter().map(|turn| turn.values).collect();
            let curves = curves(&functions, &places, &self.rule);
            let is_first = seen.is_none();
            let seen: &JudgedPixels = seen.get_or_insert_with(|| {
                JudgedPixels::new(pixels, &places, &curves[0], &self.screen, &self.exposures)
            });
            let from = usize::from(is_first);
            let error = |i: usize| measure(seen, &curves[from + i]);
            let found = in_parallel(batch.len() - from, &error, &mut |_, _| {});
            for (turn, error) in batch[from..].iter().zip(found) {
                errors[turn.place] = error;
            }
            let all = judged.candidates.iter().zip(&place_of);
            enough = all
                .filter(|(one, place)| is_enough(one, errors[**place]))
                .map(|(one, _)| one.candidate.cost)
                .fold(f64::INFINITY, f64::min);
        }
        place_of.iter().map(|place| errors[*place]).collect()
    }
}

/// The truth, the function that reports hold against the plan, and all others by their cost.
fn turns<'a>(
    judged: &'a JudgedMaterial,
    distinct: &[&'a [[f64; 3]]],
    place_of: &[usize],
) -> Vec<Turn<'a>> {
    let turn = |(place, values): (usize, &&'a [[f64; 3]])| {
        let all = judged.candidates.iter().zip(place_of);
        let own = all.filter(|(_, of)| **of == place);
        let cost = own.map(|(one, _)| {
            if is_shared(&one.candidate) {
                f64::NEG_INFINITY
            } else {
                one.candidate.cost
            }
        });
        Turn {
            cost: cost.fold(f64::INFINITY, f64::min),
            place,
            values,
        }
    };
    let mut turns: Vec<Turn> = distinct.iter().enumerate().map(turn).collect();
    turns.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let truth = Turn {
        cost: f64::NEG_INFINITY,
        place: 0,
        values: &judged.truth,
    };
    turns.insert(0, truth);
    turns
}

/// The values of candidates, each once, and for each candidate its place among them.
pub(super) fn distinct_values(candidates: &[JudgedCandidate]) -> (Vec<&[[f64; 3]]>, Vec<usize>) {
    let mut distinct: Vec<&[[f64; 3]]> = Vec::new();
    let mut places = Vec::new();
    for one in candidates {
        let values = &*one.candidate.values;
        let is_same = |known: &&[[f64; 3]]| std::ptr::eq(*known, values) || *known == values;
        let known = distinct.iter().position(is_same);
        places.push(known.unwrap_or(distinct.len()));
        if known.is_none() {
            distinct.push(values);
        }
    }
    (distinct, places)
}
