//! A source read: a material of the catalogue, of a text at hand, or a medium that is a number.

use std::path::Path;

use crate::generator::command_line::path_again;
use crate::physics::materials::{self, ConstantIndex, Material};

use crate::generator::error::{Error, unknown};
use crate::generator::fault::RequestFault;
use crate::generator::request::Source;

/// A source read: the material, and what it was read from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The record.
    pub material: Material,
    /// What a user types to name it again.
    pub argument: String,
    /// Its file's text.
    pub text: String,
}

/// Reads a material from the catalogue, or from a text at hand.
///
/// # Errors
/// The catalogue has no material of this name, the number lies outside its limits, or the text is not a material.
pub fn load(source: &Source) -> Result<Loaded, Error> {
    match source {
        Source::Named(word) if ConstantIndex::parse(word).is_some() => constant(word),
        Source::Named(name) | Source::BroughtAlong(name) => {
            let found = materials::find(name).zip(materials::source(name));
            let (material, text) =
                found.ok_or_else(|| unknown("material", name, &materials::names()))?;
            Ok(Loaded {
                material: material?,
                argument: name.clone(),
                text: text.to_owned(),
            })
        }
        Source::File { file, text } => {
            let material = Material::read(file, text)?;
            Ok(Loaded {
                argument: argument(file, &material.page),
                material,
                text: text.clone(),
            })
        }
    }
}

/// A medium that is a number.
fn constant(word: &str) -> Result<Loaded, Error> {
    let index = ConstantIndex::parse(word).expect("it was found to be a number");
    let index = index.map_err(|fault| RequestFault::conflict(fault.to_string()))?;
    Ok(Loaded {
        material: index.material(),
        argument: index.to_string(),
        text: index.to_string(),
    })
}

/// What a user types to name a file again. A page at an absolute path is named by its place in the database that it lies in, since its
/// name is made of that.
fn argument(file: &str, page: &str) -> String {
    let is_absolute = Path::new(file).is_absolute();
    if is_absolute && !page.is_empty() && file.replace('\\', "/").ends_with(page) {
        page.to_owned()
    } else {
        path_again(file)
    }
}
