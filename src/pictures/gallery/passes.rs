//! The passes of a row as the page draws them, the text of functions as a reader copies it, and the pass that puts the panels
//! side by side.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::lower::{GlesProgram, LoweringFault, lowered};
use super::orbit::Orbit;
use super::packed::SKY;
use crate::generator::emit::{
    self, EffectRequest, EmittedFunction, Naming, effect_function_text, library_functions,
    validate_wgsl,
};
use crate::lab::gpu::Depth;
use crate::language::methods::Method;
use crate::language::{effects, methods, targets};
use crate::pictures::scene::{BACK, DrawnSurface, PHOTONS, PassRow, RenderRow, Slot, TRIANGLES};

/// A pass.
#[derive(Clone, Debug, Serialize)]
pub struct GalleryPass {
    /// The vertex entry point.
    pub vertex: &'static str,
    /// The fragment entry point.
    pub fragment: &'static str,
    /// The mesh that is drawn; `None` for a triangle that covers the target.
    pub mesh: Option<String>,
    /// The number of vertices that the entry point makes itself, where there is no mesh.
    pub count: u32,
    /// Whether its output is added to the target.
    pub adds: bool,
    /// Whether its picture has a margin.
    pub margin: bool,
    /// The side of its picture in pixels, where it is not the panel's.
    pub side: Option<u32>,
    /// The depth test: off, the nearest surface, or the farthest.
    pub depth: &'static str,
    /// The index of its view in the orbit.
    pub view: usize,
    /// The slots that it writes.
    pub writes: Vec<String>,
    /// The slots that it reads, from binding 3 on.
    pub reads: Vec<String>,
}

/// The passes of a row with this orbit.
pub fn passes_of(row: &RenderRow, orbit: &Orbit) -> Vec<GalleryPass> {
    if row.receiver.is_some() {
        return light_passes(row);
    }
    let passes = row.passes.iter();
    passes.map(|pass| seen_pass(row, pass, orbit)).collect()
}

/// The passes of light that falls through a body onto a receiver: both sides of the body, photons, and the triangles between
/// them.
fn light_passes(row: &RenderRow) -> Vec<GalleryPass> {
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let side = |depth, side, writes: [&str; 2]| GalleryPass {
        vertex: "vs_body",
        fragment: "fs_side",
        mesh: Some(row.body.name().to_owned()),
        count: 0,
        adds: false,
        depth: depth_test(depth),
        view: 0,
        margin: false,
        side: Some(side),
        writes: names(&writes),
        reads: names(&[SKY]),
    };
    let front = ["FrontPositions", "FrontNormals"];
    let back = ["BackPositions", "BackNormals"];
    let photons = ["PhotonPlaces", "PhotonEnergies"];
    let drawn = |vertex, fragment, count, of: [&str; 2]| GalleryPass {
        vertex,
        fragment,
        mesh: None,
        count,
        reads: names(&[SKY, of[0], of[1], back[0], back[1]]),
        ..side(Depth::Unused, PHOTONS, photons)
    };
    vec![
        side(Depth::Nearest, PHOTONS, front),
        side(Depth::Farthest, BACK, back),
        drawn("vs_cover", "fs_photon", 3, front),
        GalleryPass {
            adds: true,
            side: None,
            writes: names(&["Colour"]),
            ..drawn(
                TRIANGLES.vertex,
                TRIANGLES.fragment,
                (TRIANGLES.vertices)(PHOTONS),
                photons,
            )
        },
    ]
}

fn seen_pass(row: &RenderRow, pass: &PassRow, orbit: &Orbit) -> GalleryPass {
    let reads = pass.reads.iter().map(slot);
    GalleryPass {
        vertex: pass.surface.vertex(),
        fragment: pass.fragment,
        mesh: match pass.surface {
            DrawnSurface::Everywhere => None,
            DrawnSurface::Front | DrawnSurface::Back => Some(row.body.name().to_owned()),
            DrawnSurface::Water => Some(format!("{} water", row.body.name())),
        },
        count: 3,
        adds: false,
        margin: pass.view.has_margin(),
        side: None,
        depth: depth_test(pass.surface.depth()),
        view: orbit.view(pass.view),
        writes: pass.writes.iter().map(slot).collect(),
        reads: [SKY.to_owned()].into_iter().chain(reads).collect(),
    }
}

/// The name of a depth test on the page.
fn depth_test(depth: Depth) -> &'static str {
    match depth {
        Depth::Unused => "none",
        Depth::Nearest => "nearest",
        Depth::Farthest => "farthest",
    }
}

fn slot(slot: &Slot) -> String {
    format!("{slot:?}")
}

/// A function in each language, with the comments above it.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionTexts {
    /// Its name.
    pub name: String,
    /// WGSL.
    pub wgsl: String,
    /// GLSL ES 3.00.
    pub gles: String,
    /// HLSL.
    pub hlsl: String,
}

/// The methods whose library functions a reader copies with the coefficients of a material.
pub const COPIED: [&str; 2] = ["fitted", "fitted_dielectric"];

/// The texts of the functions with these names.
///
/// # Errors
/// A function cannot be written: a bug.
pub fn texts(names: &BTreeSet<String>) -> Result<Vec<FunctionTexts>, emit::Error> {
    let mut all: BTreeMap<String, EmittedFunction> = BTreeMap::new();
    let is_copied = |method: &&&Method| method.keeps_inputs() || COPIED.contains(&method.name);
    for method in methods::ALL.iter().filter(is_copied) {
        for emitted in library_functions(method, &Naming::default())? {
            if names.contains(&emitted.name) {
                all.insert(emitted.name.clone(), emitted);
            }
        }
    }
    for effect in effects::ALL {
        for method in methods::ALL.iter().filter(|method| !method.keeps_inputs()) {
            let request = EffectRequest {
                effect,
                method,
                subject: None,
            };
            if !is_wanted(&request, names) {
                continue;
            }
            for emitted in request.functions(&Naming::default())? {
                if names.contains(&emitted.name) {
                    all.insert(emitted.name.clone(), emitted);
                }
            }
        }
    }
    let written = |(name, emitted): (String, EmittedFunction)| {
        let text = |target: &str| {
            let target = targets::find(target).expect("a target");
            effect_function_text(target, &emitted)
        };
        Ok(FunctionTexts {
            name,
            wgsl: text("wgsl")?,
            gles: text("gles")?,
            hlsl: text("hlsl")?,
        })
    };
    all.into_iter().map(written).collect()
}

/// Whether a function of these names may be one of an effect by a method.
fn is_wanted(request: &EffectRequest, names: &BTreeSet<String>) -> bool {
    let prefix = &Naming::default().prefix;
    let method = request.unusual_method().map(|name| format!("_{name}"));
    let suffix = method.unwrap_or_default();
    request.effect.functions.iter().any(|function| {
        let name = format!("{prefix}{}{suffix}", function.name);
        names.iter().any(|wanted| wanted.starts_with(&name))
    })
}

/// The text of the pass that shows the panels.
const SHOW: &str = include_str!("show.wgsl");

/// The programs of that pass.
#[derive(Clone, Debug, Serialize)]
pub struct ShowPrograms {
    /// For WebGPU.
    pub wgsl: &'static str,
    /// The vertex shader for WebGL 2.
    pub vertex: GlesProgram,
    /// The fragment shader for WebGL 2.
    pub fragment: GlesProgram,
}

/// The programs in both languages.
///
/// # Errors
/// naga refuses it: a bug.
pub fn programs() -> Result<ShowPrograms, LoweringFault> {
    let (module, _) = validate_wgsl(SHOW).map_err(LoweringFault)?;
    Ok(ShowPrograms {
        wgsl: SHOW,
        vertex: lowered(&module, "vs_cover", &[], false)?,
        fragment: lowered(&module, "fs_show", &[], false)?,
    })
}
