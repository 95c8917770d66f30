//! What an engine shows of a material: as it ships, with F82-tint, with our functions, and what is true.
//!
//! Below a clear coat all of them have the engine's coat, which reflects `R_c + (1 - R_c) B`: Schlick's approximation with F0 = .04. As it
//! ships, an engine takes the metal's colours in air for B, and Babylon.js lowers them. Truth has both interfaces and all that is reflected between them.

use super::Flavour;
use crate::generator::emit::{self, COAT, CatalogueRow, Naming, adapter_rows};
use crate::generator::exchange::{CoatLaw, EngineMaterial, ExchangeFault, Model};
use crate::generator::reference::MaterialInMedium;
use crate::language::methods::Values;
use crate::physics::foreign::Foreign;
use crate::physics::materials::ViewingConditions;
use crate::physics::num::each_channel;

/// The number of [`angles`].
pub const ANGLES: usize = 1025;

/// A material by an engine. Curves are reflectances at [`angles`].
#[derive(Clone, Debug)]
pub struct Compared {
    /// The engine's formula as it ships, in words.
    pub stock_model: &'static str,
    /// The formula with F82, in words; of dielectrics the law for one index, as OpenPBR and Blender have it.
    pub f82_model: &'static str,
    /// Our method.
    pub method: &'static str,
    /// By the engine as it ships.
    pub stock: Vec<[f64; 3]>,
    /// By F82-tint, or by the law for one index.
    pub f82: Vec<[f64; 3]>,
    /// By our adapter.
    pub ours: Vec<[f64; 3]>,
    /// The truth.
    pub truth: Vec<[f64; 3]>,
}

/// The angles of curves: 0 to 90 degrees in equal steps.
pub fn angles() -> Vec<f64> {
    let right = std::f64::consts::FRAC_PI_2;
    let last = (ANGLES - 1) as f64;
    (0..ANGLES).map(|i| right * i as f64 / last).collect()
}

/// Why there is nothing to compare.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ComparedFault {
    /// The numbers for engines.
    #[error(transparent)]
    Exchange(#[from] ExchangeFault),
    /// A language refuses a text: a bug.
    #[error(transparent)]
    Emit(#[from] emit::Error),
    /// A clear coat whose base is not known.
    #[error(
        "what {engine} makes of a metal below its clear coat is not known here; it is of {}",
        known_coats()
    )]
    NoCoat {
        /// The engine.
        engine: &'static str,
    },
    /// The flavour is a package for several engines.
    #[error("the flavour {flavour} is a package for several engines; name one of them")]
    Package {
        /// Its name.
        flavour: &'static str,
    },
    /// No fitted method follows the material.
    #[error(
        "no method of adapters follows `{}`: {}",
        Foreign(name),
        if *has_films { "its films have too many fringes; `fresnel-gen bake --material` writes a table" } else { "it hardly reflects" }
    )]
    NoMethod {
        /// The material.
        name: String,
        /// Whether it lies under films.
        has_films: bool,
    },
}

impl Compared {
    /// A material in air, or below the engine's clear coat.
    ///
    /// # Errors
    /// Engines have no numbers for it, or no method of adapters follows it.
    pub fn new(
        engine: &Flavour,
        subject: &MaterialInMedium,
        viewing: &ViewingConditions,
        with_coat: bool,
    ) -> Result<Compared, ComparedFault> {
        let cosines: Vec<f64> = angles().into_iter().map(libm::cos).collect();
        let in_air = EngineMaterial::new(subject, viewing)?;
        let true_material = match with_coat {
            true => EngineMaterial::below_coat(subject, viewing, COAT)?,
            false => in_air.clone(),
        };
        let rows = adapter_rows(std::slice::from_ref(subject), &Naming::default())?;
        let no_method = || ComparedFault::NoMethod {
            name: subject.name.clone(),
            has_films: subject.has_films(),
        };
        let ours = our_model(rows.first().ok_or_else(no_method)?, with_coat);
        let ours = ours.ok_or_else(no_method)?;
        let ships = engine.stock.ok_or(ComparedFault::Package {
            flavour: engine.name,
        })?;
        let stock = match (with_coat, engine.coated_f0) {
            (false, _) => ships(&in_air),
            (true, Some(below)) => {
                let mut coated = in_air.clone();
                coated.f0 = coated.f0.map(below);
                ships(&coated)
            }
            (true, None) => {
                return Err(ComparedFault::NoCoat {
                    engine: engine.name,
                });
            }
        };
        let f82 = Model::f82_tint_or_law(&in_air);
        let seen = |model: &Model| -> Vec<[f64; 3]> {
            let base = model.reflectances(&cosines);
            let pairs = base.into_iter().zip(&cosines);
            let coated = |(base, cos): ([f64; 3], &f64)| {
                let coat = CoatLaw::Schlick.reflectance(COAT, *cos);
                let own = if with_coat { coat } else { 0.0 };
                each_channel(|i| own + (1.0 - own) * base[i].clamp(0.0, 1.0))
            };
            pairs.map(coated).collect()
        };
        Ok(Compared {
            stock_model: stock.words,
            f82_model: f82.words,
            method: ours.words,
            stock: seen(&stock),
            f82: seen(&f82),
            ours: seen(&ours),
            truth: cosines
                .iter()
                .map(|cos| true_material.truth(*cos))
                .collect(),
        })
    }
}

fn known_coats() -> String {
    let known = super::ALL.iter().filter(|one| one.coated_f0.is_some());
    known.map(|one| one.name).collect::<Vec<_>>().join(", ")
}

/// The function that an adapter takes for a material.
fn our_model(row: &CatalogueRow, with_coat: bool) -> Option<Model> {
    let coefficients = match with_coat {
        true => &row.coated.as_ref()?.coefficients,
        false => &row.coefficients,
    };
    let inputs = row.method.inputs.iter().zip(coefficients);
    let values: Values = inputs
        .map(|(input, value)| (input.name.into(), *value))
        .collect();
    Some(Model::fitted(row.method, values))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::reference::Derivation;
    use crate::physics::materials;

    fn compared(name: &str, with_coat: bool) -> Compared {
        let viewing = ViewingConditions::default();
        let typed = (name.to_owned(), materials::find(name).unwrap().unwrap());
        let subject = MaterialInMedium::new(typed, None, &viewing, Derivation::default());
        Compared::new(Flavour::THREE, &subject.unwrap(), &viewing, with_coat).unwrap()
    }

    fn most(one: &[[f64; 3]], truth: &[[f64; 3]]) -> f64 {
        let pairs = one.iter().zip(truth);
        let apart = pairs.flat_map(|(a, b)| [0, 1, 2].map(|i| (a[i] - b[i]).abs()));
        apart.fold(0.0, f64::max)
    }

    #[test]
    fn ours_is_nearer_than_what_ships() {
        for (name, with_coat) in [
            ("platinum", false),
            ("titanium", false),
            ("anodised_titanium_purple", false),
            ("water", false),
            ("gold", true),
            ("copper", true),
        ] {
            let found = compared(name, with_coat);
            let [stock, ours] = [&found.stock, &found.ours].map(|one| most(one, &found.truth));
            assert!(5.0 * ours < stock, "{name}: {ours} {stock}");
        }
    }

    #[test]
    fn a_coat_reflects_at_grazing_whatever_lies_below() {
        let found = compared("gold", true);
        for curve in [&found.stock, &found.f82, &found.ours, &found.truth] {
            assert!((curve[ANGLES - 1][2] - 1.0).abs() < 1e-6);
        }
        // Less comes back from below a coat than from the metal alone: F0 of gold in air is 1, .77, .34.
        assert!(found.truth[0][1] < 0.77 && found.truth[0][1] > found.truth[0][2]);
    }
}
