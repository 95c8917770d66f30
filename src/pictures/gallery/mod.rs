//! The gallery as data: every row of the pictures with its texts in WGSL and GLSL ES, the numbers of materials, and the scenes. The
//! page is one self-contained HTML file, and runs without this program.
//!
//! The page puts each program together from parts: the functions that users import, the calls of the chosen method, the row's
//! passes. In GLSL ES the passes are naga's translation, and the functions are our own text.

mod listed;
mod lower;
mod materials;
mod orbit;
mod packed;
mod passes;
mod row;

use std::collections::BTreeMap;

use serde::Serialize;
use tera::Context;

use crate::generator::emit;
use crate::generator::reference::MaterialInMedium;
use crate::lab::chart::{ERRORS, intended_data};
use crate::physics::spectra::Space;
use crate::pictures::html;
use crate::pictures::scene::{
    self, ABSORPTION_AT, FILM_AT, FRAME, INDEX_AT, INPUTS, INPUTS_AT, MARGIN, PIXEL_AT,
};
use lower::LoweringFault;
use materials::{MaterialNumbers, MethodNumbers, OwnIndex};
use orbit::Orbit;
use packed::{PackedMesh, PackedTexture, SKY, textures_of};
use passes::ShowPrograms;

pub use listed::ListedMaterials;
pub use packed::{CUBE, as_stored, reduced_tables};
pub use passes::FunctionTexts;
pub use row::{GalleryRow, MethodCalls, films, is_shown, methods_of, own_subject, rows};

/// The data of the page.
#[derive(Debug, Serialize)]
pub struct Gallery {
    /// The rows.
    pub rows: Vec<GalleryRow>,
    /// The calls of methods, which many rows share.
    pub calls: Vec<MethodCalls>,
    /// Methods with their costs.
    pub methods: Vec<MethodNumbers>,
    /// Materials, with the values of each method's inputs and its errors.
    pub materials: Vec<MaterialNumbers>,
    /// The values of inputs for an index that the reader chooses.
    pub own: Vec<OwnIndex>,
    /// The axes of cost: name and title.
    pub costs: Vec<[String; 2]>,
    /// The metrics of error: name and title.
    pub errors: Vec<[&'static str; 2]>,
    /// The text of every function.
    pub functions: Vec<FunctionTexts>,
    /// The frame's text in WGSL.
    pub frame: &'static str,
    /// The places in the frame's block that the reader's choice changes.
    pub layout: Layout,
    /// The views of the camera.
    pub orbits: Vec<Orbit>,
    /// The textures that passes read: the sky, the room, the relief.
    pub textures: Vec<PackedTexture>,
    /// The bodies.
    pub meshes: Vec<PackedMesh>,
    /// The programs that put the panels side by side.
    pub show: ShowPrograms,
    /// Samples of a pixel along each side.
    pub samples: u32,
    /// The margin of a picture is its side divided by this.
    pub margin: u32,
}

/// Places in the frame's block, counted in numbers.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Layout {
    index: usize,
    absorption: usize,
    film: usize,
    inputs: usize,
    roughness: usize,
    pixel: usize,
    size: usize,
}

/// The gallery with these materials. `progress` gets the number done and the total.
///
/// # Errors
/// A text cannot be written or translated: a bug.
pub fn gallery(
    subjects: &[MaterialInMedium],
    space: Space,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Gallery, LoweringFault> {
    let data = intended_data(materials::shown_methods(), subjects, space, progress);
    let (mut orbits, mut calls, mut played) = (Vec::new(), Vec::new(), Vec::new());
    let mut textures = BTreeMap::from([(SKY.to_owned(), packed::sky_texture())]);
    let mut meshes = BTreeMap::new();
    for row in row::rows() {
        let mut images = BTreeMap::from([(SKY.to_owned(), SKY.to_owned())]);
        for (slot, source) in textures_of(row) {
            images.insert(format!("{slot:?}"), source.name());
            textures
                .entry(source.name())
                .or_insert_with(|| source.packed());
        }
        meshes
            .entry((row.body.name(), false))
            .or_insert_with(|| PackedMesh::solid(row.body));
        if row.has_water() {
            let water = || PackedMesh::water(row.body);
            meshes.entry((row.body.name(), true)).or_insert_with(water);
        }
        let shared = (&mut orbits, &mut calls);
        played.push(GalleryRow::new(row, subjects, images, shared)?);
    }
    let called = calls.iter().flat_map(|calls| &calls.functions);
    let all = called
        .chain(played.iter().flat_map(|row| &row.functions))
        .cloned();
    let copied = passes::COPIED.map(|name| format!("{}{name}", emit::Naming::default().prefix));
    let functions = passes::texts(&all.chain(copied).collect())?;
    let costs = data.costs.iter();
    Ok(Gallery {
        methods: materials::method_numbers(&data),
        materials: materials::numbers(subjects, &data),
        own: materials::own_indices(),
        costs: costs
            .map(|cost| [cost.name.to_owned(), cost.title.clone()])
            .collect(),
        errors: ERRORS.map(|error| [error.name, error.title]).to_vec(),
        functions,
        frame: FRAME,
        layout: Layout {
            index: INDEX_AT,
            absorption: ABSORPTION_AT,
            film: FILM_AT,
            inputs: INPUTS_AT,
            roughness: ABSORPTION_AT + 3,
            pixel: PIXEL_AT,
            size: INPUTS_AT + 4 * INPUTS,
        },
        orbits,
        textures: textures.into_values().collect(),
        meshes: meshes.into_values().collect(),
        show: passes::programs()?,
        samples: scene::SAMPLES,
        margin: MARGIN,
        rows: played,
        calls,
    })
}

impl From<emit::Error> for LoweringFault {
    fn from(fault: emit::Error) -> LoweringFault {
        LoweringFault(fault.to_string())
    }
}

static TEMPLATE: &str = include_str!("../../../templates/gallery.html.tera");
static SCRIPT: &str = include_str!("../../../templates/gallery.js");
static PICK: &str = include_str!("../../../templates/gallery.pick.js");
static PLAYER: &str = include_str!("../../../templates/gallery.player.js");

/// The page, or why it cannot be made.
///
/// # Errors
/// The page's template cannot be filled.
pub fn gallery_page(gallery: &Gallery, command: &str) -> Result<String, String> {
    let mut context = Context::new();
    context.insert("data", &html::script_json(gallery)?);
    context.insert("player", PLAYER);
    context.insert("pick", PICK);
    context.insert("script", SCRIPT);
    context.insert("command", command);
    html::fill(TEMPLATE, &context)
}
