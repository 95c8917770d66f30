//! Reports: views of typed rows, for people and for scripts. What computes the rows stands in other rooms.

#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod audit;
pub mod budget;
pub mod coated;
pub mod cost;
mod envelope;
pub mod fits;
pub mod frontier;
#[cfg(feature = "cli")]
pub mod gallery;
pub mod headline;
#[cfg(feature = "cli")]
mod html;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod junit;
pub mod markdown;
pub mod material_sheet;
pub mod params;
#[cfg(feature = "cli")]
mod pixels;
#[cfg(feature = "cli")]
pub mod plan;
pub mod plot;
#[cfg(feature = "pictures")]
pub mod png;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod render;
pub mod reproduce;
#[cfg(feature = "cli")]
pub mod scene_error;
pub mod search;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod shard;
pub mod stability;
pub mod survey;
pub mod table;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod time;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod verify;

pub use envelope::{Origin, Report, SCHEMA, TOOL};
