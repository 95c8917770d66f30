//! The materials of a run, each in its medium, as they are seen.

use std::collections::BTreeMap;

use crate::app::error::Error;
use crate::app::request::{DEFAULT_MATERIALS, Loaded, Materials, Source, check_transparent, load};
use crate::materials::{Sight, Surface};
use crate::methods::Light;
use crate::reference::Truth;
use crate::spectra::Space;

/// What is wanted of which materials.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The choice of materials.
    pub materials: Materials,
    /// What the light comes from; air where there is none.
    pub medium: Option<Source>,
    /// How they are seen.
    pub sight: Sight,
}

/// A material in its medium, seen.
#[derive(Clone, Debug)]
pub struct Lit {
    /// The material's name, with `_in_` and the medium's where there is one.
    pub name: String,
    /// What a user types to get it again.
    pub argument: String,
    /// What a user types to get the medium again, where it is not air.
    pub medium: Option<String>,
    /// What is seen of it.
    pub truth: Truth,
    /// The working space; none where a channel is one wavelength.
    pub space: Option<Space>,
}

impl Lit {
    /// What is seen, in words.
    pub fn seen(&self) -> &str {
        &self.truth.surface.seen
    }
}

/// The materials, sorted by name, each once; and why some that `all` brings along are left out.
///
/// # Errors
/// A file or name that is none, a material that is not known where it is looked at, two of one name.
pub fn lit(wanted: &Wanted) -> Result<(Vec<Lit>, Vec<String>), Error> {
    let medium = wanted.medium.as_ref().map(load).transpose()?;
    if let Some(medium) = &medium {
        check_transparent(&medium.material)?;
    }
    let mut ready: BTreeMap<String, (Lit, String)> = BTreeMap::new();
    let mut left_out = Vec::new();
    for source in &sources(&wanted.materials) {
        let loaded = load(source)?;
        match (one(&loaded, medium.as_ref(), &wanted.sight), source) {
            (Err(Error::Unseen(fault)), Source::BroughtAlong(_)) => left_out.push(fault.why),
            (Err(error), _) => return Err(error),
            (Ok(lit), _) => {
                let name = lit.name.clone();
                let text = loaded.text;
                match ready.get(&name) {
                    Some((_, other)) if *other != text => return Err(twice(&name)),
                    _ => drop(ready.insert(name, (lit, text))),
                }
            }
        }
    }
    if let (true, Some(why)) = (ready.is_empty(), left_out.first()) {
        return Err(Error::Usage { what: why.clone() });
    }
    Ok((ready.into_values().map(|(lit, _)| lit).collect(), left_out))
}

fn twice(name: &str) -> Error {
    Error::Usage {
        what: format!("two different materials are named `{name}`; rename one in its file"),
    }
}

fn sources(materials: &Materials) -> Vec<Source> {
    match materials {
        Materials::Default => DEFAULT_MATERIALS
            .map(|name| Source::Named(name.to_owned()))
            .to_vec(),
        Materials::None => Vec::new(),
        Materials::All => Source::catalogue().collect(),
        Materials::These(sources) => sources.clone(),
    }
}

fn one(loaded: &Loaded, medium: Option<&Loaded>, sight: &Sight) -> Result<Lit, Error> {
    let around = medium.map(|medium| &medium.material);
    let surface = Surface::new(&loaded.material, around, sight)?;
    let name = &loaded.material.name;
    Ok(Lit {
        name: around.map_or(name.clone(), |medium| format!("{name}_in_{}", medium.name)),
        argument: loaded.argument.clone(),
        medium: medium.map(|medium| medium.argument.clone()),
        space: surface
            .channels()
            .is_none()
            .then_some(sight.integration.space),
        truth: Truth::new(surface, Light::Unpolarised),
    })
}
