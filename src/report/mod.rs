//! Reports: what people look at.

pub mod card;
pub mod chart;
pub mod cost;
pub mod fits;
pub mod frontier;
pub mod headline;
#[cfg(feature = "cli")]
mod html;
pub mod markdown;
#[cfg(feature = "pictures")]
pub mod png;
pub mod reproduce;
pub mod search;
pub mod stability;
pub mod survey;
pub mod table;

/// The version of the form of JSON reports. It rises when a key changes its meaning or goes.
pub const SCHEMA: u32 = 1;

/// A class of materials in words: `metals`, with semiconductors, or `dielectrics`.
pub fn class_title(class: &str) -> &'static str {
    match class {
        "metals" => "metals and semiconductors",
        _ => "dielectrics, n of 1.2 and more",
    }
}
