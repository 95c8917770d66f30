//! Materials beside each other: what each reflects, and the n and k that it reflects by.

use roxmltree::Document;

use super::Fact;
use super::PictureFile;
use super::check_all;
use super::reader::Pixels;
use super::reader::Plot;
use super::reader::plots;
use crate::cli::Place;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "compared-*.svg",
        says: "all panels of reflectance have one axis, no wider than the curves want, and end at 1",
        holds: |shown| {
            let plots = read(shown);
            let (angles, _) = plots.split_at(plots.len() - 2);
            let mut values = Vec::new();
            for plot in angles {
                for (name, points) in &plot.curves {
                    let last = points[points.len() - 1];
                    assert!((last.1 - 1.0).abs() < 4e-3, "{name}: {last:?}");
                    values.extend(points.iter().map(|point| point.1));
                }
                let ends = [0.0, 1.0].map(|value| plot.y.place(value));
                let first = [0.0, 1.0].map(|value| angles[0].y.place(value));
                assert!((ends[0] - first[0]).abs() < 1e-6 && (ends[1] - first[1]).abs() < 1e-6);
            }
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            // The axis of metals begins above 0.
            let bottom = angles[0].y.place(0.0);
            assert!(least < 0.2 || bottom > 600.0, "{least}: 0 at {bottom}");
        },
    },
    Fact {
        pictures: "compared-silver.svg",
        says: "silver's k rises to the red, by every measurement, and it reflects more than .85",
        holds: |shown| {
            let plots = read(shown);
            let [n, k] = [&plots[plots.len() - 2], &plots[plots.len() - 1]];
            assert_eq!(
                [n.title.as_str(), &k.title],
                ["Refractive index", "Extinction coefficient"]
            );
            for name in ["silver", "silver_babar", "silver_jiang"] {
                assert!(k.at(name, 700.0) > 1.5 * k.at(name, 450.0), "{name}");
                assert!(n.at(name, 600.0) < 0.2, "{name}");
                assert!(
                    plots[..3].iter().all(|plot| plot.lowest(name).1 > 0.85),
                    "{name}"
                );
            }
            assert!(shown.text().contains("Phys. Rev. B 6, 4370-4379 (1972)"));
        },
    },
    Fact {
        pictures: "compared-polarised.svg",
        says: "at 550 nm water reflects no p at Brewster's angle of 53 degrees and s more than p, and at 0 degrees n gives R",
        holds: |shown| {
            let plots = read(shown);
            assert_eq!(plots.len(), 2 + 2);
            let (plot, n) = (&plots[0], &plots[2]);
            assert_eq!(plot.title, "Reflectance, 550 nm");
            let (at, low) = plot.lowest("water p");
            assert!((at - 53.2).abs() < 1.0 && low < 4e-3, "{at}: {low}");
            for degrees in [20.0, 53.0, 80.0] {
                let [s, p] = ["s", "p"].map(|of| plot.at(&format!("water {of}"), degrees));
                let both = plot.at("water", degrees);
                assert!(
                    s > p && (both - 0.5 * (s + p)).abs() < 6e-3,
                    "{both} of {s}, {p}"
                );
            }
            let n = n.at("water", 550.0);
            let normal = ((n - 1.0) / (n + 1.0)).powi(2);
            assert!((plot.at("water", 0.0) - normal).abs() < 5e-3);
        },
    },
    Fact {
        pictures: "compared-silver.png",
        says: "the drawing beside it is there in pixels",
        holds: |shown| {
            let pixels = Pixels::new(&shown.bytes());
            assert!(pixels.width == 2400 && pixels.height > 1400);
        },
    },
];

#[track_caller]
fn read(shown: &PictureFile) -> Vec<Plot> {
    let text = shown.text();
    let plots = plots(&Document::parse(&text).unwrap());
    assert!(plots.iter().all(|plot| plot.x.rises_rightwards()));
    plots
}

#[test]
fn measurements_stand_beside_each_other() {
    let place = Place::new();
    place.done("materials compare silver silver_babar silver_jiang --svg compared-silver.svg --png compared-silver.png");
    place.done("materials compare water gold --wavelengths 550,650 --polarised --svg compared-polarised.svg");
    assert_eq!(check_all(&place.path("")).len(), 3);
}
