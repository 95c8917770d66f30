//! The catalogue, and users' files.
//!
//! The catalogue's files are those of `data/materials/`, embedded in the program and parsed on demand, as are those of
//! `data/films/`, materials under films. A user's file may be of
//! our own format, a page of refractiveindex.info, or a table.

use include_dir::{Dir, include_dir};

use super::Page;
use super::material::Material;
use crate::physics::user_text::FileFault;

static FILES: Dir = include_dir!("$CARGO_MANIFEST_DIR/data/materials");
static STACKS: Dir = include_dir!("$CARGO_MANIFEST_DIR/data/films");

/// The names of all materials in the catalogue, sorted.
///
/// ```
/// assert!(fresnel_gen::physics::materials::names().contains(&"gold"));
/// ```
pub fn names() -> Vec<&'static str> {
    names_in(&FILES)
}

/// The names of materials under films that have a file, sorted. They are no part of the catalogue.
pub fn stacks() -> Vec<&'static str> {
    names_in(&STACKS)
}

/// The names of both, as a user may type them.
pub fn known() -> Vec<&'static str> {
    [names(), stacks()].concat()
}

fn names_in(folder: &'static Dir) -> Vec<&'static str> {
    let mut names: Vec<&str> = folder
        .files()
        .filter_map(|file| file.path().file_stem()?.to_str())
        .collect();
    names.sort_unstable();
    names
}

/// The text of the file of a material, or of a stack.
pub fn source(name: &str) -> Option<&'static str> {
    Some(file(name)?.1)
}

/// The path of the file of a material, or of a stack, and its text.
fn file(name: &str) -> Option<(String, &'static str)> {
    let file = format!("{name}.toml");
    let folders = [("data/materials", &FILES), ("data/films", &STACKS)];
    folders.into_iter().find_map(|(folder, files)| {
        let text = files.get_file(&file)?.contents_utf8()?;
        Some((format!("{folder}/{file}"), text))
    })
}

/// The material of this name, if the catalogue has it or it is a stack.
///
/// ```
/// use fresnel_gen::physics::materials::{Extrapolate, find};
///
/// let water = find("water").expect("the catalogue has it").expect("its file is right");
/// assert_eq!(water.index(550.0, Extrapolate::Refuse).map(|index| index.n), Ok(1.333));
/// ```
pub fn find(name: &str) -> Option<Result<Material, FileFault>> {
    let (path, text) = file(name)?;
    Some(Material::parse(&path, text))
}

/// All materials of the catalogue, by name.
///
/// # Errors
/// A file of the catalogue has a fault; a test holds that none has.
pub fn list() -> Result<Vec<Material>, FileFault> {
    names().into_iter().filter_map(find).collect()
}

impl Material {
    /// Reads a file by its extension: `.yml` and `.yaml` are pages of refractiveindex.info, `.csv`, `.tsv` and
    /// `.txt` are tables, all others are our own format.
    ///
    /// # Errors
    /// The text is not of the format that the extension says, or not a material.
    pub fn read(file: &str, text: &str) -> Result<Material, FileFault> {
        match page(file, text) {
            Some(page) => page?.material(None),
            None => Material::parse(file, text),
        }
    }
}

/// The page or table in a file, if its extension says that it is one.
pub fn page(file: &str, text: &str) -> Option<Result<Page, FileFault>> {
    let ending = file.rsplit('.').next().unwrap_or("").to_lowercase();
    match ending.as_str() {
        "yml" | "yaml" => Some(Page::parse(file, text)),
        "csv" | "tsv" | "txt" => Some(Page::parse_csv(file, text)),
        _ => None,
    }
}
