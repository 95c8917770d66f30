//! The page of a plan: its pictures show what is known of gold.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use image::RgbImage;

use crate::cli::Place;

/// A sphere of gold in dim light, which takes the Gaussian form of Schlick's formula.
const SCENE: &str = "size = [64, 64]\n[camera]\northographic = 2.0\neye = [0, 0, 4]\n[light]\nuniform = [0.05, 0.04, 0.0275]\n[[object]]\nbody = \"sphere\"\nextent = 2.0\nmaterial = \"gold\"\n";

/// The pictures of a page in their order, with what is written under each.
fn pictures(page: &str) -> Vec<(String, RgbImage)> {
    let parts = page.split("<figure>").skip(1);
    let picture = |part: &str| {
        let between = |from: &str, to: &str| {
            let rest = part.split_once(from).expect("a picture has it").1;
            rest.split_once(to).expect("it ends").0.to_owned()
        };
        let bytes = BASE64_STANDARD.decode(between("base64,", "\""));
        let bytes = bytes.expect("it is base64");
        let picture = image::load_from_memory(&bytes).expect("it is a PNG");
        (
            between("<figcaption>", "</figcaption>"),
            picture.into_rgb8(),
        )
    };
    parts.map(picture).collect()
}

#[test]
fn gold_is_yellow_and_differs_nowhere_in_the_middle() {
    let place = Place::new();
    place.put("scene.toml", SCENE);
    place.done("plan scene.toml --out-dir page");
    let pictures = pictures(&place.read("page/plan.html"));
    let titles: Vec<&str> = pictures.iter().map(|(title, _)| title.as_str()).collect();
    assert_eq!(titles.len(), 5, "{titles:?}");
    assert_eq!(titles[0], "exact law");
    assert!(
        titles[1].starts_with("schlick_spherical_gaussian"),
        "{titles:?}"
    );
    let [exact, chosen, apart] = [0, 1, 2].map(|i| &pictures[i].1);
    let [width, height] = [exact.width(), exact.height()];
    assert_eq!([width, height], [64, 64]);
    let middle = |picture: &RgbImage| picture.get_pixel(width / 2, height / 2).0;
    let [red, green, blue] = middle(exact);
    assert!(red > green && green > blue, "{:?}", middle(exact));
    assert_eq!(middle(exact), middle(chosen));
    // F0 is met, and near the rim it is not: the difference is larger there than in the middle.
    let brightest = |x: u32| apart.get_pixel(x, height / 2).0.into_iter().max();
    let rim = (0..6).filter_map(brightest).max();
    assert!(rim > middle(apart).into_iter().max(), "{rim:?}");
    // Beside the sphere there is nothing.
    assert_eq!(exact.get_pixel(0, 0), chosen.get_pixel(0, 0));
    assert_eq!(exact.get_pixel(0, 0).0, [40, 42, 46]);
}
