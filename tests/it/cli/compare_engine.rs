//! `compare`: engines beside the truth, as a user sees it.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::Place;
use crate::bless;
use crate::readme::replaced;

const PAGE: &str = "docs/does-it-matter.md";
const SHOWN: &str = "copper platinum gold:coat titanium anodised_titanium_purple water";
/// The rows of the page's table.
const TABLE: &str = "silver copper gold aluminium water bk7 diamond platinum titanium iron chromium gold:coat copper:coat silver:coat platinum:coat anodised_titanium_purple tempered_steel_blue oil_on_water magnesium_fluoride_on_glass cold_mirror soap";

fn rows(place: &Place, line: &str) -> Vec<Value> {
    let ran = place.done(&format!("compare {line} --json -"));
    ran.json()["rows"].as_array().unwrap().clone()
}

fn number(row: &Value, way: &str, key: &str) -> f64 {
    row[way]["delta_e2000"][key].as_f64().unwrap()
}

/// The committed picture is what its command draws, to the byte.
#[test]
fn the_page_shows_what_its_command_draws() {
    let place = Place::new();
    place.done(&format!("compare {SHOWN} -o drawn.png"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let committed = root.join("docs/does-it-matter.png");
    bless::check(&committed, &fs::read(place.path("drawn.png")).unwrap());
    let page = fs::read_to_string(root.join(PAGE)).unwrap();
    let command = format!("fresnel-gen compare {SHOWN} -o docs/does-it-matter.png");
    assert!(page.contains(&command), "{PAGE} lacks {command}");
}

#[test]
fn the_page_has_the_table_of_today() {
    let place = Place::new();
    let mut table = "| material | three.js as it ships | seen | F82-tint | with fresnel-gen |\n| --- | ---: | ---: | ---: | ---: |\n".to_owned();
    for row in rows(&place, TABLE) {
        let coat = if row["with_coat"] == true {
            ":coat"
        } else {
            ""
        };
        let both = |way: &str| {
            format!(
                "{:.1}, {:.1}",
                number(&row, way, "mean"),
                number(&row, way, "p99")
            )
        };
        table += &format!(
            "| `{}{coat}` | {} | {:.0} % | {} | {} |\n",
            row["material"].as_str().unwrap(),
            both("stock"),
            100.0 * row["stock"]["seen"].as_f64().unwrap(),
            both("f82"),
            both("fitted")
        );
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE);
    let page = fs::read_to_string(&path).unwrap();
    bless::check(&path, replaced(&page, "matter", &table).as_bytes());
}

/// What a physicist expects, and what the page says of when not to bother.
#[test]
fn coats_and_films_are_seen_and_bare_metals_hardly() {
    let place = Place::new();
    for row in rows(&place, "silver copper aluminium gold") {
        assert!(number(&row, "stock", "mean") < 0.5, "{row}");
    }
    for row in rows(&place, "gold:coat platinum:coat anodised_titanium_purple") {
        let seen = row["stock"]["seen"].as_f64().unwrap();
        assert!(seen > 0.9 && number(&row, "stock", "mean") > 4.0, "{row}");
        assert!(number(&row, "fitted", "mean") < 0.5, "{row}");
    }
    // Schlick's approximation has no dip before grazing, and F82-tint has one.
    for row in rows(&place, "platinum titanium iron --environment white") {
        let [stock, f82] = ["stock", "f82"].map(|way| number(&row, way, "p99"));
        assert!(stock > 4.0 * f82, "{row}");
    }
}

#[test]
fn every_engine_with_an_adapter_is_compared() {
    let place = Place::new();
    let engines = fresnel_gen::generator::flavours::ALL.iter();
    for engine in engines.filter(|one| one.stock.is_some()) {
        let name = engine.name;
        let line = format!("platinum --engine {name} --size 64 -o {name}.png");
        let rows = rows(&place, &line);
        let [stock, fitted] = ["stock", "fitted"].map(|way| number(&rows[0], way, "mean"));
        assert!(fitted < stock, "{name}: {fitted} {stock}");
        let coated = format!("compare platinum:coat --engine {name} --size 64 -o {name}.png");
        match engine.coated_f0 {
            Some(_) => {
                place.done(&coated);
            }
            None => place.refused(&coated, &["not known here", "three"]),
        }
    }
}

#[test]
fn wrong_words_name_the_right_ones() {
    let place = Place::new();
    place.refused("compare gold:coats", &["gold"]);
    place.refused("compare golt:coat", &["did you mean gold"]);
    place.refused("compare gold --engine thre", &["three"]);
    place.refused("compare water:coat", &["dielectric"]);
    place.refused("compare gold --size 8", &["64 to 512"]);
    place.refused("compare gold -o gold.svg", &[".png"]);
    place.refused("compare gold --environment skye", &["skye"]);
    place.put("compare.png", "mine");
    place.refused("compare gold", &["compare.png", "-o"]);
    assert_eq!(
        fs::read_to_string(place.path("compare.png")).unwrap(),
        "mine"
    );
}
