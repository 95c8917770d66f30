//! Table 1: the indices of refraction, as our material files hold them.

use super::row::{Figure, Row, Verdict};
use super::{Section, specialised, thesis};

/// The materials in the order of the thesis.
const MATERIALS: [&str; 4] = ["gold", "platinum", "water", "diamond"];
/// The channels in the order of the thesis.
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Table 1 beside our files.
pub fn section() -> Section {
    Section {
        title: "Table 1: indices of refraction at 685, 535 and 475 nm, from data/materials/*_thesis.toml"
            .to_owned(),
        rows: MATERIALS.into_iter().flat_map(rows).collect(),
    }
}

fn rows(material: &'static str) -> impl Iterator<Item = Row> {
    let ours = specialised::channels(material);
    CHANNELS.into_iter().enumerate().map(move |(i, channel)| {
        let printed = thesis::numbers(&["table1_index", material, channel]);
        let printed = [printed[0], printed[1]];
        let ours = [ours.n[i], ours.k[i]];
        Row::new("table1", material, channel)
            .thesis(Figure::Index(printed))
            .ours(Figure::Index(ours))
            .verdict(if printed == ours {
                Verdict::Agrees
            } else {
                Verdict::Differs
            })
    })
}
