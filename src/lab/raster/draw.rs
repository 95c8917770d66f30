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

use glam::DVec3;

use super::camera::Camera;
use super::mesh::{Mesh, Vertex};

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
    let points = surface_points(mesh, camera).into_iter();
    Frame {
        size: camera.lens.size,
        covered: points.map(|point| (point.place, point.cos_theta)).collect(),
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
    let screen = Screen::new(camera);
    let corners: Vec<Corner> = mesh
        .vertices
        .iter()
        .map(|vertex| screen.corner(camera.relative(vertex.position)))
        .collect();
    let mut depth = DepthBuffer::new(screen.size);
    for (name, triangle) in mesh.triangles.iter().enumerate() {
        let triangle = triangle.map(|corner| corners[corner as usize]);
        let name = name as u32;
        depth.enter(&screen, name, triangle, is_one_sided(name));
    }
    let point = |(place, name): (usize, &u32)| {
        let triangle = mesh.triangles[*name as usize];
        let positions = triangle.map(|corner| corners[corner as usize].position);
        let vertices = triangle.map(|corner| mesh.vertices[corner as usize]);
        let ray = screen.ray(place);
        let weights = weights(ray, positions);
        let (normal, cos_theta) = seen_normal(ray, positions, weights, &vertices, camera);
        SurfacePoint {
            place: place as u32,
            triangle: *name,
            cos_theta,
            normal: camera.in_world(normal).normalize(),
            to_camera: -camera.in_world(ray).normalize(),
            weights,
        }
    };
    let names = depth.names.iter().enumerate();
    let covered = names.filter(|(_, name)| **name != NONE);
    covered.map(point).collect()
}

/// The grid of pixels.
struct Screen {
    size: [u32; 2],
    pixels_a_slope: f64,
    /// The smallest and the largest visible 1/z.
    inverse_depths: [f64; 2],
}

/// A corner relative to the camera, and its position on the screen.
#[derive(Clone, Copy)]
struct Corner {
    position: DVec3,
    x: f64,
    y: f64,
}

impl Screen {
    fn new(camera: &Camera) -> Screen {
        Screen {
            size: camera.lens.size,
            pixels_a_slope: camera.pixels_a_slope(),
            inverse_depths: [camera.far.recip(), camera.near.recip()],
        }
    }

    fn corner(&self, position: DVec3) -> Corner {
        let [width, height] = self.size.map(f64::from);
        let scale = self.pixels_a_slope / position.z;
        Corner {
            position,
            x: width / 2.0 + scale * position.x,
            y: height / 2.0 + scale * position.y,
        }
    }

    /// The slope of the ray through a column's or a row's centre.
    fn slope(&self, axis: usize, place: usize) -> f64 {
        (place as f64 + 0.5 - f64::from(self.size[axis]) / 2.0) / self.pixels_a_slope
    }

    fn ray(&self, place: usize) -> DVec3 {
        let width = self.size[0] as usize;
        let (x, y) = (self.slope(0, place % width), self.slope(1, place / width));
        DVec3::new(x, y, 1.0)
    }

    /// The columns or rows whose centres lie between these positions.
    fn centres(&self, axis: usize, places: [f64; 3]) -> std::ops::Range<usize> {
        let [a, b, c] = places;
        let first = (a.min(b).min(c) - 0.5 - ROUNDING).ceil();
        let last = (a.max(b).max(c) - 0.5 + ROUNDING).floor();
        // A conversion from float saturates at 0 and at the largest integer.
        first as usize..((last + 1.0) as usize).min(self.size[axis] as usize)
    }

    /// The columns and rows of a triangle's bounding box. All of them where it reaches behind the camera.
    fn range(&self, triangle: &[Corner; 3]) -> [std::ops::Range<usize>; 2] {
        if triangle.iter().any(|corner| corner.position.z <= 0.0) {
            return self.size.map(|pixels| 0..pixels as usize);
        }
        [
            self.centres(0, triangle.map(|corner| corner.x)),
            self.centres(1, triangle.map(|corner| corner.y)),
        ]
    }
}

/// The nearest triangle so far at every pixel, and 1/z there.
struct DepthBuffer {
    nearest: Vec<f64>,
    names: Vec<u32>,
}

impl DepthBuffer {
    fn new([width, height]: [u32; 2]) -> DepthBuffer {
        let pixels = width as usize * height as usize;
        DepthBuffer {
            nearest: vec![0.0; pixels],
            names: vec![NONE; pixels],
        }
    }

    fn enter(&mut self, screen: &Screen, name: u32, triangle: [Corner; 3], is_one_sided: bool) {
        let [columns, rows] = screen.range(&triangle);
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let positions = triangle.map(|corner| corner.position);
        let det = positions[0].dot(positions[1].cross(positions[2]));
        let is_hidden = is_one_sided && det > 0.0;
        if det == 0.0 || !det.is_finite() || is_hidden {
            return;
        }
        let [farthest, nearest] = screen.inverse_depths;
        let edges = edges(positions).map(|edge| edge * det.signum());
        let (least, most) = depths(positions);
        let width = screen.size[0] as usize;
        for row in rows {
            let y = screen.slope(1, row);
            let along = edges.map(|edge| edge.y * y + edge.z);
            for column in columns.clone() {
                let x = screen.slope(0, column);
                let e = [0, 1, 2].map(|i| edges[i].x * x + along[i]);
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
    let depths = positions.map(|position| position.z.recip());
    if depths.iter().any(|depth| *depth <= 0.0) {
        return (0.0, f64::MAX);
    }
    let [a, b, c] = depths;
    (a.min(b).min(c), a.max(b).max(c))
}

/// The barycentric coordinates of the point where a ray meets a triangle.
fn weights(ray: DVec3, positions: [DVec3; 3]) -> [f64; 3] {
    let weights = edges(positions).map(|edge| edge.dot(ray));
    let whole = weights[0] + weights[1] + weights[2];
    weights.map(|weight| weight / whole)
}

/// The normal on the visible side, in camera axes, and the cosine between it and the direction to the camera.
fn seen_normal(
    ray: DVec3,
    positions: [DVec3; 3],
    weights: [f64; 3],
    vertices: &[Vertex; 3],
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
