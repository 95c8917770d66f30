//! Spectra: from reflectance at every wavelength to one colour, and differences between colours.
//!
//! The steps to a colour: [`Step`] gives the wavelengths. [`Observer`] and [`Illuminant`] give the weight of each in X, Y and
//! Z. [`Space`] turns XYZ into linear red, green and blue. [`Adaptation`] makes a mirror white. [`Integrator`] is all of this
//! as one table of weights. [`Gamut`] handles colours outside [0, 1]. [`ciede2000`] is a perceptual difference, and
//! [`colour_error`] is what is lost by taking reflectance as three numbers at all.
//!
//! Wavelengths are in nanometres. Colours are linear, in [`glam::DVec3`] as (X, Y, Z) or (red, green, blue). The tables lie
//! in `data/spectra/` and are embedded in the program.

mod difference;
mod illuminant;
mod integrator;
mod observer;
mod space;
mod spectrum;
mod table;

pub use difference::{Lab, ciede2000, colour_error, xyz_to_lab};
pub use illuminant::Illuminant;
pub use integrator::{Integration, Integrator, NoWhite, weighted_sum, xyz_weights};
pub use observer::Observer;
pub use space::{Adaptation, Gamut, Space, bradford, rgb_to_xyz, srgb_byte, srgb_linear, xyz_of};
pub use spectrum::{FIRST_NM, LAST_NM, OBSERVED_NM, Spectrum, Step};
pub use table::is_separator;
