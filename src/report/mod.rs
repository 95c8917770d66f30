//! Reports: what people look at.

pub mod chart;
pub mod markdown;
pub mod reproduce;
pub mod survey;
pub mod table;
