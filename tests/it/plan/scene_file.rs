//! Scene files: what is read, what is drawn, and what is refused with its place.

use glam::DVec3;

use fresnel_gen::lab::raster::CUBE;
use fresnel_gen::pictures::plan::{MappedMaterial, SceneFile};

const GOOD: &str = "size = [64, 48]
[camera]
vertical_degrees = 45
eye = [0, 1, 3]
[light]
uniform = [1, 1, 1]
[[object]]
body = \"sphere\"
material = \"gold\"
";

fn read(text: &str) -> Result<SceneFile, fresnel_gen::physics::user_text::FileFault> {
    SceneFile::parse("s.toml", text)
}

/// A scene that differs in one place from a good one is refused: in which line and column, and why.
#[track_caller]
fn check(from: &str, to: &str, at: (usize, usize), says: &str) {
    let text = GOOD.replacen(from, to, 1);
    assert_ne!(text, GOOD);
    let fault = read(&text).expect_err("a fault");
    assert!(fault.what.contains(says), "{fault}");
    assert_eq!((fault.line, fault.column), at, "{fault}");
}

#[test]
fn each_fault_names_its_place() {
    check("\"gold\"", "\"godl\"", (9, 12), "(did you mean gold");
    check("material", "matreial", (9, 1), "(did you mean material");
    check("eye", "eey", (4, 1), "(did you mean eye");
    check("uniform", "uniforn", (6, 1), "(did you mean uniform");
    check("[64, 48]", "[64, 15]", (1, 13), "sides have 16 to 4096");
    check("[64, 48]", "[64, 4097]", (1, 13), "sides have 16 to 4096");
    check("[64, 48]", "[-64, 48]", (1, 9), "sides have 16 to 4096");
    check("[64, 48]", "[64]", (1, 8), "");
    check("45", "nan", (3, 20), "`vertical_degrees` is NaN");
    check("45", "inf", (3, 20), "`vertical_degrees` is inf");
    check("45", "180", (3, 20), "between 0.01 and 170");
    check(
        "45",
        "45\northographic = 1",
        (2, 1),
        "one of `orthographic`",
    );
    check(
        "vertical_degrees = 45\n",
        "",
        (2, 1),
        "one of `orthographic`",
    );
    check(
        "45",
        "45\nturntable = { frames = 721 }",
        (4, 24),
        "between 1 and 720",
    );
    check(
        "45",
        "45\nturntable = { frames = 0 }",
        (4, 24),
        "between 1 and 720",
    );
    check(
        "45",
        "45\nturntable = { frames = 2, axis = [0, 0, 0] }",
        (4, 35),
        "no direction",
    );
    check(
        "45",
        "45\nturntable = { frame = 2 }",
        (4, 15),
        "(did you mean frames",
    );
    check("[0, 1, 3]", "[0, 0, 0]", (4, 8), "m apart");
    check(
        "[0, 1, 3]",
        "[0, 1e7, 3]",
        (4, 11),
        "between -1000000 and 1000000",
    );
    check("[1, 1, 1]", "[1, -1, 1]", (6, 15), "between 0 and 65504");
    check(
        "uniform = [1, 1, 1]",
        "",
        (5, 1),
        "one of `uniform` and `environment`",
    );
    check("\"sphere\"", "\"spere\"", (8, 8), "(did you mean sphere");
    check("body = \"sphere\"", "", (7, 1), "one of `body` and `mesh`");
    check("\"sphere\"", "\"plane\"\nextent = 2", (9, 10), "no end");
    check(
        "\"sphere\"",
        "\"sphere\"\ncoverage = 0",
        (9, 12),
        "`coverage`",
    );
    check(
        "\"sphere\"",
        "\"sphere\"\nroughness = 1.1",
        (9, 13),
        "`roughness`",
    );
    check(
        "\"sphere\"",
        "\"sphere\"\nname = \"\\u001b\"",
        (9, 8),
        "control character",
    );
    check(
        "size",
        "tone = \"filmic\"\nsize",
        (1, 8),
        "there is no tone curve",
    );
    check(
        "[[object]]\nbody = \"sphere\"\nmaterial = \"gold\"\n",
        "",
        (1, 1),
        "missing field `object`",
    );
}

#[test]
fn frames_count_over_all_cameras() {
    let camera = "[[camera]]\northographic = 1\neye = [0, 0, 2]\nturntable = { frames = 360 }\n";
    let rest = GOOD.split("[light]").nth(1).unwrap();
    let scene = |cameras: usize| read(&format!("{}[light]{rest}", camera.repeat(cameras)));
    assert_eq!(scene(2).unwrap().frames(), 720);
    let fault = scene(3).unwrap_err();
    assert_eq!(fault.line, 9, "{fault}");
    assert!(fault.what.contains("more than 720 frames"), "{fault}");
}

/// A file that the scene names and that is not there.
fn nothing(path: &str) -> Result<Vec<u8>, String> {
    Err(format!("there is no {path}"))
}

#[test]
fn objects_of_one_name_and_material_are_one() {
    let more = "[[object]]\nbody = \"cube\"\nmaterial = \"gold\"\nat = [1, 0, 0]\n[[object]]\nbody = \"cube\"\nextent = 0.6\nname = \"ring\"\nmaterial = \"gold\"\n[[object]]\nbody = \"plane\"\nmaterial = \"own/mine.toml\"\nat = [0, -0.5, 0]\n";
    let scene = read(&format!("{GOOD}{more}")).unwrap();
    let mapped = |name: &str, material: &str| MappedMaterial {
        name: name.into(),
        material: material.into(),
    };
    let wanted = [
        mapped("gold", "gold"),
        mapped("ring", "gold"),
        mapped("own/mine.toml", "own/mine.toml"),
    ];
    assert_eq!(scene.materials(), wanted);
    let fault = scene.material_fault(2, "it is not there".into());
    assert_eq!((fault.line, fault.column), (21, 12), "{fault}");
    let frame = scene.frame(0, &scene.read(&mut nothing).unwrap());
    assert!(!frame.of_material[0].is_empty() && !frame.of_material[2].is_empty());
    // The ring is a cube within the sphere: one depth buffer hides all of it but its corners.
    assert!(frame.of_material[1].len() < frame.of_material[0].len() / 4);
    let mut seen: Vec<u32> = frame.of_material.concat().iter().map(|p| p.place).collect();
    let count = seen.len();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), count);
}

#[test]
fn a_turntable_ends_where_it_began() {
    let text = GOOD.replace("45", "45\nturntable = { frames = 5, step_degrees = 90 }");
    let scene = read(&text.replace("sphere", "relief")).unwrap();
    let drawn = scene.read(&mut nothing).unwrap();
    let first = scene.frame(0, &drawn);
    assert_ne!(first, scene.frame(1, &drawn));
    let last = scene.frame(4, &drawn);
    let pairs = first.of_material[0].iter().zip(&last.of_material[0]);
    let same =
        pairs.filter(|(a, b)| a.place == b.place && (a.cos_theta - b.cos_theta).abs() < 1e-5);
    assert!(same.count() > first.of_material[0].len() * 99 / 100);
}

fn png_of(texels: &[u8], [width, height]: [u32; 2]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(texels).unwrap();
    writer.finish().unwrap();
    bytes
}

/// An environment's light is that of the mirrored direction: a sphere's middle shows what is behind the camera.
#[test]
fn a_mirror_shows_what_is_behind_the_camera() {
    let text = GOOD.replace("uniform = [1, 1, 1]", "environment = \"sky.png\"");
    let scene = read(&text.replace("[0, 1, 3]", "[0, 0, 3]")).unwrap();
    let fault = scene.read(&mut nothing).unwrap_err();
    assert_eq!((fault.line, fault.column), (6, 15));
    assert!(fault.what.contains("there is no sky.png"), "{fault}");
    assert!(scene.read(&mut |_| Ok(b"no picture".to_vec())).is_err());
    // +z is at both ends of a row.
    let texel = |at: usize| {
        [
            if (16..48).contains(&(at % 64)) {
                0
            } else {
                255
            },
            255,
            0,
        ]
    };
    let texels: Vec<u8> = (0..64 * 32).flat_map(texel).collect();
    let png = png_of(&texels, [64, 32]);
    let drawn = scene.read(&mut |_| Ok(png.clone())).unwrap();
    let frame = scene.frame(0, &drawn);
    for pixel in &frame.of_material[0] {
        let [red, green, blue] = pixel.light;
        assert!((green - 1.0).abs() < 1e-3 && blue == 0.0);
        if pixel.cos_theta > 0.75 {
            assert!((red - 1.0).abs() < 1e-3, "{pixel:?}");
        } else if pixel.cos_theta < 0.6 {
            assert!(red < 1e-3, "{pixel:?}");
        }
    }
}

#[test]
fn a_mesh_keeps_its_place_unless_the_scene_states_another() {
    let mut mesh = CUBE.mesh();
    for vertex in &mut mesh.vertices {
        vertex.position = 0.4 * vertex.position + DVec3::new(0.3, 0.0, 0.0);
    }
    let obj = crate::raster::obj::obj(&mesh, true);
    let text = GOOD.replace("body = \"sphere\"", "mesh = \"statue.obj\"");
    let seen = |text: &str| {
        let scene = read(text).unwrap();
        let frame = scene.frame(
            0,
            &scene.read(&mut |_| Ok(obj.clone().into_bytes())).unwrap(),
        );
        frame.of_material[0].clone()
    };
    let stated = GOOD.replace("\"sphere\"", "\"cube\"\nextent = 0.4\nat = [0.3, 0, 0]");
    let places = |text: &str| -> Vec<u32> { seen(text).iter().map(|p| p.place).collect() };
    assert_eq!(places(&text), places(&stated));
    let moved = places(&text.replace("mesh =", "at = [0, 0, 0]\nextent = 1\nmesh ="));
    assert_eq!(moved, places(&GOOD.replace("sphere", "cube")));
    let scene = read(&text).unwrap();
    let fault = scene
        .read(&mut |_| Ok(b"v 0 0 0\nf 1 2 3\n".to_vec()))
        .unwrap_err();
    assert_eq!(
        (fault.file.as_str(), fault.line),
        ("statue.obj", 2),
        "{fault}"
    );
    let fault = scene.read(&mut |_| Ok(vec![0xff, 0])).unwrap_err();
    assert!(fault.what.contains("not UTF-8"), "{fault}");
    let far = "v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n";
    let fault = scene
        .read(&mut |_| Ok(far.as_bytes().to_vec()))
        .unwrap_err();
    assert!(fault.what.contains("`extent`"), "{fault}");
}

#[test]
fn too_many_triangles_are_refused() {
    let more = "[[object]]\nbody = \"relief\"\nmaterial = \"gold\"\n".repeat(20);
    let scene = read(&format!("{GOOD}{more}")).unwrap();
    let fault = scene.read(&mut nothing).unwrap_err();
    assert!(
        fault.what.contains("more than 4000000 triangles"),
        "{fault}"
    );
    assert!(fault.line > 60, "{fault}");
}

#[test]
fn nothing_in_a_file_makes_it_panic() {
    for end in 0..GOOD.len() {
        let _ = read(&GOOD[..end]);
        let _ = read(&GOOD.replacen(&GOOD[end..=end], "\0", 1));
        let _ = read(&GOOD.replacen(&GOOD[end..=end], "é", 1));
        let _ = read(&GOOD.replacen(&GOOD[end..=end], "9", 1));
    }
}
