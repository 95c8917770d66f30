//! Colours that artists set, on the exact curve: the table beside the form of renderers, and what must be so in nature.

use std::path::Path;

use fresnel_gen::lab::verify::{ABSOLUTE_FLOOR, cosines};
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::language::methods;
use fresnel_gen::physics::num::{Num, ulp_distance};
use fresnel_gen::physics::optics;

use crate::readme::{page, replaced};

const POINTS: usize = 20_000;
/// Next to 1, where a difference of reflectances has no digits, and a usual glass.
const INDICES: [f32; 4] = [1.001, 1.01, 1.1, 1.5];

/// The function between a grey and white.
fn ours<N: Num>(ior: f32, f0: f64, cosines: &[f32]) -> Vec<f64> {
    between::<N>(ior, [f0, 1.0], cosines)
}

/// The function between two greys.
fn between<N: Num>(ior: f32, [f0, f90]: [f64; 2], cosines: &[f32]) -> Vec<f64> {
    let method = methods::find("dielectric_tinted").unwrap();
    let function = method.function(false).unwrap();
    let angles = cosines.iter().map(|c| N::from_f64((*c).into()));
    let arguments = [
        Value::each(angles.collect()),
        Value::scalar(ior.into()),
        Value::rgb([f0; 3]),
        Value::rgb([f90; 3]),
    ];
    let values = evaluate(&function, &arguments);
    (0..cosines.len())
        .map(|i| values.at(i)[0].to_f64())
        .collect()
}

/// `(R - R0) / (1 - R0)` in f32, as Cycles has it in `fresnel_dielectric_cos` and `microfacet_fresnel`.
fn cycles(ior: f32, c: f32) -> f32 {
    let g2 = ior * ior - 1.0 + c * c;
    let reflected = if g2 > 0.0 {
        let g = g2.sqrt();
        let a = (g - c) / (g + c);
        let b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
        0.5 * a * a * (1.0 + b * b)
    } else {
        1.0
    };
    let root = (ior - 1.0) / (ior + 1.0);
    let r0 = root * root;
    ((reflected - r0) / (1.0 - r0)).clamp(0.0, 1.0)
}

/// The most that either is off over the angles, in units in the last place where it is above the floor of the claims, and absolutely.
fn worst(ior: f32, cosines: &[f32], got: &[f32]) -> [f64; 2] {
    let want = ours::<f64>(ior, 0.0, cosines);
    got.iter()
        .zip(want)
        .fold([0.0; 2], |[ulp, abs], (got, want)| {
            let off = (f64::from(*got) - want).abs();
            let own = if off > ABSOLUTE_FLOOR {
                ulp_distance(*got, want)
            } else {
                0.0
            };
            [ulp.max(own), abs.max(off)]
        })
}

fn table() -> String {
    let cosines = cosines(POINTS);
    let mut text =
        "| index | renderers: ulp, largest error | `dielectric_tinted` |\n| --- | --- | --- |\n"
            .to_owned();
    for ior in INDICES {
        let renderers: Vec<f32> = cosines.iter().map(|c| cycles(ior, *c)).collect();
        let own: Vec<f32> = ours::<f32>(ior, 0.0, &cosines)
            .into_iter()
            .map(|value| value as f32)
            .collect();
        let [theirs, own] = [renderers, own].map(|got| worst(ior, &cosines, &got));
        let cell = |[ulp, abs]: [f64; 2]| format!("{ulp:.1}, {abs:.1e}");
        text += &format!("| {ior} | {} | {} |\n", cell(theirs), cell(own));
    }
    text
}

#[test]
fn the_table_beside_renderers_is_measured() {
    let path = "docs/methods.md";
    let text = replaced(&page(path), "tinted", &table());
    crate::bless::check(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join(path),
        text.as_bytes(),
    );
}

/// With the index's own reflectance and a white edge it is the law itself.
#[test]
fn its_own_colours_give_the_law() {
    for ior in [0.4f32, 0.66, 1.001, 1.33, 1.5, 2.4, 4.0] {
        let root = (f64::from(ior) - 1.0) / (f64::from(ior) + 1.0);
        let cosines = cosines(POINTS);
        for (f, c) in ours::<f64>(ior, root * root, &cosines)
            .into_iter()
            .zip(&cosines)
        {
            let law = optics::dielectric(ior.into(), f64::from(*c).min(1.0)).unpolarised();
            assert!((f - law).abs() < 1e-9, "{ior} {c}: {f} {law}");
        }
    }
}

/// Past the critical angle the edge's colour is all that is left. Next to it F0 is.
#[test]
fn the_edge_begins_at_the_critical_angle() {
    let critical = (1.0f32 - 1.0 / (1.5 * 1.5)).sqrt();
    let values = ours::<f64>(1.0 / 1.5, 0.0, &[critical - 1e-3, critical + 0.05, 1.0]);
    assert_eq!(values[0], 1.0);
    assert!(values[1] < 0.4 && values[2] == 0.0, "{values:?}");
}

/// The absolute error over indices, colours and angles, in both directions.
#[test]
fn its_code_error_is_what_it_promises() {
    let cosines = cosines(POINTS);
    let mut most = 0.0f64;
    for ior in [1.0001f32, 1.001, 1.1, 1.33, 1.5, 2.0, 2.4, 4.0, 8.0, 12.0] {
        for colours in [[0.0, 1.0], [0.04, 1.0], [0.9, 1.0], [0.5, 0.0], [1.0, 0.0]] {
            let got = between::<f32>(ior, colours, &cosines);
            let want = between::<f64>(ior, colours, &cosines);
            let off = got.iter().zip(want).map(|(got, want)| (got - want).abs());
            most = off.fold(most, f64::max);
        }
    }
    let promised = methods::find("dielectric_tinted").unwrap().claims.code_abs;
    assert!(
        most <= promised && most >= 0.5 * promised,
        "{most:e}, {promised:e}"
    );
}
