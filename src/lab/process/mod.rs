//! Worker processes of this program, which answer requests line by line, and what the processes of a run share.
//!
//! All use one protocol. A request and its response are a line of JSON each, and the request is preceded by the milliseconds that
//! the response may take. `Worker` asks, `Inbox` answers, and `Pool` distributes jobs among workers. Each room has its own types
//! of requests and responses.

mod surroundings;
mod worker;

pub use surroundings::{Error, Surroundings, TEMPORARY, beside};
pub use worker::{Inbox, Launch, NoAnswer, Pool, Task, Worker};
