//! From a material to files: fits, functions, tables, adapters for engines, formats of tools.

// Rooms: envelope, command_line, reference < fit < emit < exchange, lut < bake, flavours, fault < error < output < request < generate

pub mod bake;
pub mod command_line;
pub mod emit;
pub mod envelope;
pub mod error;
pub mod exchange;
pub mod fault;
pub mod fit;
pub mod flavours;
pub mod generate;
pub mod lut;
pub mod output;
pub mod reference;
pub mod request;

// Rooms: envelope, command_line, reference < fit < emit < exchange, lut < bake, flavours, fault < error < output < request < generate

pub use error::Error;
pub use generate::{Generated, generate};
