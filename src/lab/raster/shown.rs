//! All frames of a view: how often each cosine is seen.

use crate::physics::num::in_parallel;

use super::camera::Camera;
use super::draw::draw;
use super::histogram::CosineHistogram;
use super::mesh::Mesh;

/// The angles that frames show.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// Every frame has the same weight, which its pixels share; the sum is 1, or 0 where nothing is seen.
    pub histogram: CosineHistogram,
    /// Frames that show anything.
    pub frames: usize,
    /// The pixels that they cover.
    pub pixels: u64,
}

/// Draws all frames, on all cores. `progress` hears how many are done, of how many.
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
