//! A material in its medium, as a table holds it.
//!
//! What is baked unless asked otherwise.

use super::row::{material_words, viewing_flags};
use super::{BakeRequest, TableSize};
use crate::generator::emit::Naming;
use crate::generator::lut::{Format, TableAxis};
use crate::generator::reference::{ReferenceCurve, Typed};
use crate::language::methods::{Light, TEXELS};
use crate::physics::materials::{Material, Surface, Unseen, ViewingConditions};
use crate::physics::spectra::{Gamut, Space};

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

/// The axis: the one with the smallest errors at equal size.
pub const DEFAULT_AXIS: TableAxis = TableAxis::Rational;
/// The files: what most programs read, what engines without float textures read, and what GPUs take.
pub const DEFAULT_FORMATS: [Format; 3] = [Format::ExrHalf, Format::Png16, Format::Ktx2];

/// The viewing conditions: a table keeps colours outside the working space, unless another policy was asked for.
pub fn as_tables_are_seen(viewing: &ViewingConditions, gamut_was_said: bool) -> ViewingConditions {
    let mut viewing = viewing.clone();
    // Where a channel is one wavelength there is no space to be outside of.
    if !gamut_was_said && viewing.wavelengths_nm.is_none() {
        viewing.gamut = Gamut::Keep;
    }
    viewing
}

/// The tables of these materials, and an atlas, as a run without flags writes them.
pub fn usual_request(subjects: Vec<TableMaterial>, viewing: &ViewingConditions) -> BakeRequest {
    BakeRequest {
        typed: material_words(&subjects),
        flags: viewing_flags(&subjects, viewing),
        subjects,
        formats: DEFAULT_FORMATS.to_vec(),
        shape: TableSize::Fixed {
            axis: DEFAULT_AXIS,
            texels: TEXELS,
        },
        atlas: true,
        targets: Vec::new(),
        prefix: Naming::default().prefix,
    }
}
