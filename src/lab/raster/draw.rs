//! Meshes, cameras, and the frames that they give: the nearest triangle at every pixel's centre, and the cosine between its
//! normal and the direction to the camera.
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
//!
//! Meshes are triangles with a normal at each corner. Cameras are a pinhole camera, a distant one that stands for an orthographic
//! camera, and a camera that turns about an object.

use glam::DVec3;

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

/// A corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Its position, in metres.
    pub position: DVec3,
    /// The normal of the surface there. Its length does not matter.
    pub normal: DVec3,
}

/// Triangles that share corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The corners.
    pub vertices: Vec<Vertex>,
    /// Three indices of corners each.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The mesh moved and scaled so that its bounding box is centred at the origin and has a longest side of this length.
    #[must_use]
    pub fn with_extent(mut self, extent: f64) -> Mesh {
        let all = || self.vertices.iter().map(|vertex| vertex.position);
        let least = all().fold(DVec3::INFINITY, DVec3::min);
        let most = all().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre = (least + most) / 2.0;
        let side = (most - least).max_element();
        let scale = if side > 0.0 { extent / side } else { 1.0 };
        for vertex in &mut self.vertices {
            vertex.position = scale * (vertex.position - centre);
        }
        self
    }

    /// The distance of the farthest corner from the origin.
    pub fn radius(&self) -> f64 {
        let lengths = self.vertices.iter().map(|vertex| vertex.position.length());
        lengths.fold(0.0, f64::max)
    }

    /// Sets the normals of a smooth surface: at each corner the sum of its triangles' normals, weighted by area.
    pub fn smooth(&mut self) {
        for vertex in &mut self.vertices {
            vertex.normal = DVec3::ZERO;
        }
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|corner| self.vertices[corner as usize].position);
            let normal = (b - a).cross(c - a);
            for corner in triangle {
                self.vertices[*corner as usize].normal += normal;
            }
        }
    }
}

/// The distance of an orthographic camera, in heights of its picture. Rays at the upper and the lower edge are turned by 5e-7
/// radians.
const DISTANT: f64 = 1e6;

/// The resolution and the field of view of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The vertical field of view, in degrees.
    pub vertical_degrees: f64,
}

/// A perspective camera. Its axes are unit vectors: to the right, down and forwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Its position.
    pub eye: DVec3,
    /// Its axes: to the right, down, forwards.
    pub axes: [DVec3; 3],
    /// Its resolution and field of view.
    pub lens: Lens,
    /// The near clip distance along its axis, in metres.
    pub near: f64,
    /// The far clip distance along its axis, in metres.
    pub far: f64,
}

impl Camera {
    /// A camera of this position and these axes that sees everything in front of it.
    pub fn new(eye: DVec3, axes: [DVec3; 3], lens: Lens) -> Camera {
        Camera {
            eye,
            axes,
            lens,
            near: 0.0,
            far: f64::INFINITY,
        }
    }

    /// A camera that looks from one point at another. Up is y, or z where it looks along y.
    pub fn looking(eye: DVec3, at: DVec3, lens: Lens) -> Camera {
        let forwards = (at - eye).normalize();
        let up = if forwards.y.abs() < 0.999 {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let right = forwards.cross(up).normalize();
        Camera::new(eye, [right, forwards.cross(right), forwards], lens)
    }

    /// A camera of this position and these axes with parallel rays: `height` metres fill its picture of `size` pixels. It
    /// approximates an orthographic camera by a pinhole a million heights behind `eye`, and sees what is behind `eye` too.
    pub fn orthographic(eye: DVec3, axes: [DVec3; 3], height: f64, size: [u32; 2]) -> Camera {
        let half = libm::atan(0.5 / DISTANT);
        let lens = Lens {
            size,
            vertical_degrees: 2.0 * half.to_degrees(),
        };
        Camera::new(eye - DISTANT * height * axes[2], axes, lens)
    }

    /// This camera with clip planes, in metres. For [`Camera::orthographic`], `height` is its height, and they count from its
    /// `eye`.
    #[must_use]
    pub fn clipped(self, [near, far]: [f64; 2], height: Option<f64>) -> Camera {
        let behind = height.map_or(0.0, |height| DISTANT * height);
        Camera {
            near: behind + near,
            far: behind + far,
            ..self
        }
    }

    /// A point relative to the camera: to the right, down, forwards.
    pub fn relative(&self, point: DVec3) -> DVec3 {
        self.turned(point - self.eye)
    }

    /// A world direction in camera axes.
    pub fn turned(&self, direction: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(direction)))
    }

    /// A direction in camera axes as a world direction.
    pub fn in_world(&self, direction: DVec3) -> DVec3 {
        let [right, down, forwards] = self.axes;
        direction.x * right + direction.y * down + direction.z * forwards
    }

    /// The number of pixels that a slope of 1 spans.
    pub fn pixels_a_slope(&self) -> f64 {
        let half = (self.lens.vertical_degrees / 2.0).to_radians();
        f64::from(self.lens.size[1]) / 2.0 / libm::tan(half)
    }
}

/// A camera that looks at the origin and turns about it by the same angle from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turntable {
    /// Its position in the first frame.
    pub start: DVec3,
    /// The axis of rotation.
    pub axis: DVec3,
    /// The angle from frame to frame, in degrees.
    pub step_degrees: f64,
    /// The number of frames.
    pub frames: usize,
    /// Its resolution and field of view.
    pub lens: Lens,
}

impl Turntable {
    /// The thesis's: 180 frames of one degree about (1, 1, 1) from 2 m. Resolution, field of view and start are ours: the thesis
    /// does not state them.
    pub const THESIS: Turntable = Turntable {
        start: DVec3::new(0.0, 0.0, -2.0),
        axis: DVec3::ONE,
        step_degrees: 1.0,
        frames: 180,
        lens: Lens {
            size: [640, 480],
            vertical_degrees: 60.0,
        },
    };

    /// The cameras of all frames.
    pub fn cameras(&self) -> Vec<Camera> {
        (0..self.frames).map(|frame| self.camera(frame)).collect()
    }

    fn camera(&self, frame: usize) -> Camera {
        let first = Camera::looking(self.start, DVec3::ZERO, self.lens);
        let angle = (frame as f64 * self.step_degrees).to_radians();
        let turned = |vector: DVec3| rotated(vector, self.axis.normalize(), angle);
        Camera::new(turned(first.eye), first.axes.map(turned), self.lens)
    }
}

/// A vector rotated about a unit axis, by Rodrigues' formula.
pub fn rotated(vector: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(angle);
    cos * vector + sin * axis.cross(vector) + (1.0 - cos) * axis.dot(vector) * axis
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_keeps_the_distance_and_looks_at_the_origin() {
        for camera in Turntable::THESIS.cameras() {
            assert!((camera.eye.length() - 2.0).abs() < 1e-12);
            let centre = camera.relative(DVec3::ZERO);
            assert!((centre - DVec3::new(0.0, 0.0, 2.0)).length() < 1e-12);
            let [right, down, forwards] = camera.axes;
            assert!((right.cross(down) - forwards).length() < 1e-12);
        }
    }
}
