//! A row of the gallery: passes, their texts, and the calls of each method.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::effects::Reflectance;
use crate::materials::MaterialKind;
use crate::methods::{self, Class, Light, Method};
use crate::reference::MaterialInMedium;
use crate::scene::{BACK, FRAME, PHOTONS, Place, RenderRow, RowText, Slot};

use super::lower::{FRAGMENT_FRAME, GlesProgram, LoweringFault, STAND_IN, lowered};
use super::orbit::Orbit;
use super::packed::SKY;

/// A row.
#[derive(Clone, Debug, Serialize)]
pub struct GalleryRow {
    /// Its name.
    pub name: &'static str,
    /// One line.
    pub summary: &'static str,
    /// Where it must be wrong, in one line.
    pub wrong: &'static str,
    /// The exact law of its kind of bodies.
    pub exact: &'static str,
    /// Its own method.
    pub method: &'static str,
    /// Its own material.
    pub material: &'static str,
    /// The materials that it takes, by name.
    pub materials: Vec<String>,
    /// Whether the index depends on the wavelength.
    pub disperses: bool,
    /// Its passes.
    pub passes: Vec<GalleryPass>,
    /// The functions that every method needs.
    pub functions: Vec<String>,
    /// The row's own text in WGSL.
    pub text: &'static str,
    /// Each method's calls.
    pub calls: Vec<MethodCalls>,
    /// Programs for WebGL 2, by pass.
    pub programs: Vec<ProgramPair>,
    /// The place of its orbit.
    pub orbit: usize,
    /// Half the width of the window, where light falls onto a receiver.
    pub half: Option<f64>,
    /// The roughness that it begins with, where it has one.
    pub roughness: Option<f64>,
    /// The stops that it begins with.
    pub exposure: f64,
    /// The textures that it reads, by slot.
    pub images: BTreeMap<String, String>,
}

/// A pass.
#[derive(Clone, Debug, Serialize)]
pub struct GalleryPass {
    /// The entry point for vertices.
    pub vertex: &'static str,
    /// The entry point for pixels.
    pub fragment: &'static str,
    /// What is drawn; a triangle that covers the target where nothing is named.
    pub mesh: Option<String>,
    /// Vertices that the entry point makes itself, where there is no mesh.
    pub count: u32,
    /// Whether it is added to what is there.
    pub adds: bool,
    /// Whether its picture has a margin.
    pub margin: bool,
    /// Pixels a side of its picture, where these are not the panel's.
    pub side: Option<u32>,
    /// Which surface is seen: none is hidden, the nearest, the farthest.
    pub depth: &'static str,
    /// The place of its view in the orbit.
    pub view: usize,
    /// What it writes.
    pub writes: Vec<String>,
    /// What it reads, from binding 3 on.
    pub reads: Vec<String>,
}

/// What a method adds to a row.
#[derive(Clone, Debug, Serialize)]
pub struct MethodCalls {
    /// The method.
    pub method: &'static str,
    /// The functions that are called, the one for the surface first.
    pub functions: Vec<String>,
    /// The calls in WGSL.
    pub wgsl: String,
    /// The calls in GLSL ES.
    pub gles: String,
    /// What computes the light that leaves a body, where this method does not.
    pub exit: Option<&'static str>,
}

/// A program for WebGL 2.
#[derive(Clone, Debug, Serialize)]
pub struct ProgramPair {
    /// For vertices.
    pub vertex: GlesProgram,
    /// For pixels.
    pub fragment: GlesProgram,
}

/// The exact law of a row's kind of bodies.
pub fn exact_method(row: &RenderRow) -> &'static str {
    match row.is_transparent() {
        true => "dielectric_exact",
        false => "conductor_exact",
    }
}

/// The methods that a row may be drawn by: for unpolarised light, without a table.
pub fn methods_of(row: &RenderRow) -> Vec<&'static Method> {
    let all = methods::ALL.iter().copied().filter(|method| {
        method.light == Light::Unpolarised
            && !method.is_textured()
            && (row.is_transparent() || method.class == Class::Any)
    });
    all.collect()
}

impl GalleryRow {
    /// A row with its texts. Its orbit is entered among these.
    ///
    /// # Errors
    /// A text cannot be written or translated: a bug.
    pub fn new(
        row: &'static RenderRow,
        subjects: &[MaterialInMedium],
        (orbits, images): (&mut Vec<Orbit>, BTreeMap<String, String>),
    ) -> Result<GalleryRow, LoweringFault> {
        let orbit = Orbit::of(row, orbits);
        let common = RowText::usual(row).common_functions()?;
        let asks = |emitted: &&crate::emit::Emitted| {
            let part = emitted.effect.map(|part| part.function.reflectance);
            part != Some(Reflectance::Unused) && !row.text.contains(&format!("{}(", emitted.name))
        };
        // What asks for R stands among each method's own functions, unless passes call it themselves.
        let unused: Vec<String> = common
            .iter()
            .filter(asks)
            .map(|one| one.name.clone())
            .collect();
        let names: Vec<String> = common.iter().map(|one| one.name.clone()).collect();
        let takes = |subject: &&MaterialInMedium| {
            row.is_transparent() == (subject.material.kind == MaterialKind::Dielectric)
        };
        let passes = match row.receiver {
            Some(_) => light_passes(row),
            None => passes(row, &orbits[orbit]),
        };
        let calls = methods_of(row)
            .into_iter()
            .map(|method| method_calls(row, method));
        Ok(GalleryRow {
            name: row.name,
            // The page draws one picture of photons.
            summary: row.summary.trim_end_matches(", while the light moves"),
            wrong: row.wrong,
            exact: exact_method(row),
            method: row.method,
            material: row.material,
            materials: subjects
                .iter()
                .filter(takes)
                .map(|one| one.name.clone())
                .collect(),
            disperses: row.disperses,
            programs: programs(&passes, &common_text(&names, row)?)?,
            passes,
            half: row.receiver.map(|[_, half]| half),
            roughness: RowText::usual(row).is_rough().then_some(ROUGHNESS),
            // What is gathered is bright.
            exposure: if row.receiver.is_some() { -2.0 } else { 0.0 },
            functions: names
                .into_iter()
                .filter(|name| !unused.contains(name))
                .collect(),
            text: row.text,
            calls: calls.collect::<Result<_, _>>()?,
            orbit,
            images,
        })
    }

    /// The names of all functions that it may call.
    pub fn function_names(&self) -> BTreeSet<String> {
        let called = self.calls.iter().flat_map(|calls| &calls.functions);
        called.chain(&self.functions).cloned().collect()
    }

    /// The module in WGSL by a method, as the page puts it together.
    pub fn module(&self, method: &str, texts: &BTreeMap<String, String>) -> Option<String> {
        let calls = self.calls.iter().find(|calls| calls.method == method)?;
        let mut names: Vec<&String> = self.functions.iter().collect();
        names.extend(
            calls
                .functions
                .iter()
                .filter(|name| !self.functions.contains(name)),
        );
        let functions: String = names.iter().map(|name| texts[*name].as_str()).collect();
        Some(functions + FRAME + &calls.wgsl + self.text)
    }

    /// The fragment shader of a pass in GLSL ES by a method, as the page puts it together.
    pub fn fragment(
        &self,
        pass: usize,
        method: &str,
        texts: &BTreeMap<String, String>,
    ) -> Option<String> {
        let calls = self.calls.iter().find(|calls| calls.method == method)?;
        let part = &self.programs[pass].fragment;
        let mut names: Vec<&String> = part.functions.iter().collect();
        if part.calls {
            names.extend(
                calls
                    .functions
                    .iter()
                    .filter(|name| !part.functions.contains(name)),
            );
            // What a call computes its arguments with.
            names.extend(self.functions.iter().filter(|name| {
                calls.gles.contains(&format!("{name}(")) && !part.functions.contains(name)
            }));
        }
        names.dedup();
        let functions: String = names.iter().map(|name| texts[*name].as_str()).collect();
        let called = if part.calls { calls.gles.as_str() } else { "" };
        Some([&part.before, functions.as_str(), called, &part.after].concat())
    }
}

fn method_calls(
    row: &'static RenderRow,
    method: &'static Method,
) -> Result<MethodCalls, LoweringFault> {
    let text = RowText { row, method };
    let functions = text.called_functions()?;
    let leaves = functions.len() > 1;
    let exit = text.exit_method().name;
    Ok(MethodCalls {
        method: method.name,
        functions: functions.into_iter().map(|one| one.name).collect(),
        wgsl: text.calls()?,
        gles: text.calls_in_gles(FRAGMENT_FRAME)?,
        exit: (leaves && exit != method.name).then_some(exit),
    })
}

/// The module with a stand-in for the calls.
fn common_text(
    names: &[String],
    row: &'static RenderRow,
) -> Result<(String, Vec<String>), LoweringFault> {
    let texts = super::functions::texts(&names.iter().cloned().collect())?;
    let functions: String = texts.iter().map(|one| one.wgsl.as_str()).collect();
    Ok((functions + FRAME + STAND_IN + row.text, names.to_vec()))
}

fn programs(
    passes: &[GalleryPass],
    (text, names): &(String, Vec<String>),
) -> Result<Vec<ProgramPair>, LoweringFault> {
    let pair = |pass: &GalleryPass| {
        Ok(ProgramPair {
            vertex: lowered(text, pass.vertex, names, true)?,
            fragment: lowered(text, pass.fragment, names, true)?,
        })
    };
    passes.iter().map(pair).collect()
}

/// Roughness to begin with.
const ROUGHNESS: f64 = 0.3;

/// Light through a body onto a receiver: both sides of the body, photons, and the triangles between these.
fn light_passes(row: &RenderRow) -> Vec<GalleryPass> {
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let side = |depth, side, writes: [&str; 2]| GalleryPass {
        vertex: "vs_body",
        fragment: "fs_side",
        mesh: Some(row.body.name().to_owned()),
        count: 0,
        adds: false,
        depth,
        view: 0,
        margin: false,
        side: Some(side),
        writes: names(&writes),
        reads: names(&[SKY]),
    };
    let (front, back) = (
        ["FrontPositions", "FrontNormals"],
        ["BackPositions", "BackNormals"],
    );
    let photons = ["PhotonPlaces", "PhotonEnergies"];
    let drawn = |vertex, fragment, count, of: [&str; 2]| GalleryPass {
        vertex,
        fragment,
        mesh: None,
        count,
        reads: names(&[SKY, of[0], of[1], back[0], back[1]]),
        ..side("none", PHOTONS, photons)
    };
    vec![
        side("nearest", PHOTONS, front),
        side("farthest", BACK, back),
        drawn("vs_cover", "fs_photon", 3, front),
        GalleryPass {
            adds: true,
            side: None,
            writes: names(&["Colour"]),
            ..drawn("vs_triangle", "fs_lit", 6 * (PHOTONS - 1).pow(2), photons)
        },
    ]
}

fn passes(row: &RenderRow, orbit: &Orbit) -> Vec<GalleryPass> {
    let pass = |pass: &crate::scene::PassRow| GalleryPass {
        vertex: vertex(pass.place),
        fragment: pass.fragment,
        mesh: match pass.place {
            Place::Everywhere => None,
            Place::Front | Place::Back => Some(row.body.name().to_owned()),
            Place::Water => Some(format!("{} water", row.body.name())),
        },
        count: 3,
        adds: false,
        margin: pass.view.has_margin(),
        side: None,
        depth: match pass.place {
            Place::Everywhere | Place::Water => "none",
            Place::Front => "nearest",
            Place::Back => "farthest",
        },
        view: orbit.view(pass.view),
        writes: pass.writes.iter().map(slot).collect(),
        reads: [SKY.to_owned()]
            .into_iter()
            .chain(pass.reads.iter().map(slot))
            .collect(),
    };
    row.passes.iter().map(pass).collect()
}

fn slot(slot: &Slot) -> String {
    format!("{slot:?}")
}

fn vertex(place: Place) -> &'static str {
    match place {
        Place::Everywhere => "vs_cover",
        Place::Front | Place::Back | Place::Water => "vs_body",
    }
}
