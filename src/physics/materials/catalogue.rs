//! The catalogue: the files of `data/materials/`, embedded in the program and read when asked for.

use include_dir::{Dir, include_dir};

use super::material::Material;
use crate::physics::spectra::FileFault;

static FILES: Dir = include_dir!("$CARGO_MANIFEST_DIR/data/materials");

/// The names of all materials in the catalogue, sorted.
///
/// ```
/// assert!(fresnel_gen::physics::materials::names().contains(&"gold"));
/// ```
pub fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = FILES
        .files()
        .filter_map(|file| file.path().file_stem()?.to_str())
        .collect();
    names.sort_unstable();
    names
}

/// The text of a material's file.
pub fn source(name: &str) -> Option<&'static str> {
    FILES.get_file(format!("{name}.toml"))?.contents_utf8()
}

/// The material of this name, if the catalogue has it.
///
/// ```
/// use fresnel_gen::physics::materials::{Extrapolate, find};
///
/// let water = find("water").expect("the catalogue has it").expect("its file is right");
/// assert_eq!(water.index(550.0, Extrapolate::Refuse).map(|index| index.n), Ok(1.333));
/// ```
pub fn find(name: &str) -> Option<Result<Material, FileFault>> {
    Some(Material::parse(
        &format!("data/materials/{name}.toml"),
        source(name)?,
    ))
}

/// All materials of the catalogue, by name.
///
/// # Errors
/// A file of the catalogue has a fault; a test holds that none has.
pub fn list() -> Result<Vec<Material>, FileFault> {
    names().into_iter().filter_map(find).collect()
}
