//! Waves: a sum of sines. Their height is the surface of the truth, their slopes are the normal map of what is drawn.

use glam::{DVec2, DVec3};

/// Wavelength in metres, direction in radians, steepest slope, phase.
const WAVES: [[f64; 4]; 7] = [
    [2.6, 1.1, 0.030, 0.0],
    [1.5, 0.4, 0.032, 1.3],
    [1.05, 2.0, 0.030, 4.1],
    [0.72, 0.9, 0.028, 2.2],
    [0.53, 2.6, 0.024, 5.3],
    [0.41, 0.1, 0.020, 0.7],
    [0.33, 1.6, 0.018, 3.6],
];

/// A sine.
#[derive(Clone, Debug, PartialEq)]
struct Wave {
    /// 2 pi over the wavelength, along its direction.
    wave_vector: DVec2,
    amplitude: f64,
    phase: f64,
}

/// The surface y = height(x, z).
#[derive(Clone, Debug, PartialEq)]
pub struct Waves {
    waves: Vec<Wave>,
    /// No crest is higher.
    pub highest: f64,
}

impl Waves {
    /// The waves of the pictures.
    pub fn new() -> Waves {
        let wave = |[length, direction, slope, phase]: [f64; 4]| {
            let (sin, cos) = libm::sincos(direction);
            let number = std::f64::consts::TAU / length;
            Wave {
                wave_vector: number * DVec2::new(cos, sin),
                amplitude: slope / number,
                phase,
            }
        };
        let waves = WAVES.map(wave).to_vec();
        Waves {
            highest: waves.iter().map(|wave| wave.amplitude).sum(),
            waves,
        }
    }

    /// The height at x and z.
    pub fn height(&self, place: DVec2) -> f64 {
        let each = |wave: &Wave| wave.amplitude * libm::sin(wave.angle(place));
        self.waves.iter().map(each).sum()
    }

    /// The normal at x and z, upward.
    pub fn normal(&self, place: DVec2) -> DVec3 {
        let each = |wave: &Wave| {
            let cosine = libm::cos(wave.angle(place));
            wave.amplitude * cosine * wave.wave_vector
        };
        let slope: DVec2 = self.waves.iter().map(each).sum();
        DVec3::new(-slope.x, 1.0, -slope.y).normalize()
    }
}

impl Wave {
    fn angle(&self, place: DVec2) -> f64 {
        self.wave_vector.dot(place) + self.phase
    }
}
