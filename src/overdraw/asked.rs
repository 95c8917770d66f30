//! What is measured: from the names of methods and materials to the functions that are drawn. Worker and supervisor come to the
//! same from the same flags, so that a number names a drawing.

use crate::app::error::Error;
use crate::app::precision::several;
use crate::app::request::{Materials, Request, Source};
use crate::cost::REFERENCE;
use crate::emit::{Bounds, Emitted, Naming, library_functions, specialised_function};
use crate::fit::{inputs_of, table_of};
use crate::methods::{self, Class, Method, Values};
use crate::num::Precision;
use crate::overdraw::{Plan, Timed};
use crate::reference::Subject;

/// Materials that functions are specialised to where none is named: a metal and a dielectric.
const USUAL: [&str; 2] = ["gold", "water"];
/// With whose numbers library functions are run: what absorbs, and what does not.
const METAL: &str = "gold";
const DIELECTRIC: &str = "water";
/// What lies below everything: the dearest of the library.
const HEAVY: &str = "conductor_from_f0_f82";

/// What is measured.
pub struct Asked {
    /// The functions, each with the material that it is specialised to as a user types it.
    pub functions: Vec<(Timed, Option<String>)>,
    /// What is drawn for them.
    pub plan: Plan,
    /// Why some are left out.
    pub left_out: Vec<String>,
}

/// The words of a request.
pub struct Words<'a> {
    /// Names of methods; none: all.
    pub methods: &'a [String],
    /// The materials.
    pub materials: Materials,
    /// Names of precisions; none: both.
    pub precisions: &'a [String],
    /// Evaluations in a draw.
    pub evaluations: usize,
}

/// The library's materials: their numbers are arguments.
struct Library {
    metal: Subject,
    dielectric: Subject,
}

impl Asked {
    /// What these words ask for.
    ///
    /// # Errors
    /// A name that is none, or nothing to measure.
    pub fn new(words: &Words) -> Result<Asked, Error> {
        let request = Request {
            methods: words.methods.to_vec(),
            materials: match &words.materials {
                Materials::Default => Materials::These(USUAL.map(named_source).to_vec()),
                other => other.clone(),
            },
            ..Request::default()
        };
        let chosen = request.resolved_methods()?;
        let subjects = request.subjects()?;
        let library = Library::new()?;
        let unseen = subjects.left_out.iter().map(|unseen| unseen.why.clone());
        let mut asked = Asked {
            functions: Vec::new(),
            plan: library.plan(&[], words.evaluations)?,
            left_out: unseen.collect(),
        };
        for precision in several(words.precisions)? {
            let methods = chosen.as_deref().unwrap_or(methods::ALL);
            asked.add_library(methods, precision, &library)?;
            for (subject, _) in &subjects.ready {
                asked.add_material(methods, precision, subject)?;
            }
        }
        if asked.functions.is_empty() {
            let what = "there is nothing to measure: no such method in this precision, or for these materials";
            return Err(Error::Usage {
                what: what.to_owned(),
            });
        }
        let timed: Vec<Timed> = asked.functions.iter().map(|(t, _)| t.clone()).collect();
        asked.plan = library.plan(&timed, words.evaluations)?;
        Ok(asked)
    }

    fn add_library(
        &mut self,
        methods: &[&'static Method],
        precision: Precision,
        library: &Library,
    ) -> Result<(), Error> {
        for method in methods {
            if self.is_refused(precision, method, "", method.half.library_refusal()) {
                continue;
            }
            for emitted in library_functions(method, &naming(precision))? {
                self.functions.push((library.timed(emitted), None));
            }
        }
        Ok(())
    }

    fn add_material(
        &mut self,
        methods: &[&'static Method],
        precision: Precision,
        subject: &Subject,
    ) -> Result<(), Error> {
        let fits = |method: &&&'static Method| subject.is_described_by(method);
        for method in methods.iter().filter(fits) {
            let of = format!(" for {}", subject.name);
            if self.is_refused(precision, method, &of, method.half.refusal()) {
                continue;
            }
            let naming = naming(precision);
            let emitted = specialised_function(method, subject, &naming, &Bounds::recorded())?;
            let timed = timed(emitted, Values::new(), subject);
            self.functions.push((timed, Some(subject.argument.clone())));
        }
        Ok(())
    }

    /// Whether a method is not written in half precision; says so.
    fn is_refused(
        &mut self,
        precision: Precision,
        method: &Method,
        of: &str,
        why: Option<&str>,
    ) -> bool {
        let why = why.filter(|_| precision.is_half());
        let told = why.map(|why| format!("{} in f16{of}: {why}", method.name));
        self.left_out.extend(told);
        why.is_some()
    }
}

impl Library {
    fn new() -> Result<Library, Error> {
        Ok(Library {
            metal: subject(METAL)?,
            dielectric: subject(DIELECTRIC)?,
        })
    }

    fn timed(&self, emitted: Emitted) -> Timed {
        let subject = match emitted.method.class {
            Class::Dielectric => &self.dielectric,
            Class::Any => &self.metal,
        };
        timed(emitted.clone(), inputs_of(subject, emitted.method), subject)
    }

    fn plan(&self, functions: &[Timed], evaluations: usize) -> Result<Plan, Error> {
        let [heavy, reference] = [HEAVY, REFERENCE].map(|name| self.single(name));
        Ok(Plan::new(&heavy?, &reference?, functions, evaluations))
    }

    /// The three-channel function of a method in single precision.
    fn single(&self, name: &str) -> Result<Timed, Error> {
        let method = methods::find(name).expect("a method of ours; a test draws it");
        let mut functions = library_functions(method, &naming(Precision::F32))?;
        Ok(self.timed(functions.swap_remove(0)))
    }
}

fn timed(emitted: Emitted, values: Values, subject: &Subject) -> Timed {
    let truth = subject.truth_for(emitted.method);
    Timed {
        table: table_of(&emitted.function, |cos_theta| truth.at(cos_theta)),
        emitted,
        values,
    }
}

fn naming(precision: Precision) -> Naming {
    Naming {
        precision,
        ..Naming::default()
    }
}

fn named_source(name: &str) -> Source {
    Source::Named(name.to_owned())
}

fn subject(name: &str) -> Result<Subject, Error> {
    let request = Request {
        materials: Materials::These(vec![named_source(name)]),
        ..Request::default()
    };
    let mut ready = request.subjects()?.ready;
    Ok(ready.swap_remove(0).0)
}
