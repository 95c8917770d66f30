//! What light does, and what is known of materials: numbers, the exact laws, spectra, colours, n and k.

pub mod cite;
pub mod digest;
pub mod foreign;
pub mod materials;
pub mod names;
pub mod num;
pub mod optics;
pub mod records;
pub mod spectra;
