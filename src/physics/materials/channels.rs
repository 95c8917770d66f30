//! Three channels of index: n and k for red, green and blue.

use super::dispersion::Extrapolate;
use super::material::{Index, Material};

/// Red, green and blue in nanometres, as the thesis chose them: the middles of the three bands.
pub const THESIS_NM: [f64; 3] = [685.0, 535.0, 475.0];

/// The relative index of refraction per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channels {
    /// Real part.
    pub n: [f64; 3],
    /// Extinction coefficient.
    pub k: [f64; 3],
}

impl Material {
    /// n and k at three wavelengths, linearly interpolated. Outside the measured range this fails and says so.
    ///
    /// # Errors
    /// A wavelength lies outside the measured range, or an index outside its limits.
    pub fn channels(&self, wavelengths_nm: [f64; 3]) -> Result<Channels, String> {
        let [red, green, blue] = wavelengths_nm.map(|nm| self.index(nm, Extrapolate::Refuse));
        Ok(Channels::of([red?, green?, blue?]))
    }
}

impl Channels {
    /// Of an index per channel.
    pub fn of(indices: [Index; 3]) -> Channels {
        Channels {
            n: indices.map(|index| index.n),
            k: indices.map(|index| index.k),
        }
    }

    /// Whether nothing is absorbed.
    pub fn is_transparent(&self) -> bool {
        self.k == [0.0; 3]
    }
}
