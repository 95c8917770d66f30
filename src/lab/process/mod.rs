//! Processes of this program that answer line by line, and what the processes of a run share.
//!
//! The protocol is one for all: a request and its response are a line of JSON each, and before the request stand the
//! milliseconds that the response may take. `Worker` asks, `Inbox` answers, `Pool` shares jobs out among workers.
//! What requests and responses are, each room says in types of its own.

mod error;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod inbox;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod pool;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod surroundings;
mod tools;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod worker;

pub use error::Error;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use inbox::Inbox;
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use pool::{Pool, Task};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use surroundings::Surroundings;
pub use tools::{TEMPORARY, beside};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use worker::{Launch, Silence, Worker};
