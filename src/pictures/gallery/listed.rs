//! The page's materials as JSON, with the keys of version 2 of physicallybased.info's API, <https://api.physicallybased.info>, so that what
//! reads that reads this.
//!
//! `color` is F0 of a metal and 1 of a clear dielectric; `specularColor` of the format F82 is the tint at 81.79 degrees, as OpenPBR and
//! Blender take it; `ior` is of a dielectric at the d line. Materials under films, and those rarer than air, are left out.

use serde::Serialize;

use crate::generator::envelope::Origin;
use crate::generator::exchange::{Body, EngineMaterial};
use crate::generator::reference::MaterialInMedium;
use crate::physics::materials::ViewingConditions;

/// The file beside the page.
#[derive(Debug, Serialize)]
pub struct ListedMaterials {
    #[serde(flatten)]
    origin: Origin,
    header: Header,
    data: Vec<Listed>,
}

#[derive(Debug, Serialize)]
struct Header {
    license: &'static str,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Listed {
    name: String,
    color: Vec<InSpace>,
    metalness: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    specular_color: Vec<Tint>,
    roughness: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    ior: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    transmission: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    complex_ior: Vec<ComplexIndex>,
    category: Vec<&'static str>,
    description: String,
    references: Vec<Cited>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct InSpace {
    color_space: &'static str,
    color: [f64; 3],
}

#[derive(Debug, Serialize)]
struct Tint {
    format: [&'static str; 1],
    color: Vec<InSpace>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct ComplexIndex {
    color_space: &'static str,
    n: [f64; 3],
    k: [f64; 3],
}

#[derive(Debug, Serialize)]
struct Cited {
    title: String,
    url: String,
}

const SRGB: &str = "srgb-linear";

impl ListedMaterials {
    /// The list of these materials, which this command writes.
    pub fn new(command: &str, subjects: &[MaterialInMedium]) -> ListedMaterials {
        ListedMaterials {
            origin: Origin::new(command),
            header: Header {
                license: "CC0 1.0 Universal",
            },
            data: subjects.iter().filter_map(listed).collect(),
        }
    }
}

fn listed(subject: &MaterialInMedium) -> Option<Listed> {
    if subject.has_films() {
        return None;
    }
    let engine = EngineMaterial::new(subject, &ViewingConditions::default()).ok()?;
    let in_srgb = |color| {
        vec![InSpace {
            color_space: SRGB,
            color,
        }]
    };
    let material = &subject.material;
    let index = |values: [f64; 3]| values.map(|value| (value * 1e5).round() / 1e5);
    let channels = subject.effective.channels;
    let (is_metal, ior, is_clear) = match engine.body {
        Body::Conductor => (true, None, false),
        Body::Dielectric { ior, is_clear, .. } => (false, Some(ior), is_clear),
    };
    Some(Listed {
        name: subject.name.clone(),
        color: in_srgb(if is_metal { engine.f0 } else { [1.0; 3] }),
        metalness: f64::from(u8::from(is_metal)),
        specular_color: if is_metal {
            vec![Tint {
                format: ["F82"],
                color: in_srgb(engine.tint.map(|tint| tint.clamp(0.0, 1.0))),
            }]
        } else {
            Vec::new()
        },
        roughness: 0.0,
        ior,
        transmission: (!is_metal).then_some(f64::from(u8::from(is_clear))),
        complex_ior: if is_metal {
            vec![ComplexIndex {
                color_space: SRGB,
                n: index(channels.n),
                k: index(channels.k),
            }]
        } else {
            Vec::new()
        },
        category: vec![material.class_name()],
        description: material.summary.clone(),
        references: vec![Cited {
            title: material.reference.clone(),
            url: material.link.clone(),
        }],
    })
}
