//! Unreal Engine: inputs of the material Default Lit, and F0 and F90 of a Substrate slab.
//!
//! Source: Epic Games, "Physically Based Materials in Unreal Engine",
//! <https://dev.epicgames.com/documentation/en-us/unreal-engine/physically-based-materials-in-unreal-engine>, and the engine's
//! BRDF.ush. Default Lit: F0 = lerp(.08 Specular, Base Color, Metallic), so a dielectric has one grey F0 of at most .08. F is
//! Schlick's approximation with min(50 F0, 1) of the green channel at 90 degrees. A slab takes F0 and F90 as colours, and
//! multiplies F90 by the same minimum for the largest channel. Roughness is .5 by default.

use super::engine_material::{Body, EngineMaterial, f0_of, rounded};
use super::format::{self, Format, Notes};
use super::model::Model;
use super::sheet::{self, Field, Node, Sheet};
use crate::physics::spectra::Space;

/// F0 where Specular is 1.
const SPECULAR_F0: f64 = 0.08;
/// The ratio of F90 to a channel of F0, for F90 up to 1.
const F90_SHARE: f64 = 50.0;

/// The record of this format.
pub static FORMAT: Format = Format {
    name: "unreal",
    summary: "inputs of Unreal Engine's Default Lit and of a Substrate slab, as TOML",
    spaces: &Space::ALL,
    has_film: false,
    coat: None,
    sheet,
    text,
};

fn sheet(material: &EngineMaterial) -> Sheet {
    let (lit, remark) = match material.body {
        Body::Conductor => (metal(material), None),
        Body::Dielectric { ior, .. } => dielectric(ior),
    };
    let slab = slab(material);
    Sheet {
        nodes: vec![lit, slab],
        remarks: remark.into_iter().collect(),
    }
}

/// A slab fades F90 out as Default Lit does, by the largest channel. Its diffuse albedo is .18 by default.
fn slab(material: &EngineMaterial) -> Node {
    let mut fields = vec![
        Field::colour("F0", material.f0),
        Field::colour("F90", [1.0; 3]),
        Field::number("Roughness", 0.0),
    ];
    if material.body == Body::Conductor {
        fields.insert(0, Field::colour("DiffuseAlbedo", [0.0; 3]));
    }
    let words = "Schlick's approximation, F90 by min(50 of the largest channel of F0, 1)";
    let largest = material.f0.iter().copied().fold(0.0, f64::max);
    Node {
        name: "substrate_slab",
        fields,
        model: Model::schlick_f90(words, material.f0, (F90_SHARE * largest).min(1.0)),
    }
}

fn metal(material: &EngineMaterial) -> Node {
    Node {
        name: "default_lit",
        fields: vec![
            Field::colour("BaseColor", material.f0),
            Field::number("Metallic", 1.0),
            Field::number("Roughness", 0.0),
        ],
        model: lit(material.f0),
    }
}

fn dielectric(ior: f64) -> (Node, Option<String>) {
    let whole = f0_of(ior) / SPECULAR_F0;
    let specular = rounded(whole.min(1.0));
    let remark = format!(
        "Specular {} is limited to 1: Default Lit reflects {SPECULAR_F0} at most at 0 degrees; a Substrate slab has no such limit",
        rounded(whole)
    );
    let node = Node {
        name: "default_lit",
        fields: vec![
            Field::number("Metallic", 0.0),
            Field::number("Roughness", 0.0),
            Field::number("Specular", specular),
            Field::number("Refraction", ior),
        ],
        model: lit([specular * SPECULAR_F0; 3]),
    };
    (node, (whole > 1.0).then_some(remark))
}

fn lit(f0: [f64; 3]) -> Model {
    let words = "Schlick's approximation, F90 by min(50 F0, 1)";
    Model::schlick_f90(words, f0, (F90_SHARE * f0[1]).min(1.0))
}

fn text(material: &EngineMaterial, sheet: &Sheet, notes: &Notes) -> String {
    format::comments("#", &FORMAT, material, notes) + &sheet::toml(sheet)
}
