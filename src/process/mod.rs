//! Processes of this program that answer line by line, and what the processes of a run share.

mod inbox;
mod surroundings;
mod worker;

pub use inbox::Inbox;
pub use surroundings::Surroundings;
pub use worker::{Silence, Worker, own_words};
