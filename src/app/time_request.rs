//! What `time` is asked for: from the names of methods and materials to the functions that are drawn.

use crate::methods;
use crate::overdraw::{LibraryMaterials, TimedFunctions};
use crate::reference::MaterialInMedium;

use super::error::Error;
use super::fault::RequestFault;
use super::precision::several;
use super::request::{Materials, Request, Source};

/// Materials that functions are specialised to where none is named: a metal and a dielectric.
const USUAL: [&str; 2] = ["gold", "water"];
/// With whose numbers library functions are run: what absorbs, and what does not.
const METAL: &str = "gold";
const DIELECTRIC: &str = "water";

/// What `time` is asked for.
pub struct TimeRequest<'a> {
    /// Names of methods; none: all.
    pub methods: &'a [String],
    /// The materials.
    pub materials: Materials,
    /// Names of precisions; none: both.
    pub precisions: &'a [String],
    /// Evaluations in a draw.
    pub evaluations: usize,
}

impl TimeRequest<'_> {
    /// The functions, and what is drawn for them.
    ///
    /// # Errors
    /// A name that is none, or nothing to measure.
    pub fn timed_functions(&self) -> Result<TimedFunctions, Error> {
        let request = Request {
            methods: self.methods.to_vec(),
            materials: match &self.materials {
                Materials::Default => Materials::These(USUAL.map(named_source).to_vec()),
                other => other.clone(),
            },
            ..Request::default()
        };
        let chosen = request.resolved_methods()?;
        let subjects = request.subjects()?;
        let library = LibraryMaterials {
            metal: subject(METAL)?,
            dielectric: subject(DIELECTRIC)?,
        };
        let ready = subjects.ready.into_iter();
        let materials: Vec<MaterialInMedium> = ready.map(|(subject, _)| subject).collect();
        let timed = TimedFunctions::new(
            chosen.as_deref().unwrap_or(methods::ALL),
            &several(self.precisions)?,
            &library,
            &materials,
            self.evaluations,
        )?;
        if timed.functions.is_empty() {
            return Err(RequestFault::NothingToDo {
                work: "measure",
                why: "no such method in this precision, or for these materials",
            }
            .into());
        }
        let unseen = subjects.left_out.into_iter().map(|unseen| unseen.why);
        Ok(TimedFunctions {
            left_out: unseen.chain(timed.left_out).collect(),
            ..timed
        })
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
    let mut ready = request.subjects()?.ready;
    Ok(ready.swap_remove(0).0)
}
