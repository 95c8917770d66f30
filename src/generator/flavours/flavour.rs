//! What a flavour is: a plain record in a static table.

use crate::generator::lut::SplitSumAxis;

/// A target dressed for one host.
#[derive(Debug)]
pub struct Flavour {
    /// Its one name: file, `--flavour`, folder, row of the table in `docs/engines.md`.
    pub name: &'static str,
    /// What it is, in one line.
    pub summary: &'static str,
    /// The host, with the version that it was tried in, or that its documentation is of.
    pub host: &'static str,
    /// The host's documentation of what the adapter uses, with a link.
    pub source: &'static str,
    /// What was seen of it, in words: run in the host, or compiled and not run. It stands in headers, its README and `docs/engines.md`.
    pub proof: &'static str,
    /// The targets whose text it holds.
    pub languages: &'static [&'static str],
    /// The split-sum tables that it holds, where it does: texels of a side, axes of cosine and roughness.
    pub table: Option<(usize, [SplitSumAxis; 2])>,
    /// Its files.
    pub pages: &'static [FlavourPage],
}

/// A file of a flavour.
#[derive(Debug)]
pub struct FlavourPage {
    /// Its name; with `{material}` there is one for each material.
    pub name: &'static str,
    /// Its template, in Tera's language. What it sees: `flavours/view.rs`.
    pub template: &'static str,
}

/// What stands for the name of a material in the name of a file.
const MATERIAL: &str = "{material}";

impl FlavourPage {
    /// Whether there is one for each material.
    pub fn is_of_material(&self) -> bool {
        self.name.contains(MATERIAL)
    }

    /// The name of the file of a material.
    pub fn file_of(&self, material: &str) -> String {
        self.name.replace(MATERIAL, material)
    }
}

impl Flavour {
    /// Whether a file of this name, in the flavour's folder, is one of its files, of this material where it has one.
    pub fn has(&self, name: &str, material: Option<&str>) -> bool {
        self.pages.iter().any(|page| match material {
            Some(material) => page.is_of_material() && page.file_of(material) == name,
            None => !page.is_of_material() && page.name == name,
        })
    }

    /// Whether it has files for each material, so that a run adds to them.
    pub fn is_by_material(&self) -> bool {
        self.pages.iter().any(FlavourPage::is_of_material)
    }
}
