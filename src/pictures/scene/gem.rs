//! The brilliant: an intersection of half-spaces. Its facets are the polygons that the half-spaces cut from each other.
//!
//! Its angles are near those that the trade calls ideal: table 57 % of the girdle, crown 34.5 degrees, pavilion 40.75 degrees (M.
//! Tolkowsky, *Diamond Design*, Spon, 1919, <https://www.folds.net/diamond_design/>).

use std::sync::LazyLock;

use glam::{DVec2, DVec3, DVec4};

use super::mesh::Vertex;

/// Where a line enters a convex body and where it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The distance to the entry, and the normal there.
    pub entry: (f64, DVec3),
    /// The distance to the exit, and the outward normal there.
    pub exit: (f64, DVec3),
}

/// The half-space normal · x <= distance.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Plane {
    normal: DVec3,
    distance: f64,
}

/// A body of plane facets.
#[derive(Clone, Debug, PartialEq)]
pub struct Facets(Vec<Plane>);

/// The girdle has radius 1 and this height.
const GIRDLE: f64 = 0.04;
/// The table's radius.
const TABLE: f64 = 0.57;
const CROWN: f64 = 34.5;
const PAVILION: f64 = 40.75;
/// How far the body is raised, so that its middle is near the origin.
const LIFT: f64 = 0.25;
/// The polygon of a facet begins with a square of this half side.
const LARGE: f64 = 10.0;

/// The brilliant, 1 in radius.
pub static GEM: LazyLock<Facets> = LazyLock::new(brilliant);

fn brilliant() -> Facets {
    let table_height = GIRDLE + (1.0 - TABLE) * f64::tan(CROWN.to_radians());
    let mut planes = vec![Plane {
        normal: DVec3::Y,
        distance: table_height,
    }];
    // Facets around the axis: their number, the azimuth of the first, their angle, and a point that they pass through.
    let rings = [
        (8, 0.0, CROWN, 1.0, GIRDLE),
        (16, 11.25, 40.0, 1.0, GIRDLE),
        (8, 22.5, 22.0, TABLE * 0.98, table_height),
        (32, 5.625, 90.0, 0.985, 0.0),
        (8, 0.0, 180.0 - PAVILION, 1.0, 0.0),
        (16, 11.25, 180.0 - 42.0, 1.0, 0.0),
    ];
    for (count, first, angle, radius, height) in rings {
        let (sin, cos) = libm::sincos(f64::to_radians(angle));
        planes.extend((0..count).map(|i| {
            let azimuth = f64::to_radians(first + 360.0 / f64::from(count) * f64::from(i));
            let (along_z, along_x) = libm::sincos(azimuth);
            Plane {
                normal: DVec3::new(sin * along_x, cos, sin * along_z),
                distance: sin * radius + cos * height,
            }
        }));
    }
    for plane in &mut planes {
        plane.distance += LIFT * plane.normal.y;
    }
    Facets(planes)
}

impl Facets {
    /// The radius of the ball around the origin that holds it.
    pub fn radius(&self) -> f64 {
        let corners = self.polygons().into_iter().flat_map(|(_, polygon)| polygon);
        corners.map(DVec3::length).fold(0.0, f64::max)
    }

    /// Where a line crosses the body. It enters by the last facet that faces it, and leaves by the first that does not.
    pub fn crossing(&self, origin: DVec3, direction: DVec3) -> Option<Crossing> {
        let mut entry = (f64::NEG_INFINITY, DVec3::ZERO);
        let mut exit = (f64::INFINITY, DVec3::ZERO);
        for plane in &self.0 {
            let slope = plane.normal.dot(direction);
            let height = plane.distance - plane.normal.dot(origin);
            if slope == 0.0 {
                if height < 0.0 {
                    return None;
                }
                continue;
            }
            let at = (height / slope, plane.normal);
            if slope < 0.0 && at.0 > entry.0 {
                entry = at;
            } else if slope > 0.0 && at.0 < exit.0 {
                exit = at;
            }
        }
        (entry.0 < exit.0).then_some(Crossing { entry, exit })
    }

    /// Its triangles: a fan for each facet.
    pub fn triangles(&self) -> Vec<[Vertex; 3]> {
        let mut triangles = Vec::new();
        for (plane, polygon) in self.polygons() {
            let along = plane.normal.any_orthonormal_vector();
            let vertex = |position: DVec3| Vertex {
                position,
                normal: plane.normal,
                tangent: DVec4::new(along.x, along.y, along.z, 1.0),
                uv: DVec2::ZERO,
            };
            for pair in polygon[1..].windows(2) {
                triangles.push([vertex(polygon[0]), vertex(pair[0]), vertex(pair[1])]);
            }
        }
        triangles
    }

    /// The plane and the polygon of each facet.
    fn polygons(&self) -> Vec<(Plane, Vec<DVec3>)> {
        let polygon = |plane: &Plane| {
            let (u, v) = plane.normal.any_orthonormal_pair();
            let corner = |x: f64, y: f64| plane.normal * plane.distance + LARGE * (x * u + y * v);
            let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let mut polygon: Vec<DVec3> = square.map(|(x, y)| corner(x, y)).to_vec();
            for other in self.0.iter().filter(|other| *other != plane) {
                polygon = other.cut(&polygon);
            }
            (polygon.len() > 2).then_some((*plane, polygon))
        };
        self.0.iter().filter_map(polygon).collect()
    }
}

impl Plane {
    /// The part of a polygon within the half-space.
    fn cut(&self, polygon: &[DVec3]) -> Vec<DVec3> {
        let height = |corner: DVec3| self.normal.dot(corner) - self.distance;
        let mut kept = Vec::new();
        for (i, corner) in polygon.iter().enumerate() {
            let next = polygon[(i + 1) % polygon.len()];
            let (here, there) = (height(*corner), height(next));
            if here <= 0.0 {
                kept.push(*corner);
            }
            if (here < 0.0) != (there < 0.0) && here != there {
                kept.push(*corner + (next - *corner) * (here / (here - there)));
            }
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For the polygons, by the divergence theorem: the sum of area times distance is three times the volume, and the areas along
    /// the normals cancel.
    #[test]
    fn facets_close_the_body() {
        let gem = &*GEM;
        let mut sum = DVec3::ZERO;
        for [a, b, c] in gem.triangles() {
            let [along, across] = [b, c].map(|corner| corner.position - a.position);
            sum += along.cross(across).length() / 2.0 * a.normal;
        }
        assert!(sum.length() < 1e-9, "{sum}");
        assert!((0.9..1.1).contains(&gem.radius()), "{}", gem.radius());
    }

    #[test]
    fn a_line_through_the_middle_crosses_from_facet_to_facet() {
        let gem = &*GEM;
        let down = gem
            .crossing(DVec3::new(0.01, 5.0, 0.02), DVec3::NEG_Y)
            .unwrap();
        assert_eq!(down.entry.1, DVec3::Y);
        assert!(down.exit.1.y < -0.7, "{down:?}");
        assert_eq!(gem.crossing(DVec3::new(3.0, 5.0, 0.0), DVec3::NEG_Y), None);
    }
}
