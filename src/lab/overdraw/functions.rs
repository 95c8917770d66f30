//! The request of `time`: its methods and materials as functions that are drawn. Worker and supervisor derive the same ones from the
//! same flags, so that a number names a drawing.

use super::plan::{DrawingPlan, TimedFunction};
use crate::generator::emit::{
    Bounds, EmittedFunction, Naming, library_functions, specialised_graph,
};
use crate::generator::error::{Error, RequestFault};
use crate::generator::fit::{table_of, values_for_material};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request, Source};
use crate::lab::cost::{FunctionId, REFERENCE};
use crate::language::methods::{self, Class, Method};
use crate::physics::num::Precision;

/// The method of the heavy shader, which is drawn below all others: the most expensive one of the library.
const HEAVY: &str = "conductor_from_f0_f82";
/// Materials that functions are specialised to where none is named: a metal and a dielectric.
const USUAL: [&str; 2] = [METAL, DIELECTRIC];
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
}

/// The measured functions, and those of the reference shaders.
pub struct TimedFunctions {
    /// The measured functions.
    pub functions: Vec<TimedFunction>,
    /// Why some functions are left out.
    pub left_out: Vec<String>,
    heavy: TimedFunction,
    reference: TimedFunction,
}

impl TimeRequest {
    /// The functions of these methods in these precisions: library functions, and those specialised to each material.
    ///
    /// # Errors
    /// A material cannot be read, a function cannot be made, or there is nothing to measure.
    pub fn timed_functions(&self) -> Result<TimedFunctions, Error> {
        let subjects = request(match &self.materials {
            Materials::Default => named(&USUAL),
            other => other.clone(),
        })
        .subjects()?;
        let unseen = subjects.left_out.iter();
        let left_out = unseen.map(|unseen| unseen.why.clone()).collect();
        let materials = subjects.materials();
        let library = LibraryMaterials {
            metal: material(METAL)?,
            dielectric: material(DIELECTRIC)?,
        };
        let mut timed = TimedFunctions {
            functions: Vec::new(),
            left_out,
            heavy: library.single(HEAVY)?,
            reference: library.single(REFERENCE)?,
        };
        let bounds = Bounds::recorded();
        for precision in self.precisions.iter().copied() {
            for method in self.methods.iter().copied() {
                let why = method.half.library_refusal();
                if !timed.is_refused(precision, method, "", why) {
                    timed.functions.extend(library.timed(method, precision)?);
                }
            }
            for material in &materials {
                let described = self.methods.iter().copied();
                for method in described.filter(|method| material.is_described_by(method)) {
                    let of = format!(" for {}", material.name);
                    if !timed.is_refused(precision, method, &of, method.half.refusal()) {
                        let function = specialised(method, material, precision, &bounds)?;
                        timed.functions.push(function);
                    }
                }
            }
        }
        if timed.functions.is_empty() {
            return Err(RequestFault::NothingToDo {
                work: "measure",
                why: "no such method in this precision, or for these materials",
            }
            .into());
        }
        Ok(timed)
    }
}

impl TimedFunctions {
    /// The drawings for the functions, with about so many operations in a long chain.
    pub fn plan(&self, operations: usize) -> DrawingPlan {
        DrawingPlan::new(&self.heavy, &self.reference, &self.functions, operations)
    }

    /// Whether a method is not written in half precision. If so, the reason is noted.
    fn is_refused(
        &mut self,
        precision: Precision,
        method: &Method,
        of: &str,
        why: Option<&str>,
    ) -> bool {
        let why = why.filter(|_| precision.is_half());
        let remark = why.map(|why| format!("{} in f16{of}: {why}", method.name));
        self.left_out.extend(remark);
        why.is_some()
    }
}

/// The materials with whose values library functions are run.
struct LibraryMaterials {
    metal: MaterialInMedium,
    dielectric: MaterialInMedium,
}

impl LibraryMaterials {
    /// The library functions of a method.
    fn timed(
        &self,
        method: &'static Method,
        precision: Precision,
    ) -> Result<Vec<TimedFunction>, Error> {
        let material = match method.class {
            Class::Dielectric => &self.dielectric,
            _ => &self.metal,
        };
        let reference = material.truth_for(method);
        let function = |emitted: EmittedFunction| TimedFunction {
            id: FunctionId::of_library_file(&emitted),
            name: emitted.name,
            values: values_for_material(material, method),
            table: table_of(&emitted.function, |c| reference.at(c)),
            graph: emitted.function,
        };
        let emitted = library_functions(method, &naming(precision))?;
        Ok(emitted.into_iter().map(function).collect())
    }

    /// The three-channel function of a method in single precision.
    fn single(&self, name: &str) -> Result<TimedFunction, Error> {
        let method = methods::find(name).expect("a method of ours; a test draws it");
        Ok(self.timed(method, Precision::F32)?.swap_remove(0))
    }
}

fn specialised(
    method: &'static Method,
    material: &MaterialInMedium,
    precision: Precision,
    bounds: &Bounds,
) -> Result<TimedFunction, Error> {
    let made = specialised_graph(method, material, precision, bounds)?;
    let reference = material.truth_for(method);
    Ok(TimedFunction {
        id: FunctionId::specialised(method, material, precision),
        name: naming(precision).specialised(method, material),
        values: method.kept_of(&made.constants),
        table: table_of(&made.function, |c| reference.at(c)),
        graph: made.function,
    })
}

fn naming(precision: Precision) -> Naming {
    Naming {
        precision,
        ..Naming::default()
    }
}

fn request(materials: Materials) -> Request {
    Request {
        materials,
        ..Request::default()
    }
}

fn named(names: &[&str]) -> Materials {
    let source = |name: &&str| Source::Named((*name).to_owned());
    Materials::These(names.iter().map(source).collect())
}

fn material(name: &str) -> Result<MaterialInMedium, Error> {
    let found = request(named(&[name])).subjects()?;
    Ok(found.materials().swap_remove(0))
}
