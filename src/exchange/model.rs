//! The model of reflectance that a node of a format computes, and its error for a material.

use serde::Serialize;

use crate::fit::{error_of, rounded_up, values_at};
use crate::methods::{self, Method, Values};

use super::sheet::Node;
use super::subject::EngineMaterial;

/// One of our methods with the numbers that a format gives it.
#[derive(Clone, Debug)]
pub struct Model {
    /// What the format computes, in words.
    pub words: &'static str,
    /// The method that is the same formula.
    pub method: &'static Method,
    /// The values of its inputs; a scalar input uses the first number.
    pub values: Values,
}

/// The error of a node against the spectrum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NodeError {
    /// The node.
    pub node: &'static str,
    /// What it computes, in words.
    pub model: &'static str,
    /// The largest error of reflectance, over angles and channels.
    pub max_abs: f64,
    /// The angle there, in degrees.
    pub worst_degrees: f64,
}

impl Model {
    fn new(words: &'static str, method: &str, values: &[(&str, [f64; 3])]) -> Model {
        let values = values.iter().map(|(name, value)| ((*name).into(), *value));
        Model {
            words,
            method: methods::find(method).expect("a test finds every model"),
            values: values.collect(),
        }
    }

    /// Schlick's approximation, 1 at 90 degrees.
    pub fn schlick(f0: [f64; 3]) -> Model {
        Model::new("Schlick's approximation", "schlick", &[("f0", f0)])
    }

    /// Schlick's approximation with a smaller reflectance at 90 degrees where F0 is small.
    pub fn schlick_f90(words: &'static str, f0: [f64; 3], f90: f64) -> Model {
        Model::new(words, "schlick_f90", &[("f0", f0), ("f90", [f90; 3])])
    }

    /// F82-tint.
    pub fn f82_tint(f0: [f64; 3], tint: [f64; 3]) -> Model {
        Model::new("F82-tint", "f82_tint", &[("f0", f0), ("tint", tint)])
    }

    /// The exact law for one index.
    pub fn dielectric(ior: f64) -> Model {
        let words = "Fresnel's equations with one index";
        Model::new(words, "dielectric_exact", &[("eta", [ior; 3])])
    }

    /// The exact law for a complex index a channel.
    pub fn conductor(n: [f64; 3], k: [f64; 3]) -> Model {
        let words = "Fresnel's equations with n and k of each channel";
        Model::new(words, "conductor_exact", &[("n", n), ("k", k)])
    }

    /// Its largest error for a material, and the angle in degrees.
    pub fn error(&self, material: &EngineMaterial) -> (f64, f64) {
        let function = self
            .method
            .function(false)
            .expect("a test builds every method");
        let run = |cosines: &[f64]| values_at(&function, self.method.inputs, &self.values, cosines);
        let error = error_of(&material.subject.reference, &run);
        (error.max_abs, libm::acos(error.worst_cos).to_degrees())
    }
}

impl NodeError {
    /// The error of a node for a material.
    pub fn of(node: &Node, material: &EngineMaterial) -> NodeError {
        let (max_abs, worst_degrees) = node.model.error(material);
        NodeError {
            node: node.name,
            model: node.model.words,
            max_abs,
            worst_degrees,
        }
    }

    /// In a line.
    pub fn line(&self) -> String {
        let NodeError {
            node,
            model,
            max_abs,
            worst_degrees,
        } = self;
        let most = rounded_up(*max_abs);
        format!("{node} computes {model}: error at most {most} (at {worst_degrees:.2} degrees)")
    }
}
