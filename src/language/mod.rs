//! The language of graphs ([`ir`]), the functions written in it, and the targets that print them.
//!
//! A method of Fresnel reflectance, or an effect, is written once with operators, which build a graph.
//! Evaluation defines what a graph means. A target defines how it is spelled in a shading language.
//! This wing imports physics only.
//! Start with `methods/formulas/schlick.rs`, a complete method, and then read the header of [`ir`].

// Rooms: ir < methods < targets < effects

pub mod effects;
pub mod ir;
pub mod methods;
pub mod targets;
