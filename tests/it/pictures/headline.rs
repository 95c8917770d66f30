//! README's first picture: spheres and curves of platinum, and of gold below a clear coat.

use roxmltree::{Document, Node};

use super::Fact;
use super::reader::colour;
use super::reader::plots;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*headline.svg",
        says: "below a coat too, gold's sphere is yellow in the middle and white at the rim, by every method",
        holds: |shown| {
            let text = shown.text();
            let document = Document::parse(&text).unwrap();
            for method in 0..3 {
                let stops = gradient(&document, &format!("gold-{method}-colour"));
                let [red, green, blue] = stops[0].1;
                assert!(red > green + 20 && green > blue + 60, "{:?}", stops[0]);
                assert_eq!(stops.last().unwrap(), &(1.0, [255; 3]));
            }
        },
    },
    Fact {
        pictures: "*headline.svg",
        says: "platinum dips before 90 degrees, which Schlick's approximation does not and fitted does",
        holds: |shown| {
            let text = shown.text();
            let document = Document::parse(&text).unwrap();
            let plots = plots(&document);
            let platinum = &plots[0];
            for (method, dips) in [("Schlick", false), ("fitted", true), ("law", true)] {
                let method = &format!("green: {method}");
                let (at, least) = platinum.lowest(method);
                let normal = platinum.at(method, 0.0);
                assert_eq!(
                    at > 60.0 && least < normal - 0.03,
                    dips,
                    "{method}: {at} {least}"
                );
                assert!((platinum.at(method, 90.0) - 1.0).abs() < 4e-3);
            }
        },
    },
    Fact {
        pictures: "*headline.svg",
        says: "Schlick errs on platinum in a ring near the rim, fitted hardly, the exact law not at all",
        holds: |shown| {
            let text = shown.text();
            let document = Document::parse(&text).unwrap();
            let brightest = |method: usize| {
                let stops = gradient(&document, &format!("platinum-{method}-error"));
                let most = stops.iter().max_by_key(|(_, colour)| colour[0]);
                let (at, [value, ..]) = *most.unwrap();
                (f64::asin(at).to_degrees(), value)
            };
            let (at, value) = brightest(0);
            assert!((70.0..88.0).contains(&at) && value > 200, "{at} {value}");
            assert!(brightest(1).1 < 40, "{:?}", brightest(1));
            assert_eq!(brightest(2).1, 0);
        },
    },
    Fact {
        pictures: "*headline.svg",
        says: "below a coat gold is darker than its colours in air, head-on too; the base for the coat is near",
        holds: |shown| {
            let text = shown.text();
            let document = Document::parse(&text).unwrap();
            let in_the_middle =
                |method: usize| gradient(&document, &format!("gold-{method}-error"))[0].1[0];
            assert!(in_the_middle(0) > 120 && in_the_middle(1) < 60);
            let gold = &plots(&document)[1];
            let green = |method: &str| gold.at(&format!("green: {method}"), 0.0);
            assert!(green("Schlick") > green("law") + 0.02);
        },
    },
];

/// The colours of a gradient by their place: 0 in the middle, 1 at the rim.
fn gradient(document: &Document, id: &str) -> Vec<(f64, [u8; 3])> {
    let is_it = |node: &Node| node.attribute("id") == Some(id);
    let found = document.descendants().find(is_it);
    let stops = found.unwrap_or_else(|| panic!("no {id}")).children();
    let stop = |node: Node| {
        let offset: f64 = node.attribute("offset")?.parse().ok()?;
        Some((offset, colour(node.attribute("stop-color")?)))
    };
    stops.filter_map(stop).collect()
}
