//! Gamut: what becomes of a reflectance above 1 or below 0, because the space has no such colour.
//!
//! Saturated gold has a red of 1.03 to 1.06 in sRGB. That is right for the sum of light, but a path tracer gains energy
//! by it and a texture of unsigned numbers cannot hold it.

use glam::DVec3;

/// What to do with colours outside [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gamut {
    /// Nothing.
    Keep,
    /// Each channel goes to the nearest end of [0, 1]: the hue changes, the other channels stay right.
    #[default]
    Clip,
    /// The colour is divided by its largest channel where that is above 1, and what is below 0 becomes 0: the hue
    /// stays, all channels are too dark. Gold in Lagarde's table is made so.
    Scale,
}

impl Gamut {
    /// All of them.
    pub const ALL: [Gamut; 3] = [Gamut::Keep, Gamut::Clip, Gamut::Scale];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Gamut::Keep => "keep",
            Gamut::Clip => "clip",
            Gamut::Scale => "scale",
        }
    }

    /// The colour that is written. A NaN stays one.
    pub fn apply(self, rgb: DVec3) -> DVec3 {
        match self {
            Gamut::Keep => rgb,
            Gamut::Clip => rgb.map(|channel| channel.clamp(0.0, 1.0)),
            Gamut::Scale => {
                let largest = rgb.max_element().max(1.0);
                rgb.map(|channel| (channel / largest).clamp(0.0, 1.0))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(rgb: [f64; 3], clip: [f64; 3], scale: [f64; 3]) {
        assert_eq!(Gamut::Keep.apply(rgb.into()).to_array(), rgb);
        assert_eq!(Gamut::Clip.apply(rgb.into()).to_array(), clip);
        assert_eq!(Gamut::Scale.apply(rgb.into()).to_array(), scale);
    }

    #[test]
    fn each_way() {
        check([0.0, 0.5, 1.0], [0.0, 0.5, 1.0], [0.0, 0.5, 1.0]);
        check([1.25, 0.5, -0.25], [1.0, 0.5, 0.0], [1.0, 0.4, 0.0]);
        check([0.5, -0.1, 0.2], [0.5, 0.0, 0.2], [0.5, 0.0, 0.2]);
        check([2.0, 4.0, 1.0], [1.0, 1.0, 1.0], [0.5, 1.0, 0.25]);
        check([-1.0, -2.0, -3.0], [0.0; 3], [0.0; 3]);
        for gamut in Gamut::ALL {
            assert!(gamut.apply(DVec3::NAN).is_nan());
        }
    }
}
