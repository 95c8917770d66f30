//! Reports: what people look at.

#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod audit;
pub mod cost;
mod envelope;
pub mod fits;
pub mod frontier;
pub mod headline;
#[cfg(feature = "cli")]
mod html;
pub mod markdown;
pub mod material_sheet;
pub mod plot;
#[cfg(feature = "pictures")]
pub mod png;
pub mod reproduce;
pub mod search;
pub mod stability;
pub mod survey;
pub mod table;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod time;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod verify;

pub use envelope::{Origin, Report, SCHEMA, TOOL};

/// A class of materials in words: `metals`, with semiconductors, or `dielectrics`.
pub fn class_title(class: &str) -> &'static str {
    match class {
        "metals" => "metals and semiconductors",
        _ => "dielectrics, n of 1.2 and more",
    }
}
