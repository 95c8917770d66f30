//! The thesis's figures: the exact law as physicists know it, and where what approximates it meets it.

use roxmltree::Document;

use super::Fact;
use super::PictureFile;
use super::check_all;
use super::reader::Plot;
use super::reader::plots;
use crate::cli::Place;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*figure-*.svg",
        says: "at 0 degrees the law is ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2), at 90 degrees it is 1",
        holds: |shown| the_law_has_its_ends(&read(shown), caption(shown)),
    },
    Fact {
        pictures: "*figure-06-water.svg",
        says: "Schlick is too dark at 60 degrees and too bright at 80",
        holds: |shown| {
            let plot = read(shown);
            meets(&plot, "Schlick", &[0.0, 90.0]);
            assert!(over(&plot, "Schlick", 60.0) < -0.4 && over(&plot, "Schlick", 80.0) > 4.0);
        },
    },
    Fact {
        pictures: "*figure-09-gold-685nm.svg",
        says: "gold's red dips at 72.6 degrees below its value at 0, and the rescaled Schlick does not",
        holds: |shown| {
            let plot = read(shown);
            dips(&plot, 72.6);
            assert!(plot.lowest("rescaled").1 > plot.at("exact law", 0.0) - 0.05);
            guide(&plot, "minimum", 72.59);
            guide(&plot, "77°", 77.0);
        },
    },
    Fact {
        pictures: "*figure-10-gold-475nm.svg",
        says: "gold's blue has no dip worth the name",
        holds: |shown| {
            let plot = read(shown);
            meets(&plot, "rescaled", &[0.0, 90.0]);
            assert!(plot.lowest("exact law").1 > plot.at("exact law", 0.0) - 0.3);
        },
    },
    Fact {
        pictures: "*figure-11-water-empirical.svg",
        says: "NVIDIA's term meets the law at 0, 60 and 90 degrees",
        holds: |shown| {
            let plot = read(shown);
            meets(&plot, "NVIDIA", &[0.0, 60.0, 90.0]);
            guide(&plot, "60°", 60.0);
            assert!(over(&plot, "NVIDIA", 80.0) > 5.0);
        },
    },
    Fact {
        pictures: "*figure-12-hydrogen.svg",
        says: "what is nearly matched reflects at grazing angles alone, and Schlick everywhere from 50 degrees on",
        holds: |shown| {
            let plot = read(shown);
            assert!(plot.at("exact law", 85.0) < 1.0 && plot.at("Schlick", 85.0) > 50.0);
            assert!(over(&plot, "Schlick", 88.0) > 75.0);
        },
    },
    Fact {
        pictures: "*figure-13-arsenic-trisulphide.svg",
        says: "Schlick is too dark at 60 degrees and too bright at 85",
        holds: |shown| {
            let plot = read(shown);
            meets(&plot, "Schlick", &[0.0, 90.0]);
            assert!(over(&plot, "Schlick", 60.0) < -1.0 && over(&plot, "Schlick", 85.0) > 3.0);
        },
    },
    Fact {
        pictures: "*figure-14-germanium.svg",
        says: "the law stays at its value of 0 degrees up to 70, and Schlick rises before it",
        holds: |shown| {
            let plot = read(shown);
            meets(&plot, "Schlick", &[0.0, 90.0]);
            assert!(over(&plot, "Schlick", 84.0) > 18.0);
            assert!((plot.at("exact law", 70.0) - plot.at("exact law", 0.0)).abs() < 1.0);
        },
    },
    Fact {
        pictures: "*figure-15-platinum-schlick.svg",
        says: "platinum dips at 76 degrees, Schlick has no dip, and from n alone begins at ((n - 1) / (n + 1))^2",
        holds: |shown| {
            let plot = read(shown);
            dips(&plot, 76.25);
            meets(&plot, "Schlick from F0", &[0.0, 90.0]);
            assert!(over(&plot, "Schlick from F0", 82.0) > 15.0);
            let from_n = plot.at("Schlick from n", 0.0);
            assert!((from_n - normal(2.49, 0.0)).abs() < 0.1, "{from_n}");
        },
    },
    Fact {
        pictures: "*figure-16-platinum-corrected.svg",
        says: "the corrected form meets the law at 0, 81.37 and 90 degrees, and dips",
        holds: |shown| {
            let plot = read(shown);
            dips(&plot, 76.25);
            meets(&plot, "corrected", &[0.0, 81.37, 90.0]);
            assert!(over(&plot, "rescaled", 81.37) > 15.0);
            guide(&plot, "minimum", 76.25);
            guide(&plot, "81.37°", 81.37);
        },
    },
];

fn read(shown: &PictureFile) -> Plot {
    let text = shown.text();
    let document = Document::parse(&text).unwrap();
    let plot = plots(&document).remove(0);
    assert!(plot.x.rises_rightwards() && !plot.x.is_logarithmic && !plot.y.is_logarithmic);
    assert!(
        plot.y.place(100.0) < plot.y.place(95.0),
        "the axis runs down"
    );
    plot
}

/// n and k as the title has them.
fn caption(shown: &PictureFile) -> (f64, f64) {
    let text = shown.text();
    let value = |name: &str| {
        let rest = text.split(&format!("{name} = ")).nth(1)?;
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        rest[..end].parse().ok()
    };
    (value("n").unwrap(), value(", k").unwrap_or(0.0))
}

/// Reflectance at 0 degrees, in per cent.
fn normal(n: f64, k: f64) -> f64 {
    100.0 * ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k)
}

#[track_caller]
fn the_law_has_its_ends(plot: &Plot, (n, k): (f64, f64)) {
    let [first, last] = [0.0, 90.0].map(|degrees| plot.at("exact law", degrees));
    assert!(
        (first - normal(n, k)).abs() < 0.1,
        "{first}, not {}",
        normal(n, k)
    );
    assert!((last - 100.0).abs() < 0.1, "{last}");
}

/// How many percentage points a curve lies over the law.
#[track_caller]
fn over(plot: &Plot, name: &str, degrees: f64) -> f64 {
    plot.at(name, degrees) - plot.at("exact law", degrees)
}

#[track_caller]
fn meets(plot: &Plot, name: &str, degrees: &[f64]) {
    for at in degrees {
        let apart = over(plot, name, *at);
        assert!(apart.abs() < 0.2, "{name} at {at}: {apart}");
    }
}

#[track_caller]
fn dips(plot: &Plot, degrees: f64) {
    let (at, low) = plot.lowest("exact law");
    assert!((at - degrees).abs() < 1.0, "{at}, not {degrees}");
    assert!(low < plot.at("exact law", 0.0) - 1.0);
}

#[track_caller]
fn guide(plot: &Plot, label: &str, degrees: f64) {
    let found = plot.guides.iter().find(|(text, _)| text.starts_with(label));
    let (_, at) = found.unwrap_or_else(|| panic!("no {label} among {:?}", plot.guides));
    assert!((at - degrees).abs() < 0.1, "{label} stands at {at}");
}

#[test]
fn figures_show_the_law_and_what_misses_it() {
    let place = Place::new();
    place.done("reproduce figures --out-dir figures");
    assert_eq!(check_all(&place.path("")).len(), 9);
}
