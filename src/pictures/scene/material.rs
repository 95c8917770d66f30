//! A scene's material as the tracer takes it: its index at some wavelengths, and the weight of each wavelength in the three
//! channels.

use glam::DVec3;

use crate::physics::materials::{Index, Surface};
use crate::physics::optics::{COS_82, index_from_f0_f82};

/// A material as a tracer takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticalMaterial {
    /// From red to blue or the reverse; the weights sum to (1, 1, 1).
    pub samples: Vec<SpectralSample>,
    /// The index of each channel: the mean over its weights.
    pub n: DVec3,
    /// The extinction coefficient of each channel.
    pub k: DVec3,
}

/// A wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralSample {
    /// Its index.
    pub index: Index,
    /// Its share of red, green and blue.
    pub weight: DVec3,
}

/// A medium with less extinction than this is transparent.
const TRANSPARENT_K: f64 = 0.1;

impl OpticalMaterial {
    /// Without dispersion.
    pub fn of_index(n: f64) -> OpticalMaterial {
        OpticalMaterial {
            samples: vec![SpectralSample {
                index: Index { n, k: 0.0 },
                weight: DVec3::ONE,
            }],
            n: DVec3::splat(n),
            k: DVec3::ZERO,
        }
    }

    /// A material under viewing conditions: a ray for each wavelength of the integrator, since the law at a mean index is not the
    /// mean of the laws.
    pub fn of_surface(surface: &Surface) -> OpticalMaterial {
        let weights = &surface.integrator.weights;
        let sum: DVec3 = weights.iter().sum();
        let weighted = || surface.indices.iter().zip(weights);
        let mean = |of: fn(&Index) -> f64| -> DVec3 {
            weighted()
                .map(|(index, weight)| of(index) * *weight / sum)
                .sum()
        };
        let samples = weighted().map(|(index, weight)| SpectralSample {
            index: *index,
            weight: *weight / sum,
        });
        let (mut n, mut k) = (mean(|index| index.n), mean(|index| index.k));
        if surface.most_k() > TRANSPARENT_K {
            // The index whose colours match the metal's own at two angles. The means of a curved spectrum have other colours.
            let [f0, f82] = [1.0, COS_82]
                .map(|cosine| surface.unpolarised(cosine).clamp(DVec3::ZERO, DVec3::ONE));
            let found = [0, 1, 2].map(|i| index_from_f0_f82(f0[i], f82[i]));
            n = DVec3::from_array(found.map(|index| index.n));
            k = DVec3::from_array(found.map(|index| index.k));
        }
        OpticalMaterial {
            samples: samples.collect(),
            n,
            k,
        }
    }

    /// Without dispersion, at green's index.
    pub fn at_one_index(&self) -> OpticalMaterial {
        OpticalMaterial {
            k: self.k,
            ..OpticalMaterial::of_index(self.n.y)
        }
    }

    /// The absorption coefficient of red, green and blue, per metre: 4 pi k / lambda, at a wavelength in the middle of each channel.
    pub fn absorption(&self) -> DVec3 {
        let wavelengths = DVec3::new(610.0, 550.0, 460.0) * 1e-9;
        4.0 * std::f64::consts::PI * self.k / wavelengths
    }
}
