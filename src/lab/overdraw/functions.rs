//! The measured functions, and the drawings for them. Worker and supervisor derive the same ones from the same flags, so that a
//! number names a drawing.

use super::plan::{DrawingPlan, TimedFunction};
use crate::generator::emit::{
    Bounds, EmittedFunction, Error, Naming, library_functions, specialised_function,
};
use crate::generator::fit::{table_of, values_for_material};
use crate::generator::reference::MaterialInMedium;
use crate::lab::cost::REFERENCE;
use crate::language::methods::{self, Class, Method, Values};
use crate::physics::num::Precision;

/// The method of the heavy shader, which is drawn below all others: the most expensive one of the library.
const HEAVY: &str = "conductor_from_f0_f82";

/// The measured functions, and the drawings for them.
pub struct TimedFunctions {
    /// The functions.
    pub functions: Vec<TimedFunction>,
    /// The drawings for them.
    pub plan: DrawingPlan,
    /// Why some functions are left out.
    pub left_out: Vec<String>,
}

/// The materials with whose values library functions are run.
pub struct LibraryMaterials {
    /// An absorbing one.
    pub metal: MaterialInMedium,
    /// One without absorption.
    pub dielectric: MaterialInMedium,
}

impl TimedFunctions {
    /// The functions of these methods in these precisions: library functions, and those specialised to each material.
    ///
    /// # Errors
    /// A function cannot be made.
    pub fn new(
        methods: &[&'static Method],
        precisions: &[Precision],
        library: &LibraryMaterials,
        materials: &[MaterialInMedium],
        operations: usize,
    ) -> Result<TimedFunctions, Error> {
        let mut timed = TimedFunctions {
            functions: Vec::new(),
            plan: library.plan(&[], operations)?,
            left_out: Vec::new(),
        };
        for precision in precisions.iter().copied() {
            timed.add_library(methods, precision, library)?;
            for material in materials {
                timed.add_material(methods, precision, material)?;
            }
        }
        timed.plan = library.plan(&timed.functions, operations)?;
        Ok(timed)
    }

    fn add_library(
        &mut self,
        methods: &[&'static Method],
        precision: Precision,
        library: &LibraryMaterials,
    ) -> Result<(), Error> {
        for method in methods {
            if self.is_refused(precision, method, "", method.half.library_refusal()) {
                continue;
            }
            for emitted in library_functions(method, &naming(precision))? {
                self.functions.push(library.timed(emitted));
            }
        }
        Ok(())
    }

    fn add_material(
        &mut self,
        methods: &[&'static Method],
        precision: Precision,
        material: &MaterialInMedium,
    ) -> Result<(), Error> {
        let fits = |method: &&&'static Method| material.is_described_by(method);
        for method in methods.iter().filter(fits) {
            let of = format!(" for {}", material.name);
            if self.is_refused(precision, method, &of, method.half.refusal()) {
                continue;
            }
            let naming = naming(precision);
            let emitted = specialised_function(method, material, &naming, &Bounds::recorded())?;
            self.functions.push(TimedFunction {
                material: Some(material.argument.clone()),
                ..timed(emitted, Values::new(), material)
            });
        }
        Ok(())
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

impl LibraryMaterials {
    fn timed(&self, emitted: EmittedFunction) -> TimedFunction {
        let material = match emitted.method.class {
            Class::Dielectric => &self.dielectric,
            Class::Metal | Class::Any => &self.metal,
        };
        timed(
            emitted.clone(),
            values_for_material(material, emitted.method),
            material,
        )
    }

    fn plan(&self, functions: &[TimedFunction], operations: usize) -> Result<DrawingPlan, Error> {
        let [heavy, reference] = [HEAVY, REFERENCE].map(|name| self.single(name));
        Ok(DrawingPlan::new(
            &heavy?,
            &reference?,
            functions,
            operations,
        ))
    }

    /// The three-channel function of a method in single precision.
    fn single(&self, name: &str) -> Result<TimedFunction, Error> {
        let method = methods::find(name).expect("a method of ours; a test draws it");
        let mut functions = library_functions(method, &naming(Precision::F32))?;
        Ok(self.timed(functions.swap_remove(0)))
    }
}

fn timed(emitted: EmittedFunction, values: Values, material: &MaterialInMedium) -> TimedFunction {
    let reflectance = material.truth_for(emitted.method);
    TimedFunction {
        table: table_of(&emitted.function, |cos_theta| reflectance.at(cos_theta)),
        emitted,
        material: None,
        values,
    }
}

fn naming(precision: Precision) -> Naming {
    Naming {
        precision,
        ..Naming::default()
    }
}
