//! Errors in pictures: what a physicist sees in the reflectance of an object, and in what Schlick misses.

use super::Fact;
use super::PictureFile;
use super::baked::exr_texels;
use super::check_all;
use super::reader::Pixels;
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
        pictures: "*_reference.png",
        says: "at grazing angles everything is a mirror",
        holds: |shown| assert!(brightest(shown) > 230),
    },
    Fact {
        pictures: "*_schlick.png",
        says: "at grazing angles everything is a mirror",
        holds: |shown| assert!(brightest(shown) > 230),
    },
    Fact {
        pictures: "*scene-error/platinum_schlick.png",
        says: "Schlick's metal is brighter than the law's at oblique angles and darker nowhere",
        holds: |shown| {
            let reference = shown
                .beside("docs/scene-error/platinum_reference.png")
                .unwrap();
            let law = Pixels::new(&reference);
            let schlick = Pixels::new(&shown.bytes());
            let mut brighter = 0;
            for i in 0..law.width * law.height {
                let at = ((i % law.width) as f64, (i / law.width) as f64);
                let (law, schlick) = (law.at(at.0, at.1), schlick.at(at.0, at.1));
                assert!((0..3).all(|c| schlick[c] >= law[c]), "{at:?} is darker");
                brighter += usize::from((0..3).all(|c| schlick[c] > law[c]));
            }
            assert!(brighter > 20_000, "{brighter}");
        },
    },
    Fact {
        pictures: "*_schlick_difference.png",
        says: "Schlick errs at oblique angles: bright bands, and most of the object dark",
        holds: |shown| {
            let all = colours(shown);
            let lit = |least: u8| all.iter().filter(|colour| colour[0] > least).count();
            assert!(brightest(shown) > 120 && lit(120) < lit(0) / 2);
        },
    },
];

fn colours(shown: &PictureFile) -> Vec<[u8; 3]> {
    let pixels = Pixels::new(&shown.bytes());
    let places = (0..pixels.width * pixels.height).map(|i| (i % pixels.width, i / pixels.width));
    places.map(|(x, y)| pixels.at(x as f64, y as f64)).collect()
}

/// The least channel of the brightest pixel.
fn brightest(shown: &PictureFile) -> u8 {
    let least = |colour: &[u8; 3]| colour.iter().copied().min();
    colours(shown).iter().filter_map(least).max().unwrap()
}

#[test]
fn a_sphere_shows_where_schlick_errs() {
    let place = Place::new();
    place.done("scene-error sphere --eye 0,0,-2 --fov 34 --material water --method schlick --size 96x96 --out-dir drawn");
    assert_eq!(check_all(&place.path("")).len(), 5);
}
