//! Generation into a folder: what is written, what is not written again, what `--check` finds, what other runs keep.

use std::fs;

use super::MY_METAL;
use super::OUT;
use super::PROGRAM;
use super::Place;
use super::contents;
use fresnel_gen::generator::output::depfile::depfile;
use fresnel_gen::language::{effects, methods, targets};

#[test]
fn an_empty_folder_is_filled_and_a_second_run_writes_nothing() {
    for line in [
        "--target gles",
        "generate",
        "--target all,msl,glsl --material none",
    ] {
        let place = Place::new();
        let ran = place.done(line);
        let files = place.files();
        let summary = format!("{OUT}: {} written, 0 unchanged, 0 removed\n", files.len());
        assert_eq!(ran.out, "");
        let (first, more) = ran.err.split_once('\n').expect("a summary");
        assert_eq!(first.to_owned() + "\n", summary);
        // Of the first run only: one of its functions, and what to do with it.
        assert!(
            more.starts_with("for example ") && more.contains("(highp float cos_theta"),
            "{more}"
        );
        assert!(
            more.contains("next: use it; `fresnel-gen verify` with the same flags runs it"),
            "{more}"
        );
        let again = place.done(line);
        let summary = format!("{OUT}: 0 written, {} unchanged, 0 removed\n", files.len());
        assert_eq!(
            (again.out.as_str(), again.err.as_str()),
            ("", summary.as_str())
        );
        assert!(
            files == place.files(),
            "{line}: the second run touched files"
        );
        assert_eq!(place.done(&format!("{line} --check")).out, "");
    }
}

#[test]
fn the_tree_is_the_documented_one() {
    let place = Place::new();
    place.done("generate");
    let tables = ["atlas", "diamond", "gold", "platinum", "water"].into_iter();
    let files = tables.flat_map(|name| {
        ["exr", "json", "ktx2", "png"].map(|ending| format!("lut/{name}.{ending}"))
    });
    let mut expected: Vec<String> = files.collect();
    for target in targets::ALL.iter().filter(|target| target.by_default) {
        let methods = methods::ALL
            .iter()
            .map(|method| format!("fresnel_{}", method.name));
        let materials = ["diamond", "gold", "platinum", "water"];
        let materials = materials.map(|name| format!("materials/{name}"));
        for stem in methods.chain(materials) {
            let name = |page: &targets::Page| {
                format!("{}/{stem}{}.{}", target.name, page.suffix, target.extension)
            };
            expected.extend(target.pages.iter().map(name));
        }
        let last = target.pages.last().expect("a target has a page").suffix;
        let effect = |effect: &&'static effects::Effect| {
            let (target, ending) = (target.name, target.extension);
            format!("{target}/effects/{}{last}.{ending}", effect.name)
        };
        expected.extend(effects::ALL.iter().map(effect));
        let array = format!("{}/catalogue.{}", target.name, target.extension);
        expected.extend(target.catalogue.map(|_| array));
    }
    let shared = ["f16.ktx2", "f32.ktx2", "json", "std430.bin"];
    expected.extend(shared.map(|ending| format!("catalogue.{ending}")));
    expected.sort();
    assert_eq!(place.listed(), expected);
    assert_eq!(place.done("--list").out, expected.join("\n") + "\n");
    expected.push("manifest.json".to_string());
    expected.sort();
    let found: Vec<String> = contents(&place.path(OUT)).into_keys().collect();
    assert_eq!(found, expected);
}

#[test]
fn a_run_without_flags_owns_its_tables_and_leaves_others_to_bake() {
    let place = Place::new();
    place.done("bake --material silver --size 16 --format c,ktx2 --target wgsl");
    place.put(&format!("{OUT}/lut/notes.txt"), "mine");
    let mut baked = contents(&place.path(OUT));
    baked.remove("manifest.json");
    let ran = place.done("generate");
    assert!(
        ran.err.ends_with("written, 0 unchanged, 0 removed\n"),
        "{ran:?}"
    );
    assert_eq!(ran.err.lines().count(), 1, "{ran:?}");
    let now = contents(&place.path(OUT));
    assert!(
        baked
            .iter()
            .all(|(file, bytes)| now.get(file) == Some(bytes))
    );
    assert_eq!(place.done("--check").out, "");
    // What bake writes and what the run writes are the same bytes.
    place.done("bake --atlas");
    assert_eq!(place.done("--check").out, "");
    // A run of one language does not touch them.
    fs::write(place.path(&format!("{OUT}/lut/gold.png")), "spoilt").unwrap();
    assert_eq!(place.done("--target gles --check").out, "");
    let drift = place.run("--check").ends(1).out;
    assert!(
        drift.starts_with("binary file lut/gold.png differs"),
        "{drift}"
    );
}

/// Of tables nobody knows whose they are: `bake` writes what it is asked for, and a run without flags some of the same.
#[test]
fn a_table_that_is_no_longer_written_stays() {
    let place = Place::new();
    place.done("generate");
    place.list_as("lut/gold.exr", "lut/gold.float.exr", "old");
    place.done("generate");
    assert_eq!(place.read(&format!("{OUT}/lut/gold.float.exr")), "old");
    assert!(place.listed().contains(&"lut/gold.float.exr".to_owned()));
}

#[test]
fn check_tells_each_difference_and_writes_nothing() {
    let place = Place::new();
    place.done("--target gles,spirv");
    let at = |name: &str| place.path(&format!("{OUT}/{name}"));
    let schlick = at("gles/fresnel_schlick.glsl");
    let text = fs::read_to_string(&schlick).unwrap();
    fs::write(&schlick, text.replace("m2 * m2 * m", "m2 * m")).unwrap();
    fs::remove_file(at("gles/fresnel_empirical.glsl")).unwrap();
    fs::write(at("spirv/fresnel_schlick.frag.spv"), b"\x03\x02\x23\x07").unwrap();
    let before = place.files();
    let ran = place.run("--target gles,spirv --check").ends(1);
    for part in [
        "--- a/gles/fresnel_schlick.glsl\n+++ b/gles/fresnel_schlick.glsl\n@@",
        "-    highp float m5 = m2 * m;\n",
        "+    highp float m5 = m2 * m2 * m;\n",
        "missing: gles/fresnel_empirical.glsl\n",
        "binary file spirv/fresnel_schlick.frag.spv differs",
    ] {
        assert!(ran.out.contains(part), "{part} is not in {ran:?}");
    }
    assert!(before == place.files(), "--check changed files");
    place
        .run("--target spirv --method empirical --check")
        .ends(0);
    place.run("--target gles,spirv --check --quiet").ends(1);
    // A module has no comments, so that nothing proves it ours once it was changed.
    place.refused(
        "--target gles,spirv",
        &["spirv/fresnel_schlick.frag.spv", "--overwrite"],
    );
    place.done("--target gles,spirv --overwrite");
    assert_eq!(place.done("--target gles,spirv --check").out, "");
}

#[test]
fn a_run_removes_orphans_and_check_names_them() {
    let place = Place::new();
    place.done("--target gles,spirv");
    let old = "// @generated by fresnel-gen\n// old_schlick\n";
    place.list_as("gles/fresnel_schlick.glsl", "gles/old_schlick.glsl", old);
    place.list_as(
        "spirv/fresnel_schlick.frag.spv",
        "spirv/old_schlick.frag.spv",
        // The head of a module of naga's.
        "\x03\x02\x23\x07\0\x03\x01\0\x1c\0\0\0",
    );
    place.put(&format!("{OUT}/gles/notes.txt"), "mine\n");
    let ran = place.run("--target gles,spirv --check").ends(1);
    for orphan in ["gles/old_schlick.glsl", "spirv/old_schlick.frag.spv"] {
        assert!(ran.out.contains(&format!("orphan: {orphan}\n")), "{ran:?}");
    }
    let ran = place.done("--target gles,spirv");
    assert!(
        ran.err.contains("removed: gles/old_schlick.glsl"),
        "{ran:?}"
    );
    assert!(!place.path(&format!("{OUT}/gles/old_schlick.glsl")).exists());
    assert!(
        !place
            .path(&format!("{OUT}/spirv/old_schlick.frag.spv"))
            .exists()
    );
    assert_eq!(place.read(&format!("{OUT}/gles/notes.txt")), "mine\n");
    assert_eq!(place.done("--target gles,spirv --check").out, "");
}

#[test]
fn check_of_nothing_finds_everything_missing_and_makes_no_folder() {
    let place = Place::new();
    let ran = place.run("--target hlsl --check").ends(1);
    assert!(ran.out.starts_with("missing: hlsl/"), "{ran:?}");
    assert!(!place.path(OUT).exists());
}

#[test]
fn list_and_quiet() {
    let place = Place::new();
    let ran = place.done("--list --target hlsl --method schlick,f82_tint --material none");
    assert_eq!(
        ran.out,
        "hlsl/fresnel_f82_tint.hlsl\nhlsl/fresnel_schlick.hlsl\n"
    );
    assert!(place.files().is_empty(), "--list wrote files");
    place.refused("--list --depfile a.d", &["--list", "--depfile"]);
    let ran = place.done("--quiet --target hlsl");
    assert_eq!((ran.out.as_str(), ran.err.as_str()), ("", ""));
}

#[test]
fn runs_of_other_scopes_keep_what_is_not_theirs() {
    let place = Place::new();
    place.put("my.toml", MY_METAL);
    let mut expected = Vec::new();
    for (line, adds) in [
        (
            "--target gles --method schlick",
            "gles/fresnel_schlick.glsl",
        ),
        (
            "--target hlsl --method schlick",
            "hlsl/fresnel_schlick.hlsl",
        ),
        (
            "--target gles --method f82_tint --material none",
            "gles/fresnel_f82_tint.glsl",
        ),
        (
            "--target gles --method schlick --material my.toml",
            "gles/materials/my_metal.glsl",
        ),
        (
            "--target gles --method schlick --material water_thesis",
            "gles/materials/water_thesis.glsl",
        ),
    ] {
        let before = place.files();
        place.done(line);
        expected.push(adds.to_string());
        expected.sort();
        assert_eq!(place.listed(), expected, "{line}");
        let after = place.files();
        for (path, file) in before.iter().filter(|(path, _)| !path.ends_with(".json")) {
            assert!(after.get(path) == Some(file), "{line} changed {path}");
        }
    }
    place.done("generate");
    let all = place.listed();
    assert!(expected.iter().all(|path| all.contains(path)), "{all:?}");
    place.done("--check");
}

#[test]
fn the_order_of_runs_does_not_matter() {
    let lines = [
        "--target gles",
        "--target wgsl --material none",
        "--material gold_thesis --target hlsl",
    ];
    let trees = [[0, 1, 2], [2, 1, 0]].map(|order| {
        let place = Place::new();
        order
            .iter()
            .for_each(|&index| drop(place.done(lines[index])));
        contents(&place.path(OUT))
    });
    assert!(trees[0] == trees[1], "another order gives another tree");
}

#[test]
fn a_method_joins_a_material_file_and_takes_nothing_from_it() {
    let place = Place::new();
    place.done("--target wgsl --material gold_thesis");
    let file = format!("{OUT}/wgsl/materials/gold_thesis.wgsl");
    let names = |text: &str| -> Vec<String> {
        let heads = text.lines().filter_map(|line| line.strip_prefix("fn "));
        heads
            .map(|head| head.split('(').next().unwrap().to_string())
            .collect()
    };
    let usual = names(&place.read(&file));
    assert_eq!(usual.len(), 5);
    place.done("--target wgsl --method schlick --material gold_thesis");
    let more = names(&place.read(&file));
    assert!(usual.iter().all(|name| more.contains(name)), "{more:?}");
    assert!(
        more.contains(&"fresnel_gold_thesis_schlick".to_string()),
        "{more:?}"
    );
    place.done("--target wgsl --method schlick --material gold_thesis --check");
    // What is not asked for by name is again the usual four.
    place.done("--target wgsl --material gold_thesis");
    assert_eq!(names(&place.read(&file)), usual);
}

#[test]
fn another_prefix_replaces_the_files() {
    let place = Place::new();
    place.done("--target gles");
    let count = place.listed().len();
    place.done("--target gles --prefix brdf_");
    assert_eq!(place.listed().len(), count);
    let files = place.files().into_keys();
    let stray: Vec<_> = files.filter(|path| path.contains("fresnel_")).collect();
    assert!(stray.is_empty(), "{stray:?}");
    assert!(
        place
            .read(&format!("{OUT}/gles/brdf_schlick.glsl"))
            .contains("vec3 brdf_schlick(")
    );
}

#[test]
fn depfile_names_outputs_and_inputs() {
    let place = Place::new();
    place.put("my metal.toml", MY_METAL);
    let arguments = [
        "--target",
        "gles",
        "--method",
        "schlick",
        "--material",
        "my metal.toml",
        "--depfile",
        "d",
    ];
    place.run_with(&arguments).ends(0);
    // The program is an input: another version writes other text.
    let program = depfile(&["x".to_owned()], &[PROGRAM.to_owned()]).unwrap();
    let program = program[3..].lines().next().unwrap().to_owned();
    let rule = format!(
        "{OUT}/gles/materials/my_metal.glsl {OUT}/gles/fresnel_schlick.glsl: {program} my\\ metal.toml\n{program}:\nmy\\ metal.toml:\n"
    );
    assert_eq!(place.read("d"), rule);
    place.done("--method schlick --target hlsl -o s.hlsl --depfile e");
    let alone = |target: &str| format!("{target}: {program}\n{program}:\n");
    assert_eq!(place.read("e"), alone("s.hlsl"));
    // So a material of the catalogue, which is no file, has an input too: a rule without one does not last in Ninja.
    place.done("--method fitted --material gold --target hlsl -o g.hlsl --depfile g");
    assert_eq!(place.read("g"), alone("g.hlsl"));
    // The target as the build system names it, in place of all others.
    let line = "--target gles --method schlick --depfile f --depfile-target";
    place.done(&format!("{line} ./stamp"));
    assert_eq!(place.read("f"), alone("./stamp"));
    place.put("own.toml", MY_METAL);
    place.refused(
        "--material own.toml --depfile f --depfile-target own.toml",
        &["own.toml", "reads"],
    );
    place.done("--method schlick -o - --depfile g --depfile-target out");
    assert_eq!(place.read("g"), alone("out"));
    for (line, says) in [
        (
            "--method schlick -o - --depfile h",
            ["`-o -`", "--depfile-target"],
        ),
        (
            "--target gles --depfile-target out",
            ["--depfile <FILE>", "required"],
        ),
        (
            &format!("{line} -"),
            ["--depfile-target takes a file", "stdout"],
        ),
        (&format!("{line} a;b"), ["\"a;b\"", "Make and Ninja"]),
    ] {
        place.refused(line, &says);
    }
}

/// A metal's form serves water badly, and a budget or the class's own method serves both.
#[test]
fn a_method_of_another_class_is_told() {
    let place = Place::new();
    let line = "--material gold,water --method fitted --target wgsl -o";
    let told = place.done(&format!("{line} a.wgsl")).err;
    for part in [
        "for water, a dielectric, fitted errs by 0.00349 (6.48 % in the mean)",
        ", and fitted_dielectric by 0.00049 (0.61 % in the mean)",
    ] {
        assert!(told.contains(part), "{told}");
    }
    for line in [
        format!("{line} b.wgsl --quiet"),
        line.replace("gold,water", "gold") + " c.wgsl",
        line.replace("fitted", "fitted_dielectric")
            .replace("gold,", "")
            + " d.wgsl",
        line.replace("--method fitted", "--budget 0.002 --quiet") + " e.wgsl",
    ] {
        assert_eq!(place.done(&line).err, "", "{line}");
    }
    let told = place.run("--material all --method fitted --target wgsl --check");
    assert!(
        told.err.contains(" more of these materials"),
        "{}",
        told.err
    );
}

/// After the first run of an adapter: the page that says how its host takes it.
#[test]
fn a_first_run_of_an_adapter_names_its_page() {
    let place = Place::new();
    let ran = place.done("--flavour three --material gold");
    let says = format!("next: {OUT}/three/README.md says how the host takes the files");
    assert!(ran.err.contains(&says), "{ran:?}");
    assert!(!ran.err.contains("fresnel-gen verify"), "{ran:?}");
    assert!(
        !place
            .done("--flavour three --material gold")
            .err
            .contains("next:")
    );
    let place = Place::new();
    let ran = place.done("--flavour three --target wgsl --material gold");
    assert!(ran.err.contains(&says), "{ran:?}");
    assert!(ran.err.contains("next: use it;"), "{ran:?}");
}
