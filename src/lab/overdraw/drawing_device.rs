//! A device that draws: its render target, and its shaders, each compiled when it is first drawn.

use serde::{Deserialize, Serialize};

use super::clock::timed;
use super::measure::Reading;
use super::plan::{Drawing, DrawingPlan};
use crate::lab::cost::{ENTRY, VERTEX};
use crate::lab::fault::Fault;
use crate::lab::gpu::{
    AdapterKind, Canvas, Device, Layer, Shader, Texture, TextureFilter, TextureFormat,
    TextureShape, Wrap,
};

/// Pixels per side of the target if none are given. A software device is busy with few pixels, a graphics card is not.
const ON_A_PROCESSOR: u32 = 256;
const ON_A_CARD: u32 = 1024;

/// A description of the device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceFacts {
    /// The device with its driver.
    pub device: String,
    /// Its name alone.
    pub name: String,
    /// Its driver alone.
    pub driver: String,
    /// Whether it is software.
    pub is_software: bool,
    /// Whether it computes in 16 bits.
    pub has_half: bool,
    /// The number of pixels in the target.
    pub pixels: u64,
}

impl DeviceFacts {
    /// A sentence that it does not compute in 16 bits.
    pub fn no_half(&self) -> String {
        format!(
            "{} has no 16-bit arithmetic in shaders (shader-f16, shaderFloat16)",
            self.device
        )
    }
}

/// A device that draws a plan.
pub struct DrawingDevice<'a> {
    plan: &'a DrawingPlan,
    canvas: Canvas,
    layers: Vec<Option<Layer>>,
}

impl<'a> DrawingDevice<'a> {
    /// The device with a target of so many pixels per side.
    ///
    /// # Errors
    /// It cannot draw to such a target.
    pub fn new(
        plan: &'a DrawingPlan,
        device: &Device,
        size: Option<u32>,
    ) -> Result<DrawingDevice<'a>, Fault> {
        let usual = match device.adapter.kind {
            AdapterKind::Software => ON_A_PROCESSOR,
            _ => ON_A_CARD,
        };
        Ok(DrawingDevice {
            plan,
            canvas: device.canvas(size.unwrap_or(usual))?,
            layers: plan.drawings.iter().map(|_| None).collect(),
        })
    }

    /// The description of the device.
    pub fn facts(&self) -> DeviceFacts {
        let adapter = self.canvas.adapter();
        DeviceFacts {
            device: adapter.to_string(),
            name: adapter.name.clone(),
            driver: adapter.driver.clone(),
            is_software: adapter.kind == AdapterKind::Software,
            has_half: self.canvas.has_half(),
            pixels: self.canvas.pixels(),
        }
    }

    /// Draws the heavy shader, and a drawing so many times over it.
    ///
    /// # Errors
    /// The device does not accept it, or is lost.
    pub fn draw(&mut self, drawing: usize, draws: u32) -> Result<Reading, Fault> {
        self.compile(DrawingPlan::HEAVY)?;
        self.compile(drawing)?;
        let layer = |place: usize, draws| Some((self.layers[place].as_ref()?, draws));
        let over = layer(drawing, draws).filter(|_| drawing != DrawingPlan::HEAVY);
        let below = layer(DrawingPlan::HEAVY, 1);
        let layers: Vec<(&Layer, u32)> = below.into_iter().chain(over).collect();
        let recorded = self.canvas.record(&layers)?;
        let (drawn, spent) = timed(|| self.canvas.draw(recorded));
        drawn?;
        Ok(Reading {
            gpu: self.canvas.nanoseconds()?,
            cpu: spent.processor,
            wall: spent.wall,
        })
    }

    fn compile(&mut self, place: usize) -> Result<(), Fault> {
        if self.layers[place].is_none() {
            self.layers[place] = Some(layer(&self.canvas, &self.plan.drawings[place])?);
        }
        Ok(())
    }
}

fn layer(canvas: &Canvas, drawing: &Drawing) -> Result<Layer, Fault> {
    let table = drawing.table.as_ref().map(|table| {
        let texels = table.texels.iter();
        let texels: Vec<[f32; 4]> = texels.map(|[r, g, b]| [*r, *g, *b, 1.0]).collect();
        (table.width, texels)
    });
    let texture = table.as_ref().map(|(width, texels)| Texture {
        width: *width,
        texels,
        format: TextureFormat::Half,
        wrap: Wrap::Clamp,
        shape: TextureShape::Flat,
        filter: TextureFilter::Linear,
    });
    canvas.layer(&Shader {
        text: &drawing.text,
        vertex: VERTEX,
        fragment: ENTRY,
        uniforms: &drawing.uniforms,
        texture: texture.as_ref(),
        blends: drawing.blends,
    })
}
