//! Maps of `stability`: what they say is read at the place that the labels give, and held against the law.

use std::fs;

use roxmltree::Document;
use tempfile::TempDir;

use super::Fact;
use super::PictureFile;
use super::check_all;
use super::reader::Pixels;
use super::reader::Scale;
use super::reader::Word;
use super::reader::across;
use super::reader::beside;
use super::reader::upwards;
use super::reader::words;
use crate::cli::Place;
use fresnel_gen::generator::fit::values;
use fresnel_gen::generator::reference::Derivation;
use fresnel_gen::lab::stability::{Cell, Map, ScanAxis, maps};
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::language::methods::{self, Class, Contract, Light, Method};
use fresnel_gen::physics::materials::Channels;
use fresnel_gen::physics::num::Precision;
use fresnel_gen::pictures::png::png;
use fresnel_gen::pictures::stability_map::heat_map;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*_eta*.png",
        says: "a colour is the formula's distance from the law, at the angle and the index that the labels say",
        holds: |shown| errors_stand_at_their_places(&Read::new(shown)),
    },
    Fact {
        pictures: "*_k*.png",
        says: "a colour is the formula's distance from the law, at the angle and the k that the labels say",
        holds: |shown| errors_stand_at_their_places(&Read::new(shown)),
    },
    Fact {
        pictures: "*dielectric_textbook_eta.png",
        says: "total reflection begins at the critical angle, asin(eta): from there to 90 degrees the textbook's form is no number",
        holds: |shown| the_textbook_ends_at_the_critical_angle(&Read::new(shown)),
    },
    Fact {
        pictures: "*schlick_eta*.png",
        says: "Schlick is exact at 0 and 90 degrees, and furthest off where total reflection begins",
        holds: |shown| {
            let read = Read::new(shown);
            schlick_meets_the_law_at_both_ends(&read);
            schlick_knows_no_total_reflection(&read);
        },
    },
    Fact {
        pictures: "*schlick_k*.png",
        says: "Schlick misses the dip of metals, between 60 and 89 degrees",
        holds: |shown| schlick_has_no_dip(&Read::new(shown)),
    },
    Fact {
        pictures: "*conductor_textbook_*.png",
        says: "the textbook's form for conductors is no number at 90 degrees, and nowhere else",
        holds: |shown| the_textbook_ends_at_90_degrees(&Read::new(shown)),
    },
    Fact {
        pictures: "*hoffman_f82_eta.png",
        says: "a form that takes F82 is exact at 81.79 degrees, not at 8.21",
        holds: |shown| f82_is_met_at_82_degrees(&Read::new(shown)),
    },
    Fact {
        pictures: "*empirical_eta.png",
        says: "NVIDIA's term meets the law at 60 degrees, not at 30",
        holds: |shown| the_empirical_term_meets_the_law_at_60_degrees(&Read::new(shown)),
    },
    Fact {
        pictures: "*film_map_titanium.png",
        says: "on a metal KHR_materials_iridescence is wrong at nearly every thickness, and beyond 1 near grazing alone",
        holds: |shown| {
            let pixels = Pixels::new(&shown.bytes());
            assert!(share_of_red(&pixels, 75..90) > 0.1 && share_of_red(&pixels, 0..70) == 0.0);
            assert!(brightness(&pixels, 5..60) > 205.0);
        },
    },
    Fact {
        pictures: "*film_map_glass.png",
        says: "on glass it is right head-on and wrong from 60 degrees on, and nowhere beyond 1",
        holds: |shown| {
            let pixels = Pixels::new(&shown.bytes());
            assert_eq!(share_of_red(&pixels, 0..90), 0.0);
            assert!(brightness(&pixels, 70..85) > brightness(&pixels, 0..30) + 15.0);
        },
    },
    Fact {
        pictures: "*film_map_six.png",
        says: "six wavelengths are nowhere beyond 1, and err less than KHR_materials_iridescence on the same film",
        holds: |shown| {
            let pixels = Pixels::new(&shown.bytes());
            assert_eq!(share_of_red(&pixels, 0..90), 0.0);
            assert!(brightness(&pixels, 5..60) < 200.0);
        },
    },
    Fact {
        pictures: "*index.html",
        says: "Schlick's error near an index of 1 is above .2, and the textbook's form fails below 1",
        holds: |shown| the_page_says_what_fails(&shown.text()),
    },
];

/// The pixels between these angles, over all thicknesses, of the panel on the left.
fn between(pixels: &Pixels, degrees: std::ops::Range<usize>) -> Vec<[u8; 3]> {
    let column = |degree: usize| 70.0 + 300.0 * (degree as f64 + 0.5) / 91.0;
    let rows = |degree| (92..308).map(move |y| (column(degree), f64::from(y)));
    degrees
        .flat_map(rows)
        .map(|(x, y)| pixels.at(x, y))
        .collect()
}

fn share_of_red(pixels: &Pixels, degrees: std::ops::Range<usize>) -> f64 {
    let all = between(pixels, degrees);
    let red = all.iter().filter(|colour| **colour == RED).count();
    red as f64 / all.len() as f64
}

/// The mean of green, which grows with the error on the scale of colours.
fn brightness(pixels: &Pixels, degrees: std::ops::Range<usize>) -> f64 {
    let all = between(pixels, degrees);
    all.iter().map(|colour| f64::from(colour[1])).sum::<f64>() / all.len() as f64
}

/// A map as its reader sees it.
struct Read {
    method: &'static Method,
    precision: Precision,
    over: &'static str,
    pixels: Pixels,
    /// Angle and index, of the panel on the left.
    x: Scale,
    y: Scale,
    /// The colours of its bar, with their values.
    bar: Vec<([u8; 3], f64)>,
}

/// Where a result is no reflectance.
const RED: [u8; 3] = [0xd7, 0x26, 0x3d];
/// Between the panels.
const MIDDLE: f64 = 475.0;
/// Steps of colour.
const SHADES: usize = 48;

impl Read {
    fn new(shown: &PictureFile) -> Read {
        let name = shown.name();
        let precision = if name.ends_with("_f16") {
            Precision::F16
        } else {
            Precision::F32
        };
        let name = name.trim_end_matches("_f16");
        let over = if name.ends_with("_k") { "k" } else { "eta" };
        let method = name.trim_end_matches(over).trim_end_matches('_');
        let pixels = Pixels::new(&shown.bytes());
        let svg = heat_map(method, &empty(over, precision));
        let document = Document::parse(&svg).unwrap();
        let words: Vec<Word> = words(document.root_element());
        let left: Vec<Word> = words.into_iter().filter(|word| word.x < MIDDLE).collect();
        let scale = beside(&left);
        Read {
            method: methods::find(method).unwrap(),
            precision,
            over,
            bar: bar(&pixels, &scale),
            x: across(&left),
            y: upwards(&left),
            pixels,
        }
    }

    /// The error that the colour says, and none where it is no reflectance.
    #[track_caller]
    fn error(&self, degrees: f64, index: f64) -> Option<f64> {
        let colour = self.pixels.at(self.x.place(degrees), self.y.place(index));
        if colour == RED {
            return None;
        }
        let found = self.bar.iter().find(|(of, _)| *of == colour);
        Some(
            found
                .unwrap_or_else(|| panic!("{colour:?} at {degrees} degrees is not on the bar"))
                .1,
        )
    }

    /// The angle at which the picture is brightest.
    fn worst(&self, index: f64) -> f64 {
        let at = |degrees: &u32| self.error(f64::from(*degrees), index).unwrap();
        let worst = (0..=90).max_by(|a, b| at(a).total_cmp(&at(b)));
        let most = at(&worst.unwrap());
        let all: Vec<u32> = (0..=90).filter(|degrees| at(degrees) == most).collect();
        f64::from(all[all.len() / 2])
    }
}

/// A map without errors: its labels stand where those of the method's stand.
fn empty(over: &'static str, precision: Precision) -> Map {
    let (low, high): (f64, f64) = if over == "eta" {
        (0.3, 10.0)
    } else {
        (1e-6, 100.0)
    };
    let values = (0..=96).map(|i| low * (high / low).powf(f64::from(i) / 96.0));
    let axis = ScanAxis {
        name: over,
        values: values.map(|value| precision.rounded(value)).collect(),
    };
    let dark = Cell {
        error: 0.0,
        digits: 0.0,
        is_broken: false,
    };
    let degrees: Vec<f64> = (0..=90).map(f64::from).collect();
    Map {
        cells: vec![dark; degrees.len() * axis.values.len()],
        axis,
        precision,
        held: String::new(),
        degrees,
    }
}

/// The colours of the bar from below, each with what stands beside it.
fn bar(pixels: &Pixels, scale: &Scale) -> Vec<([u8; 3], f64)> {
    let [bottom, top] = [1e-6, 1.0].map(|end| scale.place(end));
    let step = (bottom - top) / SHADES as f64;
    let x = 392.0;
    let shade = |i: usize| {
        let y = bottom - step * (i as f64 + 0.5);
        (pixels.at(x, y), scale.value(y))
    };
    (0..SHADES).map(shade).collect()
}

/// Fresnel's law by complex numbers, as Born and Wolf print it: s, then p.
fn law(n: f64, k: f64, cosine: f64) -> [f64; 2] {
    let square = (n * n - k * k - (1.0 - cosine * cosine), 2.0 * n * k);
    let size = square.0.hypot(square.1);
    let real = ((size + square.0) / 2.0).max(0.0).sqrt();
    let root = (real, ((size - square.0) / 2.0).max(0.0).sqrt());
    let ratio = |a: (f64, f64), b: (f64, f64)| {
        let [under, over] = [(a.0 - b.0, a.1 - b.1), (a.0 + b.0, a.1 + b.1)];
        (under.0 * under.0 + under.1 * under.1) / (over.0 * over.0 + over.1 * over.1)
    };
    let index = (n * n - k * k, 2.0 * n * k);
    [
        ratio((cosine, 0.0), root),
        ratio((index.0 * cosine, index.1 * cosine), root),
    ]
}

/// How far the method's formula is from the law.
fn expected(read: &Read, degrees: f64, index: f64) -> f64 {
    let rounded = |value: f64| read.precision.rounded(value);
    let (n, k) = match read.over {
        "eta" => (rounded(index), 0.0),
        _ => (1.5, rounded(index)),
    };
    let cosine = rounded(if degrees == 90.0 {
        0.0
    } else {
        degrees.to_radians().cos()
    });
    let channels = Channels {
        n: [n; 3],
        k: [k; 3],
    };
    let mut values = values(read.method, &channels, &Derivation::default());
    for value in values.values_mut() {
        *value = value.map(rounded);
    }
    let mut arguments = vec![Value::each(vec![cosine])];
    arguments.extend(read.method.arguments(&values, None));
    let [got, _, _] = evaluate::<f64>(&read.method.function(false).unwrap(), &arguments).at(0);
    let [s, p] = law(n, k, cosine);
    let law = match read.method.light {
        Light::Unpolarised => (s + p) / 2.0,
        Light::S => s,
        Light::P => p,
    };
    (got - law).abs()
}

/// The values of the axis at which the picture is read: those of its rows.
fn indices(over: &str) -> Vec<f64> {
    let (low, high): (f64, f64) = if over == "eta" {
        (0.3, 10.0)
    } else {
        (1e-6, 100.0)
    };
    let row = |i: i32| low * (high / low).powf(f64::from(i) / 96.0);
    [4, 14, 24, 46, 58, 68, 80, 92].map(row).to_vec()
}

/// A colour is one of 48 over six decades, and stands for all that is nearer to it than to the next.
const STEP: f64 = 6.0 / 47.0;

/// Darker than this a colour tells nothing; in half precision formulas are written otherwise, and fits rounded.
fn least(precision: Precision) -> f64 {
    match precision {
        Precision::F32 => 1e-5,
        Precision::F16 => 2e-2,
    }
}

#[track_caller]
fn errors_stand_at_their_places(read: &Read) {
    assert!(read.x.rises_rightwards() && !read.x.is_logarithmic && read.y.is_logarithmic);
    let mut seen = 0;
    for index in indices(read.over) {
        for degrees in [0, 2, 8, 15, 30, 42, 55, 60, 67, 75, 82, 88, 90].map(f64::from) {
            let want = expected(read, degrees, index);
            let Some(got) = read.error(degrees, index) else {
                let is_kept = read.method.contract == Contract::Kept;
                assert!(!is_kept, "{} is red at {degrees}", read.method.name);
                continue;
            };
            let at = format!(
                "{} at {degrees} degrees and {} {index:.4}",
                read.method.name, read.over
            );
            if want < least(read.precision) {
                assert!(
                    got < 3.0 * least(read.precision),
                    "{at}: {got:.1e}, not {want:.1e}"
                );
                continue;
            }
            seen += 1;
            let apart = (got / want.min(1.0)).log10().abs();
            let within = if read.precision.is_half() {
                3.0 * STEP
            } else {
                1.2 * STEP
            };
            assert!(apart < within, "{at}: {got:.2e}, not {want:.2e}");
        }
    }
    let is_exact = read
        .method
        .claims
        .model
        .iter()
        .all(|claim| claim.max_abs == 0.0);
    let is_read = seen > 5 || is_exact || read.precision.is_half();
    assert!(is_read, "nothing was read: {seen}");
}

/// Indices below 1, with their critical angles.
fn critical() -> impl Iterator<Item = (f64, f64)> {
    [4, 14, 24]
        .map(|i| 0.3 * (10.0f64 / 0.3).powf(f64::from(i) / 96.0))
        .into_iter()
        .map(|eta| (eta, eta.asin().to_degrees()))
}

#[track_caller]
fn the_textbook_ends_at_the_critical_angle(read: &Read) {
    for (eta, angle) in critical() {
        let first = (0..=90).find(|degrees| read.error(f64::from(*degrees), eta).is_none());
        let first = f64::from(first.expect("no total reflection"));
        assert!(
            (0.0..1.0).contains(&(first - angle)),
            "eta {eta}: from {first} on, not {angle}"
        );
        let beyond = first as u32..=90;
        assert!(
            beyond
                .into_iter()
                .all(|degrees| read.error(f64::from(degrees), eta).is_none())
        );
    }
    // From the thinner side there is none.
    assert!((0..=90).all(|degrees| read.error(f64::from(degrees), 1.5).is_some()));
}

#[track_caller]
fn schlick_meets_the_law_at_both_ends(read: &Read) {
    for eta in [0.5, 1.33, 1.5, 2.4, 4.0] {
        for degrees in [0.0, 90.0] {
            if eta > 1.0 || degrees == 0.0 {
                let error = read.error(degrees, eta).unwrap();
                assert!(
                    error < 3.0 * least(read.precision),
                    "eta {eta}, {degrees}: {error:.1e}"
                );
            }
        }
        let [near, far] = [10.0, 84.0].map(|degrees| read.error(degrees, eta).unwrap());
        assert!(
            eta < 1.0 || far > 100.0 * near.min(1e-4),
            "eta {eta}: {near:.1e}, {far:.1e}"
        );
    }
}

#[track_caller]
fn schlick_knows_no_total_reflection(read: &Read) {
    for (eta, angle) in critical() {
        let before = read.error(angle.floor() - 4.0, eta).unwrap();
        let beyond = read.error(angle.ceil() + 1.0, eta).unwrap();
        assert!(
            beyond > 0.6 && before < beyond / 2.0,
            "eta {eta}: {before:.1e}, then {beyond:.1e}"
        );
    }
}

#[track_caller]
fn schlick_has_no_dip(read: &Read) {
    for k in [3.5, 10.0, 20.0] {
        let worst = read.worst(k);
        assert!((60.0..=89.5).contains(&worst), "k {k}: worst at {worst}");
    }
    // The more it absorbs, the nearer to 90 degrees the dip lies.
    assert!(read.worst(20.0) > read.worst(3.5));
}

#[track_caller]
fn the_textbook_ends_at_90_degrees(read: &Read) {
    for index in indices(read.over) {
        assert_eq!(read.error(90.0, index), None);
        assert!((0..90).all(|degrees| read.error(f64::from(degrees), index).is_some()));
    }
}

#[track_caller]
fn f82_is_met_at_82_degrees(read: &Read) {
    for eta in [1.5, 2.4, 4.0] {
        let [met, other] = [82.0, 70.0].map(|degrees| read.error(degrees, eta).unwrap());
        assert!(
            met < other / 3.0,
            "eta {eta}: {met:.1e} at 82, {other:.1e} at 70"
        );
    }
}

#[track_caller]
fn the_empirical_term_meets_the_law_at_60_degrees(read: &Read) {
    for eta in [1.5, 2.0, 2.4] {
        let [met, other] = [60.0, 30.0].map(|degrees| read.error(degrees, eta).unwrap());
        assert!(
            met < 1e-5 && other > 1e-5,
            "eta {eta}: {met:.1e} at 60, {other:.1e} at 30"
        );
    }
}

#[test]
fn maps_show_total_reflection_beyond_the_critical_angle() {
    let folder = TempDir::new().unwrap();
    for precision in [Precision::F32, Precision::F16] {
        let is_drawn = |method: &&&Method| {
            let is_refused = precision.is_half() && method.half.library_refusal().is_some();
            !method.is_textured() && !is_refused && !method.keeps_inputs()
        };
        for method in methods::ALL.iter().filter(is_drawn) {
            let all = maps(method, precision);
            let is_of_all = matches!(method.class, Class::Any | Class::Film);
            assert_eq!(all.len(), if is_of_all { 2 } else { 1 });
            for map in all {
                let name = format!(
                    "{}_{}{}.png",
                    method.name,
                    map.axis.name,
                    precision.suffix()
                );
                let picture = png(&heat_map(method.name, &map), 1.0).unwrap();
                fs::write(folder.path().join(name), picture).unwrap();
            }
        }
    }
    check_all(folder.path());
}

#[track_caller]
fn the_page_says_what_fails(page: &str) {
    let section = |method: &str| {
        let own = page
            .split("<h2 id=\"")
            .find(|section| section.starts_with(&format!("{method}\"")));
        own.unwrap().to_owned()
    };
    assert!(
        section("schlick").contains("error above 0.2")
            && section("schlick").contains("missed minimum")
    );
    assert!(section("dielectric_textbook").contains("eta &lt;= 1, -0.5 &lt;= cos_theta"));
}

/// The page shows the very pictures that lie beside it, each in its method's section.
#[test]
fn the_page_of_maps_shows_the_files() {
    let place = Place::new();
    place.done("stability --method schlick,dielectric_textbook --out-dir maps");
    let files = check_all(&place.path(""));
    assert_eq!(files.len(), 4, "{files:?}");
    let page = place.read("maps/index.html");
    let sections: Vec<&str> = page.split("<h2 id=\"").collect();
    for (method, over) in [
        ("dielectric_textbook", "eta"),
        ("schlick", "eta"),
        ("schlick", "k"),
    ] {
        let own = sections
            .iter()
            .find(|section| section.starts_with(&format!("{method}\"")));
        let about = format!(
            "<img alt=\"Errors of {method} over angle and {over}\" src=\"data:image/png;base64,"
        );
        let data = own
            .unwrap()
            .split(&about)
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap();
        let bytes = base64::Engine::decode(&base64::prelude::BASE64_STANDARD, data).unwrap();
        let file = fs::read(place.path(&format!("maps/{method}_{over}.png"))).unwrap();
        assert!(bytes == file, "{method} over {over}");
    }
}
