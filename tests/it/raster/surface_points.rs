//! What pixels show of a surface: normals, directions, and the camera that stands for an orthographic one.

use glam::DVec3;

use super::camera;
use super::few_cameras;
use fresnel_gen::lab::raster::{CUBE, Camera, RELIEF, SPHERE, draw, rotated, surface_points};

/// A camera with parallel rays that looks at the origin.
fn orthographic(eye: DVec3, height: f64, size: [u32; 2]) -> Camera {
    let axes = Camera::looking(eye, DVec3::ZERO, camera([1.0; 3], size, 1.0).lens).axes;
    Camera::orthographic(eye, axes, height, size)
}

#[test]
fn points_hold_what_frames_hold() {
    let mesh = RELIEF.mesh();
    for camera in few_cameras(60) {
        let points = surface_points(&mesh, &camera);
        let covered: Vec<(u32, f64)> = points.iter().map(|p| (p.place, p.cos_theta)).collect();
        assert_eq!(covered, draw(&mesh, &camera).covered);
        for point in points {
            assert!((point.normal.length() - 1.0).abs() < 1e-12);
            assert!((point.to_camera.length() - 1.0).abs() < 1e-12);
            let cosine = point.normal.dot(point.to_camera).clamp(0.0, 1.0);
            assert!((cosine - point.cos_theta).abs() < 1e-12);
            // A mirror turns about the normal, and shows as much of it as the camera sees.
            assert!(
                (point.mirrored() + point.to_camera)
                    .cross(point.normal)
                    .length()
                    < 1e-12
            );
        }
    }
}

#[test]
fn normals_are_those_of_the_world() {
    let camera = camera([-1.3, 0.9, 1.7], [160, 120], 45.0);
    for point in surface_points(&CUBE.mesh(), &camera) {
        let axes = [DVec3::NEG_X, DVec3::Y, DVec3::Z];
        let is_face = axes
            .iter()
            .any(|axis| (*axis - point.normal).length() < 1e-12);
        assert!(is_face && point.normal.dot(camera.eye) > 0.0, "{point:?}");
    }
}

/// Flat faces under parallel rays: all pixels of a face show the cosine between its normal and the camera's axis.
#[test]
fn an_orthographic_camera_sees_a_face_under_one_angle() {
    for step in 1..12 {
        let angle = 0.13 * f64::from(step);
        let eye = rotated(DVec3::new(0.0, 1.0, 2.0), DVec3::Y, angle);
        for height in [1e-3, 2.0, 3e4] {
            let mut mesh = CUBE.mesh();
            for vertex in &mut mesh.vertices {
                vertex.position *= 0.6 * height;
            }
            let camera = orthographic(height * eye, height, [64, 64]);
            let points = surface_points(&mesh, &camera);
            assert!(points.len() > 500);
            for point in points {
                let closed = point.normal.dot(eye.normalize());
                assert!(
                    (point.cos_theta - closed).abs() < 1e-5,
                    "{point:?} {closed}"
                );
            }
        }
    }
}

/// A sphere that fills the height: cos θ = √(1 - r²) at the distance r from the middle, in radii. Triangles stand for the sphere,
/// whose chords lie up to 2e-5 within it, so that the squares of cosines agree to as much.
#[test]
fn an_orthographic_camera_sees_a_sphere_in_closed_form() {
    let size = 512;
    let camera = orthographic(DVec3::new(0.0, 0.0, 2.0), 1.0, [size, size]);
    let points = surface_points(&SPHERE.mesh(), &camera);
    let disc = std::f64::consts::FRAC_PI_4 * f64::from(size * size);
    assert!(
        (points.len() as f64 / disc - 1.0).abs() < 1e-3,
        "{}",
        points.len()
    );
    for point in points {
        let half = f64::from(size) / 2.0;
        let offset = |at: u32| (f64::from(at) + 0.5 - half) / half;
        let (x, y) = (offset(point.place % size), offset(point.place / size));
        let squared = 1.0 - x * x - y * y;
        assert!(
            (point.cos_theta.powi(2) - squared).abs() < 1.2e-4,
            "{point:?} {squared}"
        );
        let closed = DVec3::new(x, -y, squared.max(0.0).sqrt());
        // Where a chord passes behind the silhouette, normals point away.
        assert!(
            squared < 0.01 || (point.normal - closed).length() < 2e-3,
            "{point:?}"
        );
    }
}
