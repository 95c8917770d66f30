//! The rows of the gallery: their passes, their texts, and the calls of each method. They are the rows of pictures and a rough
//! ball, whose truth no tracer here computes.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::lower::{FRAGMENT_FRAME, GlesProgram, LoweringFault, STAND_IN, lowered};
use super::orbit::Orbit;
use super::passes::{GalleryPass, passes_of};
use crate::generator::emit::{EmittedFunction, effect_function_text};
use crate::generator::reference::MaterialInMedium;
use crate::language::effects::Reflectance;
use crate::language::methods::{self, Class, Light, Method};
use crate::language::targets;
use crate::physics::materials::MaterialKind;
use crate::pictures::scene::{
    self, BodyName, FRAME, PassRow, Paths, Place, RenderRow, RowText, Slot, View,
};

/// A row of the gallery.
#[derive(Clone, Debug, Serialize)]
pub struct GalleryRow {
    /// Its name.
    pub name: &'static str,
    /// What it shows, in one line.
    pub summary: &'static str,
    /// Where it must be wrong, in one line.
    pub wrong: &'static str,
    /// The exact law for its kind of body.
    pub exact: &'static str,
    /// Its own method.
    pub method: &'static str,
    /// Its own material.
    pub material: &'static str,
    /// The materials that it can be drawn with, by name.
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
    /// The index of its orbit.
    pub orbit: usize,
    /// Half the width of the receiver's window, where light falls onto a receiver.
    pub half: Option<f64>,
    /// The initial roughness, where it has one.
    pub roughness: Option<f64>,
    /// The initial exposure, in stops.
    pub exposure: f64,
    /// The textures that it reads, by slot.
    pub images: BTreeMap<String, String>,
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
    /// The method that computes the light that leaves a body, where this method does not.
    pub exit: Option<&'static str>,
}

/// A program for WebGL 2.
#[derive(Clone, Debug, Serialize)]
pub struct ProgramPair {
    /// The vertex shader.
    pub vertex: GlesProgram,
    /// The fragment shader.
    pub fragment: GlesProgram,
}

/// The exact law for a row's kind of body.
pub fn exact_method(row: &RenderRow) -> &'static str {
    if row.is_transparent() {
        "dielectric_exact"
    } else {
        "conductor_exact"
    }
}

/// The methods that a row may be drawn by: those for unpolarised light without a table.
pub fn methods_of(row: &RenderRow) -> Vec<&'static Method> {
    let all = methods::ALL.iter().copied().filter(|method| {
        method.light == Light::Unpolarised
            && !method.is_textured()
            && if row.is_transparent() {
                method.class != Class::Metal
            } else {
                method.class == Class::Any
            }
    });
    all.collect()
}

impl GalleryRow {
    /// A row with its texts. A new orbit is appended to `orbits`.
    ///
    /// # Errors
    /// A text cannot be written or translated: a bug.
    pub fn new(
        row: &'static RenderRow,
        subjects: &[MaterialInMedium],
        (orbits, images): (&mut Vec<Orbit>, BTreeMap<String, String>),
    ) -> Result<GalleryRow, LoweringFault> {
        let orbit = Orbit::of(row, orbits);
        let (names, unused) = common_names(row)?;
        let takes = |subject: &&MaterialInMedium| {
            row.is_transparent() == (subject.material.kind == MaterialKind::Dielectric)
        };
        let passes = passes_of(row, &orbits[orbit]);
        let calls = methods_of(row)
            .into_iter()
            .map(|method| method_calls(row, method));
        Ok(GalleryRow {
            name: row.name,
            summary: row.summary,
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
            programs: programs(&passes, &common_text(row)?)?,
            passes,
            half: row.receiver.map(|[_, half]| half),
            roughness: RowText::usual(row).is_rough().then_some(ROUGHNESS),
            // Gathered light is bright.
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

    /// The WGSL module with a method, as the page puts it together.
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

    /// The GLSL ES fragment shader of a pass with a method, as the page puts it together.
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
            // The functions that compute a call's arguments.
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

/// The names of the functions of a row's effects, and of those among them that need R and that no pass calls itself. Each method
/// has its own version of the latter.
fn common_names(row: &'static RenderRow) -> Result<(Vec<String>, Vec<String>), LoweringFault> {
    let common = RowText::usual(row).common_functions()?;
    let asks = |emitted: &&EmittedFunction| {
        let part = emitted.effect.map(|part| part.function.reflectance);
        part != Some(Reflectance::Unused) && !row.text.contains(&format!("{}(", emitted.name))
    };
    let unused = common.iter().filter(asks).map(|one| one.name.clone());
    let unused = unused.collect();
    Ok((common.into_iter().map(|one| one.name).collect(), unused))
}

/// The initial roughness.
const ROUGHNESS: f64 = 0.3;

fn method_calls(
    row: &'static RenderRow,
    method: &'static Method,
) -> Result<MethodCalls, LoweringFault> {
    let text = RowText { row, method };
    let functions = text.called_functions()?;
    let asks_for_exit = row.text.contains("transmittance_out(");
    let exit = text.exit_method().name;
    Ok(MethodCalls {
        method: method.name,
        functions: functions.into_iter().map(|one| one.name).collect(),
        wgsl: text.calls()?,
        gles: text.calls_in_gles(FRAGMENT_FRAME)?,
        exit: (asks_for_exit && exit != method.name).then_some(exit),
    })
}

/// The module with a stand-in for the calls, and the names of its functions.
fn common_text(row: &'static RenderRow) -> Result<(String, Vec<String>), LoweringFault> {
    let wgsl = targets::find("wgsl").expect("a target");
    let (mut text, mut names) = (String::new(), Vec::new());
    for function in RowText::usual(row).common_functions()? {
        text += &effect_function_text(wgsl, &function)?;
        names.push(function.name);
    }
    Ok((text + FRAME + STAND_IN + row.text, names))
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

const DARK: PassRow = PassRow {
    fragment: "fs_dark",
    place: Place::Everywhere,
    view: View::Eye,
    writes: &[Slot::Colour],
    reads: &[],
};

/// A rough ball under three lamps.
static ROUGH: RenderRow = RenderRow {
    name: "ggx_specular",
    summary: "A rough ball under three lamps: GGX, the method at the half vector",
    effects: &["interface", "ggx_specular"],
    method: "schlick",
    text: include_str!("ggx_specular.wgsl"),
    passes: &[
        DARK,
        PassRow {
            fragment: "fs_front",
            place: Place::Front,
            ..DARK
        },
    ],
    body: BodyName::Ball,
    material: "gold",
    disperses: true,
    own_paths: Paths::Mirror,
    true_paths: Paths::Mirror,
    eye: [0.0, 0.75, 2.9],
    in_room: false,
    dents: None,
    receiver: None,
    wrong: "light that bounces twice is missing",
};

/// All rows of the gallery.
pub fn rows() -> Vec<&'static RenderRow> {
    scene::ALL.iter().chain([&ROUGH]).collect()
}

/// The row of this name.
pub fn find(name: &str) -> Option<&'static RenderRow> {
    rows().into_iter().find(|row| row.name == name)
}
