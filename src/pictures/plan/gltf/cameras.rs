//! The cameras of a file, or those that turn about its middle.

use glam::DVec3;
use gltf_json::{Root, camera};

use super::super::scene_file::MOST_FRAMES;
use super::container::Place;
use super::nodes::PlacedNode;
use crate::lab::raster::{Camera, Lens, Mesh, rotated};

/// What stands for the cameras of a file that has none.
pub const AROUND_IN_WORDS: &str = "36 cameras about the middle of all triangles, 10 degrees apart about y, 20 degrees above it, 45 degrees of view, as far away as shows all";
const FRAMES: u32 = 36;
const ABOVE_DEGREES: f64 = 20.0;
const VERTICAL_DEGREES: f64 = 45.0;

/// A camera for each node that has one. It looks along its own -z; its +y is up. It sees what lies between its clip planes.
///
/// # Errors
/// A field of view or a height lies outside its limits, a transform has no directions, or there are too many.
pub fn cameras(root: &Root, nodes: &[PlacedNode], size: [u32; 2]) -> Result<Vec<Camera>, Place> {
    let mut cameras = Vec::new();
    for node in nodes {
        let Some(index) = node.node.camera.map(|camera| camera.value()) else {
            continue;
        };
        let matrix = node.into_world.matrix3;
        let axes = axes(-matrix.z_axis, matrix.y_axis).ok_or_else(|| {
            let what = "its transform leaves the camera no direction";
            Place::new(format!("nodes[{}]", node.index), what)
        })?;
        let place = format!("cameras[{index}]");
        let eye = node.into_world.translation;
        cameras.push(camera(&root.cameras[index], eye, axes, size, &place)?);
        if cameras.len() > MOST_FRAMES {
            return Err(Place::new(
                place,
                format!("the scene has more than {MOST_FRAMES} cameras"),
            ));
        }
    }
    Ok(cameras)
}

/// To the right, down and forwards; none where the directions are none.
fn axes(forwards: DVec3, up: DVec3) -> Option<[DVec3; 3]> {
    let forwards = forwards.try_normalize()?;
    let right = forwards.cross(up).try_normalize()?;
    Some([right, forwards.cross(right), forwards])
}

fn camera(
    camera: &camera::Camera,
    eye: DVec3,
    axes: [DVec3; 3],
    size: [u32; 2],
    place: &str,
) -> Result<Camera, Place> {
    let within = |value: f64, [low, high]: [f64; 2], what: &str| {
        if (low..=high).contains(&value) {
            Ok(value)
        } else {
            let says = format!("it is {value}; it must lie between {low} and {high}");
            Err(Place::new(format!("{place}.{what}"), says))
        }
    };
    match (&camera.perspective, &camera.orthographic) {
        (Some(perspective), _) => {
            let field = f64::from(perspective.yfov);
            let field = within(field, [2e-4, 2.97], "perspective.yfov")?;
            let vertical_degrees = field.to_degrees();
            let lens = Lens {
                size,
                vertical_degrees,
            };
            let far = perspective.zfar.map_or(f64::INFINITY, f64::from);
            let planes = planes([perspective.znear.into(), far], place, "perspective")?;
            Ok(Camera::new(eye, axes, lens).clipped(planes, None))
        }
        (None, Some(orthographic)) => {
            let half = f64::from(orthographic.ymag);
            let half = within(half, [1e-6, 1e6], "orthographic.ymag")?;
            let ends = [orthographic.znear, orthographic.zfar].map(f64::from);
            let planes = planes(ends, place, "orthographic")?;
            let height = 2.0 * half;
            Ok(Camera::orthographic(eye, axes, height, size).clipped(planes, Some(height)))
        }
        (None, None) => Err(Place::new(
            place,
            "it is neither perspective nor orthographic",
        )),
    }
}

/// The distances between which a camera sees anything (section 3.10.3).
fn planes([near, far]: [f64; 2], place: &str, what: &str) -> Result<[f64; 2], Place> {
    if near < 0.0 {
        let says = format!("it is {near}; it must not be below 0");
        return Err(Place::new(format!("{place}.{what}.znear"), says));
    }
    if far <= near {
        let says = format!("it is {far}; it must be greater than znear, {near}");
        return Err(Place::new(format!("{place}.{what}.zfar"), says));
    }
    Ok([near, far])
}

/// Cameras that turn about the middle of a mesh, far enough to see all of it.
pub fn around(mesh: &Mesh, size: [u32; 2]) -> Vec<Camera> {
    let places = || mesh.vertices.iter().map(|vertex| vertex.position);
    let least = places().fold(DVec3::INFINITY, DVec3::min);
    let most = places().fold(DVec3::NEG_INFINITY, DVec3::max);
    let middle = (least + most) / 2.0;
    let radius = places()
        .map(|place| (place - middle).length())
        .fold(1e-6, f64::max);
    let half = (VERTICAL_DEGREES / 2.0).to_radians();
    // A picture that is higher than wide shows less to the sides.
    let aspect = (f64::from(size[0]) / f64::from(size[1])).min(1.0);
    let distance = radius / libm::sin(libm::atan(aspect * libm::tan(half)));
    let start = rotated(
        distance * DVec3::Z,
        DVec3::NEG_X,
        ABOVE_DEGREES.to_radians(),
    );
    let lens = Lens {
        size,
        vertical_degrees: VERTICAL_DEGREES,
    };
    let turned = |frame: u32| {
        let angle = std::f64::consts::TAU * f64::from(frame) / f64::from(FRAMES);
        Camera::looking(middle + rotated(start, DVec3::Y, angle), middle, lens)
    };
    (0..FRAMES).map(turned).collect()
}
