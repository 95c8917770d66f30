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
    /// What the host as it ships makes of a material in air: its formula with the numbers that a user would give it. None: the
    /// flavour is a package for several hosts.
    pub stock: Option<fn(&EngineMaterial) -> Model>,
    /// What the host as it ships makes of a metal's F0 below its clear coat of index 1.5; none where that is not known.
    pub coated_f0: Option<fn(f64) -> f64>,
    /// The targets whose text it contains.
    pub languages: &'static [&'static str],
    /// The split-sum tables that it contains, if any: texels per side, axes of cosine and roughness.
    pub table: Option<(usize, [SplitSumAxis; 2])>,
    /// The flavours whose modules it holds, each under that flavour's name.
    pub parts: &'static [&'static Flavour],
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

/// The module of materials that an engine in a browser reads, beside its own: constants, checks, and how a table is read.
pub(super) const MATERIALS_MODULE: FlavourPage = FlavourPage {
    name: "materials.js",
    template: include_str!("../../../templates/flavours/materials.js.tera"),
};

/// Its types.
pub(super) const MATERIALS_TYPES: FlavourPage = FlavourPage {
    name: "materials.d.ts",
    template: include_str!("../../../templates/flavours/materials.d.ts.tera"),
};

/// How the name of an adapter's own modules begins. In a package it gives way to the name of the adapter.
const MODULE: &str = "fresnel";

impl Flavour {
    /// Whether the flavour has a file of this name in its folder, for this material if it has one.
    pub fn has(&self, name: &str, material: Option<&str>) -> bool {
        let mut of_materials = self.pages.iter().filter(|page| page.is_of_material());
        match material {
            Some(material) => of_materials.any(|page| page.file_of(material) == name),
            None => self.shared_pages().any(|(own, _, _)| own == name),
        }
    }

    /// The files that are not of one material: the name, the page, and the flavour whose host it is for. Those of its parts are among
    /// them.
    pub fn shared_pages(&self) -> impl Iterator<Item = (String, &FlavourPage, &Flavour)> {
        let own = self.pages.iter().filter(|page| !page.is_of_material());
        let own = own.map(move |page| (page.name.to_owned(), page, self));
        let parts = self.parts.iter().flat_map(|part| {
            let modules = part
                .pages
                .iter()
                .filter(|page| page.name.starts_with(MODULE));
            modules.map(move |page| (page.name.replacen(MODULE, part.name, 1), page, *part))
        });
        own.chain(parts)
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
