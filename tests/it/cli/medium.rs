//! `--medium` as a number: one medium for all spellings of it, its names, and what is refused.

use super::OUT;
use super::Place;
use fresnel_gen::physics::materials::{
    self, ConstantIndex, Extrapolate, Surface, ViewingConditions,
};

#[test]
fn one_number_is_one_medium() {
    let texts = ["1.5", "1.50", "1.500", "15e-1"].map(|number| {
        let place = Place::new();
        place.done(&format!(
            "--target wgsl --material gold --method schlick --medium {number}"
        ));
        let inputs = place.manifest()["inputs"].to_string();
        (
            place.read(&format!("{OUT}/wgsl/materials/gold_in_index_1_5.wgsl")),
            inputs,
        )
    });
    assert!(texts[0].0.contains("--medium 1.5\n"), "{}", texts[0].0);
    assert!(texts[0].1.contains("gold_in_index_1_5"), "{}", texts[0].1);
    assert!(texts.iter().all(|text| *text == texts[0]));
    let place = Place::new();
    place.done("--target wgsl --material gold --method schlick --medium 1.05");
    let other = place.read(&format!("{OUT}/wgsl/materials/gold_in_index_1_05.wgsl"));
    assert_ne!(other, texts[0].0);
}

/// The command in a head writes the same file.
#[test]
fn the_command_in_a_head_reproduces() {
    let place = Place::new();
    place.done("--material gold --method schlick --medium 1.500 -o gold.glsl --target gles");
    let text = place.read("gold.glsl");
    let command = text
        .lines()
        .find_map(|line| line.split_once("fresnel-gen: fresnel-gen "));
    let command = command.or_else(|| {
        text.lines()
            .find_map(|line| line.split_once(": fresnel-gen "))
    });
    let (_, flags) = command.unwrap_or_else(|| panic!("no command in {text}"));
    assert!(flags.contains("--medium 1.5"), "{flags}");
    let flags: Vec<&str> = flags.split_whitespace().collect();
    let words = flags
        .iter()
        .position(|flag| *flag == "-o")
        .map_or(flags.len(), |at| at);
    let again = place
        .run_with(&[&flags[..words], &["-o", "-"]].concat())
        .ends(0);
    assert_eq!(again.out, text);
}

#[test]
fn a_medium_of_index_1_is_air() {
    let gold = materials::find("gold")
        .expect("it is there")
        .expect("it is whole");
    let vacuum = ConstantIndex::parse("1.0")
        .expect("a number")
        .expect("within limits");
    let surface =
        |medium| Surface::new(&gold, medium, &ViewingConditions::default()).expect("a spectrum");
    assert_eq!(surface(None), surface(Some(&vacuum.material())));
    let place = Place::new();
    let params = |line: &str| {
        let mut params = place
            .done(&format!("materials params gold --json - {line}"))
            .json();
        let medium = params["medium"].take();
        (medium, params)
    };
    let (air, in_air) = params("");
    let (number, in_number) = params("--medium 1.0");
    assert_eq!(
        (air.as_str(), number.as_str()),
        (Some("air"), Some("index_1"))
    );
    assert_eq!(in_air, in_number);
    let (_, denser) = params("--medium 1.5");
    assert_ne!(in_air["f0"], denser["f0"]);
}

#[test]
fn water_vanishes_in_a_number_equal_to_its_index() {
    let water = materials::find("water")
        .expect("it is there")
        .expect("it is whole");
    let at = |nm: f64| water.index(nm, Extrapolate::Refuse).expect("measured").n;
    let place = Place::new();
    let f0 = |medium: f64| {
        let line =
            format!("materials params water --wavelengths 550,550,550 --medium {medium} --json -");
        place.done(&line).json()["f0"][0]
            .as_f64()
            .expect("a number")
    };
    assert!(f0(at(550.0)) < 1e-12, "{}", f0(at(550.0)));
    assert!(f0(at(550.0) + 0.05) > 1e-4);
}

#[test]
fn other_commands_take_it_too() {
    let place = Place::new();
    let fits = place
        .done("fit --material gold --medium 1.5 --terms 4 --json -")
        .json();
    assert!(
        fits["command"]
            .as_str()
            .is_some_and(|line| line.contains("--medium 1.5")),
        "{fits}"
    );
    place.done("materials show gold --medium 1.5 --svg gold.svg");
    let sheet = place.done("materials params gold --medium 1.5 --as openpbr");
    assert!(sheet.out.contains("--medium 1.5"), "{}", sheet.out);
    place.done("bake --material gold --medium 1.5 --size 8 --out-dir baked");
    place.done("verify --target wgsl --material gold --method schlick --medium 1.5 --points 100");
}

#[test]
fn other_numbers_are_refused() {
    let place = Place::new();
    for number in ["0.5", "10.5", "0", "-1.5", "inf", "nan"] {
        let says = ["--medium", "a number from 1 to 10 is allowed"];
        place.refused(
            &format!("--target wgsl --material gold --medium {number}"),
            &says,
        );
    }
    let says = [
        "there is no material `1,5`",
        "a medium can be a refractive index from 1 to 10 too",
    ];
    place.refused("--target wgsl --material gold --medium 1,5", &says);
    place.refused(
        "--target wgsl --medium watr",
        &["did you mean water", "from 1 to 10"],
    );
    place.refused("--target wgsl --material 1.5", &["1.5"]);
}

#[test]
fn colours_under_a_coat() {
    let place = Place::new();
    let line = "materials coat --f0 0.9,.71,1 --f82 .88,.1,.98 --index";
    let row = place.done(&format!("{line} 1.50 --json -")).json()["rows"][0].clone();
    assert_eq!(row["exact"].to_string(), "[true,false,false]", "{row}");
    assert_eq!(row["f0_in_coat"][2], 1.0, "a mirror stays one");
    let f0 = row["f0_in_coat"][0].as_f64().expect("a number");
    assert!(f0 < 0.9 && f0 > 0.8, "{row}");
    let text = place.done(&format!("{line} 1.5")).out;
    assert!(
        text.contains("No index gives F0 and F82 of green and blue"),
        "{text}"
    );
    let air = place.done(&format!("{line} 1 --json -")).json()["rows"][0].clone();
    let same =
        (0..3).map(|i| air["f0_in_coat"][i].as_f64().unwrap() - air["f0"][i].as_f64().unwrap());
    assert!(
        same.fold(0.0_f64, |most, off| most.max(off.abs())) < 1e-12,
        "{air}"
    );
    for index in ["0.9", "11", "water"] {
        let line = format!("materials coat --f0 1,1,1 --f82 1,1,1 --index {index}");
        place.refused(&line, &["a coat's index is a number from 1 to 10"]);
    }
    place.refused(
        "materials coat --f0 1,1 --f82 1,1,1",
        &["three reflectances from 0 to 1"],
    );
    place.refused("materials coat --f0 1,1,1", &["--f82"]);
}
