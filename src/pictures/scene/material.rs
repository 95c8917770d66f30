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
        let mean = |of: fn(&Index) -> f64| -> DVec3 {
            let weighted = surface.indices.iter().zip(weights);
            weighted
                .map(|(index, weight)| of(index) * *weight / sum)
                .sum()
        };
        let samples = surface.indices.iter().zip(weights);
        let samples = samples.map(|(index, weight)| SpectralSample {
            index: *index,
            weight: *weight / sum,
        });
        let mut material = OpticalMaterial {
            samples: samples.collect(),
            n: mean(|index| index.n),
            k: mean(|index| index.k),
        };
        if surface.most_k() > TRANSPARENT_K {
            // The index whose colours match the metal's own at two angles. The means of a curved spectrum have other colours.
            let colours = [1.0, COS_82]
                .map(|cosine| surface.unpolarised(cosine).clamp(DVec3::ZERO, DVec3::ONE));
            let pairs = colours[0].to_array().into_iter().zip(colours[1].to_array());
            let found: Vec<_> = pairs.map(|(f0, f82)| index_from_f0_f82(f0, f82)).collect();
            material.n = DVec3::new(found[0].n, found[1].n, found[2].n);
            material.k = DVec3::new(found[0].k, found[1].k, found[2].k);
        }
        material
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
