//! The measured functions: library functions with arguments from uniforms, and specialised ones with their constants folded in.
//! Also how many numbers describe a material in a method, which an engine stores and passes to each call.

use std::sync::OnceLock;

use super::family::Dialect;
use super::function_id::FunctionId;
use super::probe::Probe;
use crate::generator::emit::{
    Bounds, EffectRequest, EmittedFunction, Error, FunctionForm, Naming, library_functions,
    specialised_graph,
};
use crate::generator::reference::MaterialInMedium;
use crate::language::effects::Effect;
use crate::language::ir::{Checked, Ty};
use crate::language::methods::{self, Method};
use crate::physics::num::Precision;

/// The method, in its library form of three channels, to which other costs and times are relative.
pub const REFERENCE: &str = "dielectric_exact";

/// A measured function.
#[derive(Clone, Debug)]
pub struct CostedFunction {
    /// Whether it was requested, or is measured only as the reference.
    pub is_asked: bool,
    /// Which function it is.
    pub id: FunctionId,
    /// Its graph.
    pub graph: Checked,
    probe: Probe,
    /// The hash for each language, computed when first needed.
    hashes: [OnceLock<String>; 3],
}

/// The functions of these methods, in each precision that they are written in: library and scalar forms, and specialised ones for
/// each material that they describe.
///
/// # Errors
/// A function cannot be made.
pub fn functions(
    methods: &[&'static Method],
    materials: &[MaterialInMedium],
    precisions: &[Precision],
) -> Result<Vec<CostedFunction>, Error> {
    let bounds = Bounds::recorded();
    let mut found = Vec::new();
    for precision in precisions.iter().copied() {
        let naming = Naming {
            precision,
            ..Naming::default()
        };
        for method in methods.iter().copied() {
            if !(precision.is_half() && method.half.library_refusal().is_some()) {
                let library = library_functions(method, &naming)?;
                found.extend(library.into_iter().map(CostedFunction::library));
            }
        }
        for material in materials {
            for method in methods.iter().copied() {
                let refused = precision.is_half() && method.half.refusal().is_some();
                if material.is_described_by(method) && !refused {
                    let made = specialised_graph(method, material, precision, &bounds)?;
                    let id = FunctionId::specialised(method, material, precision);
                    found.push(CostedFunction::new(id, made.function));
                }
            }
        }
    }
    if !found.iter().any(CostedFunction::is_reference) {
        found.push(reference());
    }
    Ok(found)
}

/// The functions of an effect for any material, with R by a method. If that is not the usual method, only those that need R.
///
/// # Errors
/// A function cannot be made.
pub fn functions_of_effect(
    effect: &'static Effect,
    method: &'static Method,
) -> Result<Vec<CostedFunction>, Error> {
    let request = EffectRequest {
        effect,
        method,
        subject: None,
    };
    let functions = request.functions(&Naming::default())?;
    Ok(functions.into_iter().map(CostedFunction::library).collect())
}

/// The reference function, where it was not requested.
fn reference() -> CostedFunction {
    let method = methods::find(REFERENCE).expect("a test asks for its cost");
    let graph = method.function(false).expect("a test builds every method");
    let id = FunctionId::library(method, FunctionForm::Library, Precision::F32);
    CostedFunction {
        is_asked: false,
        ..CostedFunction::new(id, graph)
    }
}

impl CostedFunction {
    fn library(emitted: EmittedFunction) -> CostedFunction {
        CostedFunction::new(FunctionId::of_library_file(&emitted), emitted.function)
    }

    fn new(id: FunctionId, graph: Checked) -> CostedFunction {
        CostedFunction {
            is_asked: true,
            probe: Probe::new(&graph, id.precision),
            hashes: Default::default(),
            id,
            graph,
        }
    }

    /// Whether it is the reference that others are compared with: the exact law for dielectrics, with arguments from uniforms.
    pub fn is_reference(&self) -> bool {
        self.id.effect.is_none()
            && self.id.method_name() == Some(REFERENCE)
            && self.id.form == FunctionForm::Library
            && !self.id.precision.is_half()
    }

    /// The types of its first argument and of its result.
    pub fn ends(&self) -> (Ty, Ty) {
        let first = self.graph.params.first();
        (first.map_or(Ty::Scalar, |param| param.ty), self.graph.ty())
    }

    /// The hash of the shader with the longer chain, which is the key of a record.
    pub fn hash(&self, dialect: Dialect) -> &str {
        self.hashes[dialect as usize].get_or_init(|| self.probe.hash(dialect))
    }

    /// The hash of that shader's shape.
    pub fn shape(&self, dialect: Dialect) -> String {
        self.probe.shape(dialect)
    }

    /// The fragment shaders of both chains.
    pub fn chains(&self, dialect: Dialect) -> [String; 2] {
        dialect
            .chains()
            .map(|evaluations| self.probe.text(evaluations, dialect))
    }

    /// The fragment shaders of both chains of the empty function.
    pub fn empty_chains(&self, dialect: Dialect) -> [String; 2] {
        let (first, result) = self.ends();
        let probe = Probe::empty(first, result, self.id.precision);
        dialect
            .chains()
            .map(|evaluations| probe.text(evaluations, dialect))
    }
}

/// How many numbers a call of a method's library function takes beside the cosine: three for each colour or index, none for a
/// texture.
pub fn input_numbers(method: &Method) -> usize {
    let numbers = |ty| match ty {
        Ty::Vec3 => 3,
        Ty::Scalar => 1,
        _ => 0,
    };
    method.inputs.iter().map(|input| numbers(input.ty)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::methods::find;

    #[test]
    fn colours_and_indices_are_three_numbers() {
        for (method, numbers) in [
            ("schlick", 3),
            ("schlick_f90", 4),
            ("f82_tint", 6),
            ("fitted", 12),
            ("dielectric_exact", 3),
            ("conductor_exact", 6),
        ] {
            assert_eq!(find(method).map(input_numbers), Some(numbers), "{method}");
        }
    }
}
