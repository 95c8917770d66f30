//! The reference reflectance: the exact law of a surface, in light of one polarisation. Errors of methods are measured
//! against it.

use std::sync::{Arc, LazyLock, OnceLock};

use glam::DVec3;

use crate::language::methods::{Light, unwarped};
use crate::physics::materials::Surface;
use crate::physics::num::each_channel;
use crate::physics::spectra::Gamut;

/// Angles between 0 and 90 degrees over which means are taken.
pub const ANGLES: usize = 2048;
/// Additional cosines close to grazing: 2⁻ⁱᐟ⁴, where indices far from 1 have their largest errors.
const GRAZING: usize = 120;
/// [`cosines`] of [`ANGLES`].
pub static COSINES: LazyLock<Vec<f64>> = LazyLock::new(|| cosines(ANGLES));

/// The number of cosines at which a curve is fitted, from 0 to 1, dense towards grazing as in `--axis steep`. Twice as many
/// change no error by a hundredth of it.
const FITTED: usize = 257;
const DENSE: f64 = 8.0;
/// The cosines at which forms are fitted to a curve.
pub static FITTED_COSINES: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let place = |i: usize| unwarped(DENSE, i as f64 / (FITTED - 1) as f64);
    (0..FITTED).map(place).collect()
});

/// The reference of methods: a surface under viewing conditions, in light of one polarisation.
#[derive(Clone, Debug)]
pub struct ReferenceCurve {
    /// The surface.
    pub surface: Surface,
    /// The polarisation.
    pub light: Light,
    /// Its reflectance at [`cosines`] of [`ANGLES`], before the gamut. It is expensive, so it is computed once, at the first use,
    /// for all clones.
    unclipped: Arc<OnceLock<Vec<DVec3>>>,
    /// The same at [`FITTED_COSINES`].
    fitted: Arc<OnceLock<Vec<DVec3>>>,
}

impl ReferenceCurve {
    /// The reference of a surface in this light.
    pub fn new(surface: Surface, light: Light) -> ReferenceCurve {
        ReferenceCurve {
            surface,
            light,
            unclipped: Arc::default(),
            fitted: Arc::default(),
        }
    }

    fn unclipped(&self) -> &[DVec3] {
        self.unclipped.get_or_init(|| self.reflected_at(&COSINES))
    }

    fn reflected_at(&self, cosines: &[f64]) -> Vec<DVec3> {
        let cosines = cosines.iter();
        cosines
            .map(|cos_theta| reflected(&self.surface, self.light, *cos_theta))
            .collect()
    }

    /// Its reflectance before the gamut at [`FITTED_COSINES`].
    pub fn fitted_to(&self) -> &[DVec3] {
        self.fitted
            .get_or_init(|| self.reflected_at(&FITTED_COSINES))
    }

    /// The same reference without a gamut: colours outside the working space stay as they are.
    pub fn before_gamut(mut self) -> ReferenceCurve {
        self.surface.gamut = Gamut::Keep;
        self
    }

    /// The reflectance at [`cosines`] of [`ANGLES`].
    pub fn table(&self) -> Vec<[f64; 3]> {
        let colours = self.unclipped().iter();
        colours
            .map(|colour| self.surface.gamut.apply(*colour).to_array())
            .collect()
    }

    /// The reflectance of each channel at a cosine, in the gamut.
    pub fn at(&self, cos_theta: f64) -> [f64; 3] {
        reference_reflectance(&self.surface, self.light, cos_theta)
    }

    /// The hemispherical reflectance of each channel, 2 ∫ R cos θ d(cos θ), by the midpoint rule in angle: ∫ R sin 2θ dθ, within
    /// 1e-6.
    pub fn average(&self) -> [f64; 3] {
        let step = std::f64::consts::FRAC_PI_2 / ANGLES as f64;
        let weight = |i: usize| libm::sin((2 * i + 1) as f64 * step) * step;
        let table = self.table();
        let sum = |channel: usize| {
            let terms = table[..ANGLES].iter().enumerate();
            terms
                .map(|(i, reflectance)| weight(i) * reflectance[channel])
                .sum()
        };
        each_channel(sum)
    }
}

/// The reflectance of each channel at a cosine, in the surface's gamut.
pub fn reference_reflectance(surface: &Surface, light: Light, cos_theta: f64) -> [f64; 3] {
    let colour = reflected(surface, light, cos_theta);
    surface.gamut.apply(colour).to_array()
}

/// The same before the gamut.
fn reflected(surface: &Surface, light: Light, cos_theta: f64) -> DVec3 {
    match light {
        Light::Unpolarised => surface.unpolarised(cos_theta),
        Light::S => surface.reflectance(cos_theta).s,
        Light::P => surface.reflectance(cos_theta).p,
    }
}

/// The midpoints of equal steps of angle, over which means are taken, then both ends and grazing cosines.
pub fn cosines(angles: usize) -> Vec<f64> {
    let middles = (0..angles).map(|i| cosine_of_part(2 * i + 1, 2 * angles));
    let grazing = (1..GRAZING).map(|i| libm::exp2(-(i as f64) / 4.0));
    middles.chain([1.0, 0.0]).chain(grazing).collect()
}

/// cos of `part/whole` of a right angle, exactly 1 and 0 at the ends.
pub fn cosine_of_part(part: usize, whole: usize) -> f64 {
    if part == whole {
        0.0
    } else {
        libm::cos(part as f64 / whole as f64 * std::f64::consts::FRAC_PI_2)
    }
}
