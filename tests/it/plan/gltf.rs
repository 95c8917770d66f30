//! glTF: what is read of it, and what is refused with its place.

use serde_json::{Value, json};

use fresnel_gen::lab::raster::{CUBE, Mesh, SPHERE};
use fresnel_gen::pictures::plan::{
    GltfFault, GltfScene, GltfView, SceneFile, SceneLight, constant_index,
};

pub const VIEW: GltfView = GltfView {
    size: [64, 48],
    light: SceneLight::Uniform([1.0, 0.5, 0.25]),
};

/// A file with one mesh: its JSON, with a buffer that lies beside it, and the buffer.
pub fn file(mesh: &Mesh) -> (Value, Vec<u8>) {
    let mut bytes = Vec::new();
    let places = mesh.vertices.iter().map(|vertex| vertex.position);
    let normals = mesh.vertices.iter().map(|vertex| vertex.normal);
    for number in places.chain(normals).flat_map(|vector| vector.to_array()) {
        bytes.extend((number as f32).to_le_bytes());
    }
    for corner in mesh.triangles.iter().flatten() {
        bytes.extend(corner.to_le_bytes());
    }
    let (corners, indices) = (mesh.vertices.len(), 3 * mesh.triangles.len());
    let json = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [
            { "mesh": 0 },
            { "camera": 0, "translation": [0.0, 0.0, 3.0] },
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": std::f32::consts::FRAC_PI_4, "znear": 0.01 } }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "material": 0,
        }] }],
        "materials": [{ "name": "Gold", "pbrMetallicRoughness": { "roughnessFactor": 0.5 } }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": corners, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1] },
            { "bufferView": 0, "byteOffset": 12 * corners, "componentType": 5126, "count": corners, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5125, "count": indices, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 24 * corners },
            { "buffer": 0, "byteOffset": 24 * corners, "byteLength": 4 * indices },
        ],
        "buffers": [{ "byteLength": bytes.len(), "uri": "a%20body.bin" }],
    });
    (json, bytes)
}

pub fn read_with(json: &Value, buffer: &[u8]) -> Result<GltfScene, GltfFault> {
    let mut read = |path: &str| match path {
        "a body.bin" => Ok(buffer.to_vec()),
        _ => Err("it is not there".to_owned()),
    };
    let bytes = serde_json::to_vec(json).unwrap();
    GltfScene::read(&bytes, &VIEW, &mut read)
}

fn read(json: &Value) -> Result<GltfScene, GltfFault> {
    read_with(json, &file(&CUBE.mesh()).1)
}

pub fn glb(json: &Value, binary: &[u8]) -> Vec<u8> {
    let mut text = serde_json::to_vec(json).unwrap();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + text.len() + 8 + binary.len();
    let mut bytes = b"glTF".to_vec();
    for number in [2, length as u32, text.len() as u32] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(b"JSON");
    bytes.extend(&text);
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}

pub fn no_file(path: &str) -> Result<Vec<u8>, String> {
    Err(format!("{path} is not wanted"))
}

#[test]
fn a_sphere_is_the_sphere_of_a_scene_file() {
    let (json, buffer) = file(&SPHERE.mesh());
    let scene = read_with(&json, &buffer).unwrap();
    assert!(scene.frames() == 1 && scene.unplanned.is_empty());
    let text = "size = [64, 48]\n[camera]\nvertical_degrees = 45\neye = [0, 0, 3]\n[light]\nuniform = [1, 0.5, 0.25]\n[[object]]\nbody = \"sphere\"\nmaterial = \"gold\"\nroughness = 0.5\n";
    let own = SceneFile::parse("s.toml", text).unwrap();
    let wanted = own.frame(0, &own.read(&mut no_file).unwrap());
    let frame = scene.frame(0);
    assert_eq!(frame.of_material[0].len(), wanted.of_material[0].len());
    for (pixel, wanted) in frame.of_material[0].iter().zip(&wanted.of_material[0]) {
        assert!((pixel.cos_theta - wanted.cos_theta).abs() < 1e-5);
        assert_eq!(
            (pixel.place, pixel.roughness),
            (wanted.place, wanted.roughness)
        );
        assert_eq!((pixel.light, pixel.other), (wanted.light, wanted.other));
    }
}

#[test]
fn all_three_forms_of_a_file_are_one() {
    let (mut json, buffer) = file(&CUBE.mesh());
    let wanted = read(&json).unwrap().frame(0);
    assert!(wanted.of_material[0].len() > 100);
    use base64::Engine;
    let data = base64::prelude::BASE64_STANDARD.encode(&buffer);
    json["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{data}").into();
    assert_eq!(read_with(&json, &[]).unwrap().frame(0), wanted);
    json["buffers"][0].as_object_mut().unwrap().remove("uri");
    let bytes = glb(&json, &buffer);
    let scene = GltfScene::read(&bytes, &VIEW, &mut no_file).unwrap();
    assert_eq!(scene.frame(0), wanted);
    // Whatever its end or a byte of it says, it is a fault or a scene.
    for end in (0..bytes.len()).step_by(3) {
        assert!(GltfScene::read(&bytes[..end], &VIEW, &mut no_file).is_err());
        let mut changed = bytes.clone();
        changed[end] ^= 0x15;
        let _ = GltfScene::read(&changed, &VIEW, &mut no_file);
    }
}

/// A file that differs in one place is refused: where, and why.
#[track_caller]
fn check(pointer: &str, value: Value, place: &str, says: &str) {
    let mut json = file(&CUBE.mesh()).0;
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match json.pointer_mut(parent).unwrap() {
        Value::Object(map) => drop(map.insert(key.to_owned(), value)),
        list => list[key.parse::<usize>().unwrap()] = value,
    }
    let fault = read(&json).expect_err("a fault");
    assert_eq!(fault.place, place, "{fault}");
    assert!(fault.what.contains(says), "{fault}");
}

#[test]
fn each_fault_names_its_place() {
    let position = "meshes[0].primitives[0].attributes.POSITION";
    let normal = "meshes[0].primitives[0].attributes.NORMAL";
    let indices = "meshes[0].primitives[0].indices";
    check(
        "/asset/version",
        json!("1.0"),
        "asset.version",
        "version 2.0",
    );
    check(
        "/extensionsRequired",
        json!(["KHR_draco_mesh_compression"]),
        "extensionsRequired[0]",
        "KHR_draco",
    );
    check(
        "/accessors/0/count",
        json!(1_000_000_000),
        position,
        "at most 12000000",
    );
    check(
        "/accessors/0/count",
        json!(49),
        position,
        "49 elements do not fit",
    );
    check(
        "/accessors/0/byteOffset",
        json!(u64::MAX),
        position,
        "do not fit",
    );
    check("/accessors/0/type", json!("VEC2"), position, "another type");
    check(
        "/accessors/0/componentType",
        json!(5123),
        position,
        "another type",
    );
    check(
        "/accessors/1/count",
        json!(23),
        normal,
        "23 normals of 24 corners",
    );
    check(
        "/accessors/2/componentType",
        json!(5126),
        indices,
        "another type",
    );
    for (mode, count, says) in [
        (4, 4, "4 indices make no whole triangles"),
        (5, 2, "three at least"),
    ] {
        let mut json = file(&CUBE.mesh()).0;
        json["accessors"][2]["count"] = count.into();
        json["meshes"][0]["primitives"][0]["mode"] = mode.into();
        let fault = read(&json).expect_err("a fault");
        assert_eq!(fault.place, indices, "{fault}");
        assert!(fault.what.contains(says), "{fault}");
    }
    check(
        "/accessors/2/bufferView",
        json!(0),
        indices,
        "leads to nothing",
    );
    check(
        "/accessors/2/bufferView",
        json!(7),
        "accessors[2].bufferView",
        "leads to nothing",
    );
    check(
        "/bufferViews/0/byteLength",
        json!(1e9 as u64),
        "bufferViews[0]",
        "leaves its buffer",
    );
    check(
        "/bufferViews/0/byteOffset",
        json!(u64::MAX),
        "bufferViews[0]",
        "leaves its buffer",
    );
    check(
        "/bufferViews/0/byteStride",
        json!(4),
        "bufferViews[0].byteStride",
        "4 apart",
    );
    check(
        "/meshes/0/primitives/0/attributes/POSITION",
        json!(9),
        position,
        "leads to nothing",
    );
    check(
        "/meshes/0/primitives/0/attributes/NORMAL",
        json!(9),
        normal,
        "leads to nothing",
    );
    check(
        "/buffers/0/byteLength",
        json!(1 << 20),
        "buffers[0].byteLength",
        "and has",
    );
    for uri in [
        "https://a.b/c",
        "/etc/passwd",
        "../a body.bin",
        "%2e%2e/a",
        "c:x",
        "data:,x",
        "b.bin",
        "",
    ] {
        check("/buffers/0/uri", json!(uri), "buffers[0].uri", "");
    }
    check(
        "/nodes/0/children",
        json!([1]),
        "scenes[0].nodes[1]",
        "stands in two places",
    );
    check(
        "/nodes/0/children",
        json!([0]),
        "nodes[0].children[0]",
        "below itself",
    );
    check(
        "/nodes/0/mesh",
        json!(1),
        "nodes[0].mesh",
        "leads to nothing",
    );
    check(
        "/nodes/0/scale",
        json!([1e9, 1, 1]),
        position,
        "beyond 1000000 m",
    );
    check(
        "/nodes/1/scale",
        json!([0, 0, 0]),
        "nodes[1]",
        "no direction",
    );
    check(
        "/cameras/0/perspective/yfov",
        json!(3.2),
        "cameras[0].perspective.yfov",
        "between",
    );
    check(
        "/materials/0/extras",
        json!({ "fresnel_gen": "godl" }),
        "materials[0].extras.fresnel_gen",
        "did you mean gold",
    );
    check(
        "/materials/0/extras",
        json!({ "fresnel_gen": 3 }),
        "materials[0].extras.fresnel_gen",
        "wants the name",
    );
    let rough = json!({ "roughnessFactor": 1.5 });
    check(
        "/materials/0/pbrMetallicRoughness",
        rough,
        "materials[0].pbrMetallicRoughness.roughnessFactor",
        "between 0 and 1",
    );
    check(
        "/meshes/0/primitives/0/mode",
        json!(1),
        "meshes",
        "no triangle",
    );
}

#[test]
fn numbers_that_are_none_are_refused() {
    let (json, mut buffer) = file(&CUBE.mesh());
    buffer[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    let fault = read_with(&json, &buffer).unwrap_err();
    assert!(fault.what.contains("element 0 is not finite"), "{fault}");
    let text = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"translation\":[1e39,0,0]}]}";
    assert!(GltfScene::read(text.as_bytes(), &VIEW, &mut no_file).is_err());
    let fault = GltfScene::read(b"{", &VIEW, &mut no_file).unwrap_err();
    assert!(fault.place.starts_with("line 1"), "{fault}");
}

#[test]
fn sparse_accessors_replace_elements() {
    let (mut json, mut buffer) = file(&CUBE.mesh());
    let end = buffer.len();
    // Two corners of the face towards the camera.
    buffer.extend([8u8, 9, 0, 0]);
    for number in [0.6f32, 0.6, 0.6, 0.7, 0.7, 0.7] {
        buffer.extend(number.to_le_bytes());
    }
    json["buffers"][0]["byteLength"] = buffer.len().into();
    let views = json["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": end, "byteLength": 2 }));
    views.push(json!({ "buffer": 0, "byteOffset": end + 4, "byteLength": 24 }));
    let sparse = |count: usize, at: usize| json!({ "count": count, "indices": { "bufferView": at, "componentType": 5121 }, "values": { "bufferView": 3 } });
    let plain = read_with(&json, &buffer).unwrap().frame(0);
    json["accessors"][0]["sparse"] = sparse(2, 2);
    assert!(read_with(&json, &buffer).unwrap().frame(0) != plain);
    json["accessors"][0]["sparse"] = sparse(3, 2);
    let fault = read_with(&json, &buffer).unwrap_err();
    assert!(fault.what.contains("3 elements do not fit"), "{fault}");
    json["accessors"][0]["sparse"] = sparse(1 << 40, 2);
    let fault = read_with(&json, &buffer).unwrap_err();
    assert!(fault.what.contains("of 24 elements"), "{fault}");
    // The bytes of .5 as indices.
    json["accessors"][0]["sparse"] = sparse(2, 0);
    let fault = read_with(&json, &buffer).unwrap_err();
    assert!(fault.what.contains("do not increase"), "{fault}");
    json["accessors"][0]["sparse"] = sparse(2, 2);
    buffer[end + 1] = 200;
    let fault = read_with(&json, &buffer).unwrap_err();
    assert!(fault.what.contains("it replaces element"), "{fault}");
}

/// A material's JSON, and what stands for it: its name, or a part of why none does.
#[track_caller]
fn mapped(material: Value, wanted: Result<&str, &str>) -> GltfScene {
    let mut json = file(&CUBE.mesh()).0;
    json["materials"][0] = material;
    let scene = read(&json).unwrap();
    match wanted {
        Ok(name) => {
            assert_eq!(scene.materials()[0].material, name);
            assert!(!scene.frame(0).of_material[0].is_empty());
        }
        Err(why) => {
            assert!(scene.materials().is_empty());
            assert!(
                scene.unplanned[0].reason.contains(why),
                "{:?}",
                scene.unplanned
            );
        }
    }
    scene
}

#[test]
fn materials_are_mapped_by_extras_by_name_and_by_index() {
    mapped(
        json!({ "name": "x", "extras": { "fresnel_gen": "silver" } }),
        Ok("silver"),
    );
    mapped(json!({ "name": "Gold Thesis" }), Ok("gold_thesis"));
    mapped(json!({ "name": "Brass 2" }), Err("Schlick"));
    let glass = json!({ "metallicFactor": 0, "baseColorFactor": [0.5, 0.25, 1, 0.5] });
    let scene = mapped(
        json!({ "pbrMetallicRoughness": glass.clone() }),
        Ok("ior_1_5"),
    );
    assert_eq!(scene.materials()[0].name, "materials[0]");
    let pixel = scene.frame(0).of_material[0][0];
    assert_eq!((pixel.other, pixel.coverage), ([0.5, 0.125, 0.25], 1.0));
    let scene = mapped(
        json!({ "alphaMode": "BLEND", "pbrMetallicRoughness": glass.clone() }),
        Ok("ior_1_5"),
    );
    assert_eq!(scene.frame(0).of_material[0][0].coverage, 0.5);
    let with = |extension: &str, value: Value| json!({ "pbrMetallicRoughness": glass.clone(), "extensions": { extension: value } });
    mapped(
        with("KHR_materials_ior", json!({ "ior": 1.45 })),
        Ok("ior_1_45"),
    );
    mapped(with("KHR_materials_ior", json!({ "ior": 2 })), Ok("ior_2"));
    mapped(
        with("KHR_materials_ior", json!({ "ior": 0 })),
        Err("an index of 0"),
    );
    mapped(
        with("KHR_materials_ior", json!({ "ior": -1e30 })),
        Err("an index of"),
    );
    mapped(with("KHR_materials_specular", json!({})), Ok("ior_1_5"));
    mapped(
        with("KHR_materials_specular", json!({ "specularFactor": 0.5 })),
        Err("KHR_materials_specular"),
    );
    // What changes no reflection.
    for (extension, value) in [
        ("KHR_materials_clearcoat", json!({})),
        (
            "KHR_materials_clearcoat",
            json!({ "clearcoatFactor": 0, "clearcoatRoughnessFactor": 0.5 }),
        ),
        (
            "KHR_materials_iridescence",
            json!({ "iridescenceIor": 1.3 }),
        ),
        (
            "KHR_materials_sheen",
            json!({ "sheenColorFactor": [0, 0, 0], "sheenRoughnessFactor": 1 }),
        ),
        (
            "KHR_materials_anisotropy",
            json!({ "anisotropyStrength": 0.0 }),
        ),
        ("KHR_materials_dispersion", json!({ "dispersion": 0.33 })),
        ("KHR_materials_volume", json!({ "thicknessFactor": 1 })),
        (
            "KHR_materials_diffuse_transmission",
            json!({ "diffuseTransmissionFactor": 1 }),
        ),
        (
            "KHR_materials_emissive_strength",
            json!({ "emissiveStrength": 3 }),
        ),
    ] {
        mapped(with(extension, value), Ok("ior_1_5"));
    }
    for (extension, value, why) in [
        (
            "KHR_materials_clearcoat",
            json!({ "clearcoatFactor": 0.1 }),
            "a coat over it",
        ),
        (
            "KHR_materials_iridescence",
            json!({ "iridescenceFactor": 1 }),
            "a film on it",
        ),
        (
            "KHR_materials_sheen",
            json!({ "sheenColorFactor": [0, 0.1, 0] }),
            "fibres on it",
        ),
        (
            "KHR_materials_anisotropy",
            json!({ "anisotropyStrength": 0.5 }),
            "rougher in one direction",
        ),
        ("KHR_materials_unlit", json!({}), "it is not lit"),
        ("KHR_materials_pbrSpecularGlossiness", json!({}), "no index"),
        (
            "EXT_materials_of_tomorrow",
            json!({}),
            "changes what it reflects",
        ),
    ] {
        mapped(with(extension, value), Err(why));
    }
    mapped(
        with(
            "KHR_materials_transmission",
            json!({ "transmissionFactor": 1 }),
        ),
        Ok("ior_1_5"),
    );
}

#[test]
fn constant_indices_have_names() {
    for (name, n) in [("ior_1_5", 1.5), ("ior_1_333", 1.333), ("ior_2", 2.0)] {
        let material = constant_index(name).unwrap();
        assert_eq!(material.name, name);
        for nm in [380.0, 550.0, 780.0] {
            let index = material
                .index(nm, fresnel_gen::physics::materials::Extrapolate::Refuse)
                .unwrap();
            assert_eq!((index.n, index.k), (n, 0.0));
        }
    }
    for name in [
        "gold",
        "ior_",
        "ior_1.5",
        "ior_1_5_0",
        "ior_01_5",
        "ior_nan",
        "ior_inf",
        "ior_-1",
        "ior_1_50",
        "ior_1e1",
    ] {
        assert_eq!(constant_index(name), None, "{name}");
    }
}

/// What has no material of its own hides what is behind it.
#[test]
fn unplanned_materials_hide_what_is_behind_them() {
    let mut json = file(&CUBE.mesh()).0;
    json["nodes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "mesh": 1, "translation": [0.5, 0.0, 1.0] }));
    json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    let all = read_frame(&json);
    let mut primitive = json["meshes"][0]["primitives"][0].clone();
    primitive["material"] = 1.into();
    json["meshes"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "primitives": [primitive] }));
    json["materials"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "name": "\u{1b}Gold" }));
    let scene = read(&json).unwrap();
    assert_eq!(scene.unplanned[0].name, "\\u{1b}Gold");
    let hidden = scene.frame(0).of_material[0].len();
    assert!(0 < hidden && hidden < all, "{hidden} {all}");
}

fn read_frame(json: &Value) -> usize {
    let mut json = json.clone();
    json["nodes"][2].as_object_mut().unwrap().remove("mesh");
    read(&json).unwrap().frame(0).of_material[0].len()
}

#[test]
fn cameras_turn_about_what_has_none() {
    let mut json = file(&CUBE.mesh()).0;
    json["nodes"][1].as_object_mut().unwrap().remove("camera");
    let scene = read(&json).unwrap();
    assert_eq!(scene.frames(), 36);
    for index in 0..36 {
        let frame = scene.frame(index);
        let [width, height] = frame.size;
        let pixels = &frame.of_material[0];
        assert!(pixels.len() > 400);
        let is_inside = |place: u32| {
            let (x, y) = (place % width, place / width);
            0 < x && x + 1 < width && 0 < y && y + 1 < height
        };
        assert!(pixels.iter().all(|pixel| is_inside(pixel.place)));
    }
}

/// A cube that is squeezed and turned shows its faces under the angles that geometry says; so does an orthographic camera.
#[test]
fn transforms_move_normals_as_they_should() {
    let mut json = file(&CUBE.mesh()).0;
    json["cameras"][0] = json!({ "type": "orthographic", "orthographic": { "xmag": 2, "ymag": 1.5, "znear": 0, "zfar": 10 } });
    // A turn about y by 30 degrees below a squeeze along x to a half: the normal (sin, 0, cos) becomes (2 sin, 0, cos).
    let half = 15f64.to_radians();
    json["nodes"] = json!([
        { "children": [2], "scale": [0.5, 1, 1] },
        { "camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1] },
        { "mesh": 0, "rotation": [0, half.sin(), 0, half.cos()] },
    ]);
    let scene = read(&json).unwrap();
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let front = cos / (4.0 * sin * sin + cos * cos).sqrt();
    let side = sin / (sin * sin + 4.0 * cos * cos).sqrt();
    let seen = scene.frame(0).of_material[0].clone();
    for pixel in &seen {
        let cosine = f64::from(pixel.cos_theta);
        assert!(
            (cosine - front).abs().min((cosine - side).abs()) < 1e-5,
            "{cosine} {front} {side}"
        );
    }
    // Without normals faces are flat, and the same.
    json["meshes"][0]["primitives"][0]["attributes"]
        .as_object_mut()
        .unwrap()
        .remove("NORMAL");
    for (pixel, flat) in seen
        .iter()
        .zip(&read(&json).unwrap().frame(0).of_material[0])
    {
        assert!((pixel.cos_theta - flat.cos_theta).abs() < 1e-5);
    }
}
