//! The choices that make a colour of a spectrum.

use super::adaptation::Adaptation;
use super::illuminant::Illuminant;
use super::observer::Observer;
use super::space::Space;
use super::wavelength::{FIRST_NM, LAST_NM, Step};

/// Who looks, under which light, in which space. The default is CIE 1931, D65, sRGB, division by the mirror, 5 nm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Integration {
    /// Whose eye.
    pub observer: Observer,
    /// The light.
    pub illuminant: Illuminant,
    /// The space of the result.
    pub space: Space,
    /// How a mirror becomes (1, 1, 1).
    pub adaptation: Adaptation,
    /// The distance of the wavelengths.
    pub step: Step,
}

impl Integration {
    /// One line for headers and reports.
    pub fn description(&self) -> String {
        let adapted = match self.adaptation {
            Adaptation::Scale => "",
            Adaptation::Bradford => "adapted by Bradford, ",
        };
        format!(
            "{FIRST_NM}-{LAST_NM} nm in steps of {} nm, {}, {}, {adapted}{}, mirror = 1",
            self.step.nm(),
            self.observer.title(),
            self.illuminant.name(),
            self.space.title(),
        )
    }

    /// What is to be said of the adaptation beside colours in this space.
    pub fn adaptation_remark(&self) -> Option<&'static str> {
        let is_other = self.space == Space::AcesCg && self.adaptation != Adaptation::Bradford;
        is_other.then_some(ACES_ADAPTS)
    }
}

/// Which adaptation ACES pipelines use, where it is another.
const ACES_ADAPTS: &str = "a mirror is made white by dividing each channel; ACES pipelines adapt by Bradford: --adaptation bradford";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line_says_all() {
        let default = Integration::default();
        assert_eq!(
            default.description(),
            "380-780 nm in steps of 5 nm, CIE 1931 2 degree observer, D65, linear sRGB, mirror = 1"
        );
        let other = Integration {
            illuminant: Illuminant::A,
            adaptation: Adaptation::Bradford,
            step: Step::Nm1,
            ..default
        };
        assert_eq!(other.adaptation_remark(), None);
        assert_eq!(
            other.description(),
            "380-780 nm in steps of 1 nm, CIE 1931 2 degree observer, A, adapted by Bradford, linear sRGB, mirror = 1"
        );
        let aces = |adaptation| Integration {
            space: Space::AcesCg,
            adaptation,
            ..Integration::default()
        };
        assert!(aces(Adaptation::Scale).adaptation_remark().is_some());
        assert_eq!(aces(Adaptation::Bradford).adaptation_remark(), None);
    }
}
