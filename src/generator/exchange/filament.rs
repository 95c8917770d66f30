//! Filament: lines of a material's fragment function.
//!
//! Source: Guy and Agopian, "Physically Based Rendering in Filament", 2018, <https://google.github.io/filament/Filament.html>,
//! section 4.8.3.2. A metal's F0 is `baseColor`. F is Schlick's approximation with min(16.5 (R + G + B) of F0, 1) at 90 degrees,
//! or 1 on phones and in images. A dielectric's F0 is .16 reflectance², at most .16. Where a lit material sets `ior` and no
//! `reflectance`, F0 is that of `ior` (`surface_shading_lit.fs`), without a limit. So `ior` is written alone.

use super::coat::{ClearCoat, CoatLaw};
use super::engine_material::{Body, EngineMaterial, f0_of};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{Field, FieldValue, Node, Sheet};
use crate::physics::spectra::Space;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "filament",
    summary: "lines of a Filament material's fragment function",
    spaces: &[Space::Srgb],
    has_film: false,
    coat: Some(ClearCoat {
        law: CoatLaw::Schlick,
        fields: |_| {
            vec![
                Field::number("clearCoat", 1.0),
                Field::number("clearCoatRoughness", 0.0),
            ]
        },
        node: "material",
        remark: Some(
            "set clearCoatIorChange : false in the material's definition: baseColor is that below the coat already",
        ),
    }),
    sheet,
    text,
};

fn sheet(material: &EngineMaterial) -> Sheet {
    let (fields, f0) = match material.body {
        Body::Conductor => {
            let fields = vec![
                Field::colour("baseColor", material.f0),
                Field::number("metallic", 1.0),
                Field::number("roughness", 0.0),
            ];
            (fields, material.f0)
        }
        Body::Dielectric { ior, .. } => {
            let fields = vec![
                Field::number("metallic", 0.0),
                Field::number("roughness", 0.0),
                Field::number("ior", ior),
            ];
            (fields, [f0_of(ior); 3])
        }
    };
    let node = Node::new("material", fields, Model::schlick_f90_of_sum(f0));
    let remark = "a material that sets reflectance too takes F0 from that: leave it out";
    let is_dielectric = material.body != Body::Conductor;
    Sheet {
        nodes: vec![node],
        remarks: is_dielectric
            .then(|| remark.to_owned())
            .into_iter()
            .collect(),
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
    format::comments("//", &FORMAT, material, notes) + &lines
}
