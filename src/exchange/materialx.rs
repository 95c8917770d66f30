//! MaterialX 1.39: `open_pbr_surface`, and for metals two nodes that hold more: `generalized_schlick_bsdf`, whose tint may lie
//! above 1, and `conductor_bsdf`, which takes n and k.
//!
//! Source: MaterialX, "Physically Based Shading Nodes, version 1.39", 2024,
//! <https://github.com/AcademySoftwareFoundation/MaterialX/blob/main/documents/Specification/MaterialX.PBRSpec.md>.
//! `color0` is F0, `color82` the tint of F82-tint, `color90` the reflectance at 90 degrees.

use crate::emit::comment_lines;
use crate::spectra::Space;

use super::format::{Format, Notes};
use super::head;
use super::model::Model;
use super::openpbr;
use super::sheet::{Field, FieldValue, Node, Sheet};
use super::subject::{Body, EngineMaterial};

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "materialx",
    summary: "a document of MaterialX 1.39, .mtlx",
    spaces: &[Space::Srgb, Space::P3, Space::AcesCg],
    sheet,
    text,
};

const OPEN_PBR: &str = "open_pbr_surface";

/// The name of a space in MaterialX.
fn space(space: Space) -> &'static str {
    match space {
        Space::Srgb => "lin_rec709",
        Space::P3 => "lin_displayp3",
        Space::AcesCg => "acescg",
        Space::Rec2020 => "lin_rec2020",
    }
}

fn sheet(material: &EngineMaterial) -> Sheet {
    let (surface, remark) = openpbr::surface(material, OPEN_PBR);
    let mut nodes = vec![surface];
    if material.body == Body::Conductor {
        let Conductor { n, k } = conductor(material);
        nodes.push(Node {
            name: "generalized_schlick_bsdf",
            fields: vec![
                Field::colour("color0", material.f0),
                Field::colour("color82", material.tint),
                Field::colour("color90", [1.0; 3]),
            ],
            model: Model::f82_tint(material.f0, material.tint),
        });
        nodes.push(Node {
            name: "conductor_bsdf",
            fields: vec![Field::colour("ior", n), Field::colour("extinction", k)],
            model: Model::conductor(n, k),
        });
    }
    Sheet {
        nodes,
        remarks: remark.into_iter().collect(),
    }
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    let colorspace = material.space.map_or(String::new(), |own| {
        format!(" colorspace=\"{}\"", space(own))
    });
    // A comment of XML holds no two hyphens, and a command does: it stands in an attribute.
    let about = comment_lines(head::about(&FORMAT, material, notes));
    let about: String = about.iter().map(|line| format!("  {line}\n")).collect();
    let about = about.replace("--", "- -");
    let doc = escaped(&head::regenerate(notes));
    let name = &material.subject.name;
    let nodes: String = sheet.nodes.iter().map(|node| shader(name, node)).collect();
    format!(
        "<?xml version=\"1.0\"?> <!-- {} -->\n<!--\n{about}-->\n<materialx version=\"1.39\"{colorspace} doc=\"{doc}\">\n{nodes}</materialx>\n",
        head::mark()
    )
}

/// A node with the surface around it, and the material that names it.
fn shader(material: &str, node: &Node) -> String {
    let kind = node.name;
    let inputs: String = node.fields.iter().map(input).collect();
    let (surface, body) = match kind {
        OPEN_PBR => {
            let surface = format!("{material}_{kind}");
            let body = format!(
                "  <{kind} name=\"{surface}\" type=\"surfaceshader\">\n{inputs}  </{kind}>\n"
            );
            (surface, body)
        }
        _ => {
            let (bsdf, surface) = (
                format!("{material}_{kind}"),
                format!("{material}_{kind}_surface"),
            );
            let body = format!(
                "  <{kind} name=\"{bsdf}\" type=\"BSDF\">\n{inputs}  </{kind}>\n  <surface name=\"{surface}\" type=\"surfaceshader\">\n    \
                 <input name=\"bsdf\" type=\"BSDF\" nodename=\"{bsdf}\" />\n  </surface>\n"
            );
            (surface, body)
        }
    };
    format!(
        "{body}  <surfacematerial name=\"{surface}_material\" type=\"material\">\n    \
         <input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"{surface}\" />\n  </surfacematerial>\n"
    )
}

fn input(field: &Field) -> String {
    let (kind, numbers) = match field.value {
        FieldValue::Colour(_) => ("color3", field.value.numbers()),
        FieldValue::Number(_) => ("float", field.value.numbers()),
        FieldValue::Whole(_) => ("integer", field.value.numbers()),
    };
    format!(
        "    <input name=\"{}\" type=\"{kind}\" value=\"{numbers}\" />\n",
        field.name
    )
}

/// The index of each channel as it is written.
struct Conductor {
    n: [f64; 3],
    k: [f64; 3],
}

fn conductor(material: &EngineMaterial) -> Conductor {
    let channels = &material.subject.effective.channels;
    Conductor {
        n: channels.n.map(super::subject::rounded),
        k: channels.k.map(super::subject::rounded),
    }
}

/// Text of an attribute.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}
