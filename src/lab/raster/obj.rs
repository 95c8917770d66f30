//! Meshes from OBJ files, read by the crate `tobj`.
//!
//! The crate accepts NaN in a position, says of an index only that it is out of range, and allocates whatever a file announces. So
//! every line is checked first: numbers are finite, indices exist, and there are not too many triangles.
//!
//! Source of the format: Wavefront Technologies, *Advanced Visualizer Manual*, appendix B1, 1993,
//! <https://paulbourke.net/dataformats/obj/>.

use std::collections::HashMap;
use std::io::{self, BufRead, Read};

use glam::DVec3;
use thiserror::Error;

use super::ears::{MOST_CONCAVE, triangles_of_faces};
use super::mesh::{Mesh, Vertex};

/// The most triangles of a mesh, and the most corners.
pub const MOST_TRIANGLES: usize = 4_000_000;
/// Statements of surfaces other than polygons, which would silently be missing.
const OTHER_SURFACES: [&str; 3] = ["surf", "bsp", "bzp"];
/// The largest coordinate, whose square is still finite.
const FARTHEST: f64 = 1e100;

/// A fault in an OBJ file, and its line.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}: {}", crate::physics::foreign::one_line(what))]
pub struct ObjFault {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong, and what is allowed.
    pub what: String,
}

/// The mesh of an OBJ text: all objects and groups together. Corners without a normal get that of a smooth surface, or that of
/// their face after `s off`. Smoothing groups are smoothed separately.
///
/// # Errors
/// The text is not such a mesh. The error says which line is at fault, and why.
pub fn mesh_of_obj(text: &str) -> Result<Mesh, ObjFault> {
    let text = &prepared(text);
    Counts::of(text)?;
    let options = tobj::LoadOptions {
        // The crate would cut every face as a fan, which covers too much of a concave one.
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
    // The triangles of all objects by smoothing group, in the order in which groups begin.
    let mut groups: Vec<(String, Mesh)> = Vec::new();
    for model in models {
        // Faces before all groups have a name given by the crate.
        let is_ours = model.name == FLAT || model.name.starts_with(SMOOTH);
        let name = if is_ours { model.name.as_str() } else { SMOOTH };
        let known = groups.iter().position(|(known, _)| known == name);
        let place = known.unwrap_or_else(|| {
            groups.push((name.to_owned(), Mesh::default()));
            groups.len() - 1
        });
        enter(&mut groups[place].1, &model.mesh).map_err(|corners| too_many(text, corners))?;
    }
    let mut mesh = Mesh::default();
    for (name, group) in groups {
        append(&mut mesh, with_normals(group, name == FLAT));
    }
    if mesh.triangles.is_empty() {
        return Err(ObjFault {
            line: lines.line.max(1),
            what: "the file ends without a face; a mesh has lines `v x y z` and `f a b c`"
                .to_owned(),
        });
    }
    Ok(mesh)
}

/// The fault of a concave face that has too many corners.
fn too_many(text: &str, corners: usize) -> ObjFault {
    let is_it = |line: &str| line.starts_with("f ") && line.split(' ').count() == corners + 1;
    ObjFault {
        line: text.lines().position(is_it).map_or(1, |line| line + 1),
        what: format!(
            "a face of {corners} corners, of which some point inwards; up to {MOST_CONCAVE} are read. Cut it into triangles"
        ),
    }
}

/// The group names that stand for smoothing groups to the crate: of flat faces, and of others.
const FLAT: &str = "flat";
const SMOOTH: &str = "smooth";

/// The lines prepared for the crate: lines continued with `\` are joined, and each object and group is replaced by the smoothing
/// group, which the crate does not know. Every line keeps its number.
fn prepared(text: &str) -> String {
    let mut prepared = String::with_capacity(text.len());
    let mut group = SMOOTH.to_owned();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let mut whole = line.to_owned();
        let mut joined = 0;
        while let Some(start) = continued(&whole) {
            whole = format!("{start} {}", lines.next().unwrap_or(""));
            joined += 1;
        }
        let mut words = whole.split_whitespace();
        match words.next() {
            Some("s") => {
                group = match words.next() {
                    Some("off" | "0") => FLAT.to_owned(),
                    Some(number) => format!("{SMOOTH} {number}"),
                    None => SMOOTH.to_owned(),
                };
                prepared += &format!("g {group}");
            }
            Some("o" | "g") => prepared += &format!("g {group}"),
            // `fo` is an old name of faces.
            Some("f" | "fo") => {
                let corners: Vec<&str> = uncommented(&whole).split_whitespace().skip(1).collect();
                prepared += &format!("f {}", corners.join(" "));
            }
            Some("v" | "vn" | "vt") => prepared += uncommented(&whole),
            // The crate takes a polyline for a face, and refuses a material without a name, which Blender writes where there is
            // none.
            Some("l" | "usemtl") => {}
            _ => prepared += &whole,
        }
        prepared += &"\n".repeat(1 + joined);
    }
    prepared
}

/// A line that continues in the next one, without the `\` at its end. A comment does not continue: it may end with a folder's name.
fn continued(line: &str) -> Option<&str> {
    let first = line.split_whitespace().next()?;
    let has_numbers = ["v", "vn", "vt", "f", "fo"].contains(&first);
    line.trim_end().strip_suffix('\\').filter(|_| has_numbers)
}

/// A line without its comment.
fn uncommented(line: &str) -> &str {
    line.split('#').next().unwrap_or(line)
}

/// A smoothing group with normals: the file's, those of flat faces, or those of a smooth surface.
fn with_normals(group: Mesh, is_flat: bool) -> Mesh {
    let has_normal = |vertex: &Vertex| vertex.normal != DVec3::ZERO;
    if group.vertices.iter().all(has_normal) {
        return group;
    }
    if is_flat {
        return flat(&group);
    }
    let mut group = welded(&group);
    group.smooth();
    group
}

/// The same triangles, each with its own corners and the normal of its face.
fn flat(mesh: &Mesh) -> Mesh {
    let mut flat = Mesh::default();
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize].position);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let first = flat.vertices.len() as u32;
        let corner = |position| Vertex { position, normal };
        flat.vertices.extend([a, b, c].map(corner));
        flat.triangles.push([first, first + 1, first + 2]);
    }
    flat
}

fn append(mesh: &mut Mesh, other: Mesh) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(other.vertices);
    let moved = |corners: [u32; 3]| corners.map(|corner| first + corner);
    mesh.triangles
        .extend(other.triangles.into_iter().map(moved));
}

/// Adds the triangles of one object. Corners without a normal get 0 in its place.
///
/// # Errors
/// A concave face has too many corners; the error is their number.
fn enter(mesh: &mut Mesh, object: &tobj::Mesh) -> Result<(), usize> {
    let three = |all: &[f64], at: usize| {
        let part = all.get(3 * at..3 * at + 3);
        part.map_or(DVec3::ZERO, DVec3::from_slice)
    };
    let first = mesh.vertices.len() as u32;
    // Where only some corners have a normal, it is unknown which.
    let normals: &[f64] = if object.normals.len() == object.positions.len() {
        &object.normals
    } else {
        &[]
    };
    let corners = (0..object.positions.len() / 3).map(|at| Vertex {
        position: three(&object.positions, at),
        normal: three(normals, at),
    });
    mesh.vertices.extend(corners);
    let place = |corner: u32| three(&object.positions, corner as usize);
    let triangles = triangles_of_faces(&object.indices, &object.face_arities, place)?;
    let triangles = triangles.iter();
    mesh.triangles
        .extend(triangles.map(|corners| corners.map(|corner| first + corner)));
    Ok(())
}

/// The same mesh with one corner per position, so that normals are those of all triangles that meet there.
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

/// Counts of what a text holds so far.
#[derive(Default)]
struct Counts {
    places: usize,
    textures: usize,
    normals: usize,
    triangles: usize,
}

impl Counts {
    /// Checks every line.
    fn of(text: &str) -> Result<(), ObjFault> {
        let mut counts = Counts::default();
        // An index may refer to a later line, so it is compared once all are counted.
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

    /// Checks a line. `last_use` holds the largest index so far of each kind, and its line.
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

/// An index from 1. A negative one counts back from the last item above it.
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
    for (at, word) in words.enumerate() {
        let number: f64 = word.parse().map_err(|_| {
            if word.contains(',') {
                format!("`{word}` is not a number, which has a point and no comma")
            } else {
                format!("`{word}` is not a number")
            }
        })?;
        // NaN is within no range.
        if !(-FARTHEST..=FARTHEST).contains(&number) {
            // A weight or a colour may follow a position.
            let meant =
                ["no place", "neither a weight nor a part of a colour"][usize::from(at > 2)];
            return Err(format!("`{word}` is {meant}: numbers lie within ±1e100"));
        }
        count += 1;
    }
    if count < least {
        Err(format!("`{what}` has {count} numbers; it wants {least}"))
    } else {
        Ok(())
    }
}

/// A reader of a text by lines that knows which line was read last.
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
