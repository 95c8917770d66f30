//! Light that a ball gathers, against the exact map of rings.

use super::device;
use fresnel_gen::pictures::scene::{
    Gathering, Photons, TRIANGLES, Window, caustic_error, caustics, exact_caustics,
};

/// A smooth spot for each photon.
const SPLATS: Gathering = Gathering {
    vertex: "vs_splat",
    fragment: "fs_splat",
    vertices: |side| 6 * side.pow(2),
    finest: 1,
};
/// A count in the pixel where each photon lands.
const POINTS: Gathering = Gathering {
    vertex: "vs_point",
    fragment: "fs_lit",
    ..SPLATS
};
const ONE_PICTURE: Photons = Photons {
    side: 256,
    moves: 1,
};

const N: f64 = 1.5;

/// How far below the ball, and the L1 of triangles, of splats and of points of 256 x 256 photons. `docs/renders.md` shows them.
const GATHERED: [(f64, [f64; 3]); 3] = [
    (1.2, [0.008, 0.275, 0.073]),
    (1.5, [0.009, 0.146, 0.155]),
    (2.0, [0.009, 0.010, 0.232]),
];

/// Triangles are within 2 % of the exact map, and their energy within .25 %; points and splats are not.
#[test]
fn triangles_of_photons_are_near_the_exact_map() {
    let Some(device) = device() else { return };
    let page = include_str!("../../../docs/renders.md");
    for (below, stated) in GATHERED {
        let window = Window {
            below,
            half: 1.0,
            pixels: 128,
        };
        let exact = exact_caustics(N, &window);
        let kinds = [TRIANGLES, SPLATS, POINTS];
        let found = kinds.map(|gathering| {
            let drawn = caustics(&device, N, &window, gathering, ONE_PICTURE);
            caustic_error(&drawn.expect("it is drawn").0, &exact)
        });
        let [(triangles, energy), (splats, _), (points, _)] = found;
        println!("{below} R: {found:?}");
        assert!(
            triangles < 0.02 && (energy - 1.0).abs() < 0.0025,
            "{below} R: {found:?}"
        );
        assert!(
            points > 2.0 * triangles && splats > triangles,
            "{below} R: {found:?}"
        );
        for ((l1, _), stated) in found.into_iter().zip(stated) {
            let near = (l1 - stated).abs() < 0.0006 + 0.02 * stated;
            assert!(near, "{below} R: {l1}, stated {stated}");
        }
        let cells = stated.map(|l1| format!(" {l1:.3} |").replacen(" 0", " ", 1));
        let line = format!("| {below} R |{}", cells.concat());
        assert!(page.contains(&line), "docs/renders.md lacks {line}");
    }
}

/// How far below the ball, and the L1 of triangles of 256 x 256 photons, of the mean of four such pictures between which the light moves by
/// half a cell, and of 1024 x 1024 photons. `docs/renders.md` shows them.
const ERRORS: [[f64; 4]; 3] = [
    [1.2, 0.0082, 0.0043, 0.0035],
    [1.5, 0.0085, 0.0037, 0.0060],
    [2.0, 0.0095, 0.0038, 0.0096],
];

/// Sixteen times as many photons gain less than four pictures with the light moved: what is left of the error is not in the distance of
/// photons, so that triangles cut where they are large would gain nothing either.
#[test]
fn a_moving_light_gains_more_than_more_photons() {
    let Some(device) = device() else { return };
    let page = include_str!("../../../docs/renders.md");
    for [below, one, four, many] in ERRORS {
        let window = Window {
            below,
            half: 1.0,
            pixels: 128,
        };
        let exact = exact_caustics(N, &window);
        let [finer_side, moved] =
            [(1024, 1), (256, 2)].map(|(side, moves)| Photons { side, moves });
        for (photons, stated) in [(ONE_PICTURE, one), (moved, four), (finer_side, many)] {
            let drawn = caustics(&device, N, &window, TRIANGLES, photons);
            let (l1, _) = caustic_error(&drawn.expect("it is drawn").0, &exact);
            let near = stated * 0.9..stated * 1.1;
            assert!(
                near.contains(&l1),
                "{below} R, {photons:?}: {l1}, stated {stated}"
            );
        }
        let line = format!("| {below} R | {one} | {four} | {many} |");
        assert!(page.contains(&line), "docs/renders.md lacks {line}");
        assert!(four < 0.6 * one);
    }
}

/// A light that moves by half a cell, both ways, leaves the points of a grid twice as fine.
#[test]
fn four_pictures_of_points_are_one_with_four_times_as_many() {
    let Some(device) = device() else { return };
    let window = Window {
        below: 1.2,
        half: 1.0,
        pixels: 64,
    };
    let points = |side, moves| {
        let photons = Photons { side, moves };
        let drawn = caustics(&device, N, &window, POINTS, photons);
        drawn.expect("it is drawn").0
    };
    let (l1, _) = caustic_error(&points(64, 2), &points(128, 1));
    assert!(l1 < 0.01, "{l1}");
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
