//! What is measured of functions: their errors on graphics stacks, their cost, their time, and where they fail.
//!
//! Whatever may hang or crash runs in a process of its own ([`process`]), and what a machine lacks is reported as not checked.
//! Errors of code ([`verify`]) and errors of models (`fit`, in the generator) are different types and are never added.
//! It imports physics, language and generator, and is left out without the feature `lab`.
//! Start with [`verify`], which runs what was generated, or with [`cost`].

// Rooms: fault < gpu, process, raster < verify, cost < overdraw, stability < audit, budget, reproduce < chart

pub mod audit;
pub mod budget;
pub mod chart;
pub mod cost;
pub mod fault;
pub mod gpu;
pub mod overdraw;
pub mod process;
pub mod raster;
pub mod reproduce;
pub mod stability;
pub mod verify;
