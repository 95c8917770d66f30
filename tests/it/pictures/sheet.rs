//! The sheet of a material: its index, its reflectance and its colour agree with each other and with what is known of it.

use roxmltree::{Document, Node};

use super::Fact;
use super::PictureFile;
use super::check_all;
use super::reader::Pixels;
use super::reader::Plot;
use super::reader::attribute;
use super::reader::colour;
use super::reader::corner;
use super::reader::panels;
use super::reader::plots;
use super::reader::words;
use crate::cli::Place;

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*material-*.svg",
        says: "at 90 degrees every channel is 1 and the reflection is white",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            for channel in CHANNELS {
                let grazing = sheet.angle().at(channel, 90.0);
                assert!((grazing - 1.0).abs() < 4e-3, "{channel}: {grazing}");
            }
            assert_eq!(sheet.swatch(90.0).fill, [255; 3]);
        },
    },
    Fact {
        pictures: "*material-*.svg",
        says: "reflectance at 0 degrees is what n and k of the panel beside it give, at each wavelength",
        holds: |shown| Sheet::new(shown).index_gives_reflectance_in(1.0),
    },
    Fact {
        pictures: "*material-*.svg",
        says: "a swatch has the colour of the reflection at its angle",
        holds: |shown| Sheet::new(shown).swatches_are_the_curves(),
    },
    Fact {
        pictures: "*material-gold*.svg",
        says: "gold's k rises and its n falls to the red, and it reflects red more than green more than blue",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            let index = sheet.index();
            assert!(index.at("k", 800.0) > 2.0 * index.at("k", 500.0));
            assert!(index.at("n", 450.0) > 5.0 * index.at("n", 650.0));
            let [red, green, blue] = CHANNELS.map(|channel| sheet.angle().at(channel, 0.0));
            assert!(
                red > 1.0 && red > green + 0.2 && green > blue + 0.3,
                "{red} {green} {blue}"
            );
            let spectrum = sheet.spectrum();
            assert!(spectrum.at("0°", 450.0) < 0.45 && spectrum.at("0°", 700.0) > 0.95);
        },
    },
    Fact {
        pictures: "*material-gold*.svg",
        says: "gold is yellow at 0 degrees and pales towards 90",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            let [red, green, blue] = sheet.swatch(0.0).fill;
            assert!(red > green && green > blue + 40, "{red} {green} {blue}");
            assert!(sheet.swatch(82.0).fill[2] > blue);
        },
    },
    Fact {
        pictures: "*gold_in_water.svg",
        says: "n and k are gold's own, and what it reflects in water is what they give divided by water's index",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            assert!(shown.text().contains("Its own, not divided by the medium"));
            sheet.index_gives_reflectance_in(1.334);
            let [red, green, blue] = sheet.swatch(0.0).fill;
            assert!(red > green && green > blue + 40, "{red} {green} {blue}");
        },
    },
    Fact {
        pictures: "*material-gold*.png",
        says: "gold's swatches and curves have their colours in the pixels too",
        holds: |shown| pixels_are_the_drawing(shown),
    },
    Fact {
        pictures: "*material-copper.svg",
        says: "copper is red: it reflects beyond 600 nm what it absorbs below",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            let spectrum = sheet.spectrum();
            assert!(spectrum.at("0°", 500.0) < 0.6 && spectrum.at("0°", 650.0) > 0.9);
            let [red, green, blue] = sheet.swatch(0.0).fill;
            assert!(red > green + 30 && green > blue, "{red} {green} {blue}");
        },
    },
    Fact {
        pictures: "*material-silver.svg",
        says: "silver reflects over .95 of all colours, and less towards its edge in the ultraviolet",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            for channel in CHANNELS {
                assert!(sheet.angle().lowest(channel).1 > 0.95);
            }
            let spectrum = sheet.spectrum();
            assert!(spectrum.at("0°", 370.0) < spectrum.at("0°", 500.0) - 0.01);
        },
    },
    Fact {
        pictures: "*material-water.svg",
        says: "water's n falls with the wavelength, and it reflects a fiftieth at 0 degrees",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            let index = sheet.index();
            let [blue, yellow, red] = [450.0, 589.0, 700.0].map(|nm| index.at("n", nm));
            assert!(
                blue > yellow && yellow > red && (yellow - 1.333).abs() < 2e-3,
                "{yellow}"
            );
            let normal = sheet.angle().at("green", 0.0);
            assert!((normal - 0.0204).abs() < 4e-3, "{normal}");
        },
    },
    Fact {
        pictures: "*material-platinum.svg",
        says: "platinum dips between 60 and 80 degrees in every channel",
        holds: |shown| {
            let sheet = Sheet::new(shown);
            for channel in CHANNELS {
                let (at, low) = sheet.angle().lowest(channel);
                assert!((60.0..80.0).contains(&at), "{channel}: {at}");
                assert!(low < sheet.angle().at(channel, 0.0) - 0.01);
            }
        },
    },
];

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// A sheet as its reader sees it.
struct Sheet {
    plots: Vec<Plot>,
    swatches: Vec<Swatch>,
    size: f64,
}

struct Swatch {
    degrees: f64,
    fill: [u8; 3],
    /// Its middle on the sheet.
    middle: (f64, f64),
}

impl Sheet {
    #[track_caller]
    fn new(shown: &PictureFile) -> Sheet {
        Sheet::of(&shown.text())
    }

    #[track_caller]
    fn of(svg: &str) -> Sheet {
        let document = Document::parse(svg).unwrap();
        let plots = plots(&document);
        let titles: Vec<&str> = plots.iter().map(|plot| plot.title.as_str()).collect();
        let wanted = [
            "Refractive index and extinction",
            "Reflectance against angle",
            "Reflectance against wavelength",
        ];
        assert_eq!(titles, wanted);
        for plot in &plots {
            assert!(plot.x.rises_rightwards() && !plot.x.is_logarithmic && !plot.y.is_logarithmic);
        }
        let panels = panels(&document);
        Sheet {
            plots,
            swatches: swatches(panels[panels.len() - 1]),
            size: attribute(document.root_element(), "width").unwrap(),
        }
    }

    fn index(&self) -> &Plot {
        &self.plots[0]
    }

    fn angle(&self) -> &Plot {
        &self.plots[1]
    }

    fn spectrum(&self) -> &Plot {
        &self.plots[2]
    }

    #[track_caller]
    fn swatch(&self, degrees: f64) -> &Swatch {
        self.swatches
            .iter()
            .find(|swatch| swatch.degrees == degrees)
            .unwrap()
    }

    #[track_caller]
    fn index_gives_reflectance_in(&self, medium: f64) {
        let has_k = self.index().curves.iter().any(|(name, _)| name == "k");
        for nm in [400.0, 500.0, 550.0, 600.0, 700.0] {
            let n = self.index().at("n", nm) / medium;
            let k = if has_k {
                self.index().at("k", nm) / medium
            } else {
                0.0
            };
            let want = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
            let got = self.spectrum().at("0°", nm);
            assert!(
                (got - want).abs() < 0.012,
                "{nm} nm: {got}, from n and k {want}"
            );
        }
    }

    #[track_caller]
    fn swatches_are_the_curves(&self) {
        for swatch in &self.swatches {
            for (channel, byte) in CHANNELS.iter().zip(swatch.fill) {
                let linear = self.angle().at(channel, swatch.degrees).clamp(0.0, 1.0);
                let shown = linear_of(byte);
                assert!(
                    (linear - shown).abs() < 0.012,
                    "{channel} at {}: {shown}, not {linear}",
                    swatch.degrees
                );
            }
        }
    }
}

/// A byte of sRGB as a linear channel.
fn linear_of(byte: u8) -> f64 {
    let value = f64::from(byte) / 255.0;
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

/// The swatches, each with the angle that stands over it.
fn swatches(panel: Node) -> Vec<Swatch> {
    let (left, top) = corner(panel);
    let words = words(panel);
    let filled = panel.children().filter(|node| node.has_tag_name("rect"));
    let swatch = |rect: Node| {
        let fill = rect.attribute("fill")?;
        let [x, y, width, height] =
            ["x", "y", "width", "height"].map(|name| attribute(rect, name).unwrap());
        let middle = (x + width / 2.0, y + height / 2.0);
        let above = |text: &str| {
            text.strip_suffix('°')
                .and_then(|number| number.parse().ok())
        };
        let label = words
            .iter()
            .find(|word| (word.x - middle.0).abs() < 1.0 && word.y < y);
        Some(Swatch {
            degrees: above(&label?.text)?,
            fill: fill.starts_with('#').then(|| colour(fill))?,
            middle: (left + middle.0, top + middle.1),
        })
    };
    let all: Vec<Swatch> = filled.filter_map(swatch).collect();
    assert_eq!(all.len(), 7);
    all
}

/// The same drawing lies beside it as SVG, whose places count.
#[track_caller]
fn pixels_are_the_drawing(shown: &PictureFile) {
    let svg = String::from_utf8(shown.beside(&shown.ending("svg")).unwrap()).unwrap();
    let (sheet, pixels) = (Sheet::of(&svg), Pixels::new(&shown.bytes()));
    let scale = pixels.width as f64 / sheet.size;
    assert!(pixels.height as f64 > 700.0 * scale);
    for swatch in &sheet.swatches {
        let seen = pixels.at(scale * swatch.middle.0, scale * swatch.middle.1);
        assert_eq!(seen, swatch.fill, "{} degrees", swatch.degrees);
    }
    // The red curve is solid: it is there at every angle.
    let plot = sheet.angle();
    let red = plot
        .curves
        .iter()
        .position(|(name, _)| name == "red")
        .unwrap();
    let (ink, places) = &plot.drawn[red];
    for (x, y) in places.iter().skip(20).step_by(40) {
        let seen = pixels.at(scale * (plot.corner.0 + x), scale * (plot.corner.1 + y));
        let apart = seen
            .iter()
            .zip(colour(ink))
            .map(|(a, b)| a.abs_diff(b))
            .max();
        assert!(apart < Some(40), "{seen:?} at {:?}", plot.x.value(*x));
    }
}

#[test]
fn sheets_show_what_is_known_of_materials() {
    let place = Place::new();
    for name in ["gold", "copper", "silver", "water", "platinum"] {
        let line = format!("materials show {name} --svg material-{name}.svg");
        place.done(&line);
    }
    place.done("materials show gold --png material-gold.png");
    place.done("materials show gold --medium water --svg gold_in_water.svg");
    assert_eq!(check_all(&place.path("")).len(), 7);
}
