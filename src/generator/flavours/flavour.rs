//! The record of a flavour.

use crate::generator::emit;
use crate::generator::exchange::{EngineMaterial, Model};
use crate::generator::lut::{self, SplitSumAxis};

/// A target adapted to one host.
#[derive(Debug)]
#[non_exhaustive]
pub struct Flavour {
    /// Its name, used for its file, for `--flavour`, for its folder, and in the table of `docs/engines.md`.
    pub name: &'static str,
    /// A description in one line.
    pub summary: &'static str,
    /// The host, with the version in which the flavour was tested, or that its documentation describes.
    pub host: &'static str,
    /// The host's documentation of the interfaces that the adapter uses, with a link.
    pub source: &'static str,
    /// How it was tested, in words: run in the host, or compiled and not run. It appears in headers, its README and
    /// `docs/engines.md`.
    pub proof: &'static str,
    /// What the host as it ships makes of a material in air: its formula with the numbers that a user would give it.
    pub stock: fn(&EngineMaterial) -> Model,
    /// What the host as it ships makes of a metal's F0 below its clear coat of index 1.5; none where that is not known.
    pub coated_f0: Option<fn(f64) -> f64>,
    /// The targets whose text it contains.
    pub languages: &'static [&'static str],
    /// The split-sum tables that it contains, if any: texels per side, axes of cosine and roughness.
    pub table: Option<(usize, [SplitSumAxis; 2])>,
    /// Its files.
    pub pages: &'static [FlavourPage],
}

/// A file of a flavour.
#[derive(Debug)]
pub struct FlavourPage {
    /// Its name. If it contains `{material}`, there is one file for each material.
    pub name: &'static str,
    /// Its template, in Tera's language. Its data: `flavours/view.rs`.
    pub template: &'static str,
}

/// The placeholder of a material's name in the name of a file.
const MATERIAL: &str = "{material}";

impl FlavourPage {
    /// Whether there is one file for each material.
    pub fn is_of_material(&self) -> bool {
        self.name.contains(MATERIAL)
    }

    /// The name of the file of a material.
    pub fn file_of(&self, material: &str) -> String {
        self.name.replace(MATERIAL, material)
    }
}

impl Flavour {
    /// Whether the flavour has a file of this name in its folder, for this material if it has one.
    pub fn has(&self, name: &str, material: Option<&str>) -> bool {
        self.pages.iter().any(|page| match material {
            Some(material) => page.is_of_material() && page.file_of(material) == name,
            None => !page.is_of_material() && page.name == name,
        })
    }

    /// Whether it has files for each material. Then a run adds to them.
    pub fn is_by_material(&self) -> bool {
        self.pages.iter().any(FlavourPage::is_of_material)
    }
}

/// An error of writing a flavour.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A language refuses a text: a bug.
    #[error(transparent)]
    Emit(#[from] emit::Error),
    /// A table cannot be made: a bug.
    #[error(transparent)]
    Table(#[from] lut::Error),
}
