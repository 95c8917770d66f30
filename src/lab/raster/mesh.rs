//! Meshes: triangles with a normal at each corner. Also bodies in closed form, of an extent of one metre: a cube with flat faces, a
//! sphere, and a relief.
//!
//! ```text
//! relief: ρ(d) = 1 + a g(q d),  g = sin x cos y + sin y cos z + sin z cos x,  a = .1, q = 7
//! normal: ρ d − (∇ρ − (d·∇ρ) d)    for every unit d
//! ```
//!
//! The relief is a sphere with bumps along the gyroid, so that its normals are exact at every corner. It stands in for a
//! sculpture: many small triangles under all angles. Source of the gyroid: Schoen, *Infinite periodic minimal surfaces without
//! self-intersections*, NASA TN D-5541, 1970, <https://ntrs.nasa.gov/citations/19700020472>.

use glam::DVec3;

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

/// The longest side of a body's box, in metres.
const EXTENT: f64 = 1.0;
/// Cells along an edge of each of the six faces that cover a round body: 196 608 triangles.
const CELLS: u32 = 128;
/// The height `a` of the relief's bumps, and the frequency `q` of the gyroid in radians per radius.
const HEIGHT: f64 = 0.1;
const FREQUENCY: f64 = 7.0;

/// A body in closed form.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its name.
    pub name: &'static str,
    build: fn() -> Mesh,
}

/// A cube with flat faces and sides of 1 m.
pub static CUBE: Body = Body {
    name: "cube",
    build: cube,
};
/// A sphere with bumps along a gyroid, 1 m wide, 196 608 triangles with exact normals.
pub static RELIEF: Body = Body {
    name: "relief",
    build: relief,
};
/// A sphere, 1 m wide, 196 608 triangles with exact normals.
pub static SPHERE: Body = Body {
    name: "sphere",
    build: sphere,
};

impl Body {
    /// All bodies.
    pub const ALL: [&'static Body; 3] = [&CUBE, &RELIEF, &SPHERE];

    /// Its triangles.
    pub fn mesh(&self) -> Mesh {
        (self.build)().with_extent(EXTENT)
    }
}

/// The axes of the six faces of a cube: outwards, and two along the face.
fn faces() -> impl Iterator<Item = [DVec3; 3]> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    (0..6).map(move |face| {
        let out = axes[face % 3];
        let (along, across) = (axes[(face + 1) % 3], axes[(face + 2) % 3]);
        if face < 3 {
            [out, along, across]
        } else {
            [-out, across, along]
        }
    })
}

fn cube() -> Mesh {
    on_faces(1, &|[out, along, across], u, v| Vertex {
        position: out + u * along + v * across,
        normal: out,
    })
}

fn sphere() -> Mesh {
    on_faces(CELLS, &|axes, u, v| {
        let d = direction(axes, u, v);
        Vertex {
            position: d,
            normal: d,
        }
    })
}

fn relief() -> Mesh {
    on_faces(CELLS, &|axes, u, v| bumped(direction(axes, u, v)))
}

/// The point of the relief in a direction.
fn bumped(d: DVec3) -> Vertex {
    let at = FREQUENCY * d;
    let sin = at.map(libm::sin);
    let cos = at.map(libm::cos);
    let gyroid = sin.x * cos.y + sin.y * cos.z + sin.z * cos.x;
    let slope = DVec3::new(
        cos.x * cos.y - sin.z * sin.x,
        cos.y * cos.z - sin.x * sin.y,
        cos.z * cos.x - sin.y * sin.z,
    );
    let radius = 1.0 + HEIGHT * gyroid;
    let slope = HEIGHT * FREQUENCY * slope;
    Vertex {
        position: radius * d,
        normal: radius * d - (slope - d.dot(slope) * d),
    }
}

/// The unit direction of a point of a face. Steps along the face's middle lines have equal angles.
fn direction([out, along, across]: [DVec3; 3], u: f64, v: f64) -> DVec3 {
    // tan(π/4) is rounded below 1, so faces would not meet at pixel centres on their seams.
    let warped = |w: f64| {
        if w.abs() == 1.0 {
            w
        } else {
            libm::tan(w * std::f64::consts::FRAC_PI_4)
        }
    };
    (out + warped(u) * along + warped(v) * across).normalize()
}

/// A grid of cells on each face, two triangles per cell. `at` takes the face's axes and two numbers from -1 to 1.
fn on_faces(cells: u32, at: &dyn Fn([DVec3; 3], f64, f64) -> Vertex) -> Mesh {
    let mut mesh = Mesh::default();
    let place = |i: u32| 2.0 * f64::from(i) / f64::from(cells) - 1.0;
    for axes in faces() {
        let first = mesh.vertices.len() as u32;
        for i in 0..=cells {
            for j in 0..=cells {
                mesh.vertices.push(at(axes, place(i), place(j)));
            }
        }
        for i in 0..cells {
            for j in 0..cells {
                let corner = first + i * (cells + 1) + j;
                let beyond = corner + cells + 1;
                mesh.triangles.push([corner, beyond, beyond + 1]);
                mesh.triangles.push([corner, beyond + 1, corner + 1]);
            }
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_of_the_relief_are_those_of_its_triangles() {
        let exact = RELIEF.mesh();
        let mut smooth = exact.clone();
        smooth.smooth();
        assert!(exact.triangles.len() >= 100_000);
        let cosines = exact.vertices.iter().zip(&smooth.vertices);
        let cosines = cosines.map(|(a, b)| a.normal.normalize().dot(b.normal.normalize()));
        let sum: f64 = cosines.sum();
        assert!(sum / exact.vertices.len() as f64 > 0.9995);
    }

    /// Coinciding corners of two faces are equal to the last bit, so that no pixel falls between them.
    #[test]
    fn faces_of_round_bodies_meet() {
        for body in [&SPHERE, &RELIEF] {
            let bits =
                |vertex: &Vertex| (vertex.position + DVec3::ZERO).to_array().map(f64::to_bits);
            let mesh = body.mesh();
            let places: std::collections::HashSet<_> = mesh.vertices.iter().map(bits).collect();
            let cells = CELLS as usize;
            assert_eq!(places.len(), 6 * cells * cells + 2, "{}", body.name);
        }
    }

    #[test]
    fn bodies_are_a_metre_wide() {
        for body in Body::ALL {
            let mesh = body.mesh();
            let most = mesh.vertices.iter().map(|vertex| vertex.position);
            let most = most.fold(DVec3::NEG_INFINITY, DVec3::max);
            assert!((most.max_element() - 0.5).abs() < 1e-12, "{}", body.name);
        }
    }
}
