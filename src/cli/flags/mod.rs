//! Flags that several commands share, and the parsers of their values.

pub mod choice;
pub mod groups;
pub mod material;
pub mod named;
pub mod output;
pub mod renamed;
pub mod viewing;
