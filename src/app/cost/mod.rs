//! Static cost: functions handed to the compilers of GPUs, each in a process of its own, or taken from the record.

mod asked;
mod function;
mod row;
#[cfg(feature = "gpu")]
mod serve;
mod session;

pub use asked::{Limits, Told, ask};
pub use function::{Function, functions};
pub use row::rows;
#[cfg(feature = "gpu")]
pub use serve::serve;
pub use session::{Said, environment, reason};
