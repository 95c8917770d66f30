//! What earlier runs put into an output folder by name, and a run of other names leaves there.

use std::path::{Path, PathBuf};

use crate::generator::error::Error;
use crate::generator::generate::Kept;
use crate::generator::output::folder;
use crate::generator::output::manifest::{self, Manifest};
use crate::physics::num::Precision;

/// The methods that the folder's material files of this precision hold, by its manifest.
///
/// # Errors
/// The manifest cannot be read, or is not ours.
pub fn kept(out_dir: &Path, precision: Precision) -> Result<Kept, Error> {
    let path: PathBuf = out_dir.join(manifest::FILE);
    let Some(text) = folder::read(&path)? else {
        return Ok(Kept::new());
    };
    let mut kept = Kept::new();
    let mut entries = Manifest::parse(&path, &text)?.files;
    entries.retain(|entry| entry.effect.is_none() && entry.precision() == precision.name());
    for entry in entries {
        let Some(material) = &entry.material else {
            continue;
        };
        kept.entry((entry.target.clone(), material.clone()))
            .or_default()
            .extend(entry.function_methods().map(str::to_owned));
    }
    Ok(kept)
}
