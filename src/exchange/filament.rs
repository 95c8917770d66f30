//! Filament: lines of a material's fragment function.
//!
//! Source: Guy and Agopian, "Physically Based Rendering in Filament", 2018, <https://google.github.io/filament/Filament.html>,
//! sections 4.8.3.2 and 4.4.3: a dielectric's F0 = .16 reflectance², a metal's is `baseColor`. Schlick's approximation with
//! min(16.5 (R + G + B) of F0, 1) at 90 degrees, or 1 on phones and in images. Beside `reflectance`, `ior` is for refraction; without it, F0
//! of lit materials is that of `ior`.

use crate::spectra::Space;

use super::format::{Format, Notes};
use super::head;
use super::model::Model;
use super::sheet::{Field, FieldValue, Node, Sheet};
use super::subject::{Body, EngineMaterial, f0_of, rounded};

/// F0 of reflectance 1.
const REFLECTANCE_F0: f64 = 0.16;
/// F90 over the sum of F0's channels, up to 1: 50 * .33 in Filament's code.
const F90_SHARE: f64 = 16.5;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "filament",
    summary: "lines of a Filament material's fragment function",
    spaces: &[Space::Srgb],
    sheet,
    text,
};

fn sheet(material: &EngineMaterial) -> Sheet {
    let mut remarks = Vec::new();
    let (fields, f0) = match material.body {
        Body::Conductor => {
            let fields = vec![
                Field::colour("baseColor", material.f0),
                Field::number("metallic", 1.0),
                Field::number("roughness", 0.0),
            ];
            (fields, material.f0)
        }
        Body::Dielectric { ior, is_clear, .. } => {
            let whole = libm::sqrt(f0_of(ior) / REFLECTANCE_F0);
            let reflectance = rounded(whole.min(1.0));
            if whole > 1.0 {
                remarks.push(format!(
                    "reflectance {} is limited to 1, which is F0 = {REFLECTANCE_F0}",
                    rounded(whole)
                ));
            }
            let mut fields = vec![
                Field::number("metallic", 0.0),
                Field::number("roughness", 0.0),
                Field::number("reflectance", reflectance),
            ];
            if is_clear {
                fields.push(Field::number("ior", ior));
                remarks.push(
                    "ior is for materials with refraction; leave it out elsewhere".to_owned(),
                );
            }
            (fields, [REFLECTANCE_F0 * reflectance * reflectance; 3])
        }
    };
    let words = "Schlick's approximation, F90 by min(16.5 (R + G + B) of F0, 1)";
    let f90 = (F90_SHARE * f0.iter().sum::<f64>()).min(1.0);
    let node = Node {
        name: "material",
        fields,
        model: Model::schlick_f90(words, f0, f90),
    };
    Sheet {
        nodes: vec![node],
        remarks,
    }
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    let line = |field: &Field| {
        let numbers = field.value.numbers();
        match field.value {
            FieldValue::Colour(_) | FieldValue::Channels(_) => {
                format!("material.{}.rgb = vec3({numbers});\n", field.name)
            }
            FieldValue::Both(_) => format!("material.{} = vec2({numbers});\n", field.name),
            FieldValue::Number(_) | FieldValue::Whole(_) => {
                format!("material.{} = {numbers};\n", field.name)
            }
        }
    };
    let fields = sheet.nodes.iter().flat_map(|node| &node.fields);
    let lines: String = fields.map(line).collect();
    head::comments("//", &FORMAT, material, notes) + &lines
}
