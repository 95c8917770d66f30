//! From a material to files: fits, functions, tables, adapters for engines, formats of tools.

#[cfg(feature = "cli")]
pub mod bake;
pub mod command_line;
pub mod emit;
pub mod exchange;
pub mod fit;
pub mod flavours;
pub mod lut;
pub mod reference;
