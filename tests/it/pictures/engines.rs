//! Engines beside the truth: what a physicist sees in the spheres.

use super::Fact;
use super::reader::{Panels, Part};

/// Panels of a row: as it ships, F82-tint, ours, truth, and the errors of the first and of ours.
const COLUMNS: usize = 6;
const GROUND: Part = [90, 166, 160, 220];
const MIDDLE: Part = [110, 146, 110, 146];
/// Right of the middle, just inside the rim.
const RIM: Part = [240, 244, 124, 132];

pub static FACTS: &[Fact] = &[
    Fact {
        pictures: "*does-it-matter.png",
        says: "below a coat gold sends back less blue than its colours in air say: it is more yellow in truth than as it ships",
        holds: |shown| {
            let read = Panels::new(shown);
            let [stock, ours, truth] =
                [0, 2, 3].map(|column| -read.blueness(2 * COLUMNS + column, GROUND));
            assert!(truth > stock + 10.0, "{truth} {stock}");
            assert!((truth - ours).abs() < 3.0, "{truth} {ours}");
        },
    },
    Fact {
        pictures: "*does-it-matter.png",
        says: "bare platinum is wrong at the rim and not in the middle; coated gold is wrong all over; ours is wrong nowhere",
        holds: |shown| {
            let read = Panels::new(shown);
            // The bar's colours grow in green.
            let error =
                |row: usize, column: usize, part| read.mean(row * COLUMNS + column, part)[1];
            assert!(error(1, 4, RIM) > error(1, 4, MIDDLE) + 60.0);
            assert!(error(2, 4, MIDDLE) > 60.0);
            for row in 0..6 {
                assert!(
                    error(row, 5, MIDDLE) < 30.0 && error(row, 5, RIM) < 40.0,
                    "{row}"
                );
            }
        },
    },
    Fact {
        pictures: "*does-it-matter.png",
        says: "purple titanium mirrors more blue and red than green",
        holds: |shown| {
            let read = Panels::new(shown);
            let [red, green, blue] = read.mean(4 * COLUMNS + 3, GROUND);
            assert!(
                red > green + 10.0 && blue > green + 5.0,
                "{red} {green} {blue}"
            );
        },
    },
];
