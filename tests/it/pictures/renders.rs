//! Effects as they are drawn, beside their truth: what a physicist sees in the panels of the committed pictures.

use super::Fact;
use super::PictureFile;
use super::reader::{Panels, Part};

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*renders/double_refraction*.png",
        says: "drawn and true alike, glass is blue of the sky below and not above; a brilliant mirrors the sky from inside",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let place = if shown.file.contains("gem") {
                    MIDDLE
                } else {
                    BOTTOM
                };
                assert!(read.blueness(panel, place) > 15.0);
                assert!(read.blueness(panel, TOP) < 0.0);
            }
        },
    },
    Fact {
        pictures: "*renders/double_refraction.png",
        says: "what is reflected inside is missing: the rim is darker than in truth",
        holds: |shown| {
            let read = Panels::new(shown);
            let [drawn, truth] = [0, 1].map(|panel| read.mean(panel, RIM)[1]);
            assert!(drawn < truth - 5.0, "{drawn} {truth}");
        },
    },
    Fact {
        pictures: "*renders/double_refraction_gem.png",
        says: "one reflection brings too much of the bright ground: the brilliant is brighter than in truth",
        holds: |shown| {
            let read = Panels::new(shown);
            let [drawn, truth] = [0, 1].map(|panel| read.mean(panel, WHOLE)[1]);
            assert!(drawn > truth, "{drawn} {truth}");
        },
    },
    Fact {
        pictures: "*renders/double_refraction_ldr.png",
        says: "the sun's glint is white in truth, and not where the sky is clamped",
        holds: |shown| {
            let read = Panels::new(shown);
            assert!(read.brightest(1) > 220.0 && read.brightest(0) < 150.0);
        },
    },
    Fact {
        pictures: "*renders/reflection_refraction.png",
        says: "two refractions show the whole sky below, one spreads a part of the world over the ball",
        holds: one_surface_magnifies,
    },
    Fact {
        pictures: "*renders/dispersion.png",
        says: "two refractions show the whole sky below, one spreads a part of the world over the ball",
        holds: one_surface_magnifies,
    },
    Fact {
        pictures: "*renders/dispersion_*.png",
        says: "real glass hardly colours a grey floor; indices far apart fill it with colours",
        holds: |shown| {
            let read = Panels::new(shown);
            let is_invented = shown.file.contains("invented");
            for panel in [0, 1] {
                let chroma = read.chroma(panel, [60, 196, 60, 120]);
                assert_eq!(chroma > 30.0, is_invented, "{chroma}");
            }
        },
    },
    Fact {
        pictures: "*renders/complex_f0.png",
        says: "gold reflects red more than green, and green more than blue",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let [red, green, blue] = read.mean(panel, BOTTOM);
                assert!(red > green + 20.0 && green > blue + 20.0);
            }
        },
    },
    Fact {
        pictures: "*renders/thin_film.png",
        says: "the oxide grows downwards: the ball is yellowish above, then purple, and blue in its middle",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let [red, _, blue] = read.mean(panel, [100, 160, 58, 70]);
                assert!(red > blue, "{red} {blue}");
                let [red, green, blue] = read.mean(panel, [40, 80, 76, 84]);
                assert!(red > green && blue > green, "{red} {green} {blue}");
                let [red, _, blue] = read.mean(panel, [110, 150, 95, 115]);
                assert!(blue > red + 40.0, "{red} {blue}");
            }
        },
    },
    Fact {
        pictures: "*renders/soap_film.png",
        says: "each wall mirrors the sun, the near one upright and the far one upside down",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let around = read.mean(panel, [70, 86, 100, 116])[1];
                let near = read.mean(panel, [90, 94, 84, 88])[1];
                let far = read.mean(panel, [153, 157, 156, 160])[2];
                let beside = read.mean(panel, [130, 146, 150, 166])[1];
                assert!(
                    near > around && far > beside,
                    "{near} {around}, {far} {beside}"
                );
            }
        },
    },
    Fact {
        pictures: "*renders/normal_mapped.png",
        says: "silver mirrors the sky above and the ground below, dents or not",
        holds: |shown| {
            let read = Panels::new(shown);
            assert!(read.blueness(0, TOP) > 50.0 && read.blueness(0, BOTTOM) < -10.0);
        },
    },
    Fact {
        pictures: "*renders/parallax_corrected.png",
        says: "a mirror keeps left on the left: the red wall is there, the green one on the right",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let [red, green, _] = read.mean(panel, LEFT);
                assert!(red > green + 50.0);
                let [red, green, _] = read.mean(panel, RIGHT);
                assert!(green > red + 50.0);
            }
        },
    },
    Fact {
        pictures: "*renders/caustics.png",
        says: "light is gathered in the middle, and the less the further out",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let light = [0, 20, 40, 80, 120].map(|far| read.mean(panel, ring(far))[0]);
                assert!(light[0] > 240.0, "{light:?}");
                assert!(light.is_sorted_by(|near, far| near > far), "{light:?}");
            }
        },
    },
    Fact {
        pictures: "*renders/caustics_ring.png",
        says: "before the focus light is brightest on a ring, the fold, and on the axis",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let light = |from, to| read.mean(panel, [from, to, 127, 129])[0];
                let (axis, between, fold, outside) = (
                    light(127, 129),
                    light(131, 133),
                    light(135, 136),
                    light(142, 146),
                );
                assert!(
                    axis > between && fold > between && between > outside + 10.0,
                    "{axis} {between} {fold} {outside}"
                );
            }
        },
    },
    Fact {
        pictures: "*renders/water.png",
        says: "water takes red from light: tiles under it are blue, the stones above are not",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                assert!(read.blueness(panel, BOTTOM) > 50.0);
                assert!(read.blueness(panel, [120, 130, 84, 90]) < -10.0);
            }
            for part in [BOTTOM, [40, 80, 190, 230], [180, 220, 190, 230]] {
                let [drawn, truth] = [0, 1].map(|panel| read.mean(panel, part));
                let apart = [0, 1, 2].map(|i| f64::abs(drawn[i] - truth[i]));
                assert!(
                    apart.iter().all(|apart| *apart < 4.0),
                    "{drawn:?} {truth:?}"
                );
            }
        },
    },
    Fact {
        pictures: "*renders/stained_glass.png",
        says: "the hub is gold, the wall lets nothing through, and where the sun stands behind the glass it is white",
        holds: |shown| {
            let read = Panels::new(shown);
            for panel in [0, 1] {
                let [red, green, blue] = read.mean(panel, [122, 134, 108, 118]);
                assert!(red > green + 5.0 && green > blue + 30.0);
                let corner = read.mean(panel, [0, 30, 0, 30]);
                assert!(corner[0] < 15.0, "{corner:?}");
                assert!(read.brightest(panel) > 240.0);
            }
        },
    },
];

fn one_surface_magnifies(shown: &PictureFile) {
    let read = Panels::new(shown);
    assert!(read.blueness(1, BOTTOM) > read.blueness(0, BOTTOM) + 15.0);
}

const WHOLE: Part = [48, 208, 48, 208];
const RIM: Part = [24, 34, 108, 148];
const TOP: Part = [108, 148, 30, 50];
const MIDDLE: Part = [98, 158, 100, 150];
const BOTTOM: Part = [108, 148, 205, 225];
const LEFT: Part = [20, 40, 118, 138];
const RIGHT: Part = [216, 236, 118, 138];

/// A part so far right of the middle.
fn ring(far: usize) -> Part {
    [125 + far, 131 + far, 125, 131]
}
