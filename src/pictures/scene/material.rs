//! A scene's material as the tracer takes it: its index at some wavelengths, and the weight of each wavelength in the three
//! channels.

use glam::DVec3;

use crate::physics::materials::{Index, Surface};
use crate::physics::optics::{
    COS_82, Layer, conductor, dielectric, index_from_f0_f82, under_films,
};

/// A material as a tracer takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticalMaterial {
    /// From red to blue or the reverse; the weights sum to (1, 1, 1).
    pub samples: Vec<SpectralSample>,
    /// The index of each channel: the mean over its weights.
    pub n: DVec3,
    /// The extinction coefficient of each channel.
    pub k: DVec3,
    /// The thickness of the film on it in nanometres, where the film is thickest.
    pub film_nm: f64,
}

/// A wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralSample {
    /// Its index.
    pub index: Index,
    /// The film on it where it is thickest, if there is one.
    pub film: Option<Layer>,
    /// Its share of red, green and blue.
    pub weight: DVec3,
}

impl SpectralSample {
    /// R of light from outside, under this share of the film's thickness.
    pub fn reflectance(&self, cosine: f64, share: f64) -> f64 {
        let Index { n, k } = self.index;
        match self.film {
            Some(film) => under_films(&[film.of_share(share)], n, k, cosine).unpolarised(),
            None => conductor(n, k, cosine).unpolarised(),
        }
    }

    /// R of light from inside a body that does not absorb: the medium outside is the base.
    pub fn reflectance_inside(&self, cosine: f64, share: f64) -> f64 {
        let n = self.index.n;
        let turned = |film: Layer| Layer {
            n: film.n / n,
            k: film.k / n,
            waves: share * film.waves * n,
        };
        match self.film.map(turned) {
            Some(film) => under_films(&[film], 1.0 / n, 0.0, cosine).unpolarised(),
            None => dielectric(1.0 / n, cosine).unpolarised(),
        }
    }
}

/// So many wavelengths of a surface under a film make one ray: fringes of a film, which is followed in steps of 1 nm, are wider.
const UNDER_A_FILM: usize = 5;

/// A medium with less extinction than this is transparent.
const TRANSPARENT_K: f64 = 0.1;

impl OpticalMaterial {
    /// Without dispersion.
    pub fn of_index(n: f64) -> OpticalMaterial {
        OpticalMaterial {
            samples: vec![SpectralSample {
                index: Index { n, k: 0.0 },
                film: None,
                weight: DVec3::ONE,
            }],
            n: DVec3::splat(n),
            k: DVec3::ZERO,
            film_nm: 0.0,
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
        let (mut n, mut k) = (mean(|index| index.n), mean(|index| index.k));
        if surface.films.is_empty() && surface.most_k() > TRANSPARENT_K {
            // The index whose colours match the metal's own at two angles. The means of a curved spectrum have other colours.
            let [f0, f82] = [1.0, COS_82]
                .map(|cosine| surface.unpolarised(cosine).clamp(DVec3::ZERO, DVec3::ONE));
            let found = [0, 1, 2].map(|i| index_from_f0_f82(f0[i], f82[i]));
            n = DVec3::from_array(found.map(|index| index.n));
            k = DVec3::from_array(found.map(|index| index.k));
        }
        let each = if surface.films.is_empty() {
            1
        } else {
            UNDER_A_FILM
        };
        let sample = |(i, weights): (usize, &[DVec3])| {
            let middle = i * each + weights.len() / 2;
            SpectralSample {
                index: surface.indices[middle],
                film: surface.films_at(middle).first().copied(),
                weight: weights.iter().sum::<DVec3>() / sum,
            }
        };
        OpticalMaterial {
            samples: weights.chunks(each).enumerate().map(sample).collect(),
            n,
            k,
            film_nm: 0.0,
        }
    }

    /// A material under one film of this thickness, in nanometres.
    pub fn under_a_film(surface: &Surface, film_nm: f64) -> OpticalMaterial {
        OpticalMaterial {
            film_nm,
            ..OpticalMaterial::of_surface(surface)
        }
    }

    /// The share of the film's thickness at this height, from -1 at the bottom of a body to 1 at its top, where the film ends.
    pub fn share_at(height: f64) -> f64 {
        (0.5 - 0.5 * height).clamp(0.0, 1.0)
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
