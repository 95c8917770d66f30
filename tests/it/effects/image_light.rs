//! The functions that read a split-sum table: with the table that `bake --dfg` makes, white reflects everything, metals reflect what the
//! table's terms and the series of bounces give, and lamps get the factor that belongs to it.

use std::sync::LazyLock;

use super::{function, numbers, vector};
use crate::compensation::series_of_bounces;
use fresnel_gen::generator::lut::{
    Depth, SPLIT_SUM_AXES, SPLIT_SUM_SIZE, SplitSum, SplitSumDesign, StoredSplitSum,
};
use fresnel_gen::language::ir::{Filter, Texels, Value, Weights, evaluate};
use fresnel_gen::language::methods::Method;

const COSINES: [f64; 6] = [0.05, 0.15, 0.3, 0.5, 0.8, 1.0];
const ROUGHNESS: [f64; 5] = [0.05, 0.2, 0.5, 0.8, 1.0];

/// Red of gold, and blue: c0 to c3 of `fitted`, and the mean.
const RED: [f64; 4] = [1.0, -0.0057, 0.0058, 0.0];
const BLUE: [f64; 4] = [0.3348, 0.3663, 0.4302, -0.1325];

static TABLE: LazyLock<StoredSplitSum> = LazyLock::new(|| {
    let basis = Method::FITTED.basis().unwrap();
    let design = SplitSumDesign::square(basis, SPLIT_SUM_SIZE, SPLIT_SUM_AXES);
    SplitSum::new(&design, &mut |_, _| {})
        .unwrap()
        .stored(Depth::Half)
});

fn mean(c: [f64; 4]) -> f64 {
    let averages = Method::FITTED.basis().unwrap().averages();
    c.iter()
        .zip(averages)
        .map(|(c, mean)| c * mean)
        .sum::<f64>()
        .clamp(0.0, 1.0)
}

/// What a function gives for a grey surface at each pair of cosine and roughness.
fn given(name: &str, c: [f64; 4]) -> Vec<(f64, f64, f64)> {
    let texels = Texels {
        width: SPLIT_SUM_SIZE,
        texels: TABLE.texels.iter().map(|t| [t[0], t[1], t[2]]).collect(),
        alpha: Some(TABLE.texels.iter().map(|t| t[3]).collect()),
        filter: Filter::Linear,
    };
    let pairs: Vec<(f64, f64)> = COSINES
        .iter()
        .flat_map(|cos| ROUGHNESS.map(|roughness| (*cos, roughness)))
        .collect();
    let (cosines, roughness): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let mut arguments = vec![numbers(&cosines), numbers(&roughness)];
    arguments.extend(c.map(|c| vector([c; 3])));
    arguments.push(vector([mean(c); 3]));
    arguments.push(Value::each(vec![SPLIT_SUM_SIZE as f64; pairs.len()]));
    arguments.push(Value::Texture(Some(texels)));
    let result = evaluate(&function(name), &arguments);
    let pairs = pairs.into_iter().enumerate();
    pairs
        .map(|(i, (cos, roughness))| (cos, roughness, result.at(i)[0]))
        .collect()
}

/// E_F, E and F_ms as the table and the series have them.
fn wanted(c: [f64; 4], cos: f64, roughness: f64) -> [f64; 3] {
    let terms = TABLE.lookup(Weights::Exact, cos, roughness);
    let once: f64 = c.iter().zip(terms).map(|(c, term)| c * term).sum();
    let lost = {
        let [a, b, c, d] = fresnel_gen::language::effects::WHITE_MEAN_LOST;
        roughness.powi(3) * (a + roughness * (b + roughness * (c + roughness * d)))
    };
    let more = series_of_bounces([mean(c); 3], 1.0 - lost)[0];
    [once.clamp(0.0, terms[0]), terms[0], more]
}

#[test]
fn white_reflects_everything_at_every_roughness() {
    for (cos, roughness, all) in given("image_reflectance", [1.0, 0.0, 0.0, 0.0]) {
        assert!((all - 1.0).abs() < 5e-4, "{cos} {roughness}: {all}");
    }
}

#[test]
fn metals_reflect_what_the_terms_and_the_bounces_give_and_lamps_get_the_factor() {
    for c in [RED, BLUE] {
        let factors = given("lamp_factor", c);
        let images = given("image_reflectance", c);
        for ((cos, roughness, image), (_, _, factor)) in images.into_iter().zip(factors) {
            let [once, white, more] = wanted(c, cos, roughness);
            let all = once + (1.0 - white) * more;
            assert!(
                (image - all).abs() < 1e-6,
                "{cos} {roughness}: {image} {all}"
            );
            assert!(
                (factor * once - all).abs() < 1e-6,
                "{cos} {roughness}: {factor}"
            );
            assert!(
                factor >= 1.0 && image <= 1.0005,
                "{cos} {roughness}: {factor} {image}"
            );
        }
    }
    // A rough coloured metal loses less of the channel that it reflects well, and so grows more saturated in all.
    let rough = |c| given("lamp_factor", c).last().unwrap().2;
    assert!(rough(RED) > rough(BLUE) && rough(BLUE) > 1.05);
}

/// Nothing reflects nothing, and the factor stays finite.
#[test]
fn black_stays_black() {
    for (_, _, all) in given("image_reflectance", [0.0; 4]) {
        assert_eq!(all, 0.0);
    }
    for (_, _, factor) in given("lamp_factor", [0.0; 4]) {
        assert_eq!(factor, 1.0);
    }
}
