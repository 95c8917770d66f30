//! What is measured: library functions with arguments from uniforms, specialised ones with their constants folded in.

use std::sync::OnceLock;

use crate::cost::{Dialect, Probe, REFERENCE};
use crate::emit::{
    Bounds, Emitted, Error, FunctionForm, Naming, library_functions, specialised_graph,
};
use crate::ir::{Checked, Ty};
use crate::methods::{self, Method};
use crate::num::Precision;
use crate::reference::MaterialInMedium;

/// A function as it is measured.
#[derive(Clone, Debug)]
pub struct CostedFunction {
    /// Whether it was asked for, or is here as the reference only.
    pub is_asked: bool,
    /// The material that it is specialised to.
    pub material: Option<String>,
    /// Its method.
    pub method: &'static Method,
    /// What it takes and gives.
    pub form: FunctionForm,
    /// What it computes in.
    pub precision: Precision,
    /// The graph.
    pub graph: Checked,
    probe: Probe,
    /// The hash for each language, once it was asked for.
    hashes: [OnceLock<String>; 3],
}

/// The functions of these methods: library and scalar forms, and specialised ones for each material that they describe,
/// in each precision that they are written in.
///
/// # Errors
/// A function cannot be made.
pub fn functions(
    methods: &[&'static Method],
    subjects: &[MaterialInMedium],
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
        for subject in subjects {
            for method in methods.iter().copied() {
                let refused = precision.is_half() && method.half.refusal().is_some();
                if subject.is_described_by(method) && !refused {
                    let made = specialised_graph(method, subject, precision, &bounds)?;
                    found.push(CostedFunction {
                        material: Some(subject.argument.clone()),
                        ..CostedFunction::new(
                            method,
                            FunctionForm::Specialised,
                            precision,
                            made.function,
                        )
                    });
                }
            }
        }
    }
    if !found.iter().any(CostedFunction::is_reference) {
        found.push(reference()?);
    }
    Ok(found)
}

/// The function with which others are compared, where nobody asked for it.
fn reference() -> Result<CostedFunction, Error> {
    let method = methods::find(REFERENCE).expect("a test asks for its cost");
    let functions = library_functions(method, &Naming::default())?;
    let emitted = functions
        .into_iter()
        .next()
        .expect("it has a form of three channels");
    Ok(CostedFunction {
        is_asked: false,
        ..CostedFunction::library(emitted)
    })
}

impl CostedFunction {
    fn library(emitted: Emitted) -> CostedFunction {
        CostedFunction::new(
            emitted.method,
            emitted.form,
            emitted.precision,
            emitted.function,
        )
    }

    fn new(
        method: &'static Method,
        form: FunctionForm,
        precision: Precision,
        graph: Checked,
    ) -> CostedFunction {
        CostedFunction {
            is_asked: true,
            material: None,
            probe: Probe::new(&graph, precision),
            hashes: Default::default(),
            method,
            form,
            precision,
            graph,
        }
    }

    /// The function with which others are compared: the exact law for dielectrics, its arguments from uniforms.
    pub fn is_reference(&self) -> bool {
        self.method.name == REFERENCE
            && self.form == FunctionForm::Library
            && !self.precision.is_half()
    }

    /// How many channels it gives.
    pub fn channels(&self) -> usize {
        if self.is_scalar() { 1 } else { 3 }
    }

    /// Whether it gives one channel.
    pub fn is_scalar(&self) -> bool {
        self.graph.ty() == Ty::Scalar
    }

    /// The shader of the longer chain by its hash: what a record belongs to.
    pub fn hash(&self, dialect: Dialect) -> &str {
        self.hashes[dialect as usize].get_or_init(|| self.probe.hash(dialect))
    }

    /// The fragment shaders of both chains.
    pub fn chains(&self, dialect: Dialect) -> [String; 2] {
        dialect
            .chains()
            .map(|evaluations| self.probe.text(evaluations, dialect))
    }
}

/// The chains of the empty function.
pub fn empty(is_scalar: bool, precision: Precision, dialect: Dialect) -> [String; 2] {
    let probe = Probe::empty(is_scalar, precision);
    dialect
        .chains()
        .map(|evaluations| probe.text(evaluations, dialect))
}
