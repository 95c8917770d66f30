//! Emission: method × target × material → the bytes of files. Nothing here touches the disk.
//!
//! One printer ([`print`]) prints the graph with the spelling of the target, a Tera template puts the page around it, and naga
//! generates SPIR-V from WGSL. Library files hold functions only.

mod artifact;
mod average;
mod batch;
mod catalogue;
mod comment;
mod detail;
mod effect_file;
mod figures;
mod file;
mod function;
mod header;
mod page;
mod print;
pub mod shader_words;
mod short;
mod xml;

pub use artifact::Artifact;
pub use average::{Average, companions};
pub use batch::{batch_entry, batch_program, places};
pub use catalogue::{
    BufferDetail, CATALOGUE, CATALOGUE_BUFFER, COEFFICIENT_ORDER, COEFFICIENTS, CatalogueMaterial,
    CatalogueMethod, CatalogueRow, CloserFit, FOURTH, catalogue_array, catalogue_buffer,
    catalogue_record, catalogue_rows, first_dielectric, recorded_catalogue,
};
pub use comment::lines as comment_lines;
pub use detail::{
    AdapterDetail, CatalogueDetail, Detail, FunctionDetail, FunctionsDetail, TableDetail,
    ViewingDetail,
};
pub use effect_file::{
    EFFECTS, EffectPart, EffectRequest, effect_file, effect_function_text, effect_text,
};
pub use figures::{
    Bounds, CodeBound, HalfBound, Missed, PLAIN_ULP, fingerprint, fitted_error, half_bounds,
    half_promise, missed, promises,
};
pub use file::{
    Error, File, PlaceInFile, library, lookup, material, single, uniform_offsets, written_for,
};
pub use function::{
    EmittedFunction, FunctionForm, Naming, Specialised, library_functions, specialised_function,
    specialised_graph,
};
pub use header::{HeaderForm, Heading, MARK, OUTPUT_LICENCE};
pub use page::{
    bare_text, spirv_with_storage as wgsl_to_spirv, text_of_template, validate as validate_wgsl,
};
pub use print::bare;
pub use xml::{XmlDocument, xml_comment, xml_text};

/// The version of naga that generates SPIR-V, pinned in Cargo.toml: another version gives other bytes.
pub const NAGA_VERSION: &str = "30.0.1";
