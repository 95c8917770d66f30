//! A user's file of any kind that is known: our own, a page of refractiveindex.info, a table.

use super::{FileFault, Material, Page};

impl Material {
    /// Reads a file by what its name ends in: `.yml` and `.yaml` are pages of refractiveindex.info, `.csv`, `.tsv` and
    /// `.txt` are tables, all else is our own format.
    ///
    /// # Errors
    /// The text is not what the file's name says, or not a material.
    pub fn read(file: &str, text: &str) -> Result<Material, FileFault> {
        match page(file, text) {
            Some(page) => page?.material(None),
            None => Material::parse(file, text),
        }
    }
}

/// The page or table in a file, where its name says that it is one.
pub fn page(file: &str, text: &str) -> Option<Result<Page, FileFault>> {
    let ending = file.rsplit('.').next().unwrap_or("").to_lowercase();
    match ending.as_str() {
        "yml" | "yaml" => Some(Page::parse(file, text)),
        "csv" | "tsv" | "txt" => Some(Page::parse_csv(file, text)),
        _ => None,
    }
}
