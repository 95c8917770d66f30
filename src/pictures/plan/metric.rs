//! How far apart two pixels look on a screen, and the error of a function in a frame.
//!
//! | metric | difference | on screen |
//! |---|---|---|
//! | `de2000` | ΔE₀₀ ([`crate::physics::spectra::ciede2000`]) beside the white of the working space | at most white |
//! | `code8` | the largest difference of three 8-bit codes of sRGB | at most white |
//! | `linear` | the largest difference of three linear channels | at most white |
//! | `itp` | 720 √(ΔI² + ΔT² + ΔP²), a difference of 1 is just visible | 1 is 203 cd/m², at most 10 000 cd/m² |
//!
//! Sources: I, T and P: Recommendation ITU-R BT.2124-0, *Objective metric for the assessment of the potential visibility of colour
//! differences in television*, 2019, annex 1; the curve PQ and the matrices: ITU-R BT.2100-2, 2018, tables 4 and 7; 203 cd/m² for
//! diffuse white: Report ITU-R BT.2408-7, 2023.
//!
//! The error of a function in a frame is the difference that 99.9 % of the material's coverage does not exceed.

use glam::{DMat3, DVec3};

use super::frame::ScenePixel;
use crate::physics::spectra::{Lab, Space, ciede2000, srgb_byte, srgb_linear, xyz_to_lab};
use crate::pictures::scene::Display;

/// A measure of visible difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// CIEDE2000.
    De2000,
    /// Codes of 8 bits.
    Code8,
    /// ΔE ITP, for screens of high dynamic range.
    Itp,
    /// Linear channels.
    Linear,
}

/// The luminance of white, and the highest luminance of a screen of high dynamic range, in cd/m².
const WHITE: f64 = 203.0;
const PEAK: f64 = 10_000.0;

impl Metric {
    /// All metrics.
    pub const ALL: [Metric; 4] = [Metric::De2000, Metric::Code8, Metric::Itp, Metric::Linear];

    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Metric::De2000 => "de2000",
            Metric::Code8 => "code8",
            Metric::Itp => "itp",
            Metric::Linear => "linear",
        }
    }

    /// Its unit in words.
    pub fn unit(self) -> &'static str {
        match self {
            Metric::De2000 => "ΔE₀₀",
            Metric::Code8 => "codes of 255",
            Metric::Itp => "ΔE ITP",
            Metric::Linear => "of linear white",
        }
    }

    /// The budget where none is given: a difference that is just not visible.
    pub fn usual_budget(self) -> f64 {
        match self {
            Metric::De2000 | Metric::Code8 | Metric::Itp => 1.0,
            Metric::Linear => 1.0 / 255.0,
        }
    }
}

/// A screen, and the metric of differences on it.
#[derive(Clone, Debug)]
pub struct Screen {
    metric: Metric,
    display: Display,
    /// The brightest value that it shows; white is 1.
    peak: f64,
    /// Whether it shows codes of 8 bits alone.
    is_coded: bool,
    to_xyz: DMat3,
    white: DVec3,
    to_lms: DMat3,
}

impl Screen {
    /// A screen that shows pictures in this space.
    pub fn new(metric: Metric, display: Display, space: Space) -> Screen {
        // Rows of BT.2100's table 7, in 4096ths.
        let lms = DMat3::from_cols(
            DVec3::new(1688.0, 683.0, 99.0),
            DVec3::new(2146.0, 2951.0, 309.0),
            DVec3::new(262.0, 462.0, 3688.0),
        ) * (1.0 / 4096.0);
        let peak = match metric {
            Metric::Itp => PEAK / WHITE,
            _ => 1.0,
        };
        Screen {
            metric,
            display,
            peak,
            is_coded: false,
            to_xyz: space.rgb_to_xyz(),
            white: space.white(),
            to_lms: lms * Space::Rec2020.xyz_to_rgb() * space.rgb_to_xyz(),
        }
    }

    /// The same screen with codes of 8 bits.
    #[must_use]
    pub fn coded(self) -> Screen {
        Screen {
            is_coded: true,
            ..self
        }
    }

    /// What the screen shows of a pixel with this reflectance, linear, at this many stops of exposure.
    pub fn shown(&self, pixel: &ScenePixel, reflectance: [f64; 3], stops: f64) -> DVec3 {
        let brighter = Display {
            exposure: self.display.exposure + stops,
            ..self.display
        };
        let shown = brighter.shown_within(radiance(pixel, reflectance), self.peak);
        if self.is_coded {
            let decoded = |x: f64| srgb_linear(f64::from(srgb_byte(x)) / 255.0);
            DVec3::from_array(shown.to_array().map(decoded))
        } else {
            shown
        }
    }

    /// The place of what it shows of a pixel.
    fn place_of(&self, pixel: &ScenePixel, reflectance: [f64; 3], stops: f64) -> DVec3 {
        self.place(self.shown(pixel, reflectance, stops))
    }

    /// The place of a shown colour in the metric's colour space. [`Screen::difference`] compares two places.
    pub fn place(&self, shown: DVec3) -> DVec3 {
        match self.metric {
            Metric::De2000 => {
                let lab = xyz_to_lab(self.to_xyz * shown, self.white);
                DVec3::new(lab.l, lab.a, lab.b)
            }
            Metric::Code8 => DVec3::from_array(shown.to_array().map(|x| f64::from(srgb_byte(x)))),
            Metric::Itp => itp(self.to_lms * shown),
            Metric::Linear => shown,
        }
    }

    /// The difference between two places.
    pub fn difference(&self, one: DVec3, other: DVec3) -> f64 {
        let lab = |place: DVec3| Lab::new(place.x, place.y, place.z);
        match self.metric {
            Metric::De2000 => ciede2000(lab(one), lab(other)),
            Metric::Code8 | Metric::Linear => (one - other).abs().max_element(),
            Metric::Itp => 720.0 * (one - other).length(),
        }
    }
}

/// I, T and P of the three cone signals, where white is 1.
fn itp(lms: DVec3) -> DVec3 {
    let [l, m, s] = lms.to_array().map(pq);
    DVec3::new(
        0.5 * (l + m),
        0.5 * (6610.0 * l - 13613.0 * m + 7003.0 * s) / 4096.0,
        (17933.0 * l - 17390.0 * m - 543.0 * s) / 4096.0,
    )
}

/// The PQ curve: from luminance to a signal in [0, 1].
fn pq(relative: f64) -> f64 {
    let y = (relative.max(0.0) * WHITE / PEAK).min(1.0);
    let power = libm::pow(y, 2610.0 / 16384.0);
    let ratio = (3424.0 / 4096.0 + 2413.0 / 128.0 * power) / (1.0 + 2392.0 / 128.0 * power);
    libm::pow(ratio, 2523.0 / 32.0)
}

/// The share of a material's coverage whose differences do not exceed its error.
const SHARE: f64 = 0.999;
/// Below this many pixels the error is the largest difference.
pub const PERCENTILE_FROM: usize = 1000;

/// The pixels of a material in a frame, with what the exact law shows there.
pub struct JudgedPixels<'a> {
    pixels: &'a [ScenePixel],
    screen: &'a Screen,
    /// For each exposure in stops, what the exact law shows of each pixel.
    truth: Vec<(f64, Vec<DVec3>)>,
}

/// From the pairs of difference and coverage of a frame's pixels to the error of the frame.
pub type ErrorOf = fn(Vec<(f64, f64)>) -> f64;

impl<'a> JudgedPixels<'a> {
    /// Pixels under these exposures, in stops from the screen's own. `truth` gives the exact reflectance of each.
    pub fn new(
        pixels: &'a [ScenePixel],
        screen: &'a Screen,
        exposures: &[f64],
        truth: impl Fn(usize) -> [f64; 3],
    ) -> JudgedPixels<'a> {
        let shown = |stops: &f64| {
            let each = pixels.iter().enumerate();
            let shown = each.map(|(i, pixel)| screen.place_of(pixel, truth(i), *stops));
            (*stops, shown.collect())
        };
        JudgedPixels {
            pixels,
            screen,
            truth: exposures.iter().map(shown).collect(),
        }
    }

    /// The error of a function with these reflectances of the pixels, at the exposure where it is worst.
    pub fn error(&self, error_of: ErrorOf, reflectance: impl Fn(usize) -> [f64; 3]) -> f64 {
        let of_exposure = |(stops, truth): &(f64, Vec<DVec3>)| {
            let each = self.pixels.iter().zip(truth).enumerate();
            let differences = each.map(|(i, (pixel, truth))| {
                let place = self.screen.place_of(pixel, reflectance(i), *stops);
                (
                    self.screen.difference(place, *truth),
                    f64::from(pixel.coverage),
                )
            });
            error_of(differences.collect())
        };
        self.truth.iter().map(of_exposure).fold(0.0, f64::max)
    }
}

/// The difference that 99.9 % of the coverage does not exceed; the largest of few pixels.
pub fn percentile(differences: Vec<(f64, f64)>) -> f64 {
    if differences.len() < PERCENTILE_FROM {
        largest(differences)
    } else {
        quantile(differences, SHARE)
    }
}

/// The largest difference, whatever the coverage.
pub fn largest(differences: Vec<(f64, f64)>) -> f64 {
    differences.iter().map(|(e, _)| *e).fold(0.0, f64::max)
}

/// The radiance that reaches the camera from a pixel: F L + (1 - F) O.
fn radiance(pixel: &ScenePixel, reflectance: [f64; 3]) -> DVec3 {
    let channel = |i: usize| {
        let [light, other] = [pixel.light[i], pixel.other[i]].map(f64::from);
        other + reflectance[i] * (light - other)
    };
    DVec3::new(channel(0), channel(1), channel(2))
}

/// The smallest value such that the values up to it hold this share of the weight.
fn quantile(mut weighted: Vec<(f64, f64)>, share: f64) -> f64 {
    weighted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = weighted.iter().map(|(_, weight)| weight).sum();
    let mut held = 0.0;
    for (value, weight) in &weighted {
        held += weight;
        // A sum of many weights is off by a few roundings.
        if held >= share * whole * (1.0 - 1e-12) {
            return *value;
        }
    }
    weighted.last().map_or(0.0, |(value, _)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::scene::TONE_CURVES;

    fn screen(metric: Metric) -> Screen {
        let display = Display {
            exposure: 0.0,
            curve: TONE_CURVES[0],
        };
        Screen::new(metric, display, Space::Srgb)
    }

    fn apart(metric: Metric, one: [f64; 3], other: [f64; 3]) -> f64 {
        let screen = screen(metric);
        let place = |rgb| screen.place_of(&ScenePixel::MIRROR_IN_WHITE, rgb, 0.0);
        let [one, other] = [one, other].map(place);
        screen.difference(one, other)
    }

    /// By BT.2408, 203 cd/m² is .58 of the signal. A grey has no T and P.
    #[test]
    fn the_curve_of_high_dynamic_range_is_that_of_the_standard() {
        assert!((pq(1.0) - 0.5807).abs() < 1e-4, "{}", pq(1.0));
        assert!((pq(100.0 / 203.0) - 0.5081).abs() < 1e-4);
        assert!((pq(PEAK / WHITE) - 1.0).abs() < 1e-12);
        let grey = screen(Metric::Itp).place(DVec3::splat(0.3));
        assert!(grey.y.abs() < 1e-3 && grey.z.abs() < 1e-3, "{grey}");
    }

    #[test]
    fn what_is_brighter_than_white_looks_the_same_where_white_is_the_most() {
        let (one, other) = ([1.0; 3], [1.5; 3]);
        for metric in [Metric::De2000, Metric::Code8, Metric::Linear] {
            assert_eq!(apart(metric, one, other), 0.0, "{}", metric.name());
        }
        assert!(apart(Metric::Itp, one, other) > 10.0);
    }

    #[test]
    fn differences_by_hand() {
        assert_eq!(apart(Metric::Code8, [0.5; 3], [0.5, 0.5, 0.215_86]), 60.0);
        assert!((apart(Metric::Linear, [0.5; 3], [0.25, 0.5, 0.5]) - 0.25).abs() < 1e-12);
        // L* of .5 and .52 is 76.069 and 77.279; see CIEDE2000's lightness weight.
        assert!((apart(Metric::De2000, [0.5; 3], [0.52; 3]) - 0.864).abs() < 0.01);
    }

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
