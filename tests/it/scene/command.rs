//! The command `render`.

use crate::cli::Place;
use crate::not_checked;

#[test]
fn a_picture_is_written_with_its_report() {
    let place = Place::new();
    let ran = place.run("render double_refraction --size 32 -o ball.png --json ball.json");
    if ran.code == Some(3) && std::env::var_os("CI").is_none() {
        return not_checked(&ran.err);
    }
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.out.contains("error      CIEDE2000"), "{}", ran.out);
    let picture = std::fs::read(place.path("ball.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG"));
    let report: serde_json::Value = serde_json::from_str(&place.read("ball.json")).unwrap();
    assert_eq!(report["rows"][0]["effect"], "double_refraction");
    let again = place.done("render double_refraction --size 32 -o again.png");
    assert!(again.out.contains("hits"), "{}", again.out);
    assert_eq!(picture, std::fs::read(place.path("again.png")).unwrap());
    place.done("render double_refraction --size 16 -o ball.exr --exposure -2 --tone-curve aces");
    assert!(
        std::fs::read(place.path("ball.exr"))
            .unwrap()
            .starts_with(&[0x76, 0x2f, 0x31, 0x01])
    );
    // Without -o a picture of its own is drawn again, and a file of the user's stays.
    place.done("render caustics --size 16");
    place.done("render caustics --size 16");
    std::fs::write(place.path("caustics.png"), "mine").unwrap();
    place.refused(
        "render caustics --size 16",
        &["name the picture's file with -o"],
    );
    // What it wrote is no environment: three panels are not twice as wide as high.
    place.refused(
        "render double_refraction --environment ball.png -o b.png",
        &["ball.png", "twice as wide"],
    );
}

#[test]
fn wrong_words_are_refused_before_the_work() {
    let place = Place::new();
    place.refused(
        "render double_refracton",
        &["double_refracton", "double_refraction"],
    );
    place.refused(
        "render double_refraction --size 4",
        &["--size is 4", "16 to 2048"],
    );
    place.refused(
        "render double_refraction --exposure 99",
        &["--exposure is 99"],
    );
    place.refused(
        "render double_refraction -o ball.bmp",
        &["ball.bmp", ".png or .exr"],
    );
    place.refused(
        "render double_refraction --tone-curve film",
        &["film", "none, aces, reinhard"],
    );
    place.refused(
        "render double_refraction --material gold",
        &["gold", "dielectric"],
    );
    place.refused(
        "render double_refraction --environment none.hdr",
        &["none.hdr"],
    );
    // Films: one clear film, for the bubble around nothing, and no film for the other pictures.
    place.refused(
        "render thin_film --material gold",
        &["gold", "one clear film", "--film titanium_dioxide:150nm"],
    );
    place.refused(
        "render thin_film --material cold_mirror",
        &["one clear film"],
    );
    place.refused(
        "render soap_film --material oil_on_water",
        &["oil_on_water", "take thin_film", "--material air"],
    );
    place.refused(
        "render complex_f0 --film 1.4:100nm",
        &["under films", "thin_film and soap_film"],
    );
    place.put("not.hdr", "text");
    place.refused(
        "render double_refraction --environment not.hdr",
        &["not.hdr"],
    );
}
