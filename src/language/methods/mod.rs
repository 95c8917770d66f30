//! The methods, one file each: a formula for reflectance with its source, inputs, domain and promised errors.
//!
//! To add one, write its file in `formulas`: a `//!` header with formula and source, a `pub static METHOD: Method`, a `build`
//! function and its limit tests. Then run `tests/lists`. ARCHITECTURE.md lists the next steps.
//! Fitted methods are methods like all others, with their coefficients as inputs.
//! This room knows no target.

use std::str::FromStr;

use crate::physics::names::{UnknownName, named};

mod affine;
mod claims;
mod formulas;
mod gpu;
mod input;
mod limits;
mod media;
mod method;
mod renamed;
mod shape;

pub use affine::{Basis, MOST_TERMS};
pub use claims::{ByClass, ColourClaim, HALF_AIM, InHalf, Spread};
pub use formulas::{
    ALL, ONLY_ROW, TEXELS, WARP, fetch, lambda, schlick_82, unwarped, warped, warped_step,
};
pub(in crate::language) use formulas::{Polarised, polarised};
pub use gpu::{Gpu, MIXES, Mix};
pub use input::{BareBase, FilmSample, Input, InputSource, Inputs, KnownFilm, KnownSurface, Range};
pub use media::{Class, MediaSet};
pub use method::{Contract, Forms, Light, Method, Origin, Values};
pub use renamed::{FORMER, RENAMED, Renamed, renamed};
pub use shape::{Factor, Shape};

/// The method of this name, or of this old name.
///
/// ```
/// let schlick = fresnel_gen::language::methods::find("schlick").expect("it is a method");
/// assert_eq!(schlick.source.year, 1994);
/// ```
pub fn find(name: &str) -> Option<&'static Method> {
    let found = ALL.iter().find(|method| method.name == name).copied();
    found.or_else(|| find(renamed(name, RENAMED)?.new))
}

/// Every method in every way in which it is written.
pub fn all_variants() -> impl Iterator<Item = &'static Method> {
    ALL.iter().flat_map(|method| method.with_variants())
}

impl FromStr for &'static Method {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<&'static Method, UnknownName> {
        named("method", name, find(name), ALL.iter().map(|one| one.name))
    }
}

/// The input of this name, of whichever method takes it.
pub fn find_input(name: &str) -> Option<&'static Input> {
    let mut inputs = ALL.iter().flat_map(|method| method.inputs);
    inputs.find(|input| input.name == name)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{ALL, Gpu, Input, all_variants, find_input};
    use crate::language::ir::{Op, Payload};
    use crate::physics::num::Precision;

    /// A variant is its method but for the text, and its name is its own.
    #[test]
    fn variants_promise_what_their_method_promises() {
        for method in ALL {
            let names: BTreeSet<&str> = method.with_variants().map(|one| one.variant).collect();
            assert_eq!(names.len(), 1 + method.variants.len(), "{}", method.name);
            for variant in method.variants {
                assert_eq!(variant.name, method.name);
                assert_eq!(variant.claims.code_ulp, method.claims.code_ulp);
                assert!(variant.variants.is_empty() && !variant.variant.is_empty());
            }
        }
        for gpu in Gpu::all() {
            assert_eq!(gpu.name().parse(), Ok(gpu));
        }
        assert!("rdna".parse::<Gpu>().is_err());
    }

    #[test]
    fn every_form_of_every_method_is_well_formed() {
        for method in all_variants() {
            for precision in Precision::ALL {
                method.function_in(precision, false).unwrap();
                if method.has_scalar_form() {
                    method.function_in(precision, true).unwrap();
                }
            }
        }
    }

    /// Compilers' warnings of unused arguments are off, since a function may be a constant. All other functions use every argument.
    #[test]
    fn what_computes_something_uses_every_argument() {
        for method in ALL {
            let function = method.function(false).expect("it is well formed");
            let uses = |index| {
                let nodes = &mut function.nodes.iter();
                nodes.any(|node| node.op == Op::Param && node.payload == Payload::Index(index))
            };
            let all = (0..function.params.len()).all(uses);
            assert!(all || function.computes_nothing(), "{}", method.name);
        }
    }

    /// A name means one thing: inputs of the same name are the same input, and have the same order in every method.
    #[test]
    fn inputs_of_one_name_are_one() {
        for method in ALL {
            for input in method.inputs {
                let first = find_input(input.name).expect("a method takes it");
                assert_eq!((first.meaning, first.range), (input.meaning, input.range));
                assert!(input.scanned.is_sorted_by(|a, b| a <= b), "{}", input.name);
                let usual = input.tried.first().expect("a usual value");
                assert!((input.range.least..=input.range.most).contains(usual));
            }
            for other in ALL {
                let place =
                    |input: &Input| other.inputs.iter().position(|own| own.name == input.name);
                let places = method.inputs.iter().filter_map(place);
                assert!(places.is_sorted(), "{} and {}", method.name, other.name);
            }
        }
    }

    #[test]
    fn every_fitted_method_promises_something_of_a_class() {
        for method in ALL {
            let promises = !method.claims.by_class.is_empty();
            let is_meant_to = method.name.starts_with("fitted");
            assert_eq!(promises, is_meant_to, "{}", method.name);
            assert!(is_meant_to || !method.is_fitted(), "{}", method.name);
        }
    }
}
