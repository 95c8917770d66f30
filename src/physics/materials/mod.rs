//! Materials: named media with measured n(λ) and k(λ), their sources and licences.
//!
//! The catalogue lies in `data/materials/`, one file a material, and is embedded in the binary. A user's own file has the
//! same format ([`Material::parse`]). To add a material to the catalogue, add its file. Materials under films lie in `data/films/`.

mod catalogue;
mod comparison;
mod csv;
mod decimal;
mod file;
mod film;
mod formula;
mod material;
mod page;
mod print;
mod reflectance;
mod rows;
mod surface;

pub use crate::physics::foreign::{escaped, is_hidden};
pub use catalogue::{find, known, list, names, page, source, stacks};
pub use comparison::{
    ComparedMaterial, ComparedRow, ReflectanceDifference, comparable, compared_rows,
};
pub use file::name_fault;
pub use film::{Film, FilmFault, film_of_word, length_nm};
pub use formula::{DispersionCurve, Extrapolate, Formula};
pub use material::{ConstantIndex, Index, IndexFault, Material, MaterialKind};
pub use page::Page;
pub use reflectance::{ReflectanceRow, ReflectedColour, reflectance_rows, reflected_colours};
pub use surface::{
    AtWavelength, Attenuation, Channels, Surface, SurfaceError, THESIS_NM, ViewingConditions,
    surfaces_of,
};
