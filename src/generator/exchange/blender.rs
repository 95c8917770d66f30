//! Blender: lines of Python that set inputs of the Principled BSDF and, for metals, of the Metallic BSDF.
//!
//! Source: Blender Manual, "Principled BSDF" and "Metallic BSDF", version 4.4,
//! <https://docs.blender.org/manual/en/4.4/render/shader_nodes/shader/principled.html>. Principled (4.0 and later): a metal is
//! F82-tint with Base Color as F0 and Specular Tint as the tint, a dielectric is the exact law of IOR. Metallic BSDF (4.3 and
//! later) with F82: Base Color and Edge Tint. Cycles limits colours and tints of metals to [0, 1]. EEVEE uses lookup tables for
//! both, so its F only approximates that of Cycles: for dielectrics it is Schlick's. Roughness is .5 by default.

use super::engine_material::{Body, EngineMaterial};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{Field, FieldValue, Node, Sheet, capped_tint};
use crate::physics::spectra::Space;

/// The names of the nodes in reports, with how Python finds or makes them.
const PRINCIPLED: &str = "Principled BSDF";
const METALLIC: &str = "Metallic BSDF";

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "blender",
    summary: "Python for Blender 4.3 and later: inputs of Principled BSDF and Metallic BSDF",
    spaces: &Space::ALL,
    has_film: false,
    sheet,
    text,
};

fn sheet(material: &EngineMaterial) -> Sheet {
    match material.body {
        Body::Conductor => metal(material),
        Body::Dielectric { ior, is_clear, .. } => {
            let mut fields = vec![
                Field::number("Metallic", 0.0),
                Field::number("Roughness", 0.0),
                Field::number("IOR", ior),
            ];
            if is_clear {
                // Base Color tints transmitted light, and is grey by default.
                fields.push(Field::colour("Base Color", [1.0; 3]));
                fields.push(Field::number("Transmission Weight", 1.0));
            }
            let node = Node::new(PRINCIPLED, fields, Model::dielectric(ior));
            Sheet {
                nodes: vec![node],
                remarks: Vec::new(),
            }
        }
    }
}

fn metal(material: &EngineMaterial) -> Sheet {
    let (tint, remark) = capped_tint(material, "Specular Tint and Edge Tint");
    let f0 = Field::colour("Base Color", material.f0);
    let nodes = [
        (
            PRINCIPLED,
            vec![
                f0.clone(),
                Field::number("Metallic", 1.0),
                Field::number("Roughness", 0.0),
                Field::colour("Specular Tint", tint),
            ],
        ),
        (
            METALLIC,
            vec![
                f0,
                Field::number("Roughness", 0.0),
                Field::colour("Edge Tint", tint),
            ],
        ),
    ];
    let node = |(name, fields)| Node::new(name, fields, Model::f82_tint(material.f0, tint));
    Sheet {
        nodes: nodes.map(node).into(),
        remarks: remark.into_iter().collect(),
    }
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    let mut text = format::comments("#", &FORMAT, material, notes);
    text += &format!(
        "import bpy\n\nmaterial = bpy.data.materials.new(\"{}\")\nmaterial.use_fake_user = True  # it is saved, though no object has it yet\nif not material.node_tree:\n    material.use_nodes = True\nnodes = material.node_tree.nodes\n",
        material.subject.name
    );
    for node in &sheet.nodes {
        text += match node.name {
            METALLIC => {
                "\n# Connect its BSDF to the Surface of the output in place of the Principled BSDF.\nnode = nodes.new(\"ShaderNodeBsdfMetallic\")\nnode.fresnel_type = \"F82\"\n"
            }
            _ => "\nnode = next(node for node in nodes if node.type == \"BSDF_PRINCIPLED\")\n",
        };
        text.extend(node.fields.iter().map(line));
    }
    text
}

fn line(field: &Field) -> String {
    let numbers = field.value.numbers();
    let value = match field.value {
        FieldValue::Colour(_) => format!("({numbers}, 1.0)"),
        FieldValue::Channels(_) | FieldValue::Both(_) => format!("({numbers})"),
        FieldValue::Number(_) | FieldValue::Whole(_) => numbers,
    };
    format!("node.inputs[\"{}\"].default_value = {value}\n", field.name)
}
