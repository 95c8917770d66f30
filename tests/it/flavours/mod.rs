//! Flavours: what a run writes and leaves alone, and each adapter in its host, or compiled where no host runs (`compiled`).

#[cfg(unix)]
mod bevy;
mod compiled;
#[cfg(unix)]
mod engines;
#[cfg(unix)]
mod godot;
#[cfg(unix)]
mod host;
mod materialx;
#[cfg(unix)]
mod npm;
#[cfg(unix)]
mod three;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::cli::{MY_METAL, OUT, Place};
use fresnel_gen::generator::emit::{self, CatalogueRow, Naming};
use fresnel_gen::generator::flavours::{self, Flavour};
use fresnel_gen::generator::lut::{Depth, LEAST_ROUGHNESS, SplitSum, SplitSumAxis, SplitSumDesign};
use fresnel_gen::generator::reference::{Derivation, MaterialInMedium};
use fresnel_gen::language::ir::Weights;
use fresnel_gen::language::{methods, targets};
use fresnel_gen::physics::materials::{
    self, AtWavelength, ConstantIndex, Extrapolate, ViewingConditions,
};
use fresnel_gen::physics::optics::{self, Ggx};

/// Materials under films: of metal and of dielectric bases.
pub const FILMS: [&str; 2] = ["anodised_titanium_purple", "oil_on_water"];

/// A material in air under the default viewing conditions.
pub fn subject(name: &str) -> MaterialInMedium {
    let material = materials::find(name).unwrap().unwrap();
    let viewing = ViewingConditions::default();
    let named = (name.to_owned(), material);
    MaterialInMedium::new(named, None, &viewing, Derivation::default()).unwrap()
}

/// Materials as adapters have them, in this order.
pub fn rows(names: &[&str]) -> Vec<CatalogueRow> {
    let row = |name: &&str| {
        let rows = emit::adapter_rows(&[subject(name)], &Naming::default());
        rows.unwrap().remove(0)
    };
    names.iter().map(row).collect()
}

/// The methods of these materials in adapters, and their coefficients one after the other.
pub fn coefficients(names: &[&str]) -> Vec<(&'static str, Vec<f32>)> {
    let flat = |row: CatalogueRow| {
        let all = row.coefficients.iter().flatten();
        (row.method.name, all.map(|value| *value as f32).collect())
    };
    rows(names).into_iter().map(flat).collect()
}

/// The first block of a language in a README.
pub fn block(readme: &str, language: &str) -> String {
    let start = format!("```{language}\n");
    let part = readme
        .split(&start)
        .nth(1)
        .expect("the README has the block");
    part.split("```").next().unwrap().to_owned()
}

/// The files of a flavour as a run writes them, by path.
pub fn written(place: &Place, flags: &str) -> BTreeSet<String> {
    place.done(flags);
    place.listed().into_iter().collect()
}

/// The files that a flavour has for these materials.
fn expected(flavour: &Flavour, materials: &[&str]) -> BTreeSet<String> {
    let own = flavour.pages.iter().filter(|page| page.is_of_material());
    let own = own.flat_map(|page| materials.iter().map(|name| page.file_of(name)));
    let shared = flavour.shared_pages().map(|(name, _, _)| name);
    shared
        .chain(own)
        .map(|name| format!("{}/{name}", flavour.name))
        .collect()
}

#[test]
fn each_flavour_is_tried_and_named() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/flavours");
    let files = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let tests = files.filter(|file| file.is_file() && !file.ends_with("mod.rs"));
    let tests: String = tests
        .filter_map(|file| fs::read_to_string(file).ok())
        .collect();
    let readme = include_str!("../../../README.md");
    for flavour in flavours::ALL {
        let name = flavour.name;
        let is_tried = [format!("\"{name}\""), format!("--flavour {name} ")];
        assert!(
            is_tried.iter().any(|use_of_it| tests.contains(use_of_it)),
            "{name} is not tried: add it to `WAYS` of compiled.rs, or write tests/it/flavours/{name}.rs"
        );
        let host = flavour.host.split(' ').next().unwrap();
        assert!(readme.contains(host), "README.md does not name {host}");
    }
}

#[test]
fn rows_name_targets_and_bring_a_readme() {
    for flavour in flavours::ALL {
        let name = flavour.name;
        assert!(targets::find(name).is_none(), "{name} is a target");
        for language in flavour.languages {
            assert!(targets::find(language).is_some(), "{name}: {language}");
        }
        assert!(flavour.source.starts_with("https://"), "{name}");
        assert!(flavour.has("README.md", None), "{name} has no README.md");
    }
}

#[test]
fn a_run_writes_the_folder_of_its_flavour_and_nothing_else() {
    for flavour in flavours::ALL {
        let place = Place::new();
        let name = flavour.name;
        let flags = format!("--flavour {name} --material gold,water");
        let files = written(&place, &flags);
        assert_eq!(files, expected(flavour, &["gold", "water"]));
        for file in &files {
            let text = place.read(&format!("{OUT}/{file}"));
            let first = text.lines().next().unwrap_or_default();
            let is_marked = match file.ends_with(".json") {
                true => text.starts_with("{\n  \"tool\": \"fresnel-gen\""),
                false => first.contains("@generated by fresnel-gen"),
            };
            assert!(is_marked, "{file}: {first}");
            assert!(text.ends_with('\n') && !text.contains('\r'), "{file}");
            assert!(
                !text.contains("{{") && !text.contains("{%"),
                "{file} holds its template"
            );
        }
        let again = place.done(&flags).err;
        assert!(again.contains(" 0 written"), "{again}");
        assert_eq!(place.done(&format!("{flags} --check")).out, "", "{name}");
        let readme = place.read(&format!("{OUT}/{name}/README.md"));
        assert!(
            readme.contains(&format!("fresnel-gen --flavour {name}")),
            "{readme}"
        );
    }
}

#[test]
fn a_run_without_flavours_writes_none_and_keeps_those_that_are_there() {
    let place = Place::new();
    place.done("--target wgsl");
    assert!(place.listed().iter().all(|file| file.starts_with("wgsl/")));
    let names: Vec<&str> = flavours::ALL.iter().map(|flavour| flavour.name).collect();
    place.done(&format!("--flavour {}", names.join(",")));
    let before = place.listed();
    place.done("--target wgsl");
    place.done("--material silver --target gles");
    let after = place.listed();
    assert!(before.iter().all(|file| after.contains(file)), "{after:?}");
    // A run of everything owns the targets, and not the flavours.
    place.done("generate");
    let after = place.listed();
    assert!(before.iter().all(|file| after.contains(file)), "{after:?}");
}

#[test]
fn later_runs_add_files_of_materials_and_agree_on_the_others() {
    for flavour in flavours::ALL
        .iter()
        .filter(|flavour| flavour.is_by_material())
    {
        let name = flavour.name;
        let (one, both) = (Place::new(), Place::new());
        one.done(&format!("--flavour {name} --material gold"));
        one.done(&format!("--flavour {name} --material water"));
        both.done(&format!("--flavour {name} --material water,gold"));
        assert_eq!(one.listed(), both.listed());
        for file in one.listed() {
            let [a, b] = [&one, &both].map(|place| place.read(&format!("{OUT}/{file}")));
            assert_eq!(a, b, "{file}");
        }
        one.done(&format!("--flavour {name} --material gold --check"));
    }
}

#[test]
fn a_target_beside_it_is_written_too_and_a_foreign_one_is_refused() {
    for flavour in flavours::ALL {
        let (name, own) = (
            flavour.name,
            flavour.languages.first().copied().unwrap_or_default(),
        );
        let place = Place::new();
        let line = format!("--flavour {name} --target {own} --material gold");
        let files = if own.is_empty() {
            continue;
        } else {
            written(&place, &line)
        };
        let folders: BTreeSet<&str> = files
            .iter()
            .filter_map(|file| file.split('/').next())
            .collect();
        assert_eq!(folders, BTreeSet::from([name, own]));
        let foreign = targets::ALL
            .iter()
            .find(|target| !flavour.languages.contains(&target.name));
        let foreign = foreign.expect("no flavour holds all languages").name;
        let line = format!("--flavour {name} --target {foreign}");
        Place::new().refused(&line, &[name, own, foreign, "leave --target out"]);
    }
}

#[test]
fn what_an_adapter_cannot_follow_is_refused() {
    let flavour = flavours::ALL[0].name;
    let refused = |flags: &str, says: &[&str]| {
        Place::new().refused(&format!("--flavour {flavour} {flags}"), says);
    };
    refused("--method schlick", &["leave --method"]);
    refused("--effect interior", &["run --effect alone"]);
    refused("--precision f16", &["leave --precision f16 out"]);
    refused("--prefix my_", &["leave --prefix out"]);
    refused("--material none", &["none"]);
    refused("--material air", &["air", "leave it out"]);
    refused("--budget 0.01", &["--budget"]);
    refused("-o gold.glsl", &["-o"]);
    Place::new().refused("--flavour threee", &["threee", "three"]);
}

#[test]
fn all_materials_bring_those_that_a_form_follows() {
    let by_material = flavours::ALL
        .iter()
        .find(|flavour| flavour.is_by_material());
    let flavour = by_material.expect("some are").name;
    let place = Place::new();
    let ran = place.done(&format!("--flavour {flavour} --material all"));
    assert!(ran.err.contains("left out: material `air`"), "{}", ran.err);
    let json: Value =
        serde_json::from_str(include_str!("../../../shaders-generated/catalogue.json")).unwrap();
    let rows = json["materials"].as_array().unwrap().len();
    let files = place.listed();
    let of_materials = files.iter().filter(|file| !file.ends_with("README.md"));
    assert!(of_materials.count() >= rows, "{} of {rows}", files.len());
}

#[test]
fn a_users_material_and_a_medium_are_written_as_others_are() {
    for flavour in flavours::ALL {
        let place = Place::new();
        let name = flavour.name;
        place.put("my_metal.toml", MY_METAL);
        place.done(&format!(
            "--flavour {name} --material my_metal.toml,diamond --medium water"
        ));
        let texts: String = place
            .listed()
            .iter()
            .map(|file| place.read(&format!("{OUT}/{file}")))
            .collect();
        for material in ["my_metal_in_water", "diamond_in_water"] {
            assert!(texts.contains(material), "{name} lacks {material}");
        }
    }
}

#[test]
fn a_material_does_not_take_the_place_of_a_file_for_all() {
    let place = Place::new();
    place.put("mine.toml", MY_METAL.replace("\"my_metal\"", "\"fresnel\""));
    place.refused(
        "--flavour unity --material mine.toml",
        &["material `fresnel`", "unity", "another name"],
    );
    place.done("--flavour three --material mine.toml");
}

#[test]
fn a_file_of_somebody_else_stays() {
    for flavour in flavours::ALL {
        let place = Place::new();
        let file = expected(flavour, &["gold"]).into_iter().next().unwrap();
        place.put(&format!("{OUT}/{file}"), "mine\n");
        let line = format!("--flavour {} --material gold", flavour.name);
        place.refused(&line, &["fresnel-gen did not write", "--overwrite"]);
        place.done(&format!("{line} --overwrite"));
    }
}

/// A command that a script or JSON could not hold as it is stands in none of them: without some letters it would do something else.
#[test]
fn a_command_is_whole_or_not_shown() {
    let place = Place::new();
    let name = "a';touch PWNED;'.toml";
    place.put(name, MY_METAL);
    place.put("Gl\u{e4}ser.toml", MY_METAL);
    for file in [name, "Gl\u{e4}ser.toml"] {
        let line = ["--flavour", "npm,three,materialx", "--material", file];
        place.run_with(&line).ends(0);
        let readme = place.read(&format!("{OUT}/three/README.md"));
        let commands = block(&readme, "sh");
        assert!(
            commands.starts_with("fresnel-gen --flavour three # "),
            "{commands}"
        );
        assert!(
            !commands.contains("touch") && !commands.contains("ser.toml"),
            "{commands}"
        );
        let package = place.read(&format!("{OUT}/npm/package.json"));
        let package: Value = serde_json::from_str(&package).unwrap();
        assert!(
            !package["command"].as_str().unwrap().contains("touch"),
            "{package}"
        );
        place.run_with(&["clean"]).ends(0);
    }
}

/// Whether there is diffuse light is a matter of the material, and not of the function that follows it best.
#[test]
fn a_dielectric_is_never_opaque() {
    let place = Place::new();
    place.done("--flavour three --material zinc_sulfide,gold,silicon,water,oil_on_water,anodised_titanium_purple");
    let module = place.read(&format!("{OUT}/three/materials.js"));
    for (name, is_opaque) in [
        ("zinc_sulfide", false),
        ("gold", true),
        ("silicon", true),
        ("water", false),
        ("oil_on_water", false),
        ("anodised_titanium_purple", true),
    ] {
        let own = module
            .split(&format!("export const {name} = {{"))
            .nth(1)
            .unwrap();
        let own = own.split("isOpaque: ").nth(1).unwrap();
        assert!(own.starts_with(&is_opaque.to_string()), "{name}");
    }
}

/// What a material under a clear coat of index 1.5 reflects, at a cosine outside: at each wavelength and for s and p the series of all
/// reflections between both interfaces.
pub fn two_interfaces(name: &str, cos: f64) -> [f64; 3] {
    let material = materials::find(name).unwrap().unwrap();
    let coat = ConstantIndex::parse("1.5").unwrap().unwrap().material();
    let surface = &subject(name).reference.surface;
    let outer = optics::dielectric(1.5, cos);
    let inside = (1.0 - (1.0 - cos * cos) / 2.25).sqrt();
    let at = |nm: &f64| {
        let below = AtWavelength::new(&material, Some(&coat), *nm, Extrapolate::Refuse).unwrap();
        let below = below.reflectance(inside);
        let both = |c: f64, b: f64| {
            // A ray that is reflected i times by the metal has left through the coat, or will.
            let leaving = (0..200).map(|i| (1.0 - c).powi(2) * b * (c * b).powi(i));
            c + leaving.sum::<f64>()
        };
        0.5 * (both(outer.s, below.s) + both(outer.p, below.p))
    };
    let spectrum: Vec<f64> = surface.integrator.wavelengths.iter().map(at).collect();
    surface
        .gamut
        .apply(surface.integrator.colour(&spectrum))
        .to_array()
}

/// A coat and what it lets through are both interfaces together, and coefficients of the base follow that.
#[test]
fn a_base_below_a_coat_makes_both_interfaces() {
    for name in [
        "gold",
        "copper",
        "platinum",
        "silicon",
        "anodised_titanium_purple",
    ] {
        let surface = &subject(name).reference.surface;
        for cos in [0.02, 0.1, 0.3, 0.6, 1.0] {
            let coat = optics::dielectric(1.5, cos).unpolarised();
            let base = surface.through_coat(1.5, cos).to_array();
            let all = two_interfaces(name, cos);
            for channel in 0..3 {
                let both = (coat + (1.0 - coat) * base[channel]).clamp(0.0, 1.0);
                assert!(
                    (both - all[channel]).abs() < 1e-9,
                    "{name} {cos}: {both} {all:?}"
                );
            }
        }
        assert_eq!(surface.through_coat(1.5, 0.0).to_array(), [0.0; 3]);
    }
    let all = rows(&[
        "gold",
        "copper",
        "platinum",
        "silicon",
        "anodised_titanium_purple",
    ]);
    for row in all {
        let coated = row.coated.unwrap();
        println!("{}: {} at {}", row.name, coated.max_abs, coated.worst_cos);
        assert!(coated.max_abs < 0.0125, "{}: {}", row.name, coated.max_abs);
    }
    assert!(rows(&["water"])[0].coated.is_none());
}

#[test]
fn no_material_has_the_name_of_a_base_of_a_coat() {
    let place = Place::new();
    let named = MY_METAL.replace("\"my_metal\"", "\"gold_under_coat\"");
    place.put("mine.toml", named);
    place.refused(
        "--flavour unity --material gold,mine.toml",
        &["gold_under_coat", "give the material another name"],
    );
}

/// Coefficients of adapters beside the law of layers over the spectrum, and beside the four that they would otherwise have.
#[test]
fn films_are_followed_better_than_by_four_coefficients() {
    let fitted = methods::find("fitted").unwrap();
    for (name, row) in FILMS.iter().zip(rows(&FILMS)) {
        assert_eq!(row.method.name, "fitted_film");
        let four = emit::fitted_error(&subject(name), fitted).unwrap().max_abs;
        let own = row.error.max_abs;
        assert!(own < 0.0012 && four > 0.011, "{name}: {own}, {four}");
    }
}

/// The two tables of films between their texels, beside the integral in f64. Those of four terms err by less than .0014.
#[test]
fn the_tables_of_films_err_as_others_do() {
    let basis = methods::find("fitted_film").unwrap().basis().unwrap();
    let (rule, names) = (Ggx::default(), materials::stacks());
    let axes = [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt];
    for (size, within) in [(80, 0.0014)] {
        let design = SplitSumDesign::square(basis, size, axes);
        let numbers = rows(&names).into_iter();
        let numbers = numbers.map(|row| design.numbers(&row.coefficients));
        let numbers: Vec<Vec<[f64; 3]>> = numbers.collect();
        let stored = SplitSum::new(&design, &mut |_, _| {}).unwrap();
        let stored = stored.stored(Depth::Half);
        let mut worst = vec![0.0; names.len()];
        for j in 0..size - 1 {
            for i in 0..size - 1 {
                let (cos_v, roughness) = design.at(i as f64 + 0.5, j as f64 + 0.5);
                if roughness < LEAST_ROUGHNESS {
                    continue;
                }
                let exact = design.channels_at(&rule, cos_v, roughness);
                let read = stored.lookup(Weights::Steps256, cos_v, roughness);
                for (worst, numbers) in worst.iter_mut().zip(&numbers) {
                    for channel in 0..3 {
                        let terms = numbers.iter().zip(read.iter().zip(&exact));
                        let off: f64 = terms.map(|(n, (a, b))| n[channel] * (a - b)).sum();
                        *worst = f64::max(*worst, off.abs());
                    }
                }
            }
        }
        for (name, off) in names.iter().zip(worst) {
            assert!(off < within, "{name}, {size} texels: {off}");
        }
    }
}

/// The numbers of a table's text in its steps, channel by channel: each is left + above - above left + its letter's.
fn numbers_of_text(text: &str, side: usize) -> Vec<Vec<i32>> {
    let text = text.replace("\\\"", "\"").replace("\\\\", "\\");
    let letters: Vec<char> = text.chars().collect();
    let plane = |letters: &[char]| {
        let mut all: Vec<i32> = Vec::new();
        for (i, letter) in letters.iter().enumerate() {
            let (x, code) = (i % side, *letter as i32);
            let left = if x > 0 { all[i - 1] } else { 0 };
            let above = if i >= side { all[i - side] } else { 0 };
            let corner = if x > 0 && i >= side {
                all[i - side - 1]
            } else {
                0
            };
            all.push(left + above - corner + code - if code < 128 { 76 } else { 0x5000 });
        }
        all
    };
    letters.chunks(side * side).map(plane).collect()
}

/// The first channel is the albedo of a surface that reflects everything: a mirror loses nothing, and no surface gives more than it gets.
#[test]
fn tables_of_a_module_hold_what_surfaces_reflect() {
    let place = Place::new();
    place.done("--flavour three --material gold");
    let without = place.read(&format!("{OUT}/three/materials.js"));
    assert!(
        !without.contains("fitted_film"),
        "gold needs nothing of films"
    );
    place.done("--flavour three --material gold,oil_on_water");
    let module = place.read(&format!("{OUT}/three/materials.js"));
    let side = 80;
    let texts = module.split("table: \"").skip(1);
    let texts = texts.map(|part| part.split("\",\n").next().unwrap());
    let tables: Vec<Vec<Vec<i32>>> = texts.map(|text| numbers_of_text(text, side)).collect();
    assert_eq!(tables.len(), 3);
    let axes = [SplitSumAxis::FourthRoot, SplitSumAxis::Sqrt];
    let names = [
        ("fitted", 2048),
        ("fitted_dielectric", 2048),
        ("fitted_film", 4096),
    ];
    for (planes, (name, one)) in tables.iter().zip(names) {
        let basis = methods::find(name).unwrap().basis().unwrap();
        let design = SplitSumDesign::square(basis, side, axes);
        assert_eq!(planes.len(), design.channels(), "{name}");
        assert!(planes.iter().all(|plane| plane.len() == side * side));
        let white = &planes[0];
        assert!(white.iter().all(|albedo| *albedo > 0 && *albedo <= one));
        assert!(
            white[..side].iter().all(|albedo| *albedo == one),
            "the first row is of a mirror"
        );
        assert!(
            white[side * (side - 1)..]
                .iter()
                .any(|albedo| *albedo < one * 9 / 10),
            "the last row loses light"
        );
        // Beside the integral: half precision errs by 1/4096 from .5 on, and a rounding to steps by no more.
        let rule = Ggx::default();
        for (j, i) in (0..side)
            .step_by(13)
            .flat_map(|j| (0..side).step_by(7).map(move |i| (j, i)))
        {
            let (cos_v, roughness) = design.at(i as f64, j as f64);
            let exact = design.channels_at(&rule, cos_v, roughness);
            for (plane, exact) in planes.iter().zip(exact) {
                let off = (f64::from(plane[j * side + i]) / f64::from(one) - exact).abs();
                assert!(off <= 1.0 / 4096.0, "{name} {cos_v} {roughness}: {off}");
            }
        }
    }
}
