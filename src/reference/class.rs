//! The classes of materials that are taken together.

use crate::materials::MaterialKind;

use super::material_in_medium::{LEAST_FITTED_N, MaterialInMedium};

/// A class of materials. Gases are in none, nor are dielectrics that absorb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialClass {
    /// Metals, and semiconductors with them.
    Metals,
    /// Transparent liquids and solids.
    Dielectrics,
}

impl MaterialClass {
    /// Both.
    pub const ALL: [MaterialClass; 2] = [MaterialClass::Metals, MaterialClass::Dielectrics];

    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            MaterialClass::Metals => "metals",
            MaterialClass::Dielectrics => "dielectrics",
        }
    }

    /// Its name in full.
    pub fn title(self) -> &'static str {
        match self {
            MaterialClass::Metals => "metals and semiconductors",
            MaterialClass::Dielectrics => "dielectrics, n of 1.2 and more",
        }
    }

    /// The class that a material in its medium is in.
    pub fn containing(subject: &MaterialInMedium) -> Option<MaterialClass> {
        let channels = &subject.effective.channels;
        let is_solid = channels.n.iter().all(|n| *n >= LEAST_FITTED_N);
        match subject.material.kind {
            MaterialKind::Metal | MaterialKind::Semiconductor => Some(MaterialClass::Metals),
            MaterialKind::Dielectric if is_solid && channels.is_transparent() => {
                Some(MaterialClass::Dielectrics)
            }
            MaterialKind::Dielectric => None,
        }
    }
}
