//! Meshes of others: what is read, and what is refused with its line.

use super::camera;
use fresnel_gen::lab::raster::{CUBE, MOST_TRIANGLES, Mesh, SPHERE, draw, mesh_of_obj};

/// A mesh as OBJ.
pub fn obj(mesh: &Mesh, with_normals: bool) -> String {
    let mut text = String::from("# a mesh\no body\n");
    for vertex in &mesh.vertices {
        let [x, y, z] = vertex.position.to_array();
        text += &format!("v {x} {y} {z}\n");
    }
    for vertex in mesh.vertices.iter().filter(|_| with_normals) {
        let [x, y, z] = vertex.normal.to_array();
        text += &format!("vn {x} {y} {z}\n");
    }
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| corner + 1);
        text += &if with_normals {
            format!("f {a}//{a} {b}//{b} {c}//{c}\n")
        } else {
            format!("f {a} {b} {c}\n")
        };
    }
    text
}

#[test]
fn a_mesh_is_drawn_as_the_body_that_it_is() {
    let view = camera([0.7, 1.1, -1.9], [160, 120], 60.0);
    let cube = mesh_of_obj(&obj(&CUBE.mesh(), true))
        .unwrap()
        .with_extent(1.0);
    assert_eq!(draw(&cube, &view), draw(&CUBE.mesh(), &view));
    // Without normals a smooth surface is assumed; its faces may be wound either way.
    let mut sphere = SPHERE.mesh();
    for triangle in &mut sphere.triangles {
        triangle.swap(0, 1);
    }
    let smooth = mesh_of_obj(&obj(&sphere, false)).unwrap().with_extent(1.0);
    let (drawn, wanted) = (draw(&smooth, &view), draw(&SPHERE.mesh(), &view));
    assert_eq!(drawn.covered.len(), wanted.covered.len());
    let pairs = drawn.covered.iter().zip(&wanted.covered);
    let apart = pairs.map(|((_, drawn), (_, wanted))| (drawn - wanted).abs());
    let mean = apart.sum::<f64>() / drawn.covered.len() as f64;
    assert!(mean < 5e-3, "{mean}");
}

#[test]
fn polygons_relative_indices_and_groups_are_read() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\ng one\nf -4/1 -3/1 -2/1 -1/1\ng two\nv 0 0 1\nf 1 2 5\nl 1 2\n";
    let mesh = mesh_of_obj(text).unwrap();
    assert_eq!(mesh.triangles.len(), 3);
    assert!(mesh.vertices.iter().all(|vertex| vertex.normal.is_finite()));
}

/// A star of one face covers what its triangles cover, and not what a fan from its first corner does; so does a dart.
#[test]
fn a_concave_face_covers_what_lies_inside() {
    let point = |i: usize| {
        let angle = std::f64::consts::PI * (0.5 + i as f64 / 5.0);
        let radius = if i.is_multiple_of(2) { 1.0 } else { 0.35 };
        (radius * angle.cos(), radius * angle.sin())
    };
    let mut places: String = (0..10)
        .map(|i| format!("v {} {} 0\n", point(i).0, point(i).1))
        .collect();
    places += "v 0 0 0\nv -0.4 -0.3 0\nv 0 0.9 0\nv 0.4 -0.3 0\nv 0 0.1 0\n";
    let face = |corners: &[usize]| {
        let words: Vec<String> = corners.iter().map(|corner| corner.to_string()).collect();
        format!("f {}\n", words.join(" "))
    };
    let whole = face(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    let cut: String = (1..11).map(|i| face(&[11, i, i % 10 + 1])).collect();
    let view = camera([0.0, 0.0, 3.0], [128, 128], 45.0);
    let pixels = |faces: &str| {
        let mesh = mesh_of_obj(&format!("{places}{faces}")).unwrap();
        draw(&mesh, &view).covered.len()
    };
    assert_eq!(pixels(&whole), pixels(&cut));
    let dart = face(&[12, 13, 14, 15]);
    assert_eq!(pixels(&dart), pixels("f 12 13 15\nf 15 13 14\n"));
    // A material without a name is none.
    assert_eq!(pixels(&format!("usemtl\n{dart}")), pixels(&dart));
    // A polyline of three places is no triangle.
    assert_eq!(pixels(&format!("{dart}l 1 3 5 7\n")), pixels(&dart));
    let many: String = (0..1100)
        .map(|i| format!("v {i} {} 0\n", i % 2))
        .chain(["v 1099 -5 0\nv 0 -5 0\nf".to_owned()])
        .chain((1..1103).map(|i| format!(" {i}")))
        .collect();
    let fault = mesh_of_obj(&many).unwrap_err();
    assert_eq!(fault.line, 1103);
    assert!(fault.what.contains("up to 1024"), "{fault}");
}

#[test]
fn a_face_may_stand_above_its_corners() {
    assert!(mesh_of_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").is_ok());
}

#[test]
fn what_is_broken_is_refused_with_its_line() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let many = format!("{three}f{}\n", " 1".repeat(MOST_TRIANGLES + 3));
    for (text, line, says) in [
        (String::new(), 1, "without a face"),
        (three.to_owned(), 3, "without a face"),
        ("v 0 0".to_owned(), 1, "has 2 numbers"),
        ("v 0 0 nan\n".to_owned(), 1, "`nan` is no place"),
        ("v 0 0 1e999\n".to_owned(), 1, "is no place"),
        (
            "v 0 0 0 1 nan 1\n".to_owned(),
            1,
            "`nan` is neither a weight nor a part of a colour",
        ),
        ("\nv 0 zero 0\n".to_owned(), 2, "`zero` is not a number"),
        (
            format!("{three}f 1 2 4\n"),
            4,
            "names place 4, and there are 3",
        ),
        (
            format!("{three}f 1 2 1000000000\n"),
            4,
            "names place 1000000000",
        ),
        (format!("{three}f 0 1 2\n"), 4, "index 0 leads to nothing"),
        (format!("{three}f -4 1 2\n"), 4, "index -4 leads to nothing"),
        (
            format!("{three}f 1 2 99999999999999999999\n"),
            4,
            "is no index",
        ),
        (
            format!("{three}f 1//1 2//1 3//1\n"),
            4,
            "names normal 1, and there are 0",
        ),
        (
            format!("{three}f 1/7 2/7 3/7\n"),
            4,
            "names texture coordinate 7",
        ),
        (format!("{three}f 1 2\n"), 4, "a face has 2 corners"),
        (format!("{three}f 1 2 x\n"), 4, "`x` is no index"),
        (many, 4, "more than 4000000 triangles"),
        (
            format!("{three}surf 0 1 0 1 1 2 3\n"),
            4,
            "`surf` is a surface",
        ),
    ] {
        let fault = mesh_of_obj(&text).unwrap_err();
        let head: String = text.chars().take(60).collect();
        assert_eq!(fault.line, line, "{head}: {fault}");
        assert!(fault.what.contains(says), "{head}: {fault}");
    }
}

/// What a fuzzer would try, a little of it on every machine: a good file with a few bytes changed.
#[test]
fn changed_bytes_do_no_harm() {
    const BYTES: &[u8] = b"0123456789-+./ \nvtfnoge#\\";
    let good = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nvt 0 1\nvn 0 0 1\nvn 0 1 1\no a\nf 1/1/1 2/1/2 3/1/1\nf -1//1 -2//2 1//1\nf 1 2 3 4\n";
    let view = camera([0.0, 0.0, -2.0], [16, 12], 60.0);
    let mut random = fastrand::Rng::with_seed(7);
    let mut read = 0;
    for _ in 0..4000 {
        let mut bytes = good.as_bytes().to_vec();
        for _ in 0..random.usize(1..4) {
            let at = random.usize(..bytes.len());
            bytes[at] = BYTES[random.usize(..BYTES.len())];
        }
        let Ok(mesh) = mesh_of_obj(std::str::from_utf8(&bytes).unwrap()) else {
            continue;
        };
        read += 1;
        let drawn = draw(&mesh.with_extent(1.0), &view);
        assert!(drawn.covered.iter().all(|(_, c)| (0.0..=1.0).contains(c)));
    }
    assert!((400..3900).contains(&read), "{read} of 4000 are read");
}

/// A cube whose faces are wound outward, without normals.
const CORNERS: &str =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
const FACES: &str = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";

/// Normals along one axis.
fn is_flat(mesh: &Mesh) -> bool {
    let mut normals = mesh.vertices.iter().map(|vertex| vertex.normal.normalize());
    normals.all(|normal| normal.abs().max_element() > 0.999)
}

#[test]
fn faces_of_no_smoothing_group_are_flat() {
    let off = mesh_of_obj(&format!("s off\n{CORNERS}{FACES}")).unwrap();
    assert!(is_flat(&off));
    assert_eq!(off.triangles.len(), 12);
    let zero = mesh_of_obj(&format!("{CORNERS}o cube\ns 0\ng side\nusemtl a\n{FACES}")).unwrap();
    assert!(is_flat(&zero));
    for smooth in ["", "s 1\n", "s on\n"] {
        let mesh = mesh_of_obj(&format!("{smooth}{CORNERS}{FACES}")).unwrap();
        assert!(!is_flat(&mesh), "{smooth}");
        assert_eq!(mesh.vertices.len(), 8, "{smooth}");
    }
    // Each face a group of its own: nothing is smoothed.
    let mut apart = CORNERS.to_owned();
    for (group, face) in FACES.lines().enumerate() {
        apart += &format!("s {}\n{face}\n", group + 1);
    }
    assert!(is_flat(&mesh_of_obj(&apart).unwrap()));
}

#[test]
fn a_line_goes_on_behind_a_backslash_and_keeps_its_number() {
    let text = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 1\nf 1//1 2//1 \\\n3//1 4//1\n";
    assert_eq!(mesh_of_obj(text).unwrap().triangles.len(), 2);
    let windows = text.replace('\n', "\r\n");
    assert_eq!(mesh_of_obj(&windows).unwrap().triangles.len(), 2);
    let fault = mesh_of_obj(&format!("{text}f 1 2 9\n")).unwrap_err();
    assert_eq!(fault.line, 8, "{fault}");
    // Comments behind numbers, and the old name of a face.
    let commented =
        text.replace("0\n", "0 # a corner\n").replace("f 1", "fo 1") + "f 1 2 3 # half\n";
    assert_eq!(mesh_of_obj(&commented).unwrap().triangles.len(), 3);
    let comma = mesh_of_obj("v 0,5 0 0\n").unwrap_err();
    assert!(comma.what.contains("a point and no comma"), "{comma}");
    // At the end of the file it continues nothing.
    assert!(mesh_of_obj(&format!("{CORNERS}{FACES}f 1 2 3 \\")).is_ok());
    // A comment goes on nowhere.
    let folder = mesh_of_obj(&format!("# C:\\meshes\\\n{CORNERS}{FACES}")).unwrap();
    assert_eq!(folder.vertices.len(), 8);
}
