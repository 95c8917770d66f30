//! The block of numbers that every pass sees: cameras, the material, the room, the inputs of the method.

use glam::{DMat4, DVec3, DVec4};

use super::camera::Camera;
use super::glass::Glass;
use super::room::{CUBE_CENTRE, ROOM_MAX, ROOM_MIN};
use super::table::View;
use super::text::INPUTS;

/// Where the index begins in the block, in numbers; n, then k, four numbers each.
pub const INDEX_AT: usize = 36;
/// Where absorption begins.
pub const ABSORPTION_AT: usize = 88;
/// Where the method's inputs begin.
pub const INPUTS_AT: usize = 92;

/// The block of a pass: its view of what the eye sees in a picture of so many pixels a side, a body of this size and material, the
/// inputs of the method.
pub fn frame(
    (view, eye, side): (View, &Camera, u32),
    size: f64,
    glass: &Glass,
    inputs: [[f32; 4]; INPUTS],
) -> Vec<f32> {
    let camera = view.camera(eye, side);
    let four = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let matrix = |m: DMat4| m.to_cols_array().map(|value| value as f32);
    let mut numbers = Vec::new();
    numbers.extend(matrix(camera.view_projection));
    numbers.extend(matrix(camera.inverse));
    numbers.extend(four(camera.eye, size));
    numbers.extend(four(glass.n, 0.0));
    numbers.extend(four(glass.k, 0.0));
    for corner in [ROOM_MIN, ROOM_MAX, CUBE_CENTRE] {
        numbers.extend(four(corner, 0.0));
    }
    for view in [View::Margin, View::Mirrored] {
        numbers.extend(matrix(view.camera(eye, side).view_projection));
    }
    numbers.extend(four(glass.absorption(), 0.0));
    numbers.extend(inputs.concat());
    numbers
}

/// The photons of a row, unless more are asked for.
pub const PHOTONS: u32 = 256;
/// Pixels a side of the picture of the back that photons are searched in.
pub const BACK: u32 = 1024;
/// Where the widths of a sample and of a pixel begin in the block of light.
pub const PIXEL_AT: usize = 46;

/// Light that falls along -z through a body onto a receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBlock {
    /// How far the receiver lies below the body's centre, and half the width of its window.
    pub window: [f64; 2],
    /// The widths of a sample and of a pixel.
    pub widths: [f64; 2],
    /// The photons of a row.
    pub photons: u32,
    /// How far the light is moved.
    pub shift: [f64; 2],
}

impl LightBlock {
    /// The block: the light's camera sees [-1, 1]^2 from +z, moved a little.
    pub fn numbers(&self, glass: &Glass, inputs: [[f32; 4]; INPUTS]) -> Vec<f32> {
        let [x, y] = self.shift;
        let view_projection = DMat4::from_cols(
            DVec4::X,
            DVec4::Y,
            DVec4::new(0.0, 0.0, -0.25, 0.0),
            DVec4::new(-x, -y, 0.5, 1.0),
        );
        let [below, half] = self.window;
        let camera = Camera {
            eye: DVec3::new(below, half, f64::from(self.photons)),
            view_projection,
            inverse: view_projection.inverse(),
        };
        let mut block = frame((View::Eye, &camera, self.photons), 1.0, glass, inputs);
        let widths = self.widths.map(|width| width as f32);
        block[PIXEL_AT..PIXEL_AT + 2].copy_from_slice(&widths);
        block
    }
}

/// A margin of a picture is this part of its side.
pub const MARGIN: u32 = 5;

impl View {
    /// Whether its picture has a margin.
    pub fn has_margin(self) -> bool {
        self != View::Eye
    }

    /// Pixels a side of what is drawn, where the picture has so many.
    pub fn side(self, side: u32) -> u32 {
        if self.has_margin() {
            side + 2 * (side / MARGIN)
        } else {
            side
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_where_their_places_say() {
        let camera = Camera::around(DVec3::new(1.0, 2.0, 3.0), 1.0);
        let mut glass = Glass::of_index(1.5);
        glass.k = DVec3::splat(0.25);
        let block = frame((View::Eye, &camera, 100), 1.0, &glass, [[7.0; 4]; INPUTS]);
        assert_eq!(
            block[INDEX_AT..INDEX_AT + 8],
            [1.5, 1.5, 1.5, 0.0, 0.25, 0.25, 0.25, 0.0]
        );
        let absorption = glass.absorption().to_array().map(|value| value as f32);
        assert_eq!(block[ABSORPTION_AT..ABSORPTION_AT + 3], absorption);
        assert_eq!(block[INPUTS_AT..], [7.0; 4 * INPUTS]);
    }
}
