//! The positions from which a reader may look, with the frame's block for each, so that the page computes no camera.

use glam::DVec3;
use serde::Serialize;

use super::packed::Packed;
use crate::pictures::scene::{
    Camera, INPUTS, INPUTS_AT, LightBlock, OpticalMaterial, PHOTONS, RenderRow, View, frame,
};

/// Positions around the body: every 5 degrees.
const AZIMUTHS: usize = 72;
/// Elevations relative to the row's own, in degrees.
const STEPS: [f64; 7] = [-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0];
/// The index of the row's own elevation among them.
const OWN: usize = 3;
/// Samples along a side of the picture. Any number serves of which a margin is a whole part.
const SIDE: u32 = 100;
/// The lowest and the highest elevation of the eye, in degrees.
const LOWEST: f64 = 4.0;
const HIGHEST: f64 = 80.0;

/// The views of a row's camera.
#[derive(Clone, Debug, Serialize)]
pub struct Orbit {
    /// The eye's first position.
    pub eye: [f64; 3],
    /// The body's size.
    pub size: f64,
    /// How many positions there are around the body.
    pub azimuths: usize,
    /// Elevations in degrees.
    pub elevations: Vec<f64>,
    /// The index of the row's own elevation.
    pub first: usize,
    /// The blocks without inputs, by view, elevation and azimuth.
    pub blocks: Packed,
    /// How many numbers a block has.
    pub numbers: usize,
    /// The views, by index.
    #[serde(skip)]
    views: Vec<View>,
}

impl Orbit {
    /// The index of a row's orbit among these. A new orbit is appended.
    pub fn of(row: &RenderRow, orbits: &mut Vec<Orbit>) -> usize {
        let size = row.body.radius();
        let mut views = Vec::new();
        for pass in row.passes {
            if !views.contains(&pass.view) {
                views.push(pass.view);
            }
        }
        let is_same = |orbit: &Orbit| {
            row.receiver.is_none()
                && (orbit.eye, orbit.size, &orbit.views) == (row.eye, size, &views)
        };
        if let Some(place) = orbits.iter().position(is_same) {
            return place;
        }
        orbits.push(match row.receiver {
            Some(receiver) => Orbit::of_light(row, receiver),
            None => Orbit::new(row.eye, size, views),
        });
        orbits.len() - 1
    }

    /// The orbit of the light's own view, which cannot be turned.
    fn of_light(row: &RenderRow, receiver: [f64; 2]) -> Orbit {
        let nothing = OpticalMaterial::of_index(0.0);
        let light = LightBlock {
            window: receiver,
            widths: [0.0; 2],
            photons: PHOTONS,
            shift: [0.0; 2],
        };
        let block = light.numbers(&nothing, [[0.0; 4]; INPUTS]);
        Orbit {
            eye: row.eye,
            size: 1.0,
            azimuths: 1,
            elevations: vec![0.0],
            first: 0,
            blocks: Packed::floats(&block[..INPUTS_AT]),
            numbers: INPUTS_AT,
            views: Vec::new(),
        }
    }

    fn new(eye: [f64; 3], size: f64, views: Vec<View>) -> Orbit {
        let nothing = OpticalMaterial::of_index(0.0);
        let mut numbers = Vec::new();
        for view in &views {
            for step in 0..STEPS.len() {
                for azimuth in 0..AZIMUTHS {
                    let camera = Camera::around(eye_at(eye, step, azimuth), size);
                    let block = frame((*view, &camera, SIDE), size, &nothing, [[0.0; 4]; INPUTS]);
                    numbers.extend(&block[..INPUTS_AT]);
                }
            }
        }
        let elevations = (0..STEPS.len()).map(|step| elevation(eye, step).round());
        Orbit {
            eye,
            size,
            azimuths: AZIMUTHS,
            elevations: elevations.collect(),
            first: OWN,
            blocks: Packed::floats(&numbers),
            numbers: INPUTS_AT,
            views,
        }
    }

    /// The index of a view.
    pub fn view(&self, view: View) -> usize {
        let place = self.views.iter().position(|other| *other == view);
        place.expect("an orbit has the views of its rows")
    }
}

fn elevation(eye: [f64; 3], step: usize) -> f64 {
    let own = libm::asin(eye[1] / DVec3::from_array(eye).length()).to_degrees();
    // An eye that looks up from below stays there.
    (own + STEPS[step]).clamp(own.min(LOWEST), HIGHEST)
}

/// The eye's position on its own orbit.
fn eye_at(eye: [f64; 3], step: usize, azimuth: usize) -> DVec3 {
    let own = DVec3::from_array(eye);
    if (step, azimuth) == (OWN, 0) {
        return own;
    }
    let turned = std::f64::consts::TAU * azimuth as f64 / AZIMUTHS as f64;
    let (sin_a, cos_a) = libm::sincos(libm::atan2(own.x, own.z) + turned);
    let (sin_e, cos_e) = libm::sincos(elevation(eye, step).to_radians());
    own.length() * DVec3::new(sin_a * cos_e, sin_e, cos_a * cos_e)
}
