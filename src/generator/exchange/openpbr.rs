//! OpenPBR 1.1.1: a metal is F82-tint with `base_color` as F0 and `specular_color` as the tint, a dielectric is the exact law of
//! `specular_ior`.
//!
//! Source: Andersson and others, "OpenPBR Surface specification, version 1.1.1", 2026,
//! <https://academysoftwarefoundation.github.io/OpenPBR/>, sections on the metallic and the dielectric base. Parameters do not
//! state their space: a host takes their colours in its working space, for which OpenPBR recommends ACEScg. The file is in the
//! space of the run, and says so where that is another. `base_color` and `specular_color` lie in [0, 1]. Dispersion is Abbe's
//! number with a scale, which is 0 by default. A film has `thin_film_thickness` in micrometres, and `thin_film_ior`; a metal under one
//! film is written twice, with the film's colours and with the bare metal's under the film. Of how a film is computed the specification
//! recommends Belcour and Barla's series, with a complex index of the metal. `specular_roughness` is .3 by default.

use super::coat::{ClearCoat, CoatLaw};
use super::engine_material::{Body, EngineFilm, EngineMaterial};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{self, Field, Node, Sheet, capped_tint};
use crate::physics::spectra::Space;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "openpbr",
    summary: "parameters of OpenPBR 1.1.1, as TOML",
    spaces: &Space::ALL,
    has_film: true,
    coat: Some(ClearCoat {
        law: CoatLaw::Exact,
        fields: coat_fields,
        node: "open_pbr_surface",
        remark: Some(NO_DARKENING),
    }),
    sheet,
    text,
};

/// The fields of a clear coat of this index.
pub fn coat_fields(index: f64) -> Vec<Field> {
    vec![
        Field::number("coat_weight", 1.0),
        Field::number("coat_roughness", 0.0),
        Field::number("coat_ior", index),
        Field::number("coat_darkening", 0.0),
    ]
}

/// All reflections between base and coat are in the base's colours.
pub const NO_DARKENING: &str = "coat_darkening is 0: the colours of the base have all reflections between base and coat in them";

fn sheet(material: &EngineMaterial) -> Sheet {
    let (node, remark) = surface(material, "open_pbr_surface");
    let under = under_film(material);
    let both = under.as_ref().map(|_| {
        "[open_pbr_surface] has the colours of the film, [thin_film] the film itself: take one. The nodes of MaterialX 1.39 halve what a metal reflects under a film"
            .to_owned()
    });
    let depth = transmission(material);
    let remarks = remark
        .into_iter()
        .chain(both)
        .chain(of_space(material))
        .chain(depth);
    Sheet {
        nodes: [node].into_iter().chain(under).collect(),
        remarks: remarks.collect(),
    }
}

/// A metal under one film, with the film's parameters.
fn under_film(material: &EngineMaterial) -> Option<Node> {
    let film = material.film.filter(|_| material.body == Body::Conductor)?;
    let fields = vec![
        Field::colour("base_color", film.f0),
        Field::number("base_metalness", 1.0),
        Field::number("specular_roughness", 0.0),
        Field::colour("specular_color", film.tint.map(|tint| tint.min(1.0))),
    ];
    let fields = [fields, thin_film(&film)].concat();
    Some(Node::new(
        "thin_film",
        fields,
        Model::airy(OF_COLOURS, &film, film.n, film.k),
    ))
}

/// What a host computes of a film, as the specification asks for it.
const OF_COLOURS: &str = "Airy's series of the film, on the n and k that both colours stand for";
const OF_INDEX: &str = "Airy's series of the film";

/// The fields of a film.
fn thin_film(film: &EngineFilm) -> Vec<Field> {
    vec![
        Field::number("thin_film_weight", 1.0),
        Field::number("thin_film_thickness", film.thickness_nm / 1000.0),
        Field::number("thin_film_ior", film.ior),
    ]
}

/// A remark on the unit of the depth.
pub fn transmission(material: &EngineMaterial) -> Option<String> {
    material
        .attenuation()
        .map(|_| "transmission_depth is in metres: turn it into the units of the scene".to_owned())
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
            attenuation,
        } => {
            let mut fields = vec![
                Field::number("base_metalness", 0.0),
                Field::number("specular_roughness", 0.0),
                Field::number("specular_ior", ior),
            ];
            if is_clear {
                fields.push(Field::number("transmission_weight", 1.0));
                if let Some(light) = attenuation {
                    fields.push(Field::colour("transmission_color", light.colour));
                    fields.push(Field::number("transmission_depth", light.distance_m));
                }
            }
            if let Some(abbe) = abbe.filter(|_| is_clear) {
                fields.push(Field::number("transmission_dispersion_scale", 1.0));
                fields.push(Field::number("transmission_dispersion_abbe_number", abbe));
            }
            match material.film {
                None => (fields, Model::dielectric(ior), None),
                Some(film) => {
                    let fields = [fields, thin_film(&film)].concat();
                    (
                        fields,
                        Model::airy(OF_INDEX, &film, [ior; 3], [0.0; 3]),
                        None,
                    )
                }
            }
        }
    };
    let node = Node::new(name, fields, model);
    (node, remark)
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    format::comments("#", &FORMAT, material, notes) + &sheet::toml(sheet)
}
