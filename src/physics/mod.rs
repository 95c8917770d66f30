//! What light does, and what is known of materials: numbers, the exact laws, spectra, colours, n and k.

// Rooms: foreign < num, cite, names, records, digest < optics < spectra < materials

pub mod cite;
pub mod digest;
pub mod foreign;
pub mod materials;
pub mod names;
pub mod num;
pub mod optics;
pub mod records;
pub mod spectra;
