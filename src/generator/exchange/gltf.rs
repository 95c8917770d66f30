//! glTF 2.0: an asset with one material.
//!
//! Source: Khronos Group, "glTF 2.0 Specification", version 2.0.1, 2021,
//! <https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html>, appendix B, and the extensions KHR_materials_ior,
//! KHR_materials_specular, KHR_materials_transmission, KHR_materials_volume, KHR_materials_clearcoat, KHR_materials_dispersion and KHR_materials_iridescence of
//! the Khronos Group,
//! <https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos>.
//!
//! A metal's F0 is `baseColorFactor`. A dielectric's is that of `ior`, times `specularColorFactor`, at most 1. Both use Schlick's
//! approximation with 1 at 90 degrees. `dispersion` is 20 over Abbe's number, and needs a volume. `metallicFactor` and
//! `roughnessFactor` are 1 by default. A metal under one film is written twice: with the film's colours, and with the bare metal's
//! colours under a film of the extension, whose thickness without a texture is `iridescenceThicknessMaximum`, in nanometres. The minimum, 0,
//! is for a texture.

use serde::Serialize;

use super::coat::{ClearCoat, CoatLaw};
use super::engine_material::{Body, EngineFilm, EngineMaterial, f0_of, rounded};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{Field, FieldValue, Node, Sheet};
use crate::generator::envelope::{TOOL, json_text};
use crate::physics::materials::escaped;
use crate::physics::spectra::Space;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "gltf",
    summary: "a material of glTF 2.0, as a whole asset",
    spaces: &[Space::Srgb],
    has_film: true,
    coat: Some(ClearCoat {
        law: CoatLaw::Schlick,
        fields: |_| {
            vec![
                Field::number("clearcoatFactor", 1.0),
                Field::number("clearcoatRoughnessFactor", 0.0),
            ]
        },
        node: "material",
        remark: None,
    }),
    sheet,
    text,
};

/// `dispersion` times Abbe's number.
const DISPERSION: f64 = 20.0;

fn sheet(material: &EngineMaterial) -> Sheet {
    let mut remarks = vec![
        "the asset holds a material and no mesh: put it among the `materials` of a file with meshes of your own, and the names of its extensions into that file's `extensionsUsed`"
            .to_owned(),
    ];
    let (fields, f0) = match material.body {
        Body::Conductor => {
            let fields = vec![
                Field::colour("baseColorFactor", material.f0),
                Field::number("metallicFactor", 1.0),
                Field::number("roughnessFactor", 0.0),
            ];
            (fields, material.f0)
        }
        Body::Dielectric {
            ior,
            abbe,
            is_clear,
            attenuation,
        } => {
            let grey = f0_of(ior);
            let own = material.film.map_or(material.f0, |film| film.f0);
            let colour = own.map(|f0| if grey > 0.0 { rounded(f0 / grey) } else { 1.0 });
            let mut fields = vec![
                Field::number("metallicFactor", 0.0),
                Field::number("roughnessFactor", 0.0),
                Field::number("ior", ior),
                Field::colour("specularColorFactor", colour),
            ];
            if is_clear {
                fields.push(Field::number("transmissionFactor", 1.0));
                fields.push(Field::number("thicknessFactor", 1.0));
                if let Some(light) = attenuation {
                    fields.push(Field::colour("attenuationColor", light.colour));
                    fields.push(Field::number("attenuationDistance", light.distance_m));
                }
                remarks.push(
                    "thicknessFactor 1 is for closed bodies, in units of the mesh; set your own"
                        .to_owned(),
                );
            }
            if let Some(abbe) = abbe.filter(|_| is_clear) {
                fields.push(Field::number("dispersion", DISPERSION / abbe));
            }
            (fields, colour.map(|colour| (colour * grey).min(1.0)))
        }
    };
    let nodes = match (material.film, material.body) {
        (None, _) => vec![Node::new("material", fields, Model::schlick(f0))],
        (Some(film), Body::Dielectric { .. }) => {
            let fields = [fields, iridescence(&film)].concat();
            vec![Node::new("material", fields, Model::iridescence(&film, f0))]
        }
        (Some(film), Body::Conductor) => {
            remarks.push(
                "the first material has the colours of the film, the second, whose name ends in _iridescence, the bare metal and the film itself".to_owned(),
            );
            let bare = vec![
                Field::colour("baseColorFactor", film.f0),
                Field::number("metallicFactor", 1.0),
                Field::number("roughnessFactor", 0.0),
            ];
            let bare = [bare, iridescence(&film)].concat();
            vec![
                Node::new("material", fields, Model::schlick(f0)),
                Node::new("iridescence", bare, Model::iridescence(&film, film.f0)),
            ]
        }
    };
    Sheet { nodes, remarks }
}

/// The fields of a film.
fn iridescence(film: &EngineFilm) -> Vec<Field> {
    vec![
        Field::number("iridescenceFactor", 1.0),
        Field::number("iridescenceIor", film.ior),
        Field::number("iridescenceThicknessMinimum", 0.0),
        Field::number("iridescenceThicknessMaximum", film.thickness_nm),
    ]
}

/// The extensions that hold a field. All other fields belong to `pbrMetallicRoughness`.
const EXTENSIONS: [(&str, &str); 13] = [
    ("ior", "KHR_materials_ior"),
    ("specularColorFactor", "KHR_materials_specular"),
    ("transmissionFactor", "KHR_materials_transmission"),
    ("thicknessFactor", "KHR_materials_volume"),
    ("attenuationColor", "KHR_materials_volume"),
    ("attenuationDistance", "KHR_materials_volume"),
    ("clearcoatFactor", "KHR_materials_clearcoat"),
    ("clearcoatRoughnessFactor", "KHR_materials_clearcoat"),
    ("dispersion", "KHR_materials_dispersion"),
    ("iridescenceFactor", "KHR_materials_iridescence"),
    ("iridescenceIor", "KHR_materials_iridescence"),
    ("iridescenceThicknessMinimum", "KHR_materials_iridescence"),
    ("iridescenceThicknessMaximum", "KHR_materials_iridescence"),
];

type Object = serde_json::Map<String, serde_json::Value>;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Asset<'a> {
    asset: AssetHead<'a>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    extensions_used: Vec<&'static str>,
    materials: Vec<Material>,
}

#[derive(Serialize)]
struct AssetHead<'a> {
    version: &'static str,
    generator: &'static str,
    extras: Extras<'a>,
}

/// What other formats say in comments. The key `tool` is the mark of this program's JSON.
#[derive(Serialize)]
struct Extras<'a> {
    tool: &'static str,
    command: &'a str,
    about: Vec<String>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Material {
    name: String,
    pbr_metallic_roughness: Object,
    #[serde(skip_serializing_if = "Object::is_empty")]
    extensions: Object,
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    let mut used = Vec::new();
    let materials = sheet.nodes.iter().map(|node| {
        let suffix = if node.name == "material" {
            ""
        } else {
            "_iridescence"
        };
        let (mut core, mut extensions) = (Object::new(), Object::new());
        for field in &node.fields {
            let extension = EXTENSIONS.iter().find(|(name, _)| *name == field.name);
            let Some((_, extension)) = extension else {
                core.insert(field.name.to_owned(), value(field));
                continue;
            };
            if !used.contains(extension) {
                used.push(*extension);
            }
            let own = extensions
                .entry(*extension)
                .or_insert_with(|| Object::new().into());
            own[field.name] = value(field);
        }
        Material {
            name: format!("{}{suffix}", material.subject.name),
            pbr_metallic_roughness: core,
            extensions,
        }
    });
    let materials = materials.collect();
    let asset = Asset {
        asset: AssetHead {
            version: "2.0",
            generator: TOOL,
            extras: Extras {
                tool: TOOL,
                command: &notes.command,
                about: format::about(&FORMAT, material, notes),
            },
        },
        extensions_used: used,
        materials,
    };
    escaped(&json_text(&asset))
}

/// A field's value. The base colour has an alpha.
fn value(field: &Field) -> serde_json::Value {
    match field.value {
        FieldValue::Number(value) => value.into(),
        FieldValue::Whole(value) => value.into(),
        FieldValue::Colour([red, green, blue]) if field.name == "baseColorFactor" => {
            vec![red, green, blue, 1.0].into()
        }
        FieldValue::Colour(values) | FieldValue::Channels(values) => values.to_vec().into(),
        FieldValue::Both(value) => vec![value, value].into(),
    }
}
