//! The thesis's measure in 32-bit floats, which its program computes in throughout (section 4): angles, both functions,
//! their difference and the sums. Over 10⁶ angles a sum has then lost its last digits, and the mean moves by some 10⁻⁴
//! of its value: enough to turn a digit.

use crate::language::ir::{Checked, Value, evaluate};

/// Mean relative difference of a function of the cosine from another, over angles and channels, all in f32.
pub fn thesis_error_in_floats(got: &Checked, want: &Checked, angles: usize) -> f32 {
    const CHUNK: usize = 4096;
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
