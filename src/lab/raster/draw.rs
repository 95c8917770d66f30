//! The frames that a mesh and a camera give: the nearest triangle at every pixel's centre, and the cosine between its normal and
//! the direction to the camera.
//!
//! ```text
//! r = (x, y, 1) through the centre of a pixel;  e₀ = r·(v₁ × v₂), e₁ = r·(v₂ × v₀), e₂ = r·(v₀ × v₁)
//! inside: all e have the sign of det = v₀·(v₁ × v₂);  1/z = (e₀ + e₁ + e₂) / det;  weights of corners: eᵢ / (e₀ + e₁ + e₂)
//! ```
//!
//! Corners are relative to the camera. Source: Olano, Greer, *Triangle Scan Conversion using 2D Homogeneous Coordinates*,
//! Graphics Hardware, 1997, <https://doi.org/10.1145/258694.258723>. Nothing is clipped or divided first, so that triangles
//! may reach behind the camera, and both triangles of an edge compute the same number with opposite signs: no pixel falls between
//! them.
//!
//! A surface has two sides: a normal that points away from the visible side is flipped. An interpolated normal may still point
//! away from the camera at the silhouette. Its cosine is 0 there, as shaders clamp it.

use std::cell::Cell;

use glam::DVec3;

use super::camera::Camera;
use super::mesh::{Mesh, Vertex};
use crate::physics::num::each_channel;

/// Pixels by which the bounding box of a triangle is widened, for the rounding of its corners.
const ROUNDING: f64 = 1e-6;
/// No triangle covers this pixel.
const NONE: u32 = u32::MAX;

/// What a frame shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The covered pixels in scan order: the index, row by row, and cos θ.
    pub covered: Vec<(u32, f64)>,
}

/// What a pixel shows of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The pixel's index, row by row from the top left.
    pub place: u32,
    /// The index of the visible triangle in the mesh.
    pub triangle: u32,
    /// The cosine between the normal and the direction to the camera, clamped to [0, 1].
    pub cos_theta: f64,
    /// The unit normal on the visible side, in world axes.
    pub normal: DVec3,
    /// The unit direction to the camera, in world axes.
    pub to_camera: DVec3,
    /// The barycentric coordinates in the triangle.
    pub weights: [f64; 3],
}

impl SurfacePoint {
    /// The unit direction of mirror reflection: 2 (n·v) n - v.
    pub fn mirrored(&self) -> DVec3 {
        2.0 * self.normal.dot(self.to_camera) * self.normal - self.to_camera
    }
}

/// Draws a frame.
pub fn draw(mesh: &Mesh, camera: &Camera) -> Frame {
    let drawn = Drawn::new(mesh, camera, &|_| false);
    let covered = drawn.covered().map(|(place, name)| {
        let seen = drawn.seen(place, name);
        (place, seen.cos_theta)
    });
    Frame {
        size: camera.lens.size,
        covered: covered.collect(),
    }
}

/// What each covered pixel shows, in scan order. Both sides of every triangle are visible.
pub fn surface_points(mesh: &Mesh, camera: &Camera) -> Vec<SurfacePoint> {
    surface_points_of(mesh, camera, &|_| false)
}

/// As [`surface_points`], where some triangles are visible only from the side from which their corners run counter-clockwise.
pub fn surface_points_of(
    mesh: &Mesh,
    camera: &Camera,
    is_one_sided: &dyn Fn(u32) -> bool,
) -> Vec<SurfacePoint> {
    let drawn = Drawn::new(mesh, camera, is_one_sided);
    let point = |(place, triangle): (u32, u32)| {
        let seen = drawn.seen(place, triangle);
        SurfacePoint {
            place,
            triangle,
            cos_theta: seen.cos_theta,
            normal: camera.in_world(seen.normal).normalize(),
            to_camera: -camera.in_world(seen.ray).normalize(),
            weights: seen.weights,
        }
    };
    drawn.covered().map(point).collect()
}

/// A mesh in front of a camera, with the nearest triangle of every pixel.
struct Drawn<'a> {
    mesh: &'a Mesh,
    camera: &'a Camera,
    screen: Screen,
    corners: Vec<Corner>,
    depth: DepthBuffer,
}

/// The part of a triangle at a pixel, in camera axes. `normal` is on the visible side and has any length.
struct Seen {
    ray: DVec3,
    weights: [f64; 3],
    normal: DVec3,
    cos_theta: f64,
}

impl Drop for Drawn<'_> {
    fn drop(&mut self) {
        SPARE.set(std::mem::take(&mut self.depth));
    }
}

impl Drawn<'_> {
    fn new<'a>(
        mesh: &'a Mesh,
        camera: &'a Camera,
        is_one_sided: &dyn Fn(u32) -> bool,
    ) -> Drawn<'a> {
        let screen = Screen::new(camera);
        let vertices = mesh.vertices.iter();
        let corners: Vec<Corner> = vertices
            .map(|vertex| screen.corner(camera.relative(vertex.position)))
            .collect();
        let mut depth = DepthBuffer::new(screen.size);
        for (name, triangle) in mesh.triangles.iter().enumerate() {
            let name = name as u32;
            let triangle = each_channel(|i| &corners[triangle[i] as usize]);
            depth.enter(&screen, name, triangle, &|| is_one_sided(name));
        }
        Drawn {
            mesh,
            camera,
            screen,
            corners,
            depth,
        }
    }

    /// The covered pixels in scan order, and their triangles.
    fn covered(&self) -> impl Iterator<Item = (u32, u32)> {
        let names = self.depth.names.iter().enumerate();
        names
            .filter(|(_, name)| **name != NONE)
            .map(|(place, name)| (place as u32, *name))
    }

    fn seen(&self, place: u32, triangle: u32) -> Seen {
        let triangle = self.mesh.triangles[triangle as usize];
        let positions = each_channel(|i| self.corners[triangle[i] as usize].position);
        let vertices = each_channel(|i| &self.mesh.vertices[triangle[i] as usize]);
        let ray = self.screen.ray(place as usize);
        let weights = weights(ray, positions);
        let (normal, cos_theta) = seen_normal(ray, positions, weights, vertices, self.camera);
        Seen {
            ray,
            weights,
            normal,
            cos_theta,
        }
    }
}

/// The grid of pixels.
struct Screen {
    size: [u32; 2],
    pixels_a_slope: f64,
    /// The slopes of the rays through the centres of all columns, and of all rows.
    slopes: [Vec<f64>; 2],
    /// The smallest and the largest visible 1/z.
    inverse_depths: [f64; 2],
}

/// A corner relative to the camera. On either axis, pixels whose centres lie behind it start at `from`, and those whose centres
/// lie before it end at `to`.
struct Corner {
    position: DVec3,
    from: [u32; 2],
    to: [u32; 2],
}

impl Screen {
    fn new(camera: &Camera) -> Screen {
        let (size, pixels_a_slope) = (camera.lens.size, camera.pixels_a_slope());
        let slopes = size.map(|pixels| {
            let middle = f64::from(pixels) / 2.0;
            let slope = |place| (f64::from(place) + 0.5 - middle) / pixels_a_slope;
            (0..pixels).map(slope).collect()
        });
        Screen {
            size,
            pixels_a_slope,
            slopes,
            inverse_depths: [camera.far.recip(), camera.near.recip()],
        }
    }

    fn corner(&self, position: DVec3) -> Corner {
        let (mut from, mut to) = ([0; 2], self.size);
        // A triangle that reaches behind the camera may cover any pixel.
        if position.z > 0.0 {
            let scale = self.pixels_a_slope / position.z;
            for (axis, slope) in [position.x, position.y].into_iter().enumerate() {
                let at = f64::from(self.size[axis]) / 2.0 + scale * slope;
                from[axis] = rounded_up(at - 0.5 - ROUNDING);
                to[axis] = to[axis].min(after(at - 0.5 + ROUNDING));
            }
        }
        Corner { position, from, to }
    }

    fn ray(&self, place: usize) -> DVec3 {
        let width = self.size[0] as usize;
        let (x, y) = (self.slopes[0][place % width], self.slopes[1][place / width]);
        DVec3::new(x, y, 1.0)
    }
}

/// The least whole number from 0 that is not below `x`. `ceil` and `floor` are calls on x86-64, and conversions saturate.
fn rounded_up(x: f64) -> u32 {
    let whole = x as u32;
    whole.saturating_add(u32::from(f64::from(whole) < x))
}

/// The least whole number from 0 that is above `x`.
fn after(x: f64) -> u32 {
    if x >= 0.0 {
        (x as u32).saturating_add(1)
    } else {
        0
    }
}

/// The columns or rows of a triangle's bounding box.
fn range([a, b, c]: [&Corner; 3], axis: usize) -> std::ops::Range<usize> {
    let from = a.from[axis].min(b.from[axis]).min(c.from[axis]);
    let to = a.to[axis].max(b.to[axis]).max(c.to[axis]);
    from as usize..to as usize
}

thread_local! {
    /// The buffer of a thread's last frame: fresh memory costs more than clearing what is there.
    static SPARE: Cell<DepthBuffer> = Cell::default();
}

/// The nearest triangle so far at every pixel, and 1/z there.
#[derive(Default)]
struct DepthBuffer {
    nearest: Vec<f64>,
    names: Vec<u32>,
}

impl DepthBuffer {
    fn new([width, height]: [u32; 2]) -> DepthBuffer {
        let pixels = width as usize * height as usize;
        let DepthBuffer {
            mut nearest,
            mut names,
        } = SPARE.take();
        nearest.clear();
        nearest.resize(pixels, 0.0);
        names.clear();
        names.resize(pixels, NONE);
        DepthBuffer { nearest, names }
    }

    fn enter(
        &mut self,
        screen: &Screen,
        name: u32,
        triangle: [&Corner; 3],
        is_one_sided: &dyn Fn() -> bool,
    ) {
        let (columns, rows) = (range(triangle, 0), range(triangle, 1));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let positions = each_channel(|i| triangle[i].position);
        let det = positions[0].dot(positions[1].cross(positions[2]));
        if det == 0.0 || !det.is_finite() || det > 0.0 && is_one_sided() {
            return;
        }
        let [farthest, nearest] = screen.inverse_depths;
        let planes = edges(positions);
        let edges = each_channel(|i| planes[i] * det.signum());
        let (least, most) = depths(positions);
        let width = screen.size[0] as usize;
        for row in rows {
            let y = screen.slopes[1][row];
            let along = each_channel(|i| edges[i].y * y + edges[i].z);
            for column in columns.clone() {
                let x = screen.slopes[0][column];
                let e = each_channel(|i| edges[i].x * x + along[i]);
                if e[0] < 0.0 || e[1] < 0.0 || e[2] < 0.0 {
                    continue;
                }
                let depth = ((e[0] + e[1] + e[2]) / det.abs()).clamp(least, most);
                let place = row * width + column;
                let is_seen = (farthest..=nearest).contains(&depth);
                if is_seen && depth > self.nearest[place] {
                    self.nearest[place] = depth;
                    self.names[place] = name;
                }
            }
        }
    }
}

/// The planes through the camera and the edge opposite to each corner.
fn edges([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    [b.cross(c), c.cross(a), a.cross(b)]
}

/// The smallest and the largest 1/z of a triangle, to clamp to: seen edge-on, a triangle has an inexact determinant.
fn depths(positions: [DVec3; 3]) -> (f64, f64) {
    let [a, b, c] = each_channel(|i| positions[i].z.recip());
    if a <= 0.0 || b <= 0.0 || c <= 0.0 {
        return (0.0, f64::MAX);
    }
    (a.min(b).min(c), a.max(b).max(c))
}

/// The barycentric coordinates of the point where a ray meets a triangle.
fn weights(ray: DVec3, positions: [DVec3; 3]) -> [f64; 3] {
    let edges = edges(positions);
    let weights = each_channel(|i| edges[i].dot(ray));
    let whole = weights[0] + weights[1] + weights[2];
    each_channel(|i| weights[i] / whole)
}

/// The normal on the visible side, in camera axes, and the cosine between it and the direction to the camera.
fn seen_normal(
    ray: DVec3,
    positions: [DVec3; 3],
    weights: [f64; 3],
    vertices: [&Vertex; 3],
    camera: &Camera,
) -> (DVec3, f64) {
    let normal = |i: usize| weights[i] * vertices[i].normal;
    let face = (positions[1] - positions[0]).cross(positions[2] - positions[0]);
    let towards = if face.dot(positions[0]) < 0.0 {
        face
    } else {
        -face
    };
    let mut normal = camera.turned(normal(0) + normal(1) + normal(2));
    // Corners without a normal, or with opposite ones.
    if normal.length_squared() == 0.0 || !normal.is_finite() {
        normal = towards;
    }
    let cos_theta = -normal.dot(ray) / (normal.length() * ray.length());
    let (normal, seen) = if normal.dot(towards) < 0.0 {
        (-normal, -cos_theta)
    } else {
        (normal, cos_theta)
    };
    (normal, seen.clamp(0.0, 1.0))
}
