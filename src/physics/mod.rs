//! Physics of reflection: number types, the exact laws, spectra with their colours, and the catalogue of n and k.
//!
//! Generated code is tested against this wing. So it knows no shader, no graph, and no file format of ours except that of
//! materials. It imports nothing else of this crate.
//! Start with [`optics`], the laws on one page, and with [`materials::Surface`], a material under viewing conditions.

// Rooms: foreign < num, cite, names, records, digest < optics, user_text < spectra < materials

pub mod cite;
pub mod digest;
pub mod foreign;
pub mod materials;
pub mod names;
pub mod num;
pub mod optics;
pub mod records;
pub mod spectra;
pub mod user_text;
