//! The request of `time`: turns the names of methods and materials into the functions that are drawn.

use crate::generator::error::{Error, RequestFault};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request, Source};
use crate::lab::overdraw::{LibraryMaterials, TimedFunctions};
use crate::language::methods::Method;
use crate::physics::num::Precision;

/// Materials that functions are specialised to where none is named: a metal and a dielectric.
const USUAL: [&str; 2] = ["gold", "water"];
/// The materials with whose values library functions are run: an absorbing one, and one without absorption.
const METAL: &str = "gold";
const DIELECTRIC: &str = "water";

/// The request of `time`.
pub struct TimeRequest {
    /// The methods.
    pub methods: Vec<&'static Method>,
    /// The materials.
    pub materials: Materials,
    /// The precisions that functions compute in.
    pub precisions: Vec<Precision>,
    /// The approximate number of operations in a long chain.
    pub operations: usize,
}

impl TimeRequest {
    /// The functions, and the drawings for them.
    ///
    /// # Errors
    /// A name is unknown, or there is nothing to measure.
    pub fn timed_functions(&self) -> Result<TimedFunctions, Error> {
        let request = Request {
            materials: match &self.materials {
                Materials::Default => Materials::These(USUAL.map(named_source).to_vec()),
                other => other.clone(),
            },
            ..Request::default()
        };
        let subjects = request.subjects()?;
        let unseen = subjects.left_out.iter();
        let mut left_out: Vec<String> = unseen.map(|unseen| unseen.why.clone()).collect();
        let library = LibraryMaterials {
            metal: subject(METAL)?,
            dielectric: subject(DIELECTRIC)?,
        };
        let timed = TimedFunctions::new(
            &self.methods,
            &self.precisions,
            &library,
            &subjects.materials(),
            self.operations,
        )?;
        if timed.functions.is_empty() {
            return Err(RequestFault::NothingToDo {
                work: "measure",
                why: "no such method in this precision, or for these materials",
            }
            .into());
        }
        left_out.extend(timed.left_out);
        Ok(TimedFunctions { left_out, ..timed })
    }
}

fn named_source(name: &str) -> Source {
    Source::Named(name.to_owned())
}

fn subject(name: &str) -> Result<MaterialInMedium, Error> {
    let request = Request {
        materials: Materials::These(vec![named_source(name)]),
        ..Request::default()
    };
    Ok(request.subjects()?.materials().swap_remove(0))
}
