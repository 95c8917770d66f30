//! Histograms of cosines: how often each cosine is seen in all frames of a view.
//!
//! A bin holds its weight and the mean of its cosines, so that the mean of a smooth function over it is right to the second order
//! of the bin's width.

use super::camera::Camera;
use super::draw::draw;
use super::mesh::Mesh;
use crate::physics::num::in_parallel;

/// The number of bins between 0 and 1.
pub const BINS: usize = 4096;

/// A weighted histogram of cosines.
#[derive(Clone, Debug, PartialEq)]
pub struct CosineHistogram {
    weights: Vec<f64>,
    /// Per bin, the sum of weight times cosine.
    moments: Vec<f64>,
}

impl Default for CosineHistogram {
    fn default() -> CosineHistogram {
        CosineHistogram {
            weights: vec![0.0; BINS],
            moments: vec![0.0; BINS],
        }
    }
}

impl CosineHistogram {
    /// The histogram of these cosines, each with a weight of 1.
    pub fn of(cosines: impl IntoIterator<Item = f64>) -> CosineHistogram {
        let mut histogram = CosineHistogram::default();
        for cosine in cosines {
            histogram.add(cosine, 1.0);
        }
        histogram
    }

    /// What a distant camera sees of any convex body, in the mean over all directions: density 2c. An area of the surface is seen
    /// with its size times the cosine, and all directions relative to its normal are equally frequent.
    pub fn of_convex_bodies() -> CosineHistogram {
        let mut histogram = CosineHistogram::default();
        let edge = |bin: usize| bin as f64 / BINS as f64;
        for bin in 0..BINS {
            let (from, to) = (edge(bin), edge(bin + 1));
            histogram.weights[bin] = to * to - from * from;
            histogram.moments[bin] = 2.0 / 3.0 * (to * to * to - from * from * from);
        }
        histogram
    }

    /// Adds a cosine from 0 to 1.
    pub fn add(&mut self, cosine: f64, weight: f64) {
        let bin = ((cosine * BINS as f64) as usize).min(BINS - 1);
        self.weights[bin] += weight;
        self.moments[bin] += weight * cosine;
    }

    /// Adds another histogram, with its weights multiplied by `times`.
    pub fn merge(&mut self, other: &CosineHistogram, times: f64) {
        for bin in 0..BINS {
            self.weights[bin] += times * other.weights[bin];
            self.moments[bin] += times * other.moments[bin];
        }
    }

    /// The sum of all weights.
    pub fn total(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// The weights of all bins, from cosine 0 to 1.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The cosines and weights of the bins that are not empty.
    pub fn seen(&self) -> (Vec<f64>, Vec<f64>) {
        let bins = self.weights.iter().zip(&self.moments);
        bins.filter(|(weight, _)| **weight > 0.0)
            .map(|(weight, moment)| ((moment / weight).clamp(0.0, 1.0), *weight))
            .unzip()
    }
}

/// The angles that frames show.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// The cosines. Every frame has the same weight, which its pixels share. The sum is 1, or 0 where nothing is seen.
    pub histogram: CosineHistogram,
    /// The number of frames in which the object is visible.
    pub frames: usize,
    /// The number of covered pixels in them.
    pub pixels: u64,
}

/// Draws all frames, on all cores. `progress` is told how many are done, of how many.
pub fn shown(mesh: &Mesh, cameras: &[Camera], progress: &mut dyn FnMut(u64, u64)) -> Shown {
    let histogram = |i: usize| {
        let covered = draw(mesh, &cameras[i]).covered;
        CosineHistogram::of(covered.iter().map(|(_, cos_theta)| *cos_theta))
    };
    let drawn = in_parallel(cameras.len(), &histogram, progress);
    let drawn: Vec<CosineHistogram> = drawn.into_iter().filter(|one| one.total() > 0.0).collect();
    let mut all = Shown {
        histogram: CosineHistogram::default(),
        frames: drawn.len(),
        pixels: 0,
    };
    for frame in &drawn {
        let pixels = frame.total();
        all.pixels += pixels as u64;
        all.histogram
            .merge(frame, 1.0 / (pixels * drawn.len() as f64));
    }
    all
}
