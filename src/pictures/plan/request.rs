//! The settings of a plan.

use super::curve::step_cosines;
use super::metric::{Metric, Screen};
use crate::generator::reference::{MaterialInMedium, ReferenceCurve};
use crate::lab::cost::Family;
use crate::language::methods::{Light, Method};
use crate::physics::materials::Surface;
use crate::physics::num::{Precision, in_parallel};
use crate::physics::spectra::Space;
use crate::pictures::scene::Display;

/// Cosines that a core takes at once. Handing over a single one takes a tenth of the law's own time.
const TOGETHER: usize = 256;
/// The largest step between exposures of a range, in stops.
const STOPS: f64 = 1.0;

/// A material of the scene.
#[derive(Clone, Debug)]
pub struct PlannedMaterial {
    /// The name or path by which a user names it.
    pub argument: String,
    /// The scene's names for it, each once.
    pub names: Vec<String>,
    /// The material.
    pub subject: MaterialInMedium,
    /// Whether it has no file that a function could be specialised to.
    pub is_library_only: bool,
}

/// The settings of a plan: its budget, its metric and its candidates.
#[derive(Clone, Debug)]
pub struct PlanRequest {
    /// The largest error.
    pub budget: f64,
    /// The metric of errors.
    pub metric: Metric,
    /// From radiance to the screen.
    pub display: Display,
    /// The colour space of the pictures.
    pub space: Space,
    /// How many stops darker and brighter are judged too.
    pub exposure_range: f64,
    /// A material that no frame shows on this many pixels is judged at every angle.
    pub min_pixels: usize,
    /// The reference that functions are compared with.
    pub truth: PlanTruth,
    /// The GPU family whose costs decide.
    pub family: &'static Family,
    /// The precision that functions compute in.
    pub precision: Precision,
    /// How many channels functions may return.
    pub channels: Vec<usize>,
    /// The methods to choose from.
    pub methods: Vec<&'static Method>,
    /// The cost of a texture fetch; without it no table is chosen.
    pub fetch: Option<f64>,
    /// The price of each further function, in units × pixels.
    pub price: f64,
}

/// The reference that functions are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanTruth {
    /// The exact law at each wavelength.
    Spectrum,
    /// The exact law with one index per channel, as the exact methods take it.
    Exact,
}

impl PlanTruth {
    /// Both.
    pub const ALL: [PlanTruth; 2] = [PlanTruth::Spectrum, PlanTruth::Exact];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            PlanTruth::Spectrum => "spectrum",
            PlanTruth::Exact => "exact",
        }
    }

    /// Its values at [`step_cosines`].
    pub(super) fn values(self, subject: &MaterialInMedium) -> Vec<[f64; 3]> {
        let own = &subject.reference;
        let reference = match self {
            PlanTruth::Spectrum => own.clone(),
            PlanTruth::Exact => {
                let mut surface = Surface::of_channels(&subject.effective.channels);
                surface.gamut = own.surface.gamut;
                ReferenceCurve::new(surface, Light::Unpolarised)
            }
        };
        let cosines = step_cosines();
        let parts: Vec<&[f64]> = cosines.chunks(TOGETHER).collect();
        let of_part = |i: usize| -> Vec<[f64; 3]> {
            let values = parts[i].iter().map(|cosine| reference.at(*cosine));
            values.collect()
        };
        in_parallel(parts.len(), &of_part, &mut |_, _| {}).concat()
    }
}

impl PlanRequest {
    /// The screen that shows the pictures.
    pub(super) fn screen(&self) -> Screen {
        Screen::new(self.metric, self.display, self.space)
    }

    /// The exposures that are judged, in stops.
    pub(super) fn exposures(&self) -> Vec<f64> {
        let range = self.exposure_range;
        let steps = (range / STOPS).ceil() as i32;
        let at = |step: i32| match steps {
            0 => 0.0,
            _ => range * f64::from(step) / f64::from(steps),
        };
        (-steps..=steps).map(at).collect()
    }
}
