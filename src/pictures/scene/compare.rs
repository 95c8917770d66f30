//! A picture beside its truth: differences as the eye sees them.

use glam::DVec3;
use serde::Serialize;

use crate::physics::spectra::{Lab, Space, ciede2000};

use super::tone::Display;

/// Differences of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The mean.
    pub mean: f64,
    /// 99 of 100 pixels differ by less.
    pub p99: f64,
}

/// The differences of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Of each pixel.
    pub map: Vec<f64>,
    /// Of those that count, taken together.
    pub difference: Difference,
}

/// CIEDE2000 between two pictures as they are shown; those pixels count that are said to.
pub fn compare(one: &[DVec3], other: &[DVec3], counts: &[bool], display: &Display) -> Comparison {
    let lab = |radiance: &DVec3| {
        let shown = display.shown(*radiance);
        Lab::from_xyz(Space::Srgb.rgb_to_xyz() * shown, Space::Srgb.white())
    };
    let pairs = one.iter().zip(other);
    let map: Vec<f64> = pairs.map(|(a, b)| ciede2000(lab(a), lab(b))).collect();
    let counted = map.iter().zip(counts).filter(|(_, counts)| **counts);
    let mut sorted: Vec<f64> = counted.map(|(error, _)| *error).collect();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len().max(1);
    let difference = Difference {
        mean: sorted.iter().sum::<f64>() / count as f64,
        p99: sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(0.0),
    };
    Comparison { map, difference }
}
