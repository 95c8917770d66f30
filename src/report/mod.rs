//! Reports: what people look at.

pub mod chart;
pub mod table;
