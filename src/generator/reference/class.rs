//! The classes of materials that are taken together.

use crate::physics::materials::MaterialKind;

use super::material_in_medium::{LEAST_FITTED_N, MaterialInMedium};

/// A class of materials. Gases are in none, nor are dielectrics that absorb, nor what is known at three wavelengths alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialClass {
    /// Metals and alloys.
    Metals,
    /// Semiconductors.
    Semiconductors,
    /// Transparent liquids and solids.
    Dielectrics,
}

impl MaterialClass {
    /// All of them.
    pub const ALL: [MaterialClass; 3] = [
        MaterialClass::Metals,
        MaterialClass::Semiconductors,
        MaterialClass::Dielectrics,
    ];

    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            MaterialClass::Metals => "metals",
            MaterialClass::Semiconductors => "semiconductors",
            MaterialClass::Dielectrics => "dielectrics",
        }
    }

    /// Its name in full.
    pub fn title(self) -> &'static str {
        match self {
            MaterialClass::Metals => "metals",
            MaterialClass::Semiconductors => "semiconductors",
            MaterialClass::Dielectrics => "dielectrics, n of 1.2 and more",
        }
    }

    /// The class that a material in its medium is in.
    pub fn containing(subject: &MaterialInMedium) -> Option<MaterialClass> {
        let channels = &subject.effective.channels;
        if subject.material.rgb_nm.is_some() {
            return None;
        }
        let is_solid = channels.n.iter().all(|n| *n >= LEAST_FITTED_N);
        match subject.material.kind {
            MaterialKind::Metal => Some(MaterialClass::Metals),
            MaterialKind::Semiconductor => Some(MaterialClass::Semiconductors),
            MaterialKind::Dielectric if is_solid && channels.is_transparent() => {
                Some(MaterialClass::Dielectrics)
            }
            MaterialKind::Dielectric => None,
        }
    }
}
