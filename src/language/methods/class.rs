//! The media that methods describe.

/// The media that a method describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// k = 0.
    Dielectric,
    /// k of a quarter of n and more.
    Metal,
    /// Any k.
    Any,
}

impl Class {
    /// Whether a method of this class describes a medium with this index.
    pub fn describes(self, n: f64, k: f64) -> bool {
        match self {
            Class::Dielectric => k == 0.0,
            Class::Metal => k >= LEAST_METALLIC * n,
            Class::Any => true,
        }
    }

    /// What it describes, in words.
    pub fn described(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics (k = 0)",
            Class::Metal => "metals (k of n / 4 and more)",
            Class::Any => "all media",
        }
    }

    /// What it describes, in words that refuse another medium.
    pub fn media(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics only, and this absorbs (k > 0)",
            Class::Metal => "metals only, with k of at least n / 4, and this has less",
            Class::Any => "all media",
        }
    }
}

/// The least k of a metal, as a share of n: semiconductors have less where one sees them.
const LEAST_METALLIC: f64 = 0.25;
