//! A material in its medium, as a table holds it.

use crate::generator::reference::{ReferenceCurve, Typed};
use crate::language::methods::Light;
use crate::physics::materials::{Material, Surface, Unseen, ViewingConditions};
use crate::physics::spectra::Space;

/// A material in its medium, as it is seen.
#[derive(Clone, Debug)]
pub struct TableMaterial {
    /// The material's name, with `_in_` and the medium's where there is one.
    pub name: String,
    /// What a user types to get it again.
    pub argument: String,
    /// What a user types to get the medium again, where it is not air.
    pub medium: Option<String>,
    /// What is seen of it.
    pub reference: ReferenceCurve,
    /// The working space; none where a channel is one wavelength.
    pub space: Option<Space>,
}

impl TableMaterial {
    /// A material and a medium, each with what a user types to get it again.
    ///
    /// # Errors
    /// It is not known where it is looked at.
    pub fn new(
        (argument, material): (&str, &Material),
        medium: Option<&Typed>,
        viewing: &ViewingConditions,
    ) -> Result<TableMaterial, Unseen> {
        let surface = Surface::new(material, medium.map(|(_, medium)| medium), viewing)?;
        let name = &material.name;
        let is_spectral = surface.channels().is_none();
        Ok(TableMaterial {
            name: medium.map_or(name.clone(), |(_, medium)| {
                format!("{name}_in_{}", medium.name)
            }),
            argument: argument.to_owned(),
            medium: medium.map(|(argument, _)| argument.clone()),
            space: is_spectral.then_some(viewing.integration.space),
            reference: ReferenceCurve::new(surface, Light::Unpolarised),
        })
    }

    /// What is seen, in words.
    pub fn seen(&self) -> &str {
        &self.reference.surface.seen
    }
}
