//! Measures of error: absolute, relative, luminance, or visible colour difference.

use glam::DVec3;

use super::perceived::lab;
use crate::physics::num::each_channel;
use crate::physics::spectra::{Space, ciede2000};

/// The measure of error whose largest value over all angles is minimised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weight {
    /// `|f - F|`, channel by channel.
    #[default]
    Absolute,
    /// `|f - F| / |F|`, channel by channel.
    Relative,
    /// `|Y (f - F)|`, where Y is the space's luminance. That is one condition on three channels. Red and blue minimise their own
    /// `|f - F|`, and green, which carries most of the luminance, takes the coefficients that make the three together the best.
    /// The error of green alone grows by what it compensates.
    Luminance,
    /// `ΔE₀₀`, beside the white of the space. The fit minimises `w |f - F|` channel by channel, where w is the ΔE₀₀ per unit of
    /// that channel at the true colour. This is right for small errors of a single channel. Errors of several channels together
    /// can look larger or smaller than their largest. Reports give the figure of all three, and unit weights are taken where they
    /// make it smaller. Without iteration, the result is no optimum.
    DeltaE,
}

/// The least reference of a relative error: smaller ones count as this.
const LEAST: f64 = 1e-6;
/// The step of a channel for its derivative of ΔE₀₀.
const STEP: f64 = 1e-4;

impl Weight {
    /// All of them; the first is the default.
    pub const ALL: [Weight; 4] = [
        Weight::Absolute,
        Weight::Relative,
        Weight::Luminance,
        Weight::DeltaE,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Weight::Absolute => "absolute",
            Weight::Relative => "relative",
            Weight::Luminance => "luminance",
            Weight::DeltaE => "delta-e",
        }
    }

    /// Whether it needs the working space of the colours, and not only single channels.
    pub fn is_of_colours(self) -> bool {
        matches!(self, Weight::Luminance | Weight::DeltaE)
    }

    /// The weight of each channel's error, near a reference reflectance.
    pub(super) fn of_channels(self, reference: [f64; 3], space: Space) -> [f64; 3] {
        match self {
            Weight::Absolute | Weight::Luminance => [1.0; 3],
            Weight::Relative => reference.map(|reflectance| 1.0 / reflectance.abs().max(LEAST)),
            Weight::DeltaE => each_channel(|channel| {
                let mut moved = reference;
                moved[channel] += STEP;
                self.error(moved, reference, space) / STEP
            }),
        }
    }

    /// The error of a reflectance against the reference, in this measure. Unit: reflectance, a ratio, or ΔE₀₀.
    pub fn error(self, reflectance: [f64; 3], reference: [f64; 3], space: Space) -> f64 {
        let difference = (DVec3::from(reflectance) - DVec3::from(reference)).abs();
        match self {
            Weight::Absolute => difference.max_element(),
            Weight::Relative => {
                (difference / DVec3::from(reference).abs().max(DVec3::splat(LEAST))).max_element()
            }
            Weight::Luminance => {
                (luminance(reflectance, space) - luminance(reference, space)).abs()
            }
            Weight::DeltaE => {
                ciede2000(lab(reflectance.into(), space), lab(reference.into(), space))
            }
        }
    }
}

/// The luminance of three channels, 1 for (1, 1, 1).
pub(super) fn luminance(rgb: [f64; 3], space: Space) -> f64 {
    shares(space).dot(rgb.into())
}

/// The share of each channel in luminance.
pub(super) fn shares(space: Space) -> DVec3 {
    space.rgb_to_xyz().row(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOLD: [f64; 3] = [1.03, 0.71, 0.29];

    #[test]
    fn an_error_is_told_in_each_measure() {
        let given = [1.02, 0.72, 0.29];
        for (weight, wanted) in [
            (Weight::Absolute, 0.01),
            (Weight::Relative, 0.01 / 0.71),
            (Weight::Luminance, 0.01 * (0.7152 - 0.2126)),
        ] {
            let found = weight.error(given, GOLD, Space::Srgb);
            assert!((found - wanted).abs() < 1e-5, "{weight:?}: {found}");
        }
    }

    /// For a small error of a single channel, the weight gives the ΔE₀₀ within a hundredth.
    #[test]
    fn the_weight_of_a_channel_is_what_is_seen_of_it() {
        let weights = Weight::DeltaE.of_channels(GOLD, Space::Srgb);
        for (channel, weight) in weights.into_iter().enumerate() {
            let mut given = GOLD;
            given[channel] -= 0.001;
            let seen = Weight::DeltaE.error(given, GOLD, Space::Srgb);
            assert!((seen / (0.001 * weight) - 1.0).abs() < 0.01, "{channel}");
        }
        let nothing = Weight::Relative.of_channels([0.0; 3], Space::Srgb);
        assert!(nothing.iter().all(|weight| weight.is_finite()));
    }
}
