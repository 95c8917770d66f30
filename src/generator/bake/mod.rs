//! Baking: materials become tables, and tables become files and rows of a report. It writes no files: its callers do.

mod film_thickness;
mod material_tables;
mod picture;
mod request;
mod row;
mod split_sum;

pub use film_thickness::{FilmTableRequest, THICKNESS_ROWS, Thicknesses, bake_film_thickness};
pub use material_tables::bake;
pub use request::{
    ATLAS, BakeRequest, DEFAULT_AXIS, DEFAULT_FORMATS, Error, TableMaterial, TableSize,
    as_tables_are_seen, material_words, split_sum_methods, usual_request, viewing_flags,
};
pub use row::{BakeRow, Baked};
pub use split_sum::{SplitSumRequest, bake_split_sum, usual_method};
