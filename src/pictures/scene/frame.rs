//! The uniform block that every pass sees: cameras, the material, the room, the inputs of the method. Also the camera of a
//! picture: rays for the tracer, a matrix for the rasteriser.

use glam::{DMat4, DVec3, DVec4};

use super::material::OpticalMaterial;
use super::room::{CUBE_CENTRE, ROOM_MAX, ROOM_MIN};
use super::table::View;
use super::text::INPUTS;

/// Where the index begins in the block, in numbers: n, then k, with four numbers each.
pub const INDEX_AT: usize = 36;
/// Where absorption begins.
pub const ABSORPTION_AT: usize = 88;
/// Where the film's thickness stands, in nanometres.
pub const FILM_AT: usize = 92;
/// Where the method's inputs begin.
pub const INPUTS_AT: usize = 96;

/// The block of a pass, from its view, the eye's camera, the pixels a side of the picture, the body's size and material, and the
/// inputs of the method.
pub fn frame(
    (view, eye, side): (View, &Camera, u32),
    size: f64,
    material: &OpticalMaterial,
    inputs: [[f32; 4]; INPUTS],
) -> Vec<f32> {
    let camera = view.camera(eye, side);
    let four = |v: DVec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
    let matrix = |m: DMat4| m.to_cols_array().map(|value| value as f32);
    let mut numbers = Vec::new();
    numbers.extend(matrix(camera.view_projection));
    numbers.extend(matrix(camera.inverse));
    numbers.extend(four(camera.eye, size));
    numbers.extend(four(material.n, 0.0));
    numbers.extend(four(material.k, 0.0));
    for corner in [ROOM_MIN, ROOM_MAX, CUBE_CENTRE] {
        numbers.extend(four(corner, 0.0));
    }
    for view in [View::Margin, View::Mirrored] {
        numbers.extend(matrix(view.camera(eye, side).view_projection));
    }
    numbers.extend(four(material.absorption(), 0.0));
    numbers.extend([material.film_nm as f32, 0.0, 0.0, 0.0]);
    numbers.extend(inputs.concat());
    numbers
}

/// The default number of photons in a row.
pub const PHOTONS: u32 = 256;
/// Pixels along a side of the picture of the body's back, where the exits of photons are searched.
pub const BACK: u32 = 1024;
/// Where the widths of a sample and of a pixel begin in the light's block.
pub const PIXEL_AT: usize = 46;

/// Light that falls along -z through a body onto a receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBlock {
    /// The receiver's distance below the body's centre, and half the width of its window.
    pub window: [f64; 2],
    /// The widths of a sample and of a pixel.
    pub widths: [f64; 2],
    /// Photons in a row.
    pub photons: u32,
    /// How far the light is shifted.
    pub shift: [f64; 2],
}

impl LightBlock {
    /// The numbers of the block. The light's camera sees [-1, 1]^2 from +z, shifted a little.
    pub fn numbers(&self, material: &OpticalMaterial, inputs: [[f32; 4]; INPUTS]) -> Vec<f32> {
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
        let mut block = frame((View::Eye, &camera, self.photons), 1.0, material, inputs);
        let widths = self.widths.map(|width| width as f32);
        block[PIXEL_AT..PIXEL_AT + 2].copy_from_slice(&widths);
        block
    }
}

/// The margin of a picture is its side divided by this.
pub const MARGIN: u32 = 5;

impl View {
    /// Whether its picture has a margin.
    pub fn has_margin(self) -> bool {
        self != View::Eye
    }

    /// The side of what is drawn, in pixels, for a picture with this side.
    pub fn side(self, side: u32) -> u32 {
        if self.has_margin() {
            side + 2 * (side / MARGIN)
        } else {
            side
        }
    }

    /// The camera of a pass, from that of the eye.
    fn camera(self, eye: &Camera, side: u32) -> Camera {
        let camera = match self {
            View::Eye | View::Margin => *eye,
            View::Mirrored => eye.mirrored().clipped_below(),
            View::MirroredUnclipped => eye.mirrored(),
        };
        camera.with_margin(side, self.side(side))
    }
}

/// A camera. The world is right-handed and its y points up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The position of the eye.
    pub eye: DVec3,
    /// From the world to clip space, depth 0 to 1.
    pub view_projection: DMat4,
    /// Its inverse, before the near plane is replaced; it gives directions.
    pub inverse: DMat4,
}

/// Where depth begins and ends, in distances of the eye from the origin.
const NEAR: f64 = 0.05;
const FAR: f64 = 10.0;

impl Camera {
    /// The camera of a square picture that looks at the origin, so that a ball of this radius around it takes 90 % of the height.
    pub fn around(eye: DVec3, radius: f64) -> Camera {
        let distance = eye.length();
        let half_height = libm::tan(libm::asin(radius / distance)) / 0.9;
        let (near, far) = (NEAR * distance, FAR * distance);
        let view_projection = perspective(half_height, near, far) * looking_at_origin(eye);
        Camera {
            eye,
            view_projection,
            inverse: view_projection.inverse(),
        }
    }

    /// The camera mirrored in the plane y = 0. Its picture shows the mirrored world at the pixels where this camera sees the
    /// plane.
    pub fn mirrored(&self) -> Camera {
        let mirror = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
        Camera {
            eye: mirror.transform_point3(self.eye),
            view_projection: self.view_projection * mirror,
            inverse: mirror * self.inverse,
        }
    }

    /// The same camera for a picture with a margin: `side` pixels of the picture, `whole` pixels with the margin.
    pub fn with_margin(&self, side: u32, whole: u32) -> Camera {
        let share = f64::from(side) / f64::from(whole);
        let smaller = DVec3::new(share, share, 1.0);
        Camera {
            eye: self.eye,
            view_projection: DMat4::from_scale(smaller) * self.view_projection,
            inverse: self.inverse * DMat4::from_scale(smaller.recip()),
        }
    }

    /// The same camera with another near plane, which clips what lies below the plane y = 0.
    pub fn clipped_below(&self) -> Camera {
        Camera {
            view_projection: with_near_plane(self.view_projection, DVec4::Y),
            ..*self
        }
    }

    /// The direction through a point of the picture: 0 to 1 from left to right, and from top to bottom.
    pub fn direction(&self, x: f64, y: f64) -> DVec3 {
        let far = DVec3::new(2.0 * x - 1.0, 1.0 - 2.0 * y, 1.0);
        (self.inverse.project_point3(far) - self.eye).normalize()
    }
}

/// From the world to the camera, which looks along its -z.
fn looking_at_origin(eye: DVec3) -> DMat4 {
    let back = eye.normalize();
    let right = DVec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let camera = DMat4::from_cols(
        right.extend(0.0),
        up.extend(0.0),
        back.extend(0.0),
        eye.extend(1.0),
    );
    camera.inverse()
}

/// From the camera to clip space, for a square picture with this half height at distance 1.
fn perspective(half_height: f64, near: f64, far: f64) -> DMat4 {
    let scale = 1.0 / half_height;
    let depth = far / (near - far);
    DMat4::from_cols(
        DVec4::new(scale, 0.0, 0.0, 0.0),
        DVec4::new(0.0, scale, 0.0, 0.0),
        DVec4::new(0.0, 0.0, depth, -1.0),
        DVec4::new(0.0, 0.0, near * depth, 0.0),
    )
}

/// The matrix with another near plane. The row of depth becomes the plane, scaled so that the corner of the frustum that is
/// farthest from the plane has depth 1. The rows of x, y and w stay.
///
/// Source: Lengyel, *Oblique View Frustum Depth Projection and Clipping*, Journal of Game Development 1 (2), 2005,
/// <https://terathon.com/lengyel/Lengyel-Oblique.pdf>; its clip space has depth -1 to 1, ours 0 to 1.
fn with_near_plane(view_projection: DMat4, plane: DVec4) -> DMat4 {
    let to_world = view_projection.inverse();
    let in_clip = to_world.transpose() * plane;
    let corner = DVec4::new(in_clip.x.signum(), in_clip.y.signum(), 1.0, 1.0);
    let depth = plane / plane.dot(to_world * corner);
    let rows = view_projection.transpose();
    DMat4::from_cols(rows.x_axis, rows.y_axis, depth, rows.w_axis).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_where_their_places_say() {
        let camera = Camera::around(DVec3::new(1.0, 2.0, 3.0), 1.0);
        let mut material = OpticalMaterial::of_index(1.5);
        material.k = DVec3::splat(0.25);
        material.film_nm = 150.0;
        let block = frame(
            (View::Eye, &camera, 100),
            1.0,
            &material,
            [[7.0; 4]; INPUTS],
        );
        assert_eq!(
            block[INDEX_AT..INDEX_AT + 8],
            [1.5, 1.5, 1.5, 0.0, 0.25, 0.25, 0.25, 0.0]
        );
        let absorption = material.absorption().to_array().map(|value| value as f32);
        assert_eq!(block[ABSORPTION_AT..ABSORPTION_AT + 3], absorption);
        assert_eq!(block[FILM_AT], 150.0);
        assert_eq!(block[INPUTS_AT..], [7.0; 4 * INPUTS]);
    }

    #[test]
    fn what_lies_below_the_plane_is_clipped() {
        let camera = Camera::around(DVec3::new(1.0, 2.0, 3.0), 1.0);
        let whole = camera.mirrored();
        let clipped = whole.clipped_below();
        assert_eq!(whole.eye, DVec3::new(1.0, -2.0, 3.0));
        for (x, z) in [(0.0, 0.0), (0.4, -0.7), (-1.0, 0.3)] {
            let at = |y: f64| {
                let place = DVec4::new(x, y, z, 1.0);
                (
                    clipped.view_projection * place,
                    whole.view_projection * place,
                )
            };
            assert!(at(0.0).0.z.abs() < 1e-12, "on the plane");
            assert!(at(-0.2).0.z < 0.0, "below it");
            let (near, same) = at(0.3);
            assert!(0.0 < near.z && near.z < near.w, "above it: {near}");
            assert_eq!((near.x, near.y, near.w), (same.x, same.y, same.w));
        }
    }

    #[test]
    fn a_mirrored_camera_sees_the_mirrored_world_where_this_one_sees_the_plane() {
        let camera = Camera::around(DVec3::new(1.0, 2.0, 3.0), 1.0);
        let mirrored = camera.mirrored();
        let place = DVec3::new(0.3, 0.0, -0.4);
        let [one, other] = [&camera, &mirrored].map(|of| of.view_projection.project_point3(place));
        assert!((one - other).length() < 1e-12, "{one} {other}");
        let (x, y) = (0.5 + 0.5 * one.x, 0.5 - 0.5 * one.y);
        let seen = camera.direction(x, y) * DVec3::new(1.0, -1.0, 1.0);
        assert!((mirrored.direction(x, y) - seen).length() < 1e-9);
    }

    #[test]
    fn rays_go_where_the_matrix_puts_them() {
        let camera = Camera::around(DVec3::new(1.0, 2.0, 3.0), 1.0);
        for (x, y) in [(0.5, 0.5), (0.1, 0.8), (0.9, 0.3)] {
            let place = camera.eye + 2.5 * camera.direction(x, y);
            let clip = camera.view_projection.project_point3(place);
            assert!((clip.x - (2.0 * x - 1.0)).abs() < 1e-9, "{clip}");
            assert!((clip.y - (1.0 - 2.0 * y)).abs() < 1e-9, "{clip}");
            assert!((0.0..1.0).contains(&clip.z), "{clip}");
        }
    }
}
