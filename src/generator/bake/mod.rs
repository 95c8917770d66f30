//! Baking: materials become tables, and tables become files and rows of a report. It writes no files: its callers do.

mod error;
mod material_tables;
mod picture;
mod request;
mod row;
mod split_sum;
mod subject;

pub use error::{Error, split_sum_methods};
pub use material_tables::bake;
pub use request::{ATLAS, BakeRequest, TableSize, usual_request};
pub use row::{BakeRow, Baked};
pub use split_sum::{SplitSumRequest, bake_split_sum, usual_method};
pub use subject::{
    DEFAULT_AXIS, DEFAULT_FORMATS, TableMaterial, as_tables_are_seen, material_words, viewing_flags,
};
