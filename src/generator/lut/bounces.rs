//! What microfacets reflect more than once, as a geometric series.
//!
//! A rough white surface reflects E of the light that falls on it at once, and would reflect all of it in the end: 1 - E is
//! reflected again. Of each bounce F̄ is left, and Ē escapes, the means over the hemisphere of F and of E. So a surface with the
//! albedo E_F of one bounce reflects in all
//!
//! ```text
//! E_F + (1 - E) F_ms,  F_ms = F̄² Ē + F̄³ (1 - Ē) Ē + ... = F̄² Ē / (1 - F̄ (1 - Ē))
//! ```
//!
//! For white F_ms is 1. Lamps and image are multiplied by 1 + (1 - E) F_ms / E_F.
//!
//! Source: Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course, 2017,
//! <https://blog.selfshadow.com/publications/s2017-shading-course/>, with F̄ squared, since light that is reflected twice has met the surface
//! twice: Hill, "A Multi-Faceted Exploration (Part 3)", 2018, <https://blog.selfshadow.com/2018/08/05/multi-faceted-part-3/>.

use crate::physics::num::each_channel;

/// 1 - Ē over the roughness r is r³ (a + r (b + r (c + r d))), for GGX with height-correlated Smith masking, α = r²: within .0007.
pub const WHITE_MEAN_LOST: [f64; 4] = [0.20275, 3.50269, -4.97845, 1.8645];

/// Ē: the mean over the hemisphere, weighted by cosine, of what a rough white surface reflects at once.
pub fn white_mean(roughness: f64) -> f64 {
    let [a, b, c, d] = WHITE_MEAN_LOST;
    let inner = a + roughness * (b + roughness * (c + roughness * d));
    1.0 - roughness * roughness * roughness * inner
}

/// F_ms of each channel: what is left of the light that is reflected more than once, from F̄ and Ē.
pub fn series_of_bounces(average: [f64; 3], white_mean: f64) -> [f64; 3] {
    average.map(|mean| mean * mean * white_mean / (1.0 - mean * (1.0 - white_mean)))
}

/// What lamps and image are multiplied by, from the image's terms: E_F, E, F̄ and the roughness.
pub fn compensation(image: [f64; 3], white: f64, average: [f64; 3], roughness: f64) -> [f64; 3] {
    let series = series_of_bounces(average, white_mean(roughness));
    each_channel(|i| 1.0 + (1.0 - white) * series[i] / image[i].max(SMALLEST_IMAGE))
}

/// What the image is divided by at least, so that black stays black.
const SMALLEST_IMAGE: f64 = 1e-5;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::num::Legendre;
    use crate::physics::optics::Ggx;

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
}
