//! Processes of this program that answer line by line, and what the processes of a run share.

mod error;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod inbox;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod surroundings;
mod tools;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod worker;

pub use error::Error;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use inbox::Inbox;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use surroundings::Surroundings;
pub use tools::{TEMPORARY, beside};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use worker::{Silence, Worker, own_words};
