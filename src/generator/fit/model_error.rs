//! Model error: a method against the exact law, over all angles. It is never to be added to code error.

use std::cell::RefCell;
use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use crate::generator::reference::{ANGLES, COSINES, ReferenceCurve};
use crate::language::ir::{Checked, Column, Function, Texels, Ty, Value, evaluate};
use crate::language::methods::{TEXELS, WARP, unwarped};
use crate::physics::num::{Half, Num, each_channel};

/// The error of a method for a material, independent of the code that computes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelError {
    /// Largest absolute difference, over angles and channels.
    pub max_abs: f64,
    /// Mean absolute difference, uniform in angle, averaged over the channels.
    pub mean_abs: f64,
    /// Mean relative difference, uniform in angle, averaged over the channels: the thesis's measure. None where a channel
    /// reflects nothing and the method says otherwise.
    pub mean_rel: Option<f64>,
    /// The cosine of the largest difference.
    pub worst_cos: f64,
    /// The number of angles at which the method gave no number. They are left out of the figures above.
    pub undefined: usize,
}

/// An error rounded up to five decimals.
pub fn rounded_up(error: f64) -> String {
    format!("{:.5}", (error * 1e5).ceil() / 1e5)
}

/// How often the neighbourhood of the worst angle is searched again, and in how many steps. A maximum is located to 1e-9, cusps
/// at the critical angle included.
const REFINEMENTS: usize = 6;
const STEPS: usize = 32;

/// The table of a function that gives reflectance at a cosine.
pub fn texels(seen: impl Fn(f64) -> [f64; 3]) -> Texels {
    let centre = |i: usize| unwarped(WARP, i as f64 / (TEXELS - 1) as f64);
    let half = |value: f64| Half::from_f64(value).to_f32();
    let texels: Vec<_> = (0..TEXELS).map(|i| seen(centre(i)).map(half)).collect();
    Texels::row(&texels)
}

/// The table that a specialised function reads, if it reads one.
pub fn table_of(function: &Function, seen: impl Fn(f64) -> [f64; 3]) -> Option<Texels> {
    let is_textured = function.params.iter().any(|param| param.ty == Ty::Texture);
    is_textured.then(|| texels(seen))
}

/// The arguments of a specialised function.
pub fn arguments<N: Num>(cosines: Vec<N>, table: Option<&Texels>) -> Vec<Value<N>> {
    let table = table.map(|table| Value::Texture(Some(table.clone())));
    [Value::each(cosines)].into_iter().chain(table).collect()
}

/// The model error of a function of `cos_theta` alone, or of `cos_theta` and the table that it reads.
pub fn model_error(function: &Checked, reference: &ReferenceCurve) -> ModelError {
    let table = table_of(function, |cos_theta| reference.at(cos_theta));
    error_of(reference, &|cosines| {
        evaluate(function, &arguments(cosines.to_vec(), table.as_ref()))
    })
}

/// The same, computed in f32 with each operation rounded.
pub fn single_error(function: &Checked, reference: &ReferenceCurve) -> ModelError {
    let table = table_of(function, |cos_theta| reference.at(cos_theta));
    error_of(reference, &|cosines| {
        let single: Vec<f32> = cosines.iter().map(|c| *c as f32).collect();
        let got = evaluate(function, &arguments(single, table.as_ref()));
        let channel = |i: usize| {
            let values = (0..cosines.len()).map(|point| f64::from(got.at(point)[i]));
            Column::Each(values.collect())
        };
        Value::Rgb(each_channel(channel))
    })
}

/// The model error of three channels that `values` gives at some cosines.
pub fn error_of(reference: &ReferenceCurve, values: &dyn Fn(&[f64]) -> Value<f64>) -> ModelError {
    SharedReference::new(reference).error_of(values)
}

/// A reference that several methods are held against. What it is at a cosine is computed once for all of them.
pub(super) struct SharedReference<'a> {
    reference: &'a ReferenceCurve,
    /// Its reflectance at [`COSINES`].
    pub(super) table: Vec<[f64; 3]>,
    /// Whether there is total reflection before 90 degrees.
    is_totally_reflecting: bool,
    /// Its reflectance at other cosines, by their bits.
    between: RefCell<HashMap<u64, [f64; 3]>>,
}

impl<'a> SharedReference<'a> {
    /// The reference, at no cosine yet but those of its table.
    pub fn new(reference: &'a ReferenceCurve) -> SharedReference<'a> {
        let table = reference.table();
        SharedReference {
            reference,
            is_totally_reflecting: is_totally_reflecting(&COSINES, &table),
            table,
            between: RefCell::default(),
        }
    }

    fn at(&self, cos_theta: f64) -> [f64; 3] {
        let mut between = self.between.borrow_mut();
        *between
            .entry(cos_theta.to_bits())
            .or_insert_with(|| self.reference.at(cos_theta))
    }

    /// The model error of three channels that `values` gives at some cosines.
    pub fn error_of(&self, values: &dyn Fn(&[f64]) -> Value<f64>) -> ModelError {
        let (at, want) = (&COSINES[..], &self.table);
        let given = values(at);
        let mut error = difference(&given, want, at);
        let first = (error.max_abs, error.worst_cos);
        let wide = libm::acos(first.1).max(1e-3) / 8.0;
        error.keep_larger(refined(first, wide, self, values));
        if self.is_totally_reflecting {
            for start in worst_of_channels(&given, want, at) {
                error.keep_larger(refined(start, 2.0 * BETWEEN, self, values));
            }
        }
        error
    }
}

/// Whether there is total reflection before 90 degrees. Each channel then has its own critical angle, and the error has a cusp
/// there that may fall between the angles.
fn is_totally_reflecting(at: &[f64], want: &[[f64; 3]]) -> bool {
    let whole = |reflectance: &f64| *reflectance > 1.0 - 1e-9;
    let mut points = at.iter().zip(want);
    points.any(|(cos_theta, want)| *cos_theta > 0.01 && want.iter().any(whole))
}

/// The largest error of each channel at the angles, and its cosine.
fn worst_of_channels(given: &Value<f64>, want: &[[f64; 3]], at: &[f64]) -> [(f64, f64); 3] {
    each_channel(|channel| {
        let off = |point: usize| (given.at(point)[channel] - want[point][channel]).abs();
        let points = (0..at.len()).filter(|point| off(*point).is_finite());
        let point = points.max_by(|a, b| off(*a).total_cmp(&off(*b)));
        point.map_or((0.0, 1.0), |point| (off(point), at[point]))
    })
}

/// The step between two angles, in radians.
const BETWEEN: f64 = std::f64::consts::FRAC_PI_2 / ANGLES as f64;

/// The largest error near a cosine, and its cosine. The search begins with a known error there, within `reach` radians on both
/// sides, and narrows.
fn refined(
    (mut most, mut worst_cos): (f64, f64),
    mut reach: f64,
    reference: &SharedReference,
    values: &dyn Fn(&[f64]) -> Value<f64>,
) -> (f64, f64) {
    for _ in 0..REFINEMENTS {
        let theta = libm::acos(worst_cos);
        let near = |i: usize| theta + reach * (2.0 * i as f64 / STEPS as f64 - 1.0);
        let inside = |theta: &f64| (0.0..std::f64::consts::FRAC_PI_2).contains(theta);
        let close: Vec<f64> = (0..=STEPS)
            .map(near)
            .filter(inside)
            .map(libm::cos)
            .collect();
        let want: Vec<[f64; 3]> = close.iter().map(|c| reference.at(*c)).collect();
        let again = difference(&values(&close), &want, &close);
        if again.max_abs > most && again.undefined < close.len() {
            (most, worst_cos) = (again.max_abs, again.worst_cos);
        }
        reach /= STEPS as f64 / 4.0;
    }
    (most, worst_cos)
}

/// The error of the same against any other curve, at the angles alone.
pub fn error_from(
    seen: impl Fn(f64) -> [f64; 3],
    values: &dyn Fn(&[f64]) -> Value<f64>,
) -> ModelError {
    let at = &COSINES[..];
    let want: Vec<[f64; 3]> = at.iter().map(|c| seen(*c)).collect();
    difference(&values(at), &want, at)
}

/// The error of values at these cosines against the exact law. Means are over the first [`ANGLES`], or over all where there are
/// fewer.
pub fn difference(values: &Value<f64>, want: &[[f64; 3]], cosines: &[f64]) -> ModelError {
    let mut error = ModelError {
        max_abs: 0.0,
        mean_abs: 0.0,
        mean_rel: Some(0.0),
        worst_cos: 1.0,
        undefined: 0,
    };
    let counted = cosines.len().min(ANGLES);
    for (point, cos_theta) in cosines.iter().enumerate() {
        let weight = if point < counted {
            1.0 / (3 * counted) as f64
        } else {
            0.0
        };
        let (got, want) = (values.at(point), want[point]);
        if got.iter().any(|got| got.is_nan()) {
            error.undefined += 1;
            continue;
        }
        for (got, want) in got.into_iter().zip(want) {
            error.include(got, want, *cos_theta, weight);
        }
    }
    if error.undefined == cosines.len() {
        // No number came, so the difference is unknown.
        error.max_abs = f64::INFINITY;
        error.mean_abs = f64::INFINITY;
        error.mean_rel = None;
    }
    error
}

impl ModelError {
    fn keep_larger(&mut self, (max_abs, worst_cos): (f64, f64)) {
        if max_abs > self.max_abs {
            (self.max_abs, self.worst_cos) = (max_abs, worst_cos);
        }
    }

    fn include(&mut self, got: f64, want: f64, cos_theta: f64, weight: f64) {
        let difference = (got - want).abs();
        self.mean_abs += weight * difference;
        if difference > 0.0 {
            let relative = Some(difference / want).filter(|relative| relative.is_finite());
            self.mean_rel = self
                .mean_rel
                .zip(relative)
                .map(|(mean, relative)| mean + weight * relative);
        }
        if difference > self.max_abs {
            (self.max_abs, self.worst_cos) = (difference, cos_theta);
        }
    }
}
