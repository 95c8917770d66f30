//! The rows of the gallery: their passes, their texts, and the calls of each method. They are the rows of pictures and a rough
//! ball, whose truth no tracer here computes.

use std::collections::BTreeMap;

use serde::Serialize;

use super::lower::{GlesProgram, LoweringFault, STAND_IN, lowered};
use super::materials::shown_methods;
use super::orbit::Orbit;
use super::passes::{GalleryPass, passes_of};
use crate::generator::emit::{effect_function_text, validate_wgsl};
use crate::generator::reference::MaterialInMedium;
use crate::generator::request::{Materials, Request, Source};
use crate::language::effects::Reflectance;
use crate::language::methods::{Class, Method};
use crate::language::targets;
use crate::physics::materials::{self, MaterialKind};
use crate::pictures::scene::{self, FRAME, GLES_CALLS, PassRow, RenderRow, RowText, WGSL_CALLS};

/// A row of the gallery.
#[derive(Clone, Debug, Serialize)]
pub struct GalleryRow {
    /// Its name.
    pub name: &'static str,
    /// What it shows, in one line.
    pub summary: &'static str,
    /// Where it must be wrong, in one line.
    pub wrong: &'static str,
    /// The exact law for its kind of body, or the method that stands for it.
    pub exact: &'static str,
    /// What that is, in words.
    pub exact_is: &'static str,
    /// Whether light passes through the body.
    pub transparent: bool,
    /// Whether a film lies on it, whose thickness the reader chooses.
    pub film: bool,
    /// Its own method.
    pub method: &'static str,
    /// Its own material.
    pub material: String,
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
    /// The indices of each method's calls.
    pub calls: Vec<usize>,
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
#[derive(Clone, Debug, PartialEq, Serialize)]
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

/// The methods that a row may be drawn by.
pub fn methods_of(row: &'static RenderRow) -> Vec<&'static Method> {
    let describes = |method: &&Method| match (row.film, row.is_transparent()) {
        (Some(_), _) => method.keeps_inputs(),
        (None, true) => !method.keeps_inputs() && method.class != Class::Metal,
        (None, false) => method.class == Class::Any,
    };
    shown_methods().filter(describes).collect()
}

impl GalleryRow {
    /// A row with its texts. A new orbit is appended to `orbits`, new calls to `calls`.
    ///
    /// # Errors
    /// A text cannot be written or translated: a bug.
    pub fn new(
        row: &'static RenderRow,
        subjects: &[MaterialInMedium],
        images: BTreeMap<String, String>,
        (orbits, calls): (&mut Vec<Orbit>, &mut Vec<MethodCalls>),
    ) -> Result<GalleryRow, LoweringFault> {
        let orbit = Orbit::of(row, orbits);
        let passes = passes_of(row, &orbits[orbit]);
        let materials = subjects.iter().filter(|subject| takes(row, subject));
        // Each method has its own version of a function that needs R. The usual one stands in the programs only where a pass calls it.
        let (mut text, mut names, mut functions) = (String::new(), Vec::new(), Vec::new());
        for function in RowText::usual(row).common_functions()? {
            text += &effect_function_text(targets::find("wgsl").expect("a target"), &function)?;
            let part = function.effect.map(|part| part.function.reflectance);
            let is_called = row.text.contains(&format!("{}(", function.name));
            if part == Some(Reflectance::Unused) || is_called {
                functions.push(function.name.clone());
            }
            names.push(function.name);
        }
        text = text + FRAME + STAND_IN + row.text;
        let (module, _) = validate_wgsl(&text).map_err(LoweringFault)?;
        let program = |entry: &str| lowered(&module, entry, &names, true);
        let pair = |pass: &GalleryPass| {
            Ok(ProgramPair {
                vertex: program(pass.vertex)?,
                fragment: program(pass.fragment)?,
            })
        };
        let programs: Result<Vec<ProgramPair>, LoweringFault> = passes.iter().map(pair).collect();
        let mut own_calls = Vec::new();
        for method in methods_of(row) {
            let new = method_calls(row, method)?;
            let found = calls.iter().position(|known| *known == new);
            own_calls.push(found.unwrap_or(calls.len()));
            if found.is_none() {
                calls.push(new);
            }
        }
        Ok(GalleryRow {
            name: row.name,
            summary: row.summary,
            wrong: row.wrong,
            exact: match (row.film, row.is_transparent()) {
                (Some(_), _) => "film_spectral_six",
                (None, true) => "dielectric_exact",
                (None, false) => "conductor_exact",
            },
            exact_is: match row.film {
                Some(_) => "the exact law at six wavelengths",
                None => "the exact law",
            },
            transparent: row.is_transparent(),
            film: row.film.is_some(),
            method: row.method,
            material: match row.film {
                Some(_) => own_subject(row).name,
                None => row.material.to_owned(),
            },
            materials: materials.map(|one| one.name.clone()).collect(),
            disperses: row.disperses,
            programs: programs?,
            passes,
            half: row.receiver.map(|[_, half]| half),
            roughness: RowText::usual(row).is_rough().then_some(ROUGHNESS),
            // Gathered light is bright.
            exposure: if row.receiver.is_some() { -2.0 } else { 0.0 },
            functions,
            text: row.text,
            calls: own_calls,
            orbit,
            images,
        })
    }
}

/// Whether a row can show a material. A film that hangs free lies on nothing.
fn takes(row: &'static RenderRow, subject: &MaterialInMedium) -> bool {
    let is_dielectric = subject.material.kind == MaterialKind::Dielectric;
    if row.film.is_none() {
        return !subject.has_films() && row.is_transparent() == is_dielectric;
    }
    row.is_transparent() == scene::hangs_free(&subject.reference.surface)
        && subject.is_described_by(RowText::usual(row).method)
}

/// Whether a row shows this material.
pub fn is_shown(subject: &MaterialInMedium) -> bool {
    rows().iter().any(|row| takes(row, subject))
}

/// The rows' own films, and on request each stack that has a name, as far as a row shows it.
pub fn films(with_stacks: bool) -> Vec<MaterialInMedium> {
    let rows = rows().into_iter().filter(|row| row.film.is_some());
    let stacks = materials::stacks().into_iter().filter(|_| with_stacks);
    let stacks = stacks.map(|name| Source::Named(name.to_owned()));
    let mut films = subjects(rows.map(RenderRow::source).chain(stacks).collect());
    films.retain(is_shown);
    films
}

/// A row's own material under its own film.
pub fn own_subject(row: &RenderRow) -> MaterialInMedium {
    subjects(vec![row.source()]).remove(0)
}

fn subjects(sources: Vec<Source>) -> Vec<MaterialInMedium> {
    let request = Request {
        materials: Materials::These(sources),
        ..Request::default()
    };
    let found = request
        .subjects()
        .expect("what this program names is known");
    found.materials()
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
        wgsl: text.calls(&WGSL_CALLS, &functions),
        gles: text.calls(&GLES_CALLS, &functions),
        functions: functions.into_iter().map(|one| one.name).collect(),
        exit: (asks_for_exit && exit != method.name).then_some(exit),
    })
}

/// A rough ball under three lamps.
static ROUGH: RenderRow = RenderRow {
    name: "ggx_specular",
    summary: "A rough ball under three lamps: GGX, the method at the half vector",
    effects: &["interface", "ggx_specular"],
    method: "schlick",
    text: include_str!("ggx_specular.wgsl"),
    passes: &[
        PassRow {
            fragment: "fs_dark",
            ..scene::SKY
        },
        scene::FRONT,
    ],
    material: "gold",
    wrong: "light that bounces twice is missing",
    ..scene::METAL
};

/// All rows of the gallery.
pub fn rows() -> Vec<&'static RenderRow> {
    scene::ALL.iter().chain([&ROUGH]).collect()
}
