//! A scene file together with the files that it names: triangles in their places, and light.

use std::collections::BTreeMap;

use glam::DVec3;
use toml::Spanned;

use super::super::sky::SceneLight;
use super::check::FARTHEST;
use super::{Light, Object, SceneFile, Shape};
use crate::lab::raster::{MOST_TRIANGLES, Mesh, Vertex, mesh_of_obj};
use crate::physics::user_text::{FileFault, mesh_text};
use crate::pictures::plan::frame::{DrawnScene, ReadFile};
use crate::pictures::scene::Environment;

/// How far a plane reaches beyond everything else, so that it ends within 1e-7 of the horizon.
const BEYOND: f64 = 1e7;

impl SceneFile {
    /// The scene with all files that it names.
    ///
    /// # Errors
    /// A file cannot be read or is not what the scene states, or there are too many triangles.
    pub fn read(&self, read: ReadFile) -> Result<DrawnScene, FileFault> {
        let light = self.light(read)?;
        let mut scene = DrawnScene::new(self.materials.len(), light);
        let (mut planes, mut meshes) = (Vec::new(), BTreeMap::new());
        for object in &self.objects {
            let mesh = match object.shape.get_ref() {
                Shape::Plane => {
                    planes.push(object);
                    continue;
                }
                Shape::Body(body) => {
                    let mesh = body.mesh().with_extent(object.extent.unwrap_or(1.0));
                    moved(mesh, object.at.unwrap_or(DVec3::ZERO))
                }
                Shape::Mesh(path) => {
                    if !meshes.contains_key(path) {
                        meshes.insert(path, self.mesh(object, path, read)?);
                    }
                    self.own_place(meshes[path].clone(), object)?
                }
            };
            let triangles = scene.triangles() + mesh.triangles.len();
            if triangles + 2 * self.objects.len() > MOST_TRIANGLES {
                let what =
                    format!("the objects up to here have more than {MOST_TRIANGLES} triangles");
                return Err(self.fault(object.shape.span().start, what));
            }
            scene.add(&mesh, object.look, None);
        }
        let radius = BEYOND * self.radius(scene.mesh());
        for plane in planes {
            let height = plane.at.unwrap_or(DVec3::ZERO).y;
            scene.add(&square(radius, height), plane.look, None);
        }
        Ok(scene)
    }

    fn light(&self, read: ReadFile) -> Result<SceneLight, FileFault> {
        match &self.light {
            Light::Uniform(light) => Ok(SceneLight::Uniform(*light)),
            Light::Environment(path) => {
                let bytes = self.bytes(path, path.get_ref(), read)?;
                let environment = Environment::read(&bytes, self.space);
                let environment = environment.map_err(|fault| {
                    let what = format!("{}: {fault}", path.get_ref());
                    self.fault(path.span().start, what)
                })?;
                Ok(SceneLight::of_environment(environment))
            }
        }
    }

    fn bytes<T>(&self, at: &Spanned<T>, path: &str, read: ReadFile) -> Result<Vec<u8>, FileFault> {
        read(path).map_err(|why| self.fault(at.span().start, format!("{path}: {why}")))
    }

    /// A user's mesh.
    fn mesh(&self, object: &Object, path: &str, read: ReadFile) -> Result<Mesh, FileFault> {
        let bytes = self.bytes(&object.shape, path, read)?;
        let text = mesh_text(bytes).map_err(|fault| {
            let what = format!("{path}: {}", fault.what);
            self.fault(object.shape.span().start, what)
        })?;
        mesh_of_obj(&text).map_err(|fault| FileFault {
            file: path.to_owned(),
            line: fault.line,
            column: 1,
            what: fault.what,
        })
    }

    /// A user's mesh. It keeps its own size and place where the scene states none.
    fn own_place(&self, mesh: Mesh, object: &Object) -> Result<Mesh, FileFault> {
        let places = || mesh.vertices.iter().map(|vertex| vertex.position);
        let least = places().fold(DVec3::INFINITY, DVec3::min);
        let most = places().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre = object.at.unwrap_or((least + most) / 2.0);
        let extent = object.extent.unwrap_or((most - least).max_element());
        if extent.max(centre.abs().max_element()) > FARTHEST {
            let what = format!(
                "the mesh reaches beyond {FARTHEST} m; `extent` and `at` give it another size and place"
            );
            return Err(self.fault(object.shape.span().start, what));
        }
        Ok(moved(mesh.with_extent(extent), centre))
    }

    /// The distance from the origin of the farthest vertex or camera; at least 1 m.
    fn radius(&self, mesh: &Mesh) -> f64 {
        let eyes = self.cameras.iter().map(|camera| camera.eye.length());
        eyes.fold(mesh.radius().max(1.0), f64::max)
    }
}

fn moved(mut mesh: Mesh, by: DVec3) -> Mesh {
    for vertex in &mut mesh.vertices {
        vertex.position += by;
    }
    mesh
}

/// A level square about the y axis.
fn square(radius: f64, height: f64) -> Mesh {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corner = |(x, z): (f64, f64)| Vertex {
        position: DVec3::new(x * radius, height, z * radius),
        normal: DVec3::Y,
    };
    Mesh {
        vertices: corners.map(corner).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}
