//! Emission: method × target × material → the bytes of files. Nothing here touches the disk.
//!
//! One printer ([`print`]) prints the graph with the spelling of the target, a Tera template puts the page around it, and naga
//! generates SPIR-V from WGSL. Library files hold functions only.

mod artifact;
mod average;
mod batch;
mod catalogue;
mod code_bound;
mod comment;
mod effect_file;
mod error;
mod figures;
mod file;
mod function;
mod header;
mod page;
mod print;
mod specialised;
mod xml;

pub use artifact::{
    AdapterDetail, Artifact, CatalogueDetail, Detail, FunctionDetail, FunctionsDetail, TableDetail,
    ViewingDetail,
};
pub use average::Average;
pub use batch::{batch_entry, batch_program, places};
pub use catalogue::{
    BufferDetail, CATALOGUE, CATALOGUE_BUFFER, COAT, COEFFICIENT_ORDER, COEFFICIENTS,
    CatalogueMaterial, CatalogueMethod, CatalogueRow, FOURTH, HALF_BUFFER, RowOrder, adapter_rows,
    catalogue_array, catalogue_buffer, catalogue_rows, first_dielectric, fourths, half_buffer,
    recorded_catalogue, rows_in_order,
};
pub use code_bound::{Bounds, CodeBound, PLAIN_ULP, fingerprint};
pub use comment::lines as comment_lines;
pub use effect_file::{EFFECTS, EffectRequest, effect_file, effect_function_text, effect_text};
pub use error::Error;
pub use figures::{half_promise, promises};
pub use file::{library, lookup, material, single, without_directive, written_for};
pub use function::{
    EffectPart, EmittedFunction, FunctionForm, Naming, companions, library_functions,
    specialised_function,
};
pub use header::{HeaderForm, Heading, MARK, OUTPUT_LICENCE};
pub use page::{
    bare_text, render_template, spirv_with_storage as wgsl_to_spirv, uniform_offsets,
    validate as validate_wgsl,
};
pub use print::bare;
pub use specialised::{Missed, fitted_error, missed, of_cosine, specialised_graph};
pub use xml::{XmlDocument, xml_comment, xml_text};

/// The version of naga that generates SPIR-V, pinned in Cargo.toml: another version gives other bytes.
pub const NAGA_VERSION: &str = "30.0.1";
