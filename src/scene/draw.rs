//! A row drawn on a device: the text that users import, the row's own text below it, pass after pass.

use std::collections::BTreeMap;

use glam::{DMat4, DVec3};

use crate::effects;
use crate::emit::{self, EffectRequest, Naming, effect_text};
use crate::gpu::{Depth, Device, DeviceFault, Draw, Image, Offscreen, VERTEX_FLOATS};
use crate::methods;
use crate::targets;

use super::body::{Body, Vertex};
use super::camera::Camera;
use super::environment::Environment;
use super::glass::Glass;
use super::room::{CUBE_CENTRE, ROOM_MAX, ROOM_MIN, room_cube};
use super::row::{PassRow, Place, RenderRow, Slot, View};
use super::texels::Texels;
use super::trace::Things;

/// Texels of a side of the room's cube map.
const CUBE: usize = 1024;
const FRAME: &str = include_str!("passes/frame.wgsl");

/// A picture as the device drew it.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Radiance of each sample, row after row; alpha says what it is.
    pub samples: Vec<[f32; 4]>,
}

/// Why a row was not drawn.
#[derive(Clone, Debug, thiserror::Error)]
pub enum DrawFault {
    /// The device.
    #[error(transparent)]
    Device(#[from] DeviceFault),
    /// The functions cannot be written: a bug.
    #[error("{0}")]
    Text(String),
}

/// Draws a row, so many samples a side.
///
/// # Errors
/// The device does not take it, or the functions cannot be written.
pub fn draw(
    device: &Device,
    row: &RenderRow,
    things: Things,
    environment: &Environment,
    camera: &Camera,
    side: u32,
) -> Result<Drawn, DrawFault> {
    let Things { body, glass, .. } = things;
    let text = text(row).map_err(|fault| DrawFault::Text(fault.to_string()))?;
    let offscreen = device.offscreen()?;
    let [width, height] = environment.size();
    let around = upload(&offscreen, [width, height], environment.texels())?;
    let [body_mesh, water_mesh] = [body.triangles(), body.water()].map(|triangles| {
        let vertices: Vec<_> = triangles.concat().iter().map(floats).collect();
        offscreen.mesh(&vertices)
    });
    let (body_mesh, water_mesh) = (body_mesh?, water_mesh?);
    let mut slots = tables_of(&offscreen, row, things)?;
    for pass in row.passes {
        let clears = !pass.writes.iter().any(|slot| slots.contains_key(slot));
        for slot in pass.writes.iter().filter(|_| clears) {
            let side = pass.view.side(side);
            slots.insert(*slot, offscreen.target(side, side)?);
        }
        let (vertex, depth) = pass.drawn_by();
        let images: Vec<&Image> = pass.reads.iter().map(|slot| &slots[slot]).collect();
        let targets: Vec<&Image> = pass.writes.iter().map(|slot| &slots[slot]).collect();
        let uniforms = frame(pass.view, camera, side, body, glass);
        offscreen.draw(&Draw {
            text: &text,
            vertex,
            fragment: pass.fragment,
            uniforms: &uniforms,
            images: &[&[&around], images.as_slice()].concat(),
            mesh: match pass.place {
                Place::Everywhere => Err(3),
                Place::Front | Place::Back => Ok(&body_mesh),
                Place::Water => Ok(&water_mesh),
            },
            targets: &targets,
            clears,
            depth,
            adds: false,
        })?;
    }
    let samples = offscreen.read(&slots[&Slot::Colour])?;
    Ok(Drawn { samples })
}

/// What passes read that is not drawn.
fn tables_of(
    offscreen: &Offscreen,
    row: &RenderRow,
    things: Things,
) -> Result<BTreeMap<Slot, Image>, DeviceFault> {
    let mut slots: BTreeMap<Slot, Image> = BTreeMap::new();
    if row.in_room {
        let cube = offscreen.upload([CUBE as u32, CUBE as u32, 6], &room_cube(CUBE))?;
        slots.insert(Slot::Room, cube);
    }
    if let Some(relief) = things.relief {
        let image = upload(offscreen, [relief.side(); 2], relief.texels())?;
        slots.insert(Slot::Relief, image);
    }
    for (slot, table) in body_tables(things.body) {
        let [width, height] = table.size().map(|texels| texels as u32);
        slots.insert(slot, offscreen.upload([width, height, 1], table.texels())?);
    }
    Ok(slots)
}

/// The tables that belong to a body.
fn body_tables(body: &Body) -> Vec<(Slot, &Texels)> {
    match body {
        Body::Ball | Body::Gem(_) => Vec::new(),
        Body::Pool(pool) => vec![(Slot::Paint, &pool.paint), (Slot::Relief, &pool.normals)],
        Body::Window(window) => vec![
            (Slot::Paint, &window.paint),
            (Slot::Relief, &window.normals),
        ],
    }
}

fn upload(
    offscreen: &Offscreen,
    [width, height]: [usize; 2],
    texels: &[[f32; 3]],
) -> Result<Image, DeviceFault> {
    let texels: Vec<[f32; 4]> = texels.iter().map(|[x, y, z]| [*x, *y, *z, 1.0]).collect();
    offscreen.upload([width as u32, height as u32, 1], &texels)
}

impl PassRow {
    fn drawn_by(&self) -> (&'static str, Depth) {
        match self.place {
            Place::Everywhere => ("vs_cover", Depth::Unused),
            Place::Front => ("vs_body", Depth::Nearest),
            Place::Back => ("vs_body", Depth::Farthest),
            Place::Water => ("vs_body", Depth::Unused),
        }
    }
}

/// The module: the functions as users import them, the frame, the row's own passes.
pub(super) fn text(row: &RenderRow) -> Result<String, emit::Error> {
    let wgsl = targets::find("wgsl").expect("a target");
    let method = methods::find(row.method).expect("a row names a method");
    let mut text = String::new();
    for name in row.effects {
        let request = EffectRequest {
            effect: effects::find(name).expect("a row names effects"),
            method,
            subject: None,
        };
        let functions = request.whole(&Naming::default())?;
        let written = effect_text(wgsl, &request, &functions, "fresnel-gen render")?;
        text += &String::from_utf8_lossy(&written);
    }
    Ok(text + FRAME + row.text)
}

/// A margin of a picture is this part of its side.
const MARGIN: u32 = 5;

impl View {
    /// Pixels a side of what is drawn, where the picture has so many.
    fn side(self, side: u32) -> u32 {
        match self {
            View::Eye => side,
            View::Margin | View::Mirrored | View::MirroredUnclipped => side + 2 * (side / MARGIN),
        }
    }

    /// The camera of a pass, by that of the eye.
    fn camera(self, eye: &Camera, side: u32) -> Camera {
        let camera = match self {
            View::Eye | View::Margin => *eye,
            View::Mirrored => eye.mirrored().clipped_below(),
            View::MirroredUnclipped => eye.mirrored(),
        };
        camera.with_margin(side, self.side(side))
    }
}

/// The bytes of the frame of a pass.
fn frame(view: View, eye: &Camera, side: u32, body: &Body, glass: &Glass) -> Vec<u8> {
    let camera = view.camera(eye, side);
    let four = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let matrix = |m: DMat4| m.to_cols_array().map(|value| value as f32);
    let mut numbers = Vec::new();
    numbers.extend(matrix(camera.view_projection));
    numbers.extend(matrix(camera.inverse));
    numbers.extend(four(camera.eye, body.radius()));
    numbers.extend(four(glass.n, 0.0));
    numbers.extend(four(glass.k, 0.0));
    for corner in [ROOM_MIN, ROOM_MAX, CUBE_CENTRE] {
        numbers.extend(four(corner, 0.0));
    }
    for view in [View::Margin, View::Mirrored] {
        numbers.extend(matrix(view.camera(eye, side).view_projection));
    }
    numbers.extend(four(glass.absorption(), 0.0));
    numbers.into_iter().flat_map(f32::to_ne_bytes).collect()
}

/// A vertex as the device takes it.
pub(super) fn floats(vertex: &Vertex) -> [f32; VERTEX_FLOATS] {
    let (p, n, t, uv) = (vertex.position, vertex.normal, vertex.tangent, vertex.uv);
    let all = [p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y, t.z, t.w, uv.x, uv.y];
    all.map(|value| value as f32)
}
