//! Media: the classes that methods describe, and the sets that claims are stated over.

/// The media that a method describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// k = 0.
    Dielectric,
    /// k of at least a quarter of n.
    Metal,
    /// Any k.
    Any,
    /// Any material under films: no law of one index follows it.
    Film,
    /// A material under one film, in air: published functions know no other medium.
    OneFilm,
    /// A material under one film that absorbs next to nothing.
    ClearFilm,
}

impl Class {
    /// Whether a method of this class describes a bare medium with this index.
    pub fn describes(self, n: f64, k: f64) -> bool {
        match self {
            Class::Dielectric => k == 0.0,
            Class::Metal => k >= LEAST_METALLIC * n,
            Class::Any => true,
            Class::Film | Class::OneFilm | Class::ClearFilm => false,
        }
    }

    /// Whether it is of materials under films.
    pub fn is_of_films(self) -> bool {
        matches!(self, Class::Film | Class::OneFilm | Class::ClearFilm)
    }

    /// The media in words.
    pub fn described(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics (k = 0)",
            Class::Metal => "metals (k of n / 4 and more)",
            Class::Any => "all media",
            Class::Film => "materials under films",
            Class::OneFilm => "materials under one film in air",
            Class::ClearFilm => "materials under one clear film",
        }
    }

    /// The media in words, for a message that refuses another medium.
    pub fn media(self) -> &'static str {
        match self {
            Class::Dielectric => "dielectrics only, and this absorbs (k > 0)",
            Class::Metal => "metals only, with k of at least n / 4, and this has less",
            Class::Any => "all media",
            Class::Film => "materials under films only, and this has none",
            Class::OneFilm => "materials under one film in air only, and this is none",
            Class::ClearFilm => {
                "materials under one film only, with k below 0.05, and this is none"
            }
        }
    }
}

/// The least k of a metal, as a fraction of n: semiconductors have less at visible wavelengths.
const LEAST_METALLIC: f64 = 0.25;

/// The sets of media that claims are stated over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MediaSet {
    /// Dielectrics, eta 1.3 to 2.5.
    Dielectrics,
    /// Metals, n 0.05 to 4.5 and k 1.5 to 8.
    Metals,
    /// From nearly matched to far beyond any material, n 1.0001 to 12 and k 0 to 13 (0 for dielectrics), and metals.
    Wide,
    /// The media of claims in half precision: n 1.001 to 12 and k 0 to 60 (0 for dielectrics), and metals.
    Half,
}

impl MediaSet {
    /// A medium of the set, n and k, from two parameters in [0, 1]. [`MediaSet::Wide`] and [`MediaSet::Half`] are dense where formulas
    /// break, near n = 1 and k = 0. Their metals are those of [`MediaSet::Metals`].
    pub fn medium(self, n_share: f64, k_share: f64) -> (f64, f64) {
        match self {
            MediaSet::Dielectrics => (1.3 + 1.2 * n_share, 0.0),
            MediaSet::Metals => (0.05 * libm::pow(90.0, n_share), 1.5 + 6.5 * k_share),
            MediaSet::Wide => (
                1.0 + 1e-4 * libm::pow(1.1e5, n_share),
                13.0 * k_share * k_share,
            ),
            MediaSet::Half => (
                1.0 + 1e-3 * libm::pow(1.1e4, n_share),
                60.0 * k_share * k_share,
            ),
        }
    }

    /// Whether a medium lies in the set.
    pub fn holds(self, n: f64, k: f64) -> bool {
        let metal = || (0.05..=4.5).contains(&n) && (1.5..=8.0).contains(&k);
        match self {
            MediaSet::Dielectrics => (1.3..=2.5).contains(&n) && k == 0.0,
            MediaSet::Metals => metal(),
            MediaSet::Wide => (1.0001..=12.0).contains(&n) && (0.0..=13.0).contains(&k) || metal(),
            MediaSet::Half => (1.001..=12.0).contains(&n) && (0.0..=60.0).contains(&k) || metal(),
        }
    }

    /// The set in words.
    pub fn text(self) -> &'static str {
        match self {
            MediaSet::Dielectrics => "eta 1.3 to 2.5",
            MediaSet::Metals => "n 0.05 to 4.5, k 1.5 to 8",
            MediaSet::Wide => "n 1.0001 to 12 with k 0 to 13, and n 0.05 to 4.5 with k 1.5 to 8",
            MediaSet::Half => "n 1.001 to 12 with k 0 to 60, and n 0.05 to 4.5 with k 1.5 to 8",
        }
    }
}
