//! A pinhole camera, a distant one that stands for an orthographic camera, and a camera that turns about an object.

use glam::DVec3;

/// The distance of an orthographic camera, in heights of its picture: rays at the upper and the lower edge are turned by 5e-7.
const DISTANT: f64 = 1e6;

/// What a camera takes in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// The vertical field of view, in degrees.
    pub vertical_degrees: f64,
}

/// A camera in perspective; axes are unit vectors: to the right, down and forwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it is.
    pub eye: DVec3,
    /// Its axes: to the right, down, forwards.
    pub axes: [DVec3; 3],
    /// What it takes in.
    pub lens: Lens,
    /// Nothing is seen that is nearer along its axis, in metres.
    pub near: f64,
    /// Nothing is seen that is farther away along its axis, in metres.
    pub far: f64,
}

impl Camera {
    /// A camera of this position and these axes that sees everything before it.
    pub fn new(eye: DVec3, axes: [DVec3; 3], lens: Lens) -> Camera {
        Camera {
            eye,
            axes,
            lens,
            near: 0.0,
            far: f64::INFINITY,
        }
    }

    /// A camera that looks from one place at another one. Up is y, or z where it looks along y.
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

    /// A camera of this position and these axes that sees parallel rays: `height` metres fill its picture of `size` pixels. It
    /// stands for an orthographic camera as a pinhole a million heights behind `eye`, which sees what is behind `eye` too.
    pub fn orthographic(eye: DVec3, axes: [DVec3; 3], height: f64, size: [u32; 2]) -> Camera {
        let half = libm::atan(0.5 / DISTANT);
        let lens = Lens {
            size,
            vertical_degrees: 2.0 * half.to_degrees(),
        };
        Camera::new(eye - DISTANT * height * axes[2], axes, lens)
    }

    /// The same with clip planes, in metres before `eye` of [`Camera::orthographic`], where `height` is its height.
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

    /// A direction along the camera's axes.
    pub fn turned(&self, direction: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(direction)))
    }

    /// A direction of the world from one along the camera's axes.
    pub fn in_world(&self, direction: DVec3) -> DVec3 {
        let [right, down, forwards] = self.axes;
        direction.x * right + direction.y * down + direction.z * forwards
    }

    /// How many pixels a slope of 1 is.
    pub fn pixels_a_slope(&self) -> f64 {
        let half = (self.lens.vertical_degrees / 2.0).to_radians();
        f64::from(self.lens.size[1]) / 2.0 / libm::tan(half)
    }
}

/// A camera that turns about the origin, which it looks at: a turn of the same angle from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turntable {
    /// Where it starts.
    pub start: DVec3,
    /// What it turns about.
    pub axis: DVec3,
    /// The angle from frame to frame, in degrees.
    pub step_degrees: f64,
    /// How many frames.
    pub frames: usize,
    /// What it takes in.
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

/// A vector turned about a unit axis, by the formula of Rodrigues.
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
