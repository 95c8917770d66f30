//! Verification: what a request generates, run on every target and held against what it means.
//!
//! Shaders run in processes of their own, so that one that never ends, or that takes its driver down, is a row of the
//! report and no more. All processes make the same [`Plan`] from the same flags; a number names a file of it.

pub mod exhaustive;
pub mod file;
mod half;
mod junit;
mod listed;
pub mod machine;
mod plan;
mod row;
mod shipped;
mod supervise;
mod worker;

pub use file::Effort;
pub use junit::junit;
pub use plan::{Plan, Planned};
pub use row::WORST;
pub use shipped::Page;
pub use supervise::{Limits, supervise};
pub use worker::serve;
