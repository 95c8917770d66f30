//! `materials import`: a page or table becomes a material file.

use crate::app::args::ImportFlags;
use crate::app::error::Error;
use crate::app::source::read;
use crate::app::write::write_file;
use crate::materials::{Material, page};

use super::Output;
use super::materials::class;

/// What is kept of a table, in nanometres: what CIE's observers see.
const SEEN_NM: (f64, f64) = (360.0, 830.0);

/// `fresnel-gen materials import PAGE`.
pub fn run(flags: &ImportFlags) -> Result<Output, Error> {
    let text = read(&flags.page)?;
    let found = page(&flags.page, &text).ok_or_else(|| Error::Usage {
        what: format!("`{}` ends in neither .yml nor .csv: a page of refractiveindex.info or a table is wanted", flags.page),
    })??;
    let own = found.material(flags.name.as_deref())?;
    let material = told(flags, own)?.trimmed(SEEN_NM.0, SEEN_NM.1);
    let toml = material.to_toml();
    // What the page holds may be more than a material file allows: an index of 0, say.
    Material::parse(&format!("the material file of {}", flags.page), &toml)?;
    let mut output = Output::default();
    if !material.note.is_empty() {
        output
            .remarks
            .push(format!("{}: {}", material.name, material.note));
    }
    match &flags.output {
        None => output.stdout = toml.into_bytes(),
        Some(file) => drop(write_file(file, toml.as_bytes())?),
    }
    Ok(output)
}

/// With what the user knows better.
fn told(flags: &ImportFlags, own: Material) -> Result<Material, Error> {
    let or = |said: &Option<String>, own: String| said.clone().unwrap_or(own);
    Ok(Material {
        kind: flags
            .class
            .as_deref()
            .map(class)
            .transpose()?
            .unwrap_or(own.kind),
        substance: or(&flags.substance, own.substance),
        summary: or(&flags.summary, own.summary),
        reference: or(&flags.reference, own.reference),
        link: or(&flags.link, own.link),
        licence: or(&flags.licence, own.licence),
        note: or(&flags.note, own.note),
        ..own
    })
}
