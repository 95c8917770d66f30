//! The catalogue of fitted coefficients, of every material that is known over the whole spectrum.

mod array;
mod coated;
mod json;
mod row;

pub use array::{
    BufferDetail, CATALOGUE_BUFFER, FOURTH, HALF_BUFFER, RowOrder, catalogue_array,
    catalogue_buffer, fourths, half_buffer,
};
pub use coated::COAT;
pub use json::{COEFFICIENT_ORDER, CatalogueMaterial, CatalogueMethod};
pub use row::{
    CATALOGUE, COEFFICIENTS, CatalogueRow, adapter_rows, catalogue_rows, first_dielectric,
    recorded_catalogue, rows_in_order,
};
