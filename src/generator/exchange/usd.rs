//! USD: a UsdPreviewSurface as a text layer.
//!
//! Source: Pixar, "UsdPreviewSurface Specification", version 2.6, <https://openusd.org/release/spec_usdpreviewsurface.html>. All
//! materials use the specular workflow: F0 is `specularColor`, by Schlick's approximation, white at 90 degrees. With `metallic` 1
//! both ends would be `diffuseColor`, so that gold would be gold at 90 degrees too. A metal's `diffuseColor` is set to black; it
//! is grey by default. `opacity` 0 makes a dielectric clear, and keeps the reflection. `roughness` is .5 by default.

use super::engine_material::{Body, EngineMaterial};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{Field, FieldValue, Node, Sheet};
use crate::physics::spectra::Space;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "usd",
    summary: "a UsdPreviewSurface, as a .usda layer",
    spaces: &[Space::Srgb],
    has_film: false,
    coat: None,
    sheet,
    text,
};

fn sheet(material: &EngineMaterial) -> Sheet {
    let fields = match material.body {
        Body::Conductor => vec![
            Field::whole("useSpecularWorkflow", 1),
            Field::colour("diffuseColor", [0.0; 3]),
            Field::colour("specularColor", material.f0),
            Field::number("roughness", 0.0),
        ],
        Body::Dielectric { ior, is_clear, .. } => {
            let mut fields = vec![
                Field::whole("useSpecularWorkflow", 1),
                Field::colour("specularColor", material.f0),
                Field::number("roughness", 0.0),
                Field::number("ior", ior),
            ];
            if is_clear {
                fields.push(Field::number("opacity", 0.0));
            }
            fields
        }
    };
    let node = Node::new("UsdPreviewSurface", fields, Model::schlick(material.f0));
    Sheet {
        nodes: vec![node],
        remarks: Vec::new(),
    }
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    let name = &material.subject.name;
    let line = |field: &Field| {
        let numbers = field.value.numbers();
        let (ty, value) = match field.value {
            FieldValue::Colour(_) => ("color3f", format!("({numbers})")),
            FieldValue::Channels(_) => ("vector3f", format!("({numbers})")),
            FieldValue::Both(_) => ("float2", format!("({numbers})")),
            FieldValue::Number(_) => ("float", numbers),
            FieldValue::Whole(_) => ("int", numbers),
        };
        format!("        {ty} inputs:{} = {value}\n", field.name)
    };
    let fields = sheet.nodes.iter().flat_map(|node| &node.fields);
    let lines: String = fields.map(line).collect();
    // The first line must be USD's own.
    let head = format::comments("#", &FORMAT, material, notes);
    format!(
        "#usda 1.0\n{head}(\n    defaultPrim = \"{name}\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\ndef Material \"{name}\"\n{{\n    \
         token outputs:surface.connect = </{name}/surface.outputs:surface>\n\n    def Shader \"surface\"\n    {{\n        \
         uniform token info:id = \"UsdPreviewSurface\"\n{lines}        token outputs:surface\n    }}\n}}\n"
    )
}
