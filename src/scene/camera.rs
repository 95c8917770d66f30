//! Where a picture is taken from: rays for the tracer, a matrix for what draws.

use glam::{DMat4, DVec3, DVec4};

/// A camera. The world is right-handed and its y points up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: DVec3,
    /// From the world to clip space, depth 0 to 1.
    pub view_projection: DMat4,
    /// Its inverse.
    pub inverse: DMat4,
}

/// Where depth begins and ends, in distances of the eye from the middle.
const NEAR: f64 = 0.05;
const FAR: f64 = 10.0;

impl Camera {
    /// A square picture from a place, of the origin, so that a ball of this radius around it takes 90 % of the height.
    pub fn around(eye: DVec3, radius: f64) -> Camera {
        let distance = eye.length();
        let half_height = libm::tan(libm::asin(radius / distance)) / 0.9;
        let (near, far) = (NEAR * distance, FAR * distance);
        let view_projection = perspective(half_height, near, far) * looking_at_origin(eye);
        Camera {
            eye,
            view_projection,
            inverse: view_projection.inverse(),
        }
    }

    /// The direction through a place of the picture: 0 to 1 from left to right, and from top to bottom.
    pub fn direction(&self, x: f64, y: f64) -> DVec3 {
        let far = DVec3::new(2.0 * x - 1.0, 1.0 - 2.0 * y, 1.0);
        (self.inverse.project_point3(far) - self.eye).normalize()
    }
}

/// From the world to the camera, which looks along its -z.
fn looking_at_origin(eye: DVec3) -> DMat4 {
    let back = eye.normalize();
    let right = DVec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let camera = DMat4::from_cols(
        right.extend(0.0),
        up.extend(0.0),
        back.extend(0.0),
        eye.extend(1.0),
    );
    camera.inverse()
}

/// From the camera to clip space: this half height at distance 1, square.
fn perspective(half_height: f64, near: f64, far: f64) -> DMat4 {
    let scale = 1.0 / half_height;
    let depth = far / (near - far);
    DMat4::from_cols(
        DVec4::new(scale, 0.0, 0.0, 0.0),
        DVec4::new(0.0, scale, 0.0, 0.0),
        DVec4::new(0.0, 0.0, depth, -1.0),
        DVec4::new(0.0, 0.0, near * depth, 0.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_go_where_the_matrix_puts_them() {
        let camera = Camera::around(DVec3::new(1.0, 2.0, 3.0), 1.0);
        for (x, y) in [(0.5, 0.5), (0.1, 0.8), (0.9, 0.3)] {
            let place = camera.eye + 2.5 * camera.direction(x, y);
            let clip = camera.view_projection.project_point3(place);
            assert!((clip.x - (2.0 * x - 1.0)).abs() < 1e-9, "{clip}");
            assert!((clip.y - (1.0 - 2.0 * y)).abs() < 1e-9, "{clip}");
            assert!((0.0..1.0).contains(&clip.z), "{clip}");
        }
    }
}
