//! Texts as editors and other programs leave them: a mark before the first letter, another encoding, letters of another one.

use super::MY_METAL;
use super::OUT;
use super::Place;

/// A text with the mark that Notepad, Excel and .NET write before it.
fn marked(text: &str) -> String {
    format!("\u{feff}{text}")
}

/// A triangle, so placed that its first corner counts.
const TRIANGLE: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n";

const SCENE: &str = r#"size = [32, 32]
[camera]
orthographic = 2.0
eye = [0, 0, -2.5]
at = [0, 0, 0]
[light]
uniform = [1, 1, 1]
[[object]]
mesh = "triangle.obj"
material = "gold"
"#;

#[test]
fn every_reader_takes_a_mark() {
    let place = Place::new();
    let csv = "wl,n\n0.38,1.6\n0.79,0.15\n\nwl,k\n0.38,1.9\n0.79,4.8\n";
    let page = "DATA:\n  - type: tabulated nk\n    data: |\n      0.3 1.5 1.8\n      0.9 0.2 5.6\n";
    let mut light = "nm,power\n".to_owned();
    for nm in (380..=780).step_by(10) {
        light += &format!("{nm},1\n");
    }
    for (file, text) in [
        ("my_metal.toml", MY_METAL),
        ("page.yml", page),
        ("table.csv", csv),
        ("light.csv", &light),
        ("triangle.obj", TRIANGLE),
        ("scene.toml", SCENE),
    ] {
        place.put(&format!("plain/{file}"), text);
        place.put(file, marked(text));
    }
    for file in ["my_metal.toml", "page.yml", "table.csv"] {
        let params = |file: &str| {
            place
                .done(&format!("materials params {file} --json -"))
                .json()
        };
        let same = ["f0", "f82", "n", "k"];
        let (one, other) = (params(file), params(&format!("plain/{file}")));
        assert!(same.iter().all(|key| one[key] == other[key]), "{file}");
    }
    place.done("materials params gold --illuminant light.csv");
    let error = |file: &str| {
        let line =
            format!("scene-error --mesh {file} --eye 0,0,-3 --size 32x32 --material gold --json -");
        place.done(&line).json()["rows"].clone()
    };
    let named = |mut rows: serde_json::Value| {
        for row in rows.as_array_mut().unwrap() {
            row["object"] = "mesh".into();
        }
        rows
    };
    assert_eq!(
        named(error("triangle.obj")),
        named(error("plain/triangle.obj"))
    );
    let plan = |file: &str| place.run(&format!("plan {file} --json -")).json()["rows"].clone();
    assert_eq!(plan("scene.toml"), plan("plain/scene.toml"));
    place.run("plan scene.toml --json plan.json");
    place.put("plan.json", marked(&place.read("plan.json")));
    place.done("--plan plan.json --target gles");
    place.put(
        &format!("{OUT}/manifest.json"),
        marked(&place.read(&format!("{OUT}/manifest.json"))),
    );
    place.done("--target gles --material gold --method schlick");
    place.run("verify --target msl --method schlick --material none --points 100 --shards 1 --shard 0 --json part.json");
    place.put("part.json", marked(&place.read("part.json")));
    place.run("merge part.json -o whole.json").ends(3);
}

#[test]
fn another_encoding_is_named_with_what_to_do() {
    let place = Place::new();
    let utf16 = |text: &str| -> Vec<u8> {
        let units = marked(text).encode_utf16().collect::<Vec<_>>();
        units.into_iter().flat_map(u16::to_le_bytes).collect()
    };
    let says = ["UTF-16, and not UTF-8 text; save it as UTF-8"];
    place.put("my_metal.toml", utf16(MY_METAL));
    place.refused("materials params my_metal.toml", &says);
    place.put("triangle.obj", utf16(TRIANGLE));
    place.refused(
        "scene-error --mesh triangle.obj --eye 0,0,-3 --material gold",
        &says,
    );
    place.put("scene.gltf", utf16("{\"asset\":{\"version\":\"2.0\"}}"));
    place.refused("plan scene.gltf", &says);
    place.put("scene.toml", SCENE);
    place.refused("plan scene.toml", &says);
}

#[test]
fn comments_of_a_mesh_may_be_latin_1() {
    let place = Place::new();
    let mut text = b"# Cr\xe9\xe9 par Maya\ng pi\xe8ce\n".to_vec();
    text.extend(TRIANGLE.as_bytes());
    place.put("triangle.obj", text);
    place.done("scene-error --mesh triangle.obj --eye 0,0,-3 --size 32x32 --material gold");
}

/// Faces that are flat, as an independent rasteriser has them.
#[test]
fn the_error_of_a_flat_cube_is_that_of_its_faces() {
    let place = Place::new();
    let corners =
        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
    let faces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";
    place.put("cube.obj", format!("s off\n{corners}{faces}"));
    let line = "scene-error --mesh cube.obj --material gold --method schlick --eye 1,2,-3 --size 200x200 --json -";
    let row = place.done(line).json()["rows"][0].clone();
    // In percent.
    let mean = row["mean_rel"]["mean"].as_f64().unwrap();
    assert!((mean - 0.8907).abs() < 1e-4, "{row}");
}

#[test]
fn blanks_beside_commas_count_for_nothing() {
    let place = Place::new();
    let run = |f0: &str, f82: &str| {
        let ran = place
            .run_with(&["fit", "--f0", f0, "--f82", f82, "--exact", "0, 90"])
            .ends(0);
        ran.out
    };
    assert_eq!(
        run("1, 0.77, 0.34", " 0.98 ,0.91, 0.66"),
        run("1,0.77,0.34", "0.98,0.91,0.66")
    );
    let eye = [
        "scene-error",
        "cube",
        "--eye",
        "1, 2, -3",
        "--size",
        "32x32",
        "--method",
        "schlick, fitted",
    ];
    place.run_with(&eye).ends(0);
    place
        .run_with(&[
            "materials",
            "params",
            "gold",
            "--wavelengths",
            "685, 535, 475",
        ])
        .ends(0);
}

#[test]
fn a_backslash_in_a_path_says_what_to_write() {
    let place = Place::new();
    place.put(
        "scene.toml",
        SCENE.replace("triangle.obj", "C:\\meshes\\statue.obj"),
    );
    place.refused("plan scene.toml", &["in a path write `/`"]);
}
