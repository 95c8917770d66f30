//! What functions are written in, and the functions themselves.
//!
//! A method of Fresnel reflectance, or an effect, is written once with operators and builds a graph ([`ir`]).
//! What a graph means is its evaluation; a target says how it is spelled in a language.
//! It imports physics.
//! Start with `methods/formulas/schlick.rs`, which is a method whole, and then read the header of [`ir`].

// Rooms: ir < methods, targets < effects

pub mod effects;
pub mod ir;
pub mod methods;
pub mod targets;
