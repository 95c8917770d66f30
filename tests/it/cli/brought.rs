//! Materials that a user brings: pages of refractiveindex.info and tables, read, imported, surveyed, drawn.

use super::OUT;
use super::Place;

/// Gold by Johnson and Christy, at a few wavelengths.
const PAGE: &str = "# a page
REFERENCES: |
    P. B. Johnson and R. W. Christy.
    <a href=\"https://doi.org/10.1103/PhysRevB.6.4370\"><i>Phys. Rev. B</i> <b>6</b>, 4370-4379 (1972)</a>
COMMENTS: |
    Room temperature
DATA:
  - type: tabulated nk
    data: |
        0.3542 1.50 1.866
        0.4509 1.38 1.914
        0.5821 0.29 2.863
        0.7045 0.13 4.103
        0.8920 0.17 5.663
";

#[test]
fn a_page_is_a_material() {
    let place = Place::new();
    place.put("main/Au/nk/Johnson.yml", PAGE);
    place.done("--material main/Au/nk/Johnson.yml --target gles");
    let text = place.read(&format!("{OUT}/gles/materials/au_johnson.glsl"));
    assert!(
        text.contains("fresnel_au_johnson(") && text.contains("--material main/Au/nk/Johnson.yml"),
        "{text}"
    );
    assert!(
        text.contains("https://doi.org/10.1103/PhysRevB.6.4370"),
        "{text}"
    );
    place.put(
        "gold.csv",
        "wl,n\n0.38,1.6\n0.79,0.15\n\nwl,k\n0.38,1.9\n0.79,4.8\n",
    );
    let json = place.done("materials params gold.csv --json -").json();
    assert_eq!(json["class"], "metal");
}

/// Every command that reads a table says which unit it took, where the header names none.
#[test]
fn a_unit_that_was_told_by_size_is_said() {
    let place = Place::new();
    let um = "\u{feff}sep=;\r\nWavelength;Refractive index n;Extinction coefficient k\r\n0,38;1,6;1,9\r\n0,79;0,15;4,8\r\n";
    place.put("gold.csv", um);
    place.put("nm.csv", "wl\tn\tk\n380\t1.6\t1.9\n790\t0.15\t4.8\n");
    let said = "the header names no unit: wavelengths from 0.38 to 0.79 are taken as micrometres";
    for line in [
        "materials params gold.csv",
        "materials reflectance gold.csv --angles 0",
        "materials compare gold.csv silver",
        "--material gold.csv --target gles",
        "bake --material gold.csv --size 8",
        "materials import gold.csv -o gold.toml",
    ] {
        let ran = place.done(line);
        assert!(ran.err.contains(said), "{ran:?}");
    }
    let shown = place.done("materials show gold.csv");
    assert!(
        shown.out.contains(said) && shown.err.is_empty(),
        "{shown:?}"
    );
    let ran = place.done("materials params nm.csv");
    let nm =
        "nm.csv: the header names no unit: wavelengths from 380 to 790 are taken as nanometres";
    assert!(ran.err.contains(nm), "{ran:?}");
    let [one, other] = ["gold.csv", "nm.csv"].map(|file| {
        let json = place
            .done(&format!("materials params {file} --json -"))
            .json();
        json["f0"].clone()
    });
    assert_eq!(one, other);
    place.put("both.csv", "wavelength,n\n0.5,1.5\n500,1.5\n");
    place.refused(
        "materials params both.csv",
        &[
            "both.csv:1:1: the header names no unit",
            "name the column wavelength_nm or wavelength_um",
        ],
    );
}

#[test]
fn an_imported_page_is_a_material_file() {
    let place = Place::new();
    place.put("Johnson.yml", PAGE);
    let ran =
        place.done("materials import Johnson.yml --name my_gold --class metal -o my_gold.toml");
    assert_eq!(ran.out, "");
    let toml = place.read("my_gold.toml");
    assert!(
        toml.contains("licence = \"CC0-1.0\"") && toml.contains("[450.9, 1.38, 1.914]"),
        "{toml}"
    );
    assert_eq!(
        place
            .done("materials import Johnson.yml --name my_gold --class metal")
            .out,
        toml
    );
    place.done("--material my_gold.toml --target gles --list");
    let [page, file] = ["Johnson.yml", "my_gold.toml"].map(|name| {
        let json = place
            .done(&format!("materials params {name} --json -"))
            .json();
        json["f0"].clone()
    });
    assert_eq!(page, file);
    place.refused(
        "materials import my_gold.toml",
        &["ends in none of .yml, .csv, .tsv, .txt"],
    );
    place.refused(
        "materials import Johnson.yml --name Gold",
        &["--name: `Gold` is no name: capital letters"],
    );
    place.refused(
        "materials import Johnson.yml --name fitted",
        &["name of the method `fitted`", "--name"],
    );
    place.refused(
        "materials import Johnson.yml --class metall",
        &["did you mean metal"],
    );
}

/// What is spoiled in a good page, and what the program says: file, line, what is wrong.
#[rustfmt::skip]
const FAULTS: &[(&str, &str, &str)] = &[
    ("0.29", "0.29-17", "p.yml:12:"),
    ("0.29", "nan", "p.yml:12:"),
    ("2.863", "-2.863", "p.yml:12:"),
    (" 2.863", "", "p.yml:12:"),
    ("0.29", "0.2\09", "p.yml:12:"),
    ("0.5821", "-0.5821", "p.yml:12:"),
    ("tabulated nk", "tabulated n2", "p.yml:8:"),
    ("tabulated nk", "tabulated kn", "p.yml:8:"),
    ("DATA:", "DATE:", "p.yml:"),
];

#[test]
fn a_bad_page_leaves_nothing_behind() {
    let place = Place::new();
    for (from, to, says) in FAULTS {
        assert!(PAGE.contains(from), "{from}");
        place.put("p.yml", PAGE.replacen(from, to, 1));
        place.refused("materials import p.yml -o out.toml", &[says]);
        place.refused("--material p.yml", &[says]);
        place.refused("materials params p.yml", &[says]);
    }
    // Cut anywhere, it is read for what it is or refused, and never half.
    for end in (0..PAGE.len()).step_by(7) {
        place.put("p.yml", &PAGE[..end]);
        let ran = place.run("materials import p.yml");
        assert!(matches!(ran.code, Some(0 | 2)), "{end}: {ran:?}");
    }
    assert!(!place.path("out.toml").exists());
}

#[test]
fn rows_in_disorder_are_mended_and_said() {
    let place = Place::new();
    let swapped = PAGE
        .replace("0.4509", "0.6")
        .replace("0.7045 0.13", "0.5821 0.31")
        .replace("1.866", "-0.01");
    place.put("p.yml", swapped);
    let ran = place.done("materials import p.yml --name m");
    for says in ["not in order", "their mean was taken", "k was below 0"] {
        assert!(
            ran.err.contains(says) && ran.out.contains(says),
            "{says}: {}",
            ran.err
        );
    }
}

#[test]
fn rows_that_cannot_be_are_named() {
    let place = Place::new();
    place.put("page.csv", "um,n,k\n.3,1,2\n.4,-1,2\n.5,.5,2\n.8,.3,4.5\n");
    let shown = place.done("materials show page.csv --json -");
    let text = place.done("materials show page.csv").out;
    let why = "n is -1 at 400 nm; it must lie between 0.001 and 10000";
    assert!(
        text.contains(&format!("left out: material `page`: {why}")),
        "{text}"
    );
    assert!(shown.json()["left_out"][0].as_str().unwrap().ends_with(why));
    assert_eq!(shown.json()["data"].as_array().unwrap().len(), 3);
}

#[test]
fn a_survey_tells_of_every_page() {
    let place = Place::new();
    place.put("db/main/Au/nk/Johnson.yml", PAGE);
    place.put("db/main/Au/about.yml", "ABOUT: gold\n");
    place.put(
        "db/main/Au/n2/Someone.yml",
        PAGE.replace("tabulated nk", "tabulated n2"),
    );
    place.put(
        "db/main/X/nk/Short.yml",
        PAGE.replace("        0.8920 0.17 5.663\n", ""),
    );
    let ran = place.done("materials survey db --json -");
    let json = ran.json();
    let rows = json["rows"].as_array().unwrap();
    let found: Vec<(&str, &str)> = rows
        .iter()
        .map(|row| {
            (
                row["page"].as_str().unwrap(),
                row["status"].as_str().unwrap(),
            )
        })
        .collect();
    let want = [
        ("main/Au/n2/Someone.yml", "refused"),
        ("main/Au/nk/Johnson.yml", "seen"),
        ("main/X/nk/Short.yml", "elsewhere"),
    ];
    assert_eq!(found, want);
    assert!(rows[0]["reason"].as_str().unwrap().contains("n2"));
    let text = place.done("materials survey db").out;
    assert!(text.starts_with("3 pages: 1 seen over the whole visible spectrum at 91 angles, 1 known elsewhere, 1 refused"), "{text}");
    let held = place.done("materials survey db --extrapolate hold").out;
    assert!(held.contains("of these 1 are extrapolated"), "{held}");
    place.done("materials survey db/main/Au/nk/Johnson.yml");
    #[cfg(unix)]
    {
        // What cannot be read is refused by name.
        std::os::unix::fs::symlink("nowhere", place.path("db/main/Au/nk/Link.yml")).unwrap();
        let text = place.done("materials survey db").out;
        assert!(
            text.contains("main/Au/nk/Link.yml") && text.contains("cannot read it"),
            "{text}"
        );
    }
    place.refused("materials survey nowhere", &["cannot read nowhere"]);
    place.put("empty/about.yml", "");
    place.refused(
        "materials survey empty",
        &["there is no page (.yml) below empty"],
    );
}

#[test]
fn pictures_are_drawn_where_they_are_told() {
    let place = Place::new();
    let text = place.done("materials show gold").out;
    let both = place.done("materials show gold silver").out;
    let silver = place.done("materials show silver").out;
    assert_eq!(both, format!("{text}\n{silver}"));
    let json = place.done("materials show gold silver --json -").out;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let rows = json["rows"].as_array().unwrap();
    assert_eq!([&rows[0]["name"], &rows[1]["name"]], ["gold", "silver"]);
    place.refused(
        "materials show gold silver --png both.png",
        &["--png", "materials compare"],
    );
    place.refused("materials show gold silvr", &["silver"]);
    let drawn = place.done("materials show gold --svg a/gold.svg --png a/gold.png");
    assert_eq!(drawn.out, text);
    assert!(
        place
            .read("a/gold.svg")
            .contains("fresnel-gen materials show gold --svg gold.svg")
    );
    let png = std::fs::read(place.path("a/gold.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png.len() > 50_000);
    place.done("materials show gold --medium water --space acescg --svg b.svg");
    let svg = place.read("b.svg");
    assert!(
        svg.contains("--medium water") && svg.contains("--space acescg"),
        "{svg}"
    );
    place.refused(
        "materials show pmma --svg c.svg",
        &["n is known from 404.7 to 1083 nm"],
    );
    place.refused(
        "materials show gold --medium silver --svg c.svg",
        &["must be transparent"],
    );
    assert!(!place.path("c.svg").exists());
}
