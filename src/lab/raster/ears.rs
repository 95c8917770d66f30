//! Triangulation of polygons: a convex one as a fan from its first corner, any other by ear clipping.
//!
//! An ear is a corner whose triangle with its neighbours lies inside and holds no other corner. Every polygon that does not cross
//! itself has two. Source: G. H. Meisters, *Polygons have Ears*, The American Mathematical Monthly 82(6), 1975,
//! <https://doi.org/10.2307/2319703>. A polygon that crosses itself has no inside. It is cut in some way, the same every time. A
//! polygon that is not planar is cut as its projection along its mean normal.

use glam::{DVec2, DVec3};

/// The most corners of a concave face. The effort of cutting it grows with their square, or worse.
pub const MOST_CONCAVE: usize = 1024;
/// Turns to the wrong side by less than this share of the whole area count as rounding.
const ROUNDING: f64 = 1e-12;

/// The triangles of faces. `corners` are those of all faces one after the other. `sizes` are their numbers of corners, empty
/// where all are triangles.
///
/// # Errors
/// A concave face has too many corners; the error is their number.
pub fn triangles_of_faces(
    corners: &[u32],
    sizes: &[u32],
    place: impl Fn(u32) -> DVec3,
) -> Result<Vec<[u32; 3]>, usize> {
    if sizes.is_empty() {
        return Ok(corners.as_chunks::<3>().0.to_vec());
    }
    let mut triangles = Vec::with_capacity(corners.len());
    let mut rest = corners;
    for size in sizes {
        let (face, after) = rest.split_at(rest.len().min(*size as usize));
        rest = after;
        let places: Vec<DVec3> = face.iter().map(|corner| place(*corner)).collect();
        if face.len() > MOST_CONCAVE && !is_convex(&places) {
            return Err(face.len());
        }
        let named = |triangle: [usize; 3]| triangle.map(|corner| face[corner]);
        triangles.extend(triangles_of(&places).into_iter().map(named));
    }
    Ok(triangles)
}

/// Whether no corner points inwards.
fn is_convex(corners: &[DVec3]) -> bool {
    corners.len() < 4 || shadow(corners).is_none_or(|flat| flat.turns_one_way())
}

/// The triangles of a polygon, by the indices of their corners.
fn triangles_of(corners: &[DVec3]) -> Vec<[usize; 3]> {
    match shadow(corners) {
        Some(flat) if corners.len() > 3 && !flat.turns_one_way() => flat.cut(),
        _ => (2..corners.len()).map(|at| [0, at - 1, at]).collect(),
    }
}

/// A polygon in a plane, counter-clockwise.
struct Flat {
    corners: Vec<DVec2>,
    twice_area: f64,
}

/// The projection of a polygon along the axis nearest to its mean normal. None where it has no area.
fn shadow(corners: &[DVec3]) -> Option<Flat> {
    let first = *corners.first()?;
    let next = corners.iter().cycle().skip(1);
    // Newell's normal, relative to a corner, so that polygons far from the origin keep their precision.
    let normal: DVec3 = corners
        .iter()
        .zip(next)
        .map(|(a, b)| (*a - first).cross(*b - first))
        .sum();
    let axis = normal.abs().max_position();
    let (mut u, mut v) = ((axis + 1) % 3, (axis + 2) % 3);
    if normal[axis] < 0.0 {
        (u, v) = (v, u);
    }
    let twice_area = normal[axis].abs();
    let flat = corners
        .iter()
        .map(|corner| DVec2::new(corner[u] - first[u], corner[v] - first[v]));
    (twice_area > 0.0 && twice_area.is_finite()).then(|| Flat {
        corners: flat.collect(),
        twice_area,
    })
}

impl Flat {
    /// Twice the signed area of a triangle, positive where it turns left.
    fn turn(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(|at| self.corners[at]);
        (b - a).perp_dot(c - a)
    }

    fn turns_one_way(&self) -> bool {
        let count = self.corners.len();
        let least = -ROUNDING * self.twice_area;
        (0..count).all(|at| self.turn([at, (at + 1) % count, (at + 2) % count]) >= least)
    }

    fn cut(&self) -> Vec<[usize; 3]> {
        let mut rest: Vec<usize> = (0..self.corners.len()).collect();
        let mut triangles = Vec::with_capacity(rest.len() - 2);
        let mut from = 0;
        while rest.len() > 3 {
            let count = rest.len();
            let at_corner = |at: usize| {
                [
                    rest[(at + count - 1) % count],
                    rest[at],
                    rest[(at + 1) % count],
                ]
            };
            let mut places = (0..count).map(|by| (from + by) % count);
            let ear = places.find(|at| self.is_ear(at_corner(*at), &rest));
            let at = ear.unwrap_or(from % count);
            triangles.push(at_corner(at));
            rest.remove(at);
            from = at;
        }
        triangles.push([rest[0], rest[1], rest[2]]);
        triangles
    }

    fn is_ear(&self, ear: [usize; 3], rest: &[usize]) -> bool {
        if self.turn(ear) <= 0.0 {
            return false;
        }
        let ends = ear.map(|at| self.corners[at]);
        let mut others = rest.iter().filter(|at| !ends.contains(&self.corners[**at]));
        !others.any(|at| {
            let [a, b, c] = ear;
            [[a, b, *at], [b, c, *at], [c, a, *at]]
                .iter()
                .all(|side| self.turn(*side) >= 0.0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec3], triangles: &[[usize; 3]]) -> f64 {
        let one = |[a, b, c]: &[usize; 3]| {
            let [a, b, c] = [*a, *b, *c].map(|at| corners[at]);
            (b - a).cross(c - a).length() / 2.0
        };
        triangles.iter().map(one).sum()
    }

    /// A comb, which no fan from one corner covers, in every plane and in both windings.
    #[test]
    fn triangles_cover_a_polygon_once() {
        let outline: Vec<(f64, f64)> = (0..9)
            .map(|i| (f64::from(i), if i % 2 == 0 { 0.1 } else { 3.0 }))
            .chain([(8.0, -1.0), (0.0, -1.0)])
            .collect();
        let right = {
            let next = outline.iter().cycle().skip(1);
            let sum: f64 = outline
                .iter()
                .zip(next)
                .map(|(a, b)| a.0 * b.1 - a.1 * b.0)
                .sum();
            (sum / 2.0).abs()
        };
        for axis in 0..3 {
            let mut corners: Vec<DVec3> = outline
                .iter()
                .map(|(x, y)| {
                    let mut corner = DVec3::splat(7.0);
                    corner[axis] = *x;
                    corner[(axis + 1) % 3] = *y;
                    corner
                })
                .collect();
            for _ in 0..2 {
                assert!(!is_convex(&corners));
                let triangles = triangles_of(&corners);
                assert_eq!(triangles.len(), corners.len() - 2);
                assert!((area(&corners, &triangles) - right).abs() < 1e-9, "{axis}");
                corners.reverse();
            }
        }
    }

    #[test]
    fn a_convex_polygon_is_a_fan_and_nothing_makes_it_panic() {
        let square = [DVec3::ZERO, DVec3::X, DVec3::ONE - DVec3::Z, DVec3::Y];
        assert_eq!(triangles_of(&square), [[0, 1, 2], [0, 2, 3]]);
        for corners in [
            vec![DVec3::ZERO; 5],
            vec![DVec3::splat(f64::NAN); 4],
            vec![DVec3::X; 2],
            vec![],
        ] {
            let _ = triangles_of(&corners);
        }
        // A bow tie, which crosses itself.
        let bow = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + 2.0 * DVec3::Y];
        assert_eq!(triangles_of(&bow).len(), 2);
    }
}
