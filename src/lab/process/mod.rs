//! Processes of this program that answer line by line, and what the processes of a run share.
//!
//! The protocol is one for all: a request and its response are a line of JSON each, and before the request stand the
//! milliseconds that the response may take. `Worker` asks, `Inbox` answers, `Pool` shares jobs out among workers.
//! What requests and responses are, each room says in types of its own.

mod pool;
mod surroundings;
mod worker;

pub use pool::{Error, Pool, Task};
pub use surroundings::{Surroundings, TEMPORARY, beside};
pub use worker::{Inbox, Launch, Silence, Worker};
