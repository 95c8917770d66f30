//! Cameras: a pinhole camera, a distant one that stands for an orthographic camera, and a camera that turns about an object.

use glam::DVec3;

use crate::physics::num::each_channel;

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
        DVec3::from_array(each_channel(|i| self.axes[i].dot(direction)))
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
