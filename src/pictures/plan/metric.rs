//! How far apart two pixels look on a screen, and the pixels of a frame that are compared.
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

use super::curve::{Curve, PixelPlace};
use crate::physics::spectra::{Lab, Space, ciede2000, srgb_byte, xyz_to_lab};
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
            to_xyz: space.rgb_to_xyz(),
            white: space.white(),
            to_lms: lms * Space::Rec2020.xyz_to_rgb() * space.rgb_to_xyz(),
        }
    }

    /// What the screen shows of a radiance, linear, at this many stops of exposure.
    pub fn shown(&self, radiance: DVec3, stops: f64) -> DVec3 {
        let brighter = Display {
            exposure: self.display.exposure + stops,
            ..self.display
        };
        brighter.shown_within(radiance, self.peak)
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
pub const SHARE: f64 = 0.999;
/// Below this many pixels the error is the largest difference.
pub const PERCENTILE_FROM: usize = 1000;

/// The pixels of a material in a frame, with what the exact law shows there.
pub struct JudgedPixels<'a> {
    pixels: &'a [ScenePixel],
    places: &'a [PixelPlace],
    screen: &'a Screen,
    /// For each exposure, what the exact law shows.
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

    /// The error of a function in these pixels, at the exposure where it is worst.
    pub fn error(&self, curve: &Curve) -> f64 {
        self.worst(curve, &error_of)
    }

    /// The largest difference that a function makes in these pixels, at the exposure where it is worst.
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

/// The error of a frame, from the pairs of difference and coverage of its pixels.
pub fn error_of(differences: Vec<(f64, f64)>) -> f64 {
    if differences.len() < PERCENTILE_FROM {
        largest(&differences)
    } else {
        quantile(differences, SHARE)
    }
}

/// The largest difference, whatever the coverage.
pub fn largest(differences: &[(f64, f64)]) -> f64 {
    differences.iter().map(|(e, _)| *e).fold(0.0, f64::max)
}

/// The radiance that reaches the camera from a pixel: F L + (1 - F) O.
pub fn radiance(pixel: &ScenePixel, reflectance: [f64; 3]) -> DVec3 {
    let channel = |i: usize| {
        let [light, other] = [pixel.light[i], pixel.other[i]].map(f64::from);
        other + reflectance[i] * (light - other)
    };
    DVec3::new(channel(0), channel(1), channel(2))
}

/// The smallest value such that the values up to it hold this share of the weight.
pub fn quantile(mut weighted: Vec<(f64, f64)>, share: f64) -> f64 {
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

/// A pixel that shows a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScenePixel {
    /// Its index in the frame, row by row from the top left.
    pub place: u32,
    /// The cosine between the normal and the direction to the camera, in [0, 1].
    pub cos_theta: f32,
    /// Perceptual roughness in [0, 1]: α is its square.
    pub roughness: f32,
    /// The share of the pixel that the material covers, above 0 to 1.
    pub coverage: f32,
    /// Incoming light along the mirrored direction, which F multiplies. It is linear, in the working space, and not negative.
    pub light: [f32; 3],
    /// All other light of the pixel, before 1 - F multiplies it: the body's own lit colour, or what is seen through it.
    pub other: [f32; 3],
}

/// The pixels of a frame, by material, whichever renderer drew them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FramePixels {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The pixels of each material, in the order of the scene's materials; each in scan order.
    pub of_material: Vec<Vec<ScenePixel>>,
}

impl FramePixels {
    /// A frame of this many materials that shows nothing yet.
    pub fn new(size: [u32; 2], materials: usize) -> FramePixels {
        FramePixels {
            size,
            of_material: vec![Vec::new(); materials],
        }
    }
}

/// A material of a scene, and the catalogue material that stands for it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MappedMaterial {
    /// What the scene calls it.
    pub name: String,
    /// A name of the catalogue, or the path of a material's file as the scene's file states it.
    pub material: String,
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
        let [one, other] =
            [one, other].map(|rgb| screen.place(screen.shown(DVec3::from(rgb), 0.0)));
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
}

#[cfg(test)]
mod picture_error_tests {
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
