//! `time` behind the command line: what is measured, the process that draws it, the report.

mod artist;
mod asked;
mod report;
mod serve;

pub use artist::Artist;
pub use asked::{Asked, Words};
pub use report::{Report, Row, text};
pub use serve::{Answer, serve};
