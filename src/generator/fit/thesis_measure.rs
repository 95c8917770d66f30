//! The thesis's measure of a function: the mean relative difference from the exact law, uniform in angle.
//!
//! In 32-bit floats it is computed as the thesis's program does throughout (section 4): angles, both functions, their difference
//! and the sums. Over 10⁶ angles, a sum loses its last digits, and the mean moves by about 10⁻⁴ of its value. That can change a
//! printed digit.

use crate::generator::reference::{cosine_of_part, reference_reflectance};
use crate::language::ir::{Checked, Value, evaluate};
use crate::language::methods::Light;
use crate::physics::materials::{Channels, Surface};

/// How many angles are computed at once.
const CHUNK: usize = 4096;

/// The thesis's measure of several functions of `cos_theta` alone for one material: mean relative difference per channel at
/// `angles` angles, uniform from 0 to 90 degrees (midpoints of equal steps). The exact law, which costs the most, is computed
/// once. `progress` receives how many angles are done.
pub fn thesis_errors(
    functions: &[&Checked],
    channels: &Channels,
    angles: usize,
    progress: &mut dyn FnMut(usize),
) -> Vec<[f64; 3]> {
    let surface = Surface::of_channels(channels);
    let mut sums = vec![[0.0; 3]; functions.len()];
    for start in (0..angles).step_by(CHUNK) {
        let cosines: Vec<f64> = (start..(start + CHUNK).min(angles))
            .map(|i| cosine_of_part(2 * i + 1, 2 * angles))
            .collect();
        let want: Vec<[f64; 3]> = cosines
            .iter()
            .map(|c| reference_reflectance(&surface, Light::Unpolarised, *c))
            .collect();
        let points = cosines.len();
        let arguments = [Value::each(cosines)];
        for (function, sums) in functions.iter().zip(&mut sums) {
            add_differences(&evaluate(function, &arguments), &want, sums);
        }
        progress(points);
    }
    let mean = |sums: [f64; 3]| sums.map(|sum| sum / angles as f64);
    sums.into_iter().map(mean).collect()
}

/// Adds the relative differences, point by point.
fn add_differences(got: &Value<f64>, want: &[[f64; 3]], sums: &mut [f64; 3]) {
    for (i, sum) in sums.iter_mut().enumerate() {
        let got = got.channel(i);
        for (point, want) in want.iter().enumerate() {
            *sum += (got.at(point) - want[i]).abs() / want[i];
        }
    }
}

/// Mean relative difference between two functions of the cosine, over angles and channels, all in f32.
pub fn thesis_error_in_floats(got: &Checked, want: &Checked, angles: usize) -> f32 {
    let mut sums = [0.0f32; 3];
    for start in (0..angles).step_by(CHUNK) {
        let cosines: Vec<f32> = (start..(start + CHUNK).min(angles))
            .map(|i| cosine(i, angles))
            .collect();
        add(&mut sums, got, want, cosines);
    }
    sums.map(|sum| sum / angles as f32).iter().sum::<f32>() / 3.0
}

fn add(sums: &mut [f32; 3], got: &Checked, want: &Checked, cosines: Vec<f32>) {
    let points = cosines.len();
    let arguments = [Value::each(cosines)];
    let [got, want] = [got, want].map(|function| evaluate::<f32>(function, &arguments));
    for (i, sum) in sums.iter_mut().enumerate() {
        let (got, want) = (got.channel(i), want.channel(i));
        for point in 0..points {
            *sum += (got.at(point) - want.at(point)).abs() / want.at(point);
        }
    }
}

fn cosine(step: usize, steps: usize) -> f32 {
    libm::cosf(step as f32 / steps as f32 * std::f32::consts::FRAC_PI_2)
}
