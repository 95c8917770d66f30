//! What some methods and the exact law give for one material at all angles.

use crate::generator::emit::{Bounds, Naming, specialised_function};
use crate::generator::reference::{Derivation, MaterialInMedium};
use crate::language::ir::{Value, evaluate};
use crate::language::methods;
use crate::physics::materials::{self, ViewingConditions};
use crate::physics::optics::cosine;

/// The reflectance of a material of the catalogue at these angles, in degrees: by each of these methods, and last by the exact law
/// of the whole spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct Reflectances {
    /// By methods, in their order.
    pub by_methods: Vec<Vec<[f64; 3]>>,
    /// By the exact law.
    pub exact: Vec<[f64; 3]>,
}

/// Computes them, in air and as materials are seen by default.
///
/// # Errors
/// A material or a method is not there, or cannot be seen.
pub fn exact_and_approximated(
    material: &str,
    methods: &[&str],
    degrees: &[f64],
) -> Result<Reflectances, String> {
    let found = materials::find(material);
    let found = found.ok_or_else(|| format!("there is no material {material}"))?;
    let typed = (material.to_owned(), found.map_err(|why| why.to_string())?);
    let viewing = ViewingConditions::default();
    let subject = MaterialInMedium::new(typed, None, &viewing, Derivation::default());
    let subject = subject.map_err(|why| why.to_string())?;
    let cosines: Vec<f64> = degrees.iter().copied().map(cosine).collect();
    let mut by_methods = Vec::new();
    for name in methods {
        let method = methods::find(name).ok_or_else(|| format!("there is no method {name}"))?;
        let (naming, bounds) = (Naming::default(), Bounds::recorded());
        let emitted = specialised_function(method, &subject, &naming, &bounds);
        let function = emitted.map_err(|why| why.to_string())?.function;
        let values = evaluate(&function, &[Value::each(cosines.clone())]);
        by_methods.push((0..cosines.len()).map(|i| values.at(i)).collect());
    }
    let exact = cosines.iter().map(|c| subject.reference.at(*c)).collect();
    Ok(Reflectances { by_methods, exact })
}
