//! What microfacets reflect more than once, as the templates of flavours compute it: a geometric series of bounces. The formula and
//! its source stand in `lut/split_sum.rs`.

use fresnel_gen::language::effects::WHITE_MEAN_LOST;
use fresnel_gen::physics::num::{Legendre, each_channel};
use fresnel_gen::physics::optics::Ggx;

/// Ē: the cosine-weighted mean over the hemisphere of what a rough white surface reflects after one bounce.
fn white_mean(roughness: f64) -> f64 {
    let [a, b, c, d] = WHITE_MEAN_LOST;
    let inner = a + roughness * (b + roughness * (c + roughness * d));
    1.0 - roughness * roughness * roughness * inner
}

/// F_ms of each channel, the share of the light reflected more than once, from F̄ and Ē.
pub fn series_of_bounces(average: [f64; 3], white_mean: f64) -> [f64; 3] {
    average.map(|mean| mean * mean * white_mean / (1.0 - mean * (1.0 - white_mean)))
}

/// The factor for lights and image, from the image's terms E_F and E, from F̄ and from the roughness.
pub fn compensation(image: [f64; 3], white: f64, average: [f64; 3], roughness: f64) -> [f64; 3] {
    let series = series_of_bounces(average, white_mean(roughness));
    each_channel(|i| 1.0 + (1.0 - white) * series[i] / image[i].max(SMALLEST_IMAGE))
}

/// The least divisor for the image, so that black stays black.
const SMALLEST_IMAGE: f64 = 1e-5;

#[test]
fn the_mean_of_white_is_that_of_the_integral() {
    let rule = Ggx::default();
    let cosines = Legendre::new(24);
    for step in 1..=20 {
        let roughness = f64::from(step) / 20.0;
        let mut mean = 0.0;
        for (cos_v, weight) in cosines.over(0.0, 1.0) {
            rule.each(cos_v, roughness * roughness, |_, share| {
                mean += 2.0 * weight * cos_v * share;
            });
        }
        let off = (white_mean(roughness) - mean).abs();
        assert!(off < 7e-4, "{roughness}: {mean}, off by {off}");
    }
    assert_eq!(white_mean(0.0), 1.0);
}

/// The series is the sum of its bounces.
#[test]
fn bounces_add_up_to_the_series() {
    for mean in [0.0, 0.05, 0.65, 0.99, 1.0] {
        for escapes in [0.4, 0.7, 1.0] {
            let (mut left, mut sum) = (mean, 0.0);
            for _ in 0..5000 {
                left *= mean;
                sum += left * escapes;
                left *= 1.0 - escapes;
            }
            let series = series_of_bounces([mean; 3], escapes)[0];
            assert!(
                (series - sum).abs() < 1e-12,
                "{mean} {escapes}: {series} {sum}"
            );
        }
    }
    assert_eq!(compensation([0.5; 3], 0.5, [1.0; 3], 0.8), [2.0; 3]);
    assert_eq!(compensation([0.0; 3], 0.5, [0.0; 3], 0.8), [1.0; 3]);
}
