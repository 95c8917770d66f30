//! Draws a row on a device: the text that users import, the row's own text below it, pass after pass.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::body::Vertex;
use super::environment::Environment;
use super::frame::{Camera, frame};
use super::room::room_cube;
use super::table::{PassRow, Place, RenderRow, Slot};
use super::texels::Texels;
use super::text::{INPUTS, RowText};
use super::trace::Things;
use crate::lab::gpu::{Depth, Device, DeviceFault, Draw, Image, Offscreen};

/// Texels along a side of the room's cube map.
const CUBE: usize = 1024;

/// A picture as the device drew it.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Radiance of each sample, row by row. Alpha says what the sample shows.
    pub samples: Vec<[f32; 4]>,
}

/// Why a row was not drawn.
#[derive(Clone, Debug, thiserror::Error)]
pub enum DrawFault {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceFault),
    /// The functions cannot be written: a bug.
    #[error("{0}")]
    Text(String),
}

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
        Scenery {
            things,
            environment,
            tables: tables
                .map(|(slot, table)| (slot, Cow::Borrowed(table)))
                .collect(),
            cube: CUBE,
        }
    }
}

/// Draws a row by a method with these values of its inputs, with this many samples a side.
///
/// # Errors
/// The device does not draw it, or the functions cannot be written.
pub fn draw(
    device: &Device,
    (text, inputs): (&RowText, [[f32; 4]; INPUTS]),
    scenery: &Scenery,
    camera: &Camera,
    side: u32,
) -> Result<Drawn, DrawFault> {
    let Things { body, glass, .. } = scenery.things;
    let row = text.row;
    let module = text.module();
    let module = module.map_err(|fault| DrawFault::Text(fault.to_string()))?;
    let offscreen = device.offscreen()?;
    let [width, height] = scenery.environment.size();
    let around = upload(&offscreen, [width, height], scenery.environment.texels())?;
    let [body_mesh, water_mesh] = [body.triangles(), body.water()].map(|triangles| {
        let vertices: Vec<_> = triangles.concat().iter().map(Vertex::numbers).collect();
        offscreen.mesh(&vertices)
    });
    let (body_mesh, water_mesh) = (body_mesh?, water_mesh?);
    let mut slots = tables(&offscreen, row, scenery)?;
    for pass in row.passes {
        let clears = !pass.writes.iter().any(|slot| slots.contains_key(slot));
        for slot in pass.writes.iter().filter(|_| clears) {
            let side = pass.view.side(side);
            slots.insert(*slot, offscreen.target(side, side)?);
        }
        let (vertex, depth) = pass.drawn_by();
        let images: Vec<&Image> = pass.reads.iter().map(|slot| &slots[slot]).collect();
        let targets: Vec<&Image> = pass.writes.iter().map(|slot| &slots[slot]).collect();
        let block = frame((pass.view, camera, side), body.radius(), glass, inputs);
        let uniforms: Vec<u8> = block.into_iter().flat_map(f32::to_ne_bytes).collect();
        offscreen.draw(&Draw {
            text: &module,
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

/// The tables that passes read.
fn tables(
    offscreen: &Offscreen,
    row: &RenderRow,
    scenery: &Scenery,
) -> Result<BTreeMap<Slot, Image>, DeviceFault> {
    let mut slots = BTreeMap::new();
    if row.in_room {
        let size = [scenery.cube as u32, scenery.cube as u32, 6];
        let cube = offscreen.upload(size, &room_cube(scenery.cube))?;
        slots.insert(Slot::Room, cube);
    }
    let relief = scenery.things.relief;
    let relief = relief.map(|relief| (Slot::Relief, relief.normals()));
    let tables = scenery.tables.iter();
    for (slot, table) in tables
        .map(|(slot, table)| (*slot, table.as_ref()))
        .chain(relief)
    {
        let [width, height] = table.size().map(|texels| texels as u32);
        slots.insert(slot, offscreen.upload([width, height, 1], table.texels())?);
    }
    Ok(slots)
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
