//! Light that a ball gathers, against the exact map of rings.

use fresnel_gen::scene::{Gathering, Window, caustic_error, caustics, exact_caustics};

use super::device;

const N: f64 = 1.5;

/// Triangles are within 2 % of the exact map, and their energy within .25 %; points and splats are not.
#[test]
fn triangles_of_photons_are_near_the_exact_map() {
    let Some(device) = device() else { return };
    let mut faults = String::new();
    for below in [1.2, 1.5, 2.0] {
        let window = Window {
            below,
            half: 1.0,
            pixels: 128,
        };
        let exact = exact_caustics(N, &window);
        let error = |gathering| {
            let (drawn, hits) = caustics(&device, N, &window, gathering).expect("it is drawn");
            let (l1, energy) = caustic_error(&drawn, &exact);
            println!("{below} R, {gathering:?}: L1 {l1:.4}, energy {energy:.4}, hits {hits:.4}");
            (l1, energy)
        };
        let (l1, energy) = error(Gathering::Triangles);
        let (splats, _) = error(Gathering::Splats);
        let (points, _) = error(Gathering::Points);
        if l1 > 0.02 || (energy - 1.0).abs() > 0.0025 {
            faults += &format!("{below} R: L1 {l1:.4}, energy {energy:.4}\n");
        }
        if points < 2.0 * l1 || splats < l1 {
            faults +=
                &format!("{below} R: L1 {l1:.4}, of points {points:.4}, of splats {splats:.4}\n");
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

/// Near the axis light lands as a thin lens sends it: the focus lies at n R / (2 (n - 1)) = 1.5 R.
#[test]
fn the_brightest_pixel_is_at_the_focus() {
    let sum_within = |below: f64| {
        let window = Window {
            below,
            half: 1.0,
            pixels: 129,
        };
        exact_caustics(N, &window)[64 * 129 + 64]
    };
    let (before, at, behind) = (sum_within(1.3), sum_within(1.45), sum_within(1.7));
    assert!(
        at > 2.0 * before && at > 2.0 * behind,
        "{before} {at} {behind}"
    );
}
