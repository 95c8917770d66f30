//! The wavelengths that a spectrum is summed over: 380 to 780 nm with both ends.
//!
//! The eye sees little beyond them. Summing 400 to 700 nm instead changes the colour of no measured metal by more than 9e-4,
//! and 380 to 780 nm holds all but 5 parts in a million of the sum of ȳ.

/// The first wavelength of a sum, in nm.
pub const FIRST_NM: f64 = 380.0;

/// The last wavelength of a sum, in nm.
pub const LAST_NM: f64 = 780.0;

/// The range of the observers in nm, which is that of the CIE's tables.
pub const OBSERVED_NM: (f64, f64) = (360.0, 830.0);

/// The distance between the wavelengths of a sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Step {
    /// 81 wavelengths. Colours of metals differ from those of 1 nm by at most 2e-4.
    #[default]
    Nm5,
    /// 401 wavelengths.
    Nm1,
}

impl Step {
    /// All of them.
    pub const ALL: [Step; 2] = [Step::Nm5, Step::Nm1];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Step::Nm5 => "5nm",
            Step::Nm1 => "1nm",
        }
    }

    /// Its width in nm.
    pub fn nm(self) -> u16 {
        match self {
            Step::Nm5 => 5,
            Step::Nm1 => 1,
        }
    }

    /// The wavelengths from [`FIRST_NM`] to [`LAST_NM`], in nm, ascending.
    pub fn wavelengths(self) -> Vec<f64> {
        (0..)
            .map(|index: u16| FIRST_NM + f64::from(index * self.nm()))
            .take_while(|nm| *nm <= LAST_NM)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_are_in() {
        for (step, count) in [(Step::Nm5, 81), (Step::Nm1, 401)] {
            let wavelengths = step.wavelengths();
            assert_eq!(wavelengths.len(), count);
            assert_eq!(wavelengths[0], FIRST_NM);
            assert_eq!(wavelengths[count - 1], LAST_NM);
        }
    }
}
