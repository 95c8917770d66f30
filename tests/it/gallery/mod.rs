//! The gallery: its texts are ours byte for byte, a browser draws every row by both of its ways, and its pixels are those that this
//! program draws.

mod browser;
mod files;
mod pixels;
mod texts;

use std::sync::OnceLock;

use crate::cli::Place;
use fresnel_gen::Materials;
use fresnel_gen::generator::reference::MaterialInMedium;
use fresnel_gen::generator::request::{Request, Source};
use fresnel_gen::pictures::gallery::films;

/// The materials of the page that tests look at: those of the rows, and one more metal.
const MATERIALS: [&str; 7] = [
    "bk7",
    "diamond",
    "gold",
    "sf11",
    "silver",
    "soda_lime_glass",
    "water",
];

/// The page with these materials, made once.
fn page() -> &'static str {
    static PAGE: OnceLock<String> = OnceLock::new();
    PAGE.get_or_init(|| {
        let place = Place::new();
        place.done(&format!(
            "gallery --material {} --out-dir .",
            MATERIALS.join(",")
        ));
        place.read("index.html")
    })
}

fn subjects() -> Vec<MaterialInMedium> {
    let named = MATERIALS.map(|name| Source::Named(name.to_owned()));
    let request = Request {
        materials: Materials::These(named.into()),
        ..Request::default()
    };
    let found = request.subjects().expect("they are of the catalogue");
    [found.materials(), films(false)].concat()
}
