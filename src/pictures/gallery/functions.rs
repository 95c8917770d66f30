//! The text of functions, as a reader copies it.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::generator::emit::{self, EffectRequest, Emitted, Naming, effect_function_text};
use crate::language::effects;
use crate::language::methods;
use crate::language::targets;

/// A function in each language, with the comments above it.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionTexts {
    /// Its name.
    pub name: String,
    /// WGSL.
    pub wgsl: String,
    /// GLSL ES 3.00.
    pub gles: String,
    /// HLSL.
    pub hlsl: String,
}

/// The texts of the functions of these names.
///
/// # Errors
/// One cannot be written: a bug.
pub fn texts(names: &BTreeSet<String>) -> Result<Vec<FunctionTexts>, emit::Error> {
    let mut all: BTreeMap<String, Emitted> = BTreeMap::new();
    for effect in effects::ALL {
        for method in methods::ALL {
            let request = EffectRequest {
                effect,
                method,
                subject: None,
            };
            for emitted in request.functions(&Naming::default())? {
                if names.contains(&emitted.name) {
                    all.insert(emitted.name.clone(), emitted);
                }
            }
        }
    }
    all.into_values().map(|emitted| written(&emitted)).collect()
}

fn written(emitted: &Emitted) -> Result<FunctionTexts, emit::Error> {
    let text = |target: &str| {
        let target = targets::find(target).expect("a target");
        effect_function_text(target, emitted)
    };
    Ok(FunctionTexts {
        name: emitted.name.clone(),
        wgsl: text("wgsl")?,
        gles: text("gles")?,
        hlsl: text("hlsl")?,
    })
}
