//! From radiance to what a screen shows: exposure, and a curve that keeps bright things apart.

use glam::DVec3;

/// A tone curve.
#[derive(Clone, Copy, Debug)]
pub struct ToneCurve {
    /// Its name on the command line.
    pub name: &'static str,
    /// A channel of exposed radiance to one of the screen, both linear.
    pub curve: fn(f64) -> f64,
}

/// The curves. That of ACES is the fit by K. Narkowicz, 2015,
/// <https://knarkowicz.wordpress.com/2016/01/06/aces-filmic-tone-mapping-curve/>; Reinhard's is of SIGGRAPH 2002,
/// <https://doi.org/10.1145/566654.566575>, equation 3.
pub const TONE_CURVES: [ToneCurve; 3] = [
    ToneCurve {
        name: "none",
        curve: |x| x,
    },
    ToneCurve {
        name: "aces",
        curve: |x| x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14),
    },
    ToneCurve {
        name: "reinhard",
        curve: |x| x / (1.0 + x),
    },
];

/// How radiance is shown.
#[derive(Clone, Copy, Debug)]
pub struct Display {
    /// In stops: 1 doubles.
    pub exposure: f64,
    /// The curve.
    pub curve: ToneCurve,
}

impl Display {
    /// What the screen shows, linear, 0 to 1.
    pub fn shown(&self, radiance: DVec3) -> DVec3 {
        self.shown_within(radiance, 1.0)
    }

    /// What a screen shows whose brightest is this, linear; white is 1.
    pub fn shown_within(&self, radiance: DVec3, brightest: f64) -> DVec3 {
        let exposed = radiance.max(DVec3::ZERO) * libm::exp2(self.exposure);
        let shown = exposed.to_array().map(self.curve.curve);
        DVec3::from_array(shown).clamp(DVec3::ZERO, DVec3::splat(brightest))
    }
}
