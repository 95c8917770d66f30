//! What is measured of functions: on graphics stacks, by compilers, by overdraw, where they fail, what they cost.

// Rooms: gpu, process, raster < verify, cost < overdraw, stability < audit, budget, reproduce < chart

pub mod audit;
pub mod budget;
pub mod chart;
pub mod cost;
pub mod gpu;
pub mod overdraw;
pub mod process;
pub mod raster;
pub mod reproduce;
pub mod stability;
pub mod verify;
