//! What is measured of functions: on graphics stacks, by compilers, by overdraw, where they fail, what they cost.

#[cfg(all(feature = "cli", feature = "gpu"))]
pub mod audit;
pub mod budget;
pub mod chart;
pub mod cost;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod overdraw;
pub mod process;
pub mod raster;
pub mod reproduce;
pub mod stability;
pub mod verify;
