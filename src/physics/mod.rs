//! What light does at a surface, and what is known of materials.
//!
//! Here stand the numbers that formulas compute with, the exact laws, spectra with their colours, and the catalogue of n and k.
//! Nothing here knows a shader, a graph or a file of ours but those of materials: what is generated is judged by this wing.
//! It imports nothing else of this crate.
//! Start with [`optics`], the laws in a page, and with [`materials::Surface`], a material as light meets it.

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
