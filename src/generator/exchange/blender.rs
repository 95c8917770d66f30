//! Blender: lines of Python that set inputs of the Principled BSDF and, for metals, of the Metallic BSDF.
//!
//! Source: Blender Manual, "Principled BSDF" and "Metallic BSDF", version 4.4,
//! <https://docs.blender.org/manual/en/4.4/render/shader_nodes/shader/principled.html>. Principled (4.0 and later): a metal is
//! F82-tint with Base Color as F0 and Specular Tint as the tint, a dielectric is the exact law of IOR. Metallic BSDF (4.3 and
//! later) with F82: Base Color and Edge Tint. Cycles limits colours and tints of metals to [0, 1]. EEVEE uses lookup tables for
//! both, so its F only approximates that of Cycles: for dielectrics it is Schlick's. Roughness is .5 by default.
//!
//! Thin Film Thickness (nm) and Thin Film IOR belong to dielectrics of the Principled BSDF from 4.2 on, and from 5.0 on to metals and to the
//! Metallic BSDF too, whose Physical Conductor takes n and k. Before 5.0 a metal has the film's colours.

use super::coat::{ClearCoat, CoatLaw};
use super::cycles_film::{CyclesBase, CyclesFilm};
use super::engine_material::{Body, EngineFilm, EngineMaterial, rounded};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{Field, FieldValue, Node, Sheet, capped_tint};
use crate::physics::spectra::Space;

/// The names of the nodes in reports, with how Python finds or makes them.
const PRINCIPLED: &str = "Principled BSDF";
const METALLIC: &str = "Metallic BSDF";
/// Its Physical Conductor.
const CONDUCTOR: &str = "Metallic BSDF of n and k";
/// The same of a metal under a film.
const FILMED: &str = "Principled BSDF with Thin Film";
const FILMED_CONDUCTOR: &str = "Metallic BSDF with Thin Film";

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "blender",
    summary: "Python for Blender 4.3 and later: inputs of Principled BSDF and Metallic BSDF",
    spaces: &Space::ALL,
    has_film: true,
    coat: Some(ClearCoat {
        law: CoatLaw::Exact,
        fields: |index| {
            vec![
                Field::number("Coat Weight", 1.0),
                Field::number("Coat Roughness", 0.0),
                Field::number("Coat IOR", index),
            ]
        },
        node: PRINCIPLED,
        remark: None,
    }),
    sheet,
    text,
};

fn sheet(material: &EngineMaterial) -> Sheet {
    match material.body {
        Body::Conductor => match material.film {
            Some(film) => filmed_metal(material, &film),
            None => metal(material),
        },
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
            let model = match material.film {
                None => Model::dielectric(ior),
                Some(film) => {
                    fields.extend(thin_film(&film));
                    let words = "Airy's series of the film, as Cycles has it";
                    Model::cycles_film(words, on(&film, CyclesBase::Dielectric(ior)))
                }
            };
            let node = Node::new(PRINCIPLED, fields, model);
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
    let channels = &material.subject.effective.channels;
    let [n, k] = [channels.n, channels.k].map(|index| index.map(rounded));
    let conductor = vec![
        Field::channels("IOR", n),
        Field::channels("Extinction", k),
        Field::number("Roughness", 0.0),
    ];
    let conductor = Node::new(CONDUCTOR, conductor, Model::conductor(n, k));
    Sheet {
        nodes: nodes.map(node).into_iter().chain([conductor]).collect(),
        remarks: remark.into_iter().collect(),
    }
}

/// A metal under a film: with the film's colours, with the film on the bare metal's colours, and with the film on its n and k.
fn filmed_metal(material: &EngineMaterial, film: &EngineFilm) -> Sheet {
    let mut sheet = metal(material);
    sheet.nodes.retain(|node| node.name == PRINCIPLED);
    let tint = film.tint.map(|tint| tint.min(1.0));
    let coloured = vec![
        Field::colour("Base Color", film.f0),
        Field::number("Metallic", 1.0),
        Field::number("Roughness", 0.0),
        Field::colour("Specular Tint", tint),
    ];
    let conductor = vec![
        Field::channels("IOR", film.n),
        Field::channels("Extinction", film.k),
        Field::number("Roughness", 0.0),
    ];
    let tinted = on(film, CyclesBase::Tinted(film.f0, tint));
    let exact = on(film, CyclesBase::Conductor(film.n, film.k));
    let node = |name, fields: Vec<Field>, words, cycles| {
        let fields = [fields, thin_film(film).to_vec()].concat();
        Node::new(name, fields, Model::cycles_film(words, cycles))
    };
    sheet.nodes.extend([
        node(
            FILMED,
            coloured,
            "Airy's series of the film on F82-tint, as Cycles has it",
            tinted,
        ),
        node(
            FILMED_CONDUCTOR,
            conductor,
            "Airy's series of the film on n and k, as Cycles has it",
            exact,
        ),
    ]);
    sheet.remarks.push(
        "films on metals want Blender 5.0: before it the script sets the film's colours".to_owned(),
    );
    sheet
}

fn on(film: &EngineFilm, base: CyclesBase) -> CyclesFilm {
    CyclesFilm {
        ior: film.ior,
        thickness_nm: film.thickness_nm,
        base,
    }
}

fn thin_film(film: &EngineFilm) -> [Field; 2] {
    [
        Field::number("Thin Film Thickness", film.thickness_nm),
        Field::number("Thin Film IOR", film.ior),
    ]
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    let mut text = format::comments("#", &FORMAT, material, notes);
    text += &format!(
        "import bpy\n\nmaterial = bpy.data.materials.new(\"{}\")\nmaterial.use_fake_user = True  # it is saved, though no object has it yet\nif not material.node_tree:\n    material.use_nodes = True\nnodes = material.node_tree.nodes\n",
        material.subject.name
    );
    let has_both = sheet.nodes.iter().any(|node| node.name == FILMED);
    for node in &sheet.nodes {
        // Of a metal under a film the version decides.
        let (head, indent) = match (node.name, has_both) {
            (_, false) => ("", ""),
            (PRINCIPLED, true) => ("\nif bpy.app.version < (5, 0, 0):", "    "),
            (FILMED, true) => ("\nelse:", "    "),
            (_, true) => ("", "    "),
        };
        text += head;
        let found: &[&str] = match node.name {
            METALLIC | CONDUCTOR | FILMED_CONDUCTOR => &[
                "",
                "# Connect its BSDF to the Surface of the output in place of the Principled BSDF.",
                "node = nodes.new(\"ShaderNodeBsdfMetallic\")",
                match node.name {
                    METALLIC => "node.fresnel_type = \"F82\"",
                    _ => "node.fresnel_type = \"PHYSICAL_CONDUCTOR\"",
                },
            ],
            _ => &[
                "",
                "node = next(node for node in nodes if node.type == \"BSDF_PRINCIPLED\")",
            ],
        };
        let fields = node.fields.iter().map(line);
        for line in found.iter().map(|line| (*line).to_owned()).chain(fields) {
            let indent = if line.is_empty() { "" } else { indent };
            text += &format!("{indent}{line}\n");
        }
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
    format!("node.inputs[\"{}\"].default_value = {value}", field.name)
}
