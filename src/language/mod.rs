//! What functions are written in: the graph, the methods, the effects, and the targets that print them.

// Rooms: ir < methods, targets < effects

pub mod effects;
pub mod ir;
pub mod methods;
pub mod targets;
