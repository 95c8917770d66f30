//! A material in its medium for a table, and the defaults of baking.

use crate::generator::command_line::CommandLine;
use crate::generator::lut::{Format, TableAxis};
use crate::generator::reference::{ReferenceCurve, Typed};
use crate::language::methods::Light;
use crate::physics::materials::{Material, Surface, SurfaceError, ViewingConditions};
use crate::physics::spectra::{Gamut, Space};

/// A material in its medium under viewing conditions.
#[derive(Clone, Debug)]
pub struct TableMaterial {
    /// The material's name, followed by `_in_` and the medium's name if there is one.
    pub name: String,
    /// The argument that names it again on the command line.
    pub argument: String,
    /// The argument that names the medium again; none for air.
    pub medium: Option<String>,
    /// Its reference reflectance.
    pub reference: ReferenceCurve,
    /// The working space; none where a channel is one wavelength.
    pub space: Option<Space>,
}

impl TableMaterial {
    /// A material and a medium, each with the argument that names it again.
    ///
    /// # Errors
    /// It is not known at the wavelengths needed.
    pub fn new(
        (argument, material): (&str, &Material),
        medium: Option<&Typed>,
        viewing: &ViewingConditions,
    ) -> Result<TableMaterial, SurfaceError> {
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

    /// The viewing conditions, in words.
    pub fn seen(&self) -> &str {
        &self.reference.surface.seen
    }
}

/// The default axis: the one with the smallest errors at equal size.
pub const DEFAULT_AXIS: TableAxis = TableAxis::Rational;
/// The default formats: one that most programs read, one for engines without float textures, and one that GPUs take.
pub const DEFAULT_FORMATS: [Format; 3] = [Format::ExrHalf, Format::Png16, Format::Ktx2];

/// The viewing conditions of tables: colours outside the working space are kept, unless another policy was requested.
pub fn as_tables_are_seen(viewing: &ViewingConditions, gamut_was_said: bool) -> ViewingConditions {
    let mut viewing = viewing.clone();
    // Where a channel is one wavelength, there is no colour space.
    if !gamut_was_said && viewing.wavelengths_nm.is_none() {
        viewing.gamut = Gamut::Keep;
    }
    viewing
}

/// The arguments that name the materials on the command line.
pub fn material_words(subjects: &[TableMaterial]) -> Vec<String> {
    subjects.iter().map(|one| one.argument.clone()).collect()
}

/// The flags of the medium and the viewing conditions, each with a space before it.
pub fn viewing_flags(subjects: &[TableMaterial], viewing: &ViewingConditions) -> String {
    let medium = subjects.first().and_then(|subject| subject.medium.as_ref());
    // Tables keep colours outside the space by default; functions clip them.
    let clips = viewing.gamut == Gamut::Clip && viewing.wavelengths_nm.is_none();
    CommandLine::new("")
        .list("medium", medium)
        .seen_as(viewing)
        .list("gamut", clips.then_some(Gamut::Clip.name()))
        .into()
}
