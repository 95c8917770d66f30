//! Three channels of index: n and k for red, green and blue, at the three wavelengths of the thesis.

use super::file::{Material, Sample};

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
    pub fn channels(&self, wavelengths_nm: [f64; 3]) -> Result<Channels, String> {
        let mut channels = Channels {
            n: [0.0; 3],
            k: [0.0; 3],
        };
        for (i, nm) in wavelengths_nm.into_iter().enumerate() {
            let sample = self.at(nm).ok_or_else(|| {
                let (first, last) = (self.samples[0].nm, self.samples[self.samples.len() - 1].nm);
                format!(
                    "material `{}` is measured from {first} to {last} nm, and {nm} nm is wanted",
                    self.name
                )
            })?;
            channels.n[i] = sample.n;
            channels.k[i] = sample.k;
        }
        Ok(channels)
    }

    /// The index at a wavelength, linear between the measured points.
    fn at(&self, nm: f64) -> Option<Sample> {
        let after = self.samples.iter().position(|sample| sample.nm >= nm)?;
        let high = self.samples[after];
        if high.nm == nm {
            return Some(high);
        }
        let low = self.samples[after.checked_sub(1)?];
        let share = (nm - low.nm) / (high.nm - low.nm);
        let between = |a: f64, b: f64| a + (b - a) * share;
        Some(Sample {
            nm,
            n: between(low.n, high.n),
            k: between(low.k, high.k),
        })
    }
}

impl Channels {
    /// The index seen from a transparent medium.
    pub fn relative_to(&self, medium: &Channels) -> Channels {
        let divide = |a: [f64; 3]| [0, 1, 2].map(|i| a[i] / medium.n[i]);
        Channels {
            n: divide(self.n),
            k: divide(self.k),
        }
    }

    /// Whether nothing is absorbed.
    pub fn is_transparent(&self) -> bool {
        self.k == [0.0; 3]
    }
}
