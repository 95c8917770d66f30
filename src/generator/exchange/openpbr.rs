//! OpenPBR 1.1.1: a metal is F82-tint with `base_color` as F0 and `specular_color` as the tint, a dielectric is the exact law of
//! `specular_ior`.
//!
//! Source: Andersson and others, "OpenPBR Surface specification, version 1.1.1", 2026,
//! <https://academysoftwarefoundation.github.io/OpenPBR/>, sections on the metallic and the dielectric base. Parameters do not
//! state their space: a host takes their colours in its working space, for which OpenPBR recommends ACEScg. The file is in the
//! space of the run, and says so where that is another. `base_color` and `specular_color` lie in [0, 1]. Dispersion is Abbe's
//! number with a scale, which is 0 by default. `specular_roughness` is .3 by default.

use super::engine_material::{Body, EngineMaterial};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{self, Field, Node, Sheet, capped_tint};
use crate::physics::spectra::Space;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "openpbr",
    summary: "parameters of OpenPBR 1.1.1, as TOML",
    spaces: &Space::ALL,
    sheet,
    text,
};

fn sheet(material: &EngineMaterial) -> Sheet {
    let (node, remark) = surface(material, "open_pbr_surface");
    Sheet {
        nodes: vec![node],
        remarks: remark.into_iter().chain(of_space(material)).collect(),
    }
}

/// A remark on the space of colours, if it is not the one that OpenPBR takes.
fn of_space(material: &EngineMaterial) -> Option<String> {
    let has_colours = material.body == Body::Conductor;
    let space = material
        .space
        .filter(|space| has_colours && *space != Space::AcesCg)?;
    Some(format!(
        "colours are in {}; OpenPBR takes ACEScg where nothing else is said: name the space where you set them, or write them in acescg",
        space.title()
    ))
}

/// The parameters, and a remark if any was clamped.
pub fn surface(material: &EngineMaterial, name: &'static str) -> (Node, Option<String>) {
    let (fields, model, remark) = match material.body {
        Body::Conductor => {
            let (tint, remark) = capped_tint(material, "specular_color");
            let fields = vec![
                Field::colour("base_color", material.f0),
                Field::number("base_metalness", 1.0),
                Field::number("specular_roughness", 0.0),
                Field::colour("specular_color", tint),
            ];
            (fields, Model::f82_tint(material.f0, tint), remark)
        }
        Body::Dielectric {
            ior,
            abbe,
            is_clear,
        } => {
            let mut fields = vec![
                Field::number("base_metalness", 0.0),
                Field::number("specular_roughness", 0.0),
                Field::number("specular_ior", ior),
            ];
            if is_clear {
                fields.push(Field::number("transmission_weight", 1.0));
            }
            if let Some(abbe) = abbe.filter(|_| is_clear) {
                fields.push(Field::number("transmission_dispersion_scale", 1.0));
                fields.push(Field::number("transmission_dispersion_abbe_number", abbe));
            }
            (fields, Model::dielectric(ior), None)
        }
    };
    let node = Node::new(name, fields, model);
    (node, remark)
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    format::comments("#", &FORMAT, material, notes) + &sheet::toml(sheet)
}
