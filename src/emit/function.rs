//! A function ready to be printed: its name, its graph, and what is known of its errors.

use crate::fit::{
    Derivation, Effective, Known, Measured, ModelError, Truth, effective, model_error, values_of,
};
use crate::ir::Checked;
use crate::materials::{Kind, Material, Sight, Surface, Unseen};
use crate::methods::{Class, Light, Method, Values};

use super::bounds::Bounds;
use super::error::Error;
use super::header::FILTERED;

/// How functions are named.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Naming {
    /// Goes before every function's name.
    pub prefix: String,
}

impl Default for Naming {
    fn default() -> Naming {
        Naming {
            prefix: "fresnel_".to_owned(),
        }
    }
}

/// A function with all that its page says about it.
#[derive(Clone, Debug)]
pub struct Emitted {
    /// Its name in the language.
    pub name: String,
    /// Its method.
    pub method: &'static Method,
    /// `library`, `scalar` or `specialised`.
    pub form: &'static str,
    /// The graph.
    pub function: Checked,
    /// The values that were folded in, for a specialised function.
    pub constants: Values,
    /// Method against exact law, for a specialised function.
    pub model_error: Option<ModelError>,
    /// f32 against f64, in ulp.
    pub code_ulp: Measured<f64>,
}

/// A material in its medium, as functions are specialised to it.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The material's name, with `_in_` and the medium's where there is one.
    pub name: String,
    /// What a user types to get it again: a name, or a file's name.
    pub argument: String,
    /// The record.
    pub material: Material,
    /// What a user types to get the medium again, and its record, where it is not air.
    pub medium: Option<(String, Material)>,
    /// What is seen of it, in unpolarised light.
    pub truth: Truth,
    /// The index per channel that stands for it.
    pub effective: Effective,
    /// How inputs are derived from it.
    pub derivation: Derivation,
}

/// A material with what a user types to get it: a name, or a file's name.
pub type Typed = (String, Material);

impl Subject {
    /// A material in air or in a medium, as it is seen.
    pub fn new(
        (argument, material): Typed,
        medium: Option<Typed>,
        sight: &Sight,
        derivation: Derivation,
    ) -> Result<Subject, Unseen> {
        let around = medium.as_ref().map(|(_, medium)| medium);
        let surface = Surface::new(&material, around, sight)?;
        let truth = Truth::new(surface, Light::Unpolarised);
        Ok(Subject {
            name: match around {
                Some(medium) => format!("{}_in_{}", material.name, medium.name),
                None => material.name.clone(),
            },
            effective: effective(&truth, material.kind),
            argument,
            material,
            medium,
            truth,
            derivation,
        })
    }

    /// What a method's inputs are for it.
    pub fn values(&self, method: &Method) -> Values {
        let seen = |cos_theta| self.truth.at(cos_theta);
        let known = Known::with(self.effective.channels, seen, &self.derivation);
        values_of(method, &known, &self.derivation)
    }

    /// What a method's error is held against: the truth in its light; what reads a table keeps the table's colours.
    pub fn truth_for(&self, method: &Method) -> Truth {
        let truth = if method.light == self.truth.light {
            self.truth.clone()
        } else {
            Truth::new(self.truth.surface.clone(), method.light)
        };
        if method.is_textured() {
            truth.kept()
        } else {
            truth
        }
    }

    /// The exact method of its class.
    pub fn exact_method(&self) -> &'static str {
        let transparent = self.effective.channels.is_transparent();
        let glass = self.material.kind == Kind::Dielectric && transparent;
        if glass {
            "dielectric_exact"
        } else {
            "conductor_exact"
        }
    }

    /// The methods that its file holds unless others are asked for: the exact one first.
    pub fn default_methods(&self) -> [&'static str; 4] {
        [
            self.exact_method(),
            "schlick_rescaled",
            "schlick_corrected",
            "table",
        ]
    }
}

/// The functions of a method's library file.
pub fn library_functions(method: &'static Method, naming: &Naming) -> Result<Vec<Emitted>, Error> {
    let forms: &[(bool, &str, &'static str)] =
        &[(false, "", "library"), (true, "_scalar", "scalar")];
    let wanted = forms
        .iter()
        .take(if method.has_scalar_form() { 2 } else { 1 });
    wanted
        .map(|(scalar, suffix, form)| {
            let function = method.function(*scalar).map_err(|fault| Error::Generated {
                file: method.name.to_owned(),
                what: fault.to_string(),
            })?;
            Ok(Emitted {
                name: format!("{}{}{suffix}", naming.prefix, method.name),
                method,
                form,
                function,
                constants: Values::new(),
                model_error: None,
                code_ulp: if method.is_textured() {
                    Measured::No(FILTERED.to_owned())
                } else {
                    Measured::Yes(method.claims.code_ulp)
                },
            })
        })
        .collect()
}

/// A method specialised to a material.
pub fn specialised_function(
    method: &'static Method,
    subject: &Subject,
    naming: &Naming,
    bounds: &Bounds,
) -> Result<Emitted, Error> {
    let refused = |what: String| Error::Specialise {
        method: method.name.to_owned(),
        material: subject.name.clone(),
        what,
    };
    if method.class == Class::Dielectric && !subject.effective.channels.is_transparent() {
        return Err(refused(
            "it describes dielectrics only, and this absorbs (k > 0)".to_owned(),
        ));
    }
    let constants = subject.values(method);
    let function = method
        .specialise(&constants)
        .map_err(|fault| refused(fault.to_string()))?;
    let own = method.name == subject.exact_method();
    let suffix = if own {
        String::new()
    } else {
        format!("_{}", method.name)
    };
    Ok(Emitted {
        name: format!("{}{}{suffix}", naming.prefix, subject.name),
        method,
        form: "specialised",
        model_error: Some(model_error(&function, &subject.truth_for(method))),
        code_ulp: if method.is_textured() {
            Measured::No(FILTERED.to_owned())
        } else {
            bounds.of(&function)
        },
        constants,
        function,
    })
}
