//! Whatever a page or a table holds: no panic, and what was read is written and read again as the same material.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use fresnel_gen::physics::materials::{DispersionCurve, Extrapolate, Material, Page};

const PAGE: &str = "\
REFERENCES: |
    A. Author. <a href=\"https://doi.org/10.1000/1\"><i>J.</i> <b>6</b></a> [b](https://c.d/e) *f* &times;
COMMENTS: |
    Room temperature
DATA:
  - type: tabulated nk
    data: |
        0.2261 1.28 1.188
        0.5 1.5 0.25
        0.4 -1.5 -0.02
  - type: formula 2
    wavelength_range: 0.3 2.5
    coefficients: 0 1.03961212 0.00600069867 0.231792344 4
CONDITIONS:
    temperature: 293
PROPERTIES:
    density:
      - value: 2510
    nd: 1.5168
";

const TABLES: &str =
    "# mine\nwl,n\n0.2261,1.28\n2.5E-01,1.3\n\nwl,k\n0.2261,1.188\nnm;n;k\n400;1;-0.1\n";

/// What is put into good texts to break them.
const SPLINTERS: [&str; 24] = [
    "\n",
    " ",
    "\t",
    "\0",
    "\r\n",
    ":",
    "- ",
    "&a ",
    "*a",
    "<",
    ">",
    "[",
    "](http://",
    "**",
    "|",
    "\"",
    "'",
    "#",
    "1e999",
    "nan",
    "1.80-17",
    "-",
    "\u{e9}",
    "\u{2028}",
];

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// A page that was read: its material is well formed, and its file says the same, or says why it cannot.
fn check(page: Page) {
    let Ok(material) = page.material(None) else {
        return;
    };
    let (from, to) = material.range_nm();
    for nm in [from, (from + to) / 2.0, to, 550.0] {
        for beyond in [Extrapolate::Refuse, Extrapolate::Hold] {
            if let Ok(index) = material.index(nm, beyond) {
                assert!(index.n > 0.0 && index.k >= 0.0, "{index:?} at {nm} nm");
            }
        }
    }
    for material in [material.trimmed(400.0, 700.0), material] {
        match Material::parse("m.toml", &material.to_toml()) {
            Ok(again) => assert_eq!(again, material),
            Err(fault) => assert!(
                !is_within_limits(&material),
                "{fault}\n{}",
                material.to_toml()
            ),
        }
    }
}

/// The limits of a material's file, written a second time.
fn is_within_limits(material: &Material) -> bool {
    let inside = |curve: &DispersionCurve, low: f64, high: f64| match curve {
        DispersionCurve::Table(table) => table
            .points()
            .iter()
            .all(|(nm, value)| (1.0..=1e6).contains(nm) && (low..=high).contains(value)),
        DispersionCurve::Formula(formula) => formula.from_nm >= 1.0 && formula.to_nm <= 1e6,
    };
    inside(&material.n, 1e-3, 1e4) && material.k.as_ref().is_none_or(|k| inside(k, 0.0, 1e4))
}

fn read(file: &str, text: &str) {
    for page in [Page::parse(file, text), Page::parse_csv(file, text)] {
        match page {
            Ok(page) => check(page),
            Err(fault) => {
                let lines = text.split('\n').count();
                assert!(
                    (1..=lines + 1).contains(&fault.line) && fault.column >= 1,
                    "{fault}"
                );
            }
        }
    }
    let _ = Material::parse(file, text);
}

/// A text with some of its places broken.
fn broken(good: &'static str) -> impl Strategy<Value = String> {
    let wound = (
        any::<prop::sample::Index>(),
        0..8_usize,
        prop::sample::select(&SPLINTERS[..]),
    );
    prop::collection::vec(wound, 1..6).prop_map(move |wounds| {
        let mut letters: Vec<char> = good.chars().collect();
        for (at, length, splinter) in wounds {
            let at = at.index(letters.len() + 1);
            let end = (at + length).min(letters.len());
            letters.splice(at..end, splinter.chars());
        }
        letters.into_iter().collect()
    })
}

/// Numbers of all sizes, most of them such as a page has.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![4 => 0.0..3.0, 1 => -1.0..1e6, 1 => any::<f64>()]
}

fn spelt() -> impl Strategy<Value = String> {
    let spell = |(number, style): (f64, u8)| match style {
        0 => format!("{number:e}"),
        1 => format!("{number:.4}"),
        2 => format!("{number:.5E}"),
        _ => number.to_string(),
    };
    (number(), 0..4_u8).prop_map(spell)
}

fn item() -> impl Strategy<Value = String> {
    let row = |columns| prop::collection::vec(spelt(), columns);
    let table = |kind: &'static str, columns| {
        prop::collection::vec(row(columns), 1..6).prop_map(move |rows| {
            let rows: String = rows
                .iter()
                .map(|row| format!("        {}\n", row.join(" ")))
                .collect();
            format!("  - type: tabulated {kind}\n    data: |\n{rows}")
        })
    };
    let formula = (
        1..10_u8,
        spelt(),
        spelt(),
        prop::collection::vec(spelt(), 1..12),
    );
    let formula = formula.prop_map(|(number, from, to, coefficients)| {
        let coefficients = coefficients.join(" ");
        format!("  - type: formula {number}\n    wavelength_range: {from} {to}\n    coefficients: {coefficients}\n")
    });
    prop_oneof![table("nk", 3), table("n", 2), table("k", 2), formula]
}

proptest! {
    #![proptest_config(config(2_000))]

    #[test]
    fn any_text_is_read_or_refused(bytes: Vec<u8>, file: String) {
        read(&file, &String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_broken_page_is_read_or_refused(text in broken(PAGE)) {
        read("main/Au/nk/Mine.yml", &text);
    }

    #[test]
    fn a_broken_table_is_read_or_refused(text in broken(TABLES), file: String) {
        read(&file, &text);
    }

    #[test]
    fn a_page_of_any_numbers_is_read_or_refused(items in prop::collection::vec(item(), 1..4), references: String) {
        let references = references.replace(['\n', '\r'], " ");
        let text = format!("REFERENCES: |\n    {references}\nDATA:\n{}", items.concat());
        read("specs/maker/glass/Mine.yml", &text);
    }
}

/// The tests above are of use only if their pages are often good.
#[test]
fn the_unbroken_texts_are_good() {
    let page = Page::parse("main/Au/nk/Mine.yml", PAGE).expect("it is good");
    assert_eq!(page.remarks.len(), 4, "{:?}", page.remarks);
    check(page);
    check(Page::parse_csv("mine.csv", TABLES).expect("it is good"));
}
