//! Meshes of others: OBJ, by the crate `tobj`.
//!
//! The crate takes NaN for a place, says of an index only that it is out of range, and holds whatever a file announces. So every
//! line is looked at first: numbers are finite, indices have a place, and there are not too many triangles.
//!
//! Source of the format: Wavefront Technologies, *Advanced Visualizer Manual*, appendix B1, 1993,
//! <https://paulbourke.net/dataformats/obj/>.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, BufRead, Read};

use glam::DVec3;
use thiserror::Error;

use super::ears::{is_convex, triangles_of};
use super::mesh::{Mesh, Vertex};

/// A mesh has at most so many triangles, and as many corners.
pub const MOST_TRIANGLES: usize = 4_000_000;
/// A face with a corner that points inwards has at most so many.
const MOST_CONCAVE: usize = 1024;
/// Statements of surfaces that are no polygons, of which some would silently be missing.
const OTHER_SURFACES: [&str; 4] = ["surf", "bsp", "bzp", "fo"];
/// No place is farther away: its square is a number.
const FARTHEST: f64 = 1e100;

/// What is wrong with an OBJ file, and where.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}: {what}")]
pub struct ObjFault {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong, and what is allowed.
    pub what: String,
}

/// The mesh of an OBJ text: all objects and groups together. Corners without a normal get that of a smooth surface.
///
/// # Errors
/// The text is no such mesh: which line, and what is wrong there.
pub fn mesh_of_obj(text: &str) -> Result<Mesh, ObjFault> {
    Counts::of(text)?;
    let text = &without_polylines(text);
    let options = tobj::LoadOptions {
        // The crate would cut every face as a fan, which covers more than a concave one.
        triangulate: false,
        ignore_points: true,
        ignore_lines: true,
        single_index: true,
    };
    let mut lines = Lines {
        rest: text.as_bytes(),
        line: 0,
    };
    let no_materials = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let loaded = tobj::load_obj_buf(&mut lines, &options, no_materials);
    let (models, _) = loaded.map_err(|fault| ObjFault {
        line: lines.line.max(1),
        what: fault.to_string(),
    })?;
    let mut mesh = Mesh::default();
    for model in models {
        enter(&mut mesh, &model.mesh).map_err(|corners| too_many(text, corners))?;
    }
    if mesh.triangles.is_empty() {
        return Err(ObjFault {
            line: lines.line.max(1),
            what: "the file ends without a face; a mesh has lines `v x y z` and `f a b c`"
                .to_owned(),
        });
    }
    let has_normals = |vertex: &Vertex| vertex.normal != DVec3::ZERO;
    if !mesh.vertices.iter().all(has_normals) {
        mesh = welded(&mesh);
        mesh.smooth();
    }
    Ok(mesh)
}

/// The text with an empty line for each polyline, which the crate takes for a face.
fn without_polylines(text: &str) -> Cow<'_, str> {
    let is_polyline = |line: &str| line.split_whitespace().next() == Some("l");
    if !text.lines().any(is_polyline) {
        return Cow::Borrowed(text);
    }
    let kept = |line| if is_polyline(line) { "\n" } else { line };
    Cow::Owned(text.split_inclusive('\n').map(kept).collect())
}

/// The line of a concave face that has too many corners.
fn too_many(text: &str, corners: usize) -> ObjFault {
    let count = |line: &str| match line.trim_start().strip_prefix("f ") {
        Some(rest) => rest.split_whitespace().count(),
        None => 0,
    };
    let line = text.lines().position(|line| count(line) == corners);
    let what = format!(
        "a face of {corners} corners, of which some point inwards; up to {MOST_CONCAVE} are read. Cut it into triangles"
    );
    ObjFault {
        line: line.map_or(1, |line| line + 1),
        what,
    }
}

/// Enters the triangles of one object. Corners without a normal have 0 in its place.
///
/// # Errors
/// A concave face has too many corners: so many.
fn enter(mesh: &mut Mesh, object: &tobj::Mesh) -> Result<(), usize> {
    let three = |all: &[f64], at: usize| {
        let part = all.get(3 * at..3 * at + 3);
        part.map_or(DVec3::ZERO, DVec3::from_slice)
    };
    let first = mesh.vertices.len() as u32;
    // Where only some corners have a normal, nothing says which.
    let normals: &[f64] = match object.normals.len() == object.positions.len() {
        true => &object.normals,
        false => &[],
    };
    let corners = (0..object.positions.len() / 3).map(|at| Vertex {
        position: three(&object.positions, at),
        normal: three(normals, at),
    });
    mesh.vertices.extend(corners);
    let mut rest = object.indices.as_slice();
    // Without a list of their corners, all faces are triangles.
    let triangles = vec![3; rest.len() / 3];
    let sizes = match object.face_arities.is_empty() {
        true => &triangles,
        false => &object.face_arities,
    };
    for size in sizes {
        let (face, after) = rest.split_at(rest.len().min(*size as usize));
        rest = after;
        let places: Vec<DVec3> = face
            .iter()
            .map(|corner| three(&object.positions, *corner as usize))
            .collect();
        if face.len() > MOST_CONCAVE && !is_convex(&places) {
            return Err(face.len());
        }
        let triangles = triangles_of(&places).into_iter();
        let named = |triangle: [usize; 3]| triangle.map(|corner| first + face[corner]);
        mesh.triangles.extend(triangles.map(named));
    }
    Ok(())
}

/// The same mesh with one corner a place, so that its normals are of all triangles that meet there.
fn welded(mesh: &Mesh) -> Mesh {
    let mut known = HashMap::new();
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut names = Vec::with_capacity(mesh.vertices.len());
    for vertex in &mesh.vertices {
        let place = vertex.position.to_array().map(f64::to_bits);
        let name = *known.entry(place).or_insert(vertices.len() as u32);
        if name as usize == vertices.len() {
            vertices.push(*vertex);
        }
        names.push(name);
    }
    let renamed = |corners: &[u32; 3]| corners.map(|corner| names[corner as usize]);
    Mesh {
        vertices,
        triangles: mesh.triangles.iter().map(renamed).collect(),
    }
}

/// What a text holds so far.
#[derive(Default)]
struct Counts {
    places: usize,
    textures: usize,
    normals: usize,
    triangles: usize,
}

impl Counts {
    /// Looks at every line.
    fn of(text: &str) -> Result<(), ObjFault> {
        let mut counts = Counts::default();
        // An index may lead to a line below its own: it is compared once all are counted.
        let mut last_use = [(0, 0); 3];
        for (at, line) in text.lines().enumerate() {
            let fault = |what| ObjFault { line: at + 1, what };
            counts.enter(line, at + 1, &mut last_use).map_err(fault)?;
        }
        let all = [counts.places, counts.textures, counts.normals];
        for (i, what) in ["place", "texture coordinate", "normal"].iter().enumerate() {
            let (most, line) = last_use[i];
            if most > all[i] {
                let what = format!("a face names {what} {most}, and there are {}", all[i]);
                return Err(ObjFault { line, what });
            }
        }
        Ok(())
    }

    /// Looks at a line; `last_use` holds the largest index so far of each kind, and its line.
    fn enter(
        &mut self,
        line: &str,
        number: usize,
        last_use: &mut [(usize, usize); 3],
    ) -> Result<(), String> {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                self.places += 1;
                check_numbers("v", words, 3)?;
            }
            Some("vn") => {
                self.normals += 1;
                check_numbers("vn", words, 3)?;
            }
            Some("vt") => self.textures += 1,
            Some("f") => self.face(words, number, last_use)?,
            Some(word) if OTHER_SURFACES.contains(&word) => {
                return Err(format!(
                    "`{word}` is a surface that is not read; export the mesh as faces, `f`"
                ));
            }
            _ => {}
        }
        if self.triangles > MOST_TRIANGLES || self.places > MOST_TRIANGLES {
            return Err(format!(
                "the mesh has more than {MOST_TRIANGLES} triangles or corners; that many are drawn at most"
            ));
        }
        Ok(())
    }

    fn face<'a>(
        &mut self,
        corners: impl Iterator<Item = &'a str>,
        number: usize,
        last_use: &mut [(usize, usize); 3],
    ) -> Result<(), String> {
        let so_far = [self.places, self.textures, self.normals];
        let mut count = 0;
        for corner in corners {
            count += 1;
            for (i, word) in corner.split('/').enumerate() {
                if i > 2 {
                    return Err(format!(
                        "`{corner}` has more than place, texture and normal"
                    ));
                }
                if word.is_empty() && i > 0 {
                    continue;
                }
                let index = index(word, so_far[i])?;
                if index > last_use[i].0 {
                    last_use[i] = (index, number);
                }
            }
        }
        if count < 3 {
            return Err(format!(
                "a face has {count} corners; it wants three or more"
            ));
        }
        self.triangles += count - 2;
        Ok(())
    }
}

/// An index from 1; a negative one counts back from the last that stands above it.
fn index(word: &str, so_far: usize) -> Result<usize, String> {
    let number: i64 = word
        .parse()
        .map_err(|_| format!("`{word}` is no index; indices are whole numbers from 1"))?;
    let back = |back: u64| so_far.checked_sub(back as usize);
    let found = match number {
        0 => None,
        1.. => Some(number as usize),
        _ => back(number.unsigned_abs()).map(|index| index + 1),
    };
    found.ok_or_else(|| format!("index {number} leads to nothing: {so_far} stand above this line"))
}

fn check_numbers<'a>(
    what: &str,
    words: impl Iterator<Item = &'a str>,
    least: usize,
) -> Result<(), String> {
    let mut count = 0;
    for word in words {
        let number: f64 = word
            .parse()
            .map_err(|_| format!("`{word}` is not a number"))?;
        // NaN is within no limits.
        if !(-FARTHEST..=FARTHEST).contains(&number) {
            return Err(format!("`{word}` is no place: numbers lie within ±1e100"));
        }
        count += 1;
    }
    match count < least {
        true => Err(format!("`{what}` has {count} numbers; it wants {least}")),
        false => Ok(()),
    }
}

/// A text that is read line by line and knows which line was read last.
struct Lines<'a> {
    rest: &'a [u8],
    line: usize,
}

impl Read for Lines<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.rest.read(into)?;
        Ok(count)
    }
}

impl BufRead for Lines<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        let end = self.rest.iter().position(|byte| *byte == b'\n');
        Ok(&self.rest[..end.map_or(self.rest.len(), |end| end + 1)])
    }

    fn consume(&mut self, count: usize) {
        self.line += usize::from(count > 0);
        self.rest = &self.rest[count..];
    }
}
