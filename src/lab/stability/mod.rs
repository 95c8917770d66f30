//! Stability: where a method fails, found by a scan of its domain and beyond, and reported as inequalities.
//!
//! Two errors are distinguished and never added: rounding (a result against the same formula in f64) and the formula itself
//! (against the law). Points are media, where the method can be compared with a law, and its arguments themselves, beyond the
//! values of any medium.

mod failure;
mod map;
mod region;
mod scan;
mod space;
mod study;

pub use failure::Failure;
pub use map::{Cell, Map, film_map, maps};
pub use region::short;
pub use scan::{Finding, scan};
pub use space::ScanAxis;
pub use study::{StabilityRow, Study};
