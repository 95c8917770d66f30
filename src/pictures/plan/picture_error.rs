//! The error of a function in a frame: what holds 99.9 % of what a material covers.

use glam::DVec3;

use super::curve::{Curve, PixelPlace};
use super::metric::Screen;
use super::pixels::ScenePixel;

/// The share of a material's coverage that differs by no more than its error.
pub const SHARE: f64 = 0.999;
/// Below so many pixels the error is the largest difference.
pub const PERCENTILE_FROM: usize = 1000;

/// The pixels of a material in a frame, with what the exact law shows there.
pub struct JudgedPixels<'a> {
    pixels: &'a [ScenePixel],
    places: &'a [PixelPlace],
    screen: &'a Screen,
    /// For each exposure what the exact law shows.
    truth: Vec<(f64, Vec<DVec3>)>,
}

impl<'a> JudgedPixels<'a> {
    /// Pixels under these exposures, in stops from the screen's own.
    pub fn new(
        pixels: &'a [ScenePixel],
        places: &'a [PixelPlace],
        truth: &Curve,
        screen: &'a Screen,
        exposures: &[f64],
    ) -> JudgedPixels<'a> {
        let seen = |stops: &f64| {
            let each = pixels.iter().zip(places);
            let seen = each.map(|(pixel, place)| {
                screen.place(screen.shown(radiance(pixel, truth.at(place)), *stops))
            });
            (*stops, seen.collect())
        };
        JudgedPixels {
            pixels,
            places,
            screen,
            truth: exposures.iter().map(seen).collect(),
        }
    }

    /// The error of a function here, under the exposure where it is worst.
    pub fn error(&self, curve: &Curve) -> f64 {
        self.worst(curve, &error_of)
    }

    /// The largest difference that it makes here, under the exposure where it is worst.
    pub fn largest(&self, curve: &Curve) -> f64 {
        self.worst(curve, &|differences| largest(&differences))
    }

    fn worst(&self, curve: &Curve, error_of: &dyn Fn(Vec<(f64, f64)>) -> f64) -> f64 {
        let of_exposure = |(stops, truth): &(f64, Vec<DVec3>)| {
            let each = self.pixels.iter().zip(self.places).zip(truth);
            let differences = each.map(|((pixel, place), truth)| {
                let shown = self.screen.shown(radiance(pixel, curve.at(place)), *stops);
                let difference = self.screen.difference(self.screen.place(shown), *truth);
                (difference, f64::from(pixel.coverage))
            });
            error_of(differences.collect())
        };
        self.truth.iter().map(of_exposure).fold(0.0, f64::max)
    }
}

/// The error of a frame with these differences and coverages of pixels.
pub fn error_of(differences: Vec<(f64, f64)>) -> f64 {
    if differences.len() < PERCENTILE_FROM {
        largest(&differences)
    } else {
        quantile(differences, SHARE)
    }
}

/// The largest difference, whatever covers how much.
pub fn largest(differences: &[(f64, f64)]) -> f64 {
    differences.iter().map(|(e, _)| *e).fold(0.0, f64::max)
}

/// What reaches the camera from a pixel: F L + (1 - F) O.
pub fn radiance(pixel: &ScenePixel, reflectance: [f64; 3]) -> DVec3 {
    let channel = |i: usize| {
        let [light, other] = [pixel.light[i], pixel.other[i]].map(f64::from);
        other + reflectance[i] * (light - other)
    };
    DVec3::new(channel(0), channel(1), channel(2))
}

/// The smallest value so that what does not exceed it has this share of the weight.
pub fn quantile(mut weighted: Vec<(f64, f64)>, share: f64) -> f64 {
    weighted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = weighted.iter().map(|(_, weight)| weight).sum();
    let mut held = 0.0;
    for (value, weight) in &weighted {
        held += weight;
        // A sum of many weights is off by some roundings.
        if held >= share * whole * (1.0 - 1e-12) {
            return *value;
        }
    }
    weighted.last().map_or(0.0, |(value, _)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quantile_is_that_of_the_nearest_rank() {
        let all = |weight: f64| (1..=1000).map(|i| (f64::from(i), weight)).collect();
        assert_eq!(quantile(all(1.0), 0.999), 999.0);
        assert_eq!(quantile(all(0.1), 0.999), 999.0);
        assert_eq!(quantile(all(1.0), 1.0), 1000.0);
        assert_eq!(quantile(vec![(3.0, 1.0), (1.0, 1.0)], 0.5), 1.0);
        assert_eq!(quantile(vec![(3.0, 1.0), (1.0, 0.9)], 0.5), 3.0);
        assert_eq!(quantile(Vec::new(), 0.999), 0.0);
    }
}
