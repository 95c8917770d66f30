//! Draws a row on a device: the text that users import, the row's own text below it, pass after pass.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::environment::Environment;
use super::frame::{Camera, frame};
use super::mesh::vertex_numbers;
use super::room::room_cube;
use super::table::{DrawnSurface, RenderRow};
use super::texels::{Slot, Texels};
use super::text::{INPUTS, RowText};
use super::trace::Things;
use crate::lab::fault::Fault;
use crate::lab::gpu::{Device, Draw, Image, Offscreen};

/// Texels along a side of the room's cube map.
const CUBE: usize = 1024;

/// The input of the passes: the things drawn, their surroundings, and the tables that passes read.
#[derive(Clone, Debug)]
pub struct Scenery<'a> {
    /// The body, its material, its surface.
    pub things: Things<'a>,
    /// The sky.
    pub environment: &'a Environment,
    /// The tables of the body.
    pub tables: Vec<(Slot, Cow<'a, Texels>)>,
    /// Texels along a side of the room's cube map.
    pub cube: usize,
}

impl<'a> Scenery<'a> {
    /// A scenery at full resolution.
    pub fn of(things: Things<'a>, environment: &'a Environment) -> Scenery<'a> {
        let tables = things.body.tables().into_iter();
        let borrowed = tables.map(|(slot, table)| (slot, Cow::Borrowed(table)));
        Scenery {
            things,
            environment,
            tables: borrowed.collect(),
            cube: CUBE,
        }
    }
}

/// Draws a row by a method with these values of its inputs, with this many samples a side. It gives the radiance of each sample,
/// row by row. Alpha says what the sample shows.
///
/// # Errors
/// The device does not draw it, or the functions cannot be written.
pub fn draw(
    device: &Device,
    (text, inputs): (&RowText, [[f32; 4]; INPUTS]),
    scenery: &Scenery,
    camera: &Camera,
    side: u32,
) -> Result<Vec<[f32; 4]>, Fault> {
    let Things { body, material, .. } = scenery.things;
    let module = text.module()?;
    let offscreen = device.offscreen()?;
    let around = upload(&offscreen, &scenery.environment.table)?;
    let body_mesh = offscreen.mesh(&vertex_numbers(&body.triangles()))?;
    let water_mesh = offscreen.mesh(&vertex_numbers(&body.water()))?;
    let mut slots = tables(&offscreen, text.row, scenery)?;
    for pass in text.row.passes {
        let clears = !pass.writes.iter().any(|slot| slots.contains_key(slot));
        for slot in pass.writes.iter().filter(|_| clears) {
            let side = pass.view.side(side);
            slots.insert(*slot, offscreen.target(side, side)?);
        }
        let images: Vec<&Image> = pass.reads.iter().map(|slot| &slots[slot]).collect();
        let targets: Vec<&Image> = pass.writes.iter().map(|slot| &slots[slot]).collect();
        let block = frame((pass.view, camera, side), body.radius(), material, inputs);
        let uniforms: Vec<u8> = block.into_iter().flat_map(f32::to_ne_bytes).collect();
        offscreen.draw(&Draw {
            text: &module,
            vertex: pass.surface.vertex(),
            fragment: pass.fragment,
            uniforms: &uniforms,
            images: &[&[&around], images.as_slice()].concat(),
            mesh: match pass.surface {
                DrawnSurface::Everywhere => Err(3),
                DrawnSurface::Front | DrawnSurface::Back => Ok(&body_mesh),
                DrawnSurface::Water => Ok(&water_mesh),
            },
            targets: &targets,
            clears,
            depth: pass.surface.depth(),
            adds: false,
        })?;
    }
    offscreen.read(&slots[&Slot::Colour])
}

/// The tables that passes read.
fn tables(
    offscreen: &Offscreen,
    row: &RenderRow,
    scenery: &Scenery,
) -> Result<BTreeMap<Slot, Image>, Fault> {
    let mut slots = BTreeMap::new();
    if row.in_room {
        let size = [scenery.cube as u32, scenery.cube as u32, 6];
        let cube = offscreen.upload(size, &room_cube(scenery.cube))?;
        slots.insert(Slot::Room, cube);
    }
    for (slot, table) in &scenery.tables {
        slots.insert(*slot, upload(offscreen, table)?);
    }
    if let Some(relief) = scenery.things.relief {
        slots.insert(Slot::Relief, upload(offscreen, &relief.normals)?);
    }
    Ok(slots)
}

fn upload(offscreen: &Offscreen, table: &Texels) -> Result<Image, Fault> {
    let [width, height] = table.size().map(|texels| texels as u32);
    offscreen.upload([width, height, 1], table.texels())
}
