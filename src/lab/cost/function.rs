//! The measured functions: library functions with arguments from uniforms, and specialised ones with their constants folded in.
//! Also how many numbers describe a material in a method, which an engine stores and passes to each call.
//!
//! The identity of a function is the key of records, and the columns of reports that say which function a row is about.

use core::fmt;
use std::sync::OnceLock;

use serde::ser::SerializeMap;

use super::family::Dialect;
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
    /// The same of its shape.
    shapes: [OnceLock<String>; 3],
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
                for method in method.with_variants() {
                    let library = library_functions(method, &naming)?;
                    found.extend(library.into_iter().map(CostedFunction::library));
                }
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

    /// A function of this identity with another graph.
    pub fn new(id: FunctionId, graph: Checked) -> CostedFunction {
        CostedFunction {
            is_asked: true,
            probe: Probe::new(&graph, id.precision),
            hashes: Default::default(),
            shapes: Default::default(),
            id,
            graph,
        }
    }

    /// Whether it is the reference that others are compared with: the exact law for dielectrics, with arguments from uniforms.
    pub fn is_reference(&self) -> bool {
        self.id.effect.is_none()
            && self.id.method_name() == Some(REFERENCE)
            && self.id.variant().is_empty()
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
    pub fn shape(&self, dialect: Dialect) -> &str {
        self.shapes[dialect as usize].get_or_init(|| self.probe.shape(dialect))
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

/// Which function something is about.
#[derive(Clone, Debug)]
pub struct FunctionId {
    /// The function of an effect, by its name after the prefix.
    pub effect: Option<&'static str>,
    /// The method. None for a function of an effect that needs no R.
    pub method: Option<&'static Method>,
    /// The material that it is specialised to, as a user types it.
    pub material: Option<String>,
    /// Its form.
    pub form: FunctionForm,
    /// How many channels it returns.
    pub channels: usize,
    /// The precision that it computes in.
    pub precision: Precision,
}

impl FunctionId {
    /// A library function of a method.
    pub fn library(
        method: &'static Method,
        form: FunctionForm,
        precision: Precision,
    ) -> FunctionId {
        FunctionId {
            effect: None,
            method: Some(method),
            material: None,
            form,
            channels: if form.is_scalar() { 1 } else { 3 },
            precision,
        }
    }

    /// A function of a method that is specialised to a material.
    pub fn specialised(
        method: &'static Method,
        material: &MaterialInMedium,
        precision: Precision,
    ) -> FunctionId {
        FunctionId {
            material: Some(material.label().to_owned()),
            ..FunctionId::library(method, FunctionForm::Specialised, precision)
        }
    }

    /// The identity of a function of a library file or of an effect's file.
    pub fn of_library_file(emitted: &EmittedFunction) -> FunctionId {
        let effect = emitted.effect.map(|part| part.function);
        let has_method = effect.is_none_or(|effect| effect.reflectance.is_used());
        let is_scalar = emitted.function.ty() == Ty::Scalar;
        FunctionId {
            effect: effect.map(|effect| effect.name),
            method: has_method.then_some(emitted.method),
            channels: if is_scalar { 1 } else { 3 },
            ..FunctionId::library(emitted.method, emitted.form, emitted.precision)
        }
    }

    /// The method's name, where it is part of the function.
    pub fn method_name(&self) -> Option<&'static str> {
        self.method.map(|method| method.name)
    }

    /// The variant of the method; empty for the usual form.
    pub fn variant(&self) -> &'static str {
        self.method.map_or("", |method| method.variant)
    }

    /// The function for people: `schlick`, `schlick, one channel`, `gold: schlick, f16`, `refracted`,
    /// `exit_transmittance: schlick`.
    pub fn label(&self) -> String {
        let of = self.material.as_deref().or(self.effect);
        let names: Vec<&str> = of.into_iter().chain(self.method_name()).collect();
        let channel = match self.channels {
            1 if self.method.is_some() => ", one channel",
            _ => "",
        };
        let variant = self.variant();
        let variant = if variant.is_empty() {
            String::new()
        } else {
            format!(", {variant}")
        };
        let half = if self.precision.is_half() {
            ", f16"
        } else {
            ""
        };
        format!("{}{channel}{variant}{half}", names.join(": "))
    }

    /// Writes the columns that rows of methods begin with.
    ///
    /// # Errors
    /// The serialiser refuses one.
    pub fn serialize_columns<Row: SerializeMap>(&self, row: &mut Row) -> Result<(), Row::Error> {
        row.serialize_entry("method", &self.method_name())?;
        row.serialize_entry("variant", self.variant())?;
        row.serialize_entry("material", &self.material)?;
        row.serialize_entry("form", &self.form)?;
        row.serialize_entry("channels", &self.channels)?;
        row.serialize_entry("precision", &self.precision)
    }
}

impl fmt::Display for FunctionId {
    /// The first columns of a record, which are its key. A column is empty where there is nothing.
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let effect = self.effect.unwrap_or_default();
        let method = self.method_name().unwrap_or_default();
        let variant = self.variant();
        let material = self.material.as_deref().unwrap_or_default();
        let (form, channels) = (self.form.name(), self.channels);
        let precision = self.precision.name();
        write!(
            to,
            "{effect},{method},{variant},{material},{form},{channels},{precision}"
        )
    }
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
