//! Flags that several commands have, and how their values are read.

pub mod choice;
pub mod groups;
pub mod material;
pub mod named;
pub mod output;
pub mod renamed;
pub mod viewing;
