//! Errors in pictures: what a physicist sees in the reflectance of an object, and in what Schlick misses.

use super::Fact;
use super::baked::exr_texels;
use super::check_all;
use super::reader::Panels;
use crate::cli::Place;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*angles.exr",
        says: "the cosine on a sphere is 1 in the middle and falls to 0 at the rim",
        holds: |shown| {
            let texels = exr_texels(&shown.bytes());
            let row = texels.height / 2 * texels.width;
            let across: Vec<f64> = (texels.width / 2..texels.width)
                .map(|x| texels.values[row + x][0])
                .take_while(|cosine| *cosine > 0.0)
                .collect();
            assert!(across[0] > 0.999 && across[across.len() - 1] < 0.3);
            assert!(across.is_sorted_by(|near, far| near > far));
        },
    },
    Fact {
        pictures: "*water_reference.exr",
        says: "water reflects two per cent head-on",
        holds: |shown| {
            let texels = exr_texels(&shown.bytes());
            let middle = texels.height / 2 * texels.width + texels.width / 2;
            let [red, green, blue, _] = texels.values[middle];
            assert!(
                [red, green, blue]
                    .iter()
                    .all(|f| (f - 0.0204).abs() < 0.0005)
            );
        },
    },
    Fact {
        pictures: "*_schlick.png",
        says: "at grazing angles everything is a mirror, and Schlick errs at oblique angles: bright bands, and most of the object dark",
        holds: |shown| {
            let read = Panels::new(shown);
            assert!(read.brightest(0) > 230.0 && read.brightest(1) > 230.0);
            let map = read.colours(2, [0, 256, 0, 256]);
            let lit = |least: f64| map.iter().filter(|colour| colour[1] > least).count();
            assert!(lit(100.0) > 0 && lit(100.0) < map.len() / 4);
        },
    },
    Fact {
        pictures: "*scene-error/platinum_schlick.png",
        says: "Schlick's metal is brighter than the law's at oblique angles and darker nowhere",
        holds: |shown| {
            let read = Panels::new(shown);
            let [schlick, law] = [0, 1].map(|panel| read.colours(panel, [0, 256, 0, 256]));
            let pairs = || schlick.iter().zip(&law);
            assert!(pairs().all(|(a, b)| (0..3).all(|c| a[c] >= b[c])));
            let brighter = pairs().filter(|(a, b)| (0..3).all(|c| a[c] > b[c]));
            let brighter = brighter.count();
            assert!(brighter > 20_000, "{brighter}");
        },
    },
];

#[test]
fn a_sphere_shows_where_schlick_errs() {
    let place = Place::new();
    place.done("scene-error sphere --eye 0,0,-2 --fov 34 --material water --method schlick --size 96x96 --out-dir drawn");
    assert_eq!(check_all(&place.path("")).len(), 3);
}
