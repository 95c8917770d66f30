//! MaterialX 1.39: `open_pbr_surface`, and for metals two nodes with a wider range: `generalized_schlick_bsdf`, whose tint may
//! exceed 1, and `conductor_bsdf`, which takes n and k.
//!
//! Source: MaterialX, "Physically Based Shading Nodes, version 1.39", 2024,
//! <https://github.com/AcademySoftwareFoundation/MaterialX/blob/main/documents/Specification/MaterialX.PBRSpec.md>. `color0` is
//! F0, `color82` the tint of F82-tint, `color90` the reflectance at 90 degrees. `ior` and `extinction` have a colour type but are
//! not colours: the space `none` keeps them unchanged. Yet the F computed from them is a colour of the document's space.
//! Roughness is .05 by default, .3 in OpenPBR. `conductor_bsdf` takes a film, its thickness in nanometres: the same metal bare, under
//! it. `open_pbr_surface` of 1.39 halves what a metal under a film reflects, and is not written for one.

use super::coat::{ClearCoat, CoatLaw};
use super::engine_material::{Body, EngineMaterial, rounded};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::openpbr;
use super::sheet::{Field, FieldValue, Node, Sheet};
use crate::generator::emit::{MARK, XmlDocument, comment_lines};
use crate::physics::spectra::Space;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "materialx",
    summary: "a document of MaterialX 1.39, .mtlx",
    spaces: &[Space::Srgb, Space::DisplayP3, Space::AcesCg],
    has_film: true,
    coat: Some(ClearCoat {
        law: CoatLaw::Exact,
        fields: openpbr::coat_fields,
        node: OPEN_PBR,
        remark: Some(openpbr::NO_DARKENING),
    }),
    sheet,
    text,
};

const OPEN_PBR: &str = "open_pbr_surface";
/// A second `conductor_bsdf`, with a film.
const FILMED: &str = "conductor_bsdf_thinfilm";

/// The name of a space in MaterialX.
fn space(space: Space) -> &'static str {
    match space {
        Space::Srgb => "lin_rec709",
        Space::DisplayP3 => "lin_displayp3",
        Space::AcesCg => "acescg",
        Space::Rec2020 => "lin_rec2020",
    }
}

fn sheet(material: &EngineMaterial) -> Sheet {
    let (surface, remark) = openpbr::surface(material, OPEN_PBR);
    let mut nodes = vec![surface];
    let mut remarks: Vec<String> = remark.into_iter().collect();
    remarks.extend(openpbr::transmission(material));
    if material.body == Body::Conductor {
        let channels = &material.subject.effective.channels;
        let [n, k] = [channels.n, channels.k].map(|index| index.map(rounded));
        nodes.push(Node {
            name: "generalized_schlick_bsdf",
            fields: vec![
                Field::colour("color0", material.f0),
                Field::colour("color82", material.tint),
                Field::colour("color90", [1.0; 3]),
                Field::both("roughness", 0.0),
            ],
            model: Model::f82_tint(material.f0, material.tint),
        });
        nodes.push(Node {
            name: "conductor_bsdf",
            fields: vec![
                Field::channels("ior", n),
                Field::channels("extinction", k),
                Field::both("roughness", 0.0),
            ],
            model: Model::conductor(n, k),
        });
        nodes.extend(material.film.map(|film| Node {
            name: FILMED,
            fields: vec![
                Field::channels("ior", film.n),
                Field::channels("extinction", film.k),
                Field::both("roughness", 0.0),
                Field::number("thinfilm_thickness", film.thickness_nm),
                Field::number("thinfilm_ior", film.ior),
            ],
            model: Model::airy(
                "Airy's series of the film, with n and k of the base",
                &film,
                film.n,
                film.k,
            ),
        }));
        remarks.extend(of_conductor(material));
    }
    Sheet { nodes, remarks }
}

/// A remark on n and k: no host converts them to another space.
fn of_conductor(material: &EngineMaterial) -> Option<String> {
    let space = space(material.space?);
    Some(format!(
        "conductor_bsdf: n and k are no colours, and a host leaves them as they are (colorspace none); they belong to {space}: for a host with another working space write the file in that one"
    ))
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    let mut document = XmlDocument::new(MARK);
    document.comment(&comment_lines(format::about(&FORMAT, material, notes)));
    // A comment may not hold two hyphens in a row, but a command does.
    let doc = format::regenerate(notes);
    let mut attributes = vec![("version", "1.39")];
    attributes.extend(material.space.map(|own| ("colorspace", space(own))));
    attributes.push(("doc", &doc));
    document.open("materialx", &attributes);
    for node in &sheet.nodes {
        shader(&mut document, &material.subject.name, node);
    }
    document.finished()
}

/// A node with the surface around it, and a material that refers to it.
fn shader(document: &mut XmlDocument, material: &str, node: &Node) {
    let name = format!("{material}_{}", node.name);
    let kind = if node.name == FILMED {
        "conductor_bsdf"
    } else {
        node.name
    };
    let is_surface = kind == OPEN_PBR;
    let ty = if is_surface { "surfaceshader" } else { "BSDF" };
    document.open(kind, &[("name", &name), ("type", ty)]);
    for field in &node.fields {
        input(document, field);
    }
    document.close();
    let surface = if is_surface {
        name
    } else {
        surface_of(document, &name)
    };
    let of_material = format!("{surface}_material");
    document.open(
        "surfacematerial",
        &[("name", &of_material), ("type", "material")],
    );
    connected(document, "surfaceshader", "surfaceshader", &surface);
    document.close();
}

/// The surface that shows a BSDF, by the BSDF's name.
fn surface_of(document: &mut XmlDocument, bsdf: &str) -> String {
    let surface = format!("{bsdf}_surface");
    document.open("surface", &[("name", &surface), ("type", "surfaceshader")]);
    connected(document, "bsdf", "BSDF", bsdf);
    document.close();
    surface
}

fn connected(document: &mut XmlDocument, name: &str, ty: &str, node: &str) {
    let attributes = [("name", name), ("type", ty), ("nodename", node)];
    document.empty("input", &attributes);
}

fn input(document: &mut XmlDocument, field: &Field) {
    let ty = match field.value {
        FieldValue::Colour(_) | FieldValue::Channels(_) => "color3",
        FieldValue::Both(_) => "vector2",
        FieldValue::Number(_) => "float",
        FieldValue::Whole(_) => "integer",
    };
    let numbers = field.value.numbers();
    let mut attributes = vec![("name", field.name), ("type", ty), ("value", &numbers)];
    if let FieldValue::Channels(_) = field.value {
        // Otherwise a host converts them to its working space with the colours.
        attributes.push(("colorspace", "none"));
    }
    document.empty("input", &attributes);
}
