//! What is baked unless asked otherwise.

use crate::generator::emit::Naming;
use crate::generator::lut::{Format, TableAxis};
use crate::language::methods::TEXELS;
use crate::physics::materials::ViewingConditions;
use crate::physics::spectra::Gamut;

use super::words::{material_words, viewing_flags};
use super::{BakeRequest, TableMaterial, TableSize};

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
