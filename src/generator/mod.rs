//! From a request to files.
//!
//! It fits coefficients to materials, folds constants into graphs, prints them into pages, and bakes tables, adapters and
//! parameters for engines. [`generate()`] is pure: it returns files in memory, which [`output`] compares with a folder or writes
//! there. A build script uses only this much, so nothing here needs a graphics stack or a command line. It imports physics and
//! language. Start with [`generate()`] and follow a request through it.

// Rooms: envelope, command_line, reference < fit < emit < exchange, lut < bake, flavours < error < output < request < generate

pub mod bake;
pub mod command_line;
pub mod emit;
pub mod envelope;
pub mod error;
pub mod exchange;
pub mod fit;
pub mod flavours;
pub mod generate;
pub mod lut;
pub mod output;
pub mod reference;
pub mod request;

pub use error::Error;
pub use generate::{Generated, generate};
