//! glTF: what changes what a camera sees beside triangles: sides, clip planes, vertex colours, and what is not read and said.

use serde_json::{Value, json};

use super::gltf::VIEW;
use super::gltf::file;
use super::gltf::glb;
use super::gltf::no_file;
use super::gltf::read_with;
use fresnel_gen::lab::raster::{CUBE, Mesh, SPHERE};
use fresnel_gen::pictures::plan::GltfScene;

/// Pixels of the first material in the first frame.
fn seen(json: &Value, buffer: &[u8]) -> usize {
    read_with(json, buffer).unwrap().frame(0).of_material[0].len()
}

/// A file of the sphere as triangles that go round the other way.
fn turned_inside_out() -> (Value, Vec<u8>) {
    let mut mesh = SPHERE.mesh();
    mesh.triangles
        .iter_mut()
        .for_each(|corners| corners.swap(0, 1));
    file(&mesh)
}

#[test]
fn back_faces_are_seen_of_double_sided_materials_alone() {
    let (mut json, buffer) = file(&SPHERE.mesh());
    let all = seen(&json, &buffer);
    json["materials"][0]["doubleSided"] = true.into();
    assert_eq!(seen(&json, &buffer), all);
    // From inside nothing is seen of a single-sided sphere, and the whole frame is full of a double-sided one.
    json["nodes"][1]["translation"] = json!([0, 0, 0]);
    let [width, height] = VIEW.size;
    assert_eq!(seen(&json, &buffer), (width * height) as usize);
    json["materials"][0]["doubleSided"] = false.into();
    assert_eq!(seen(&json, &buffer), 0);
    // Corners that go round the other way show the far half, and a node that mirrors turns them back.
    let (mut json, buffer) = turned_inside_out();
    let far = read_with(&json, &buffer).unwrap().frame(0);
    assert_eq!(far.of_material[0].len(), all);
    json["nodes"][0]["scale"] = json!([1, 1, -1]);
    let near = read_with(&json, &buffer).unwrap().frame(0);
    assert_eq!(near.of_material[0].len(), all);
    let (json, buffer) = file(&SPHERE.mesh());
    let usual = read_with(&json, &buffer).unwrap().frame(0);
    let cosines = |frame: &fresnel_gen::pictures::plan::FramePixels| -> f32 {
        frame.of_material[0]
            .iter()
            .map(|pixel| pixel.cos_theta)
            .sum()
    };
    assert!((cosines(&near) - cosines(&usual)).abs() < 0.05 * cosines(&usual));
}

#[test]
fn each_other_triangle_of_a_strip_goes_round_the_other_way() {
    let mesh = Mesh {
        vertices: [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]]
            .map(|[x, y]| fresnel_gen::lab::raster::Vertex {
                position: [x, y, 0.0].into(),
                normal: [0.0, 0.0, 1.0].into(),
            })
            .to_vec(),
        triangles: vec![[0, 1, 2], [1, 3, 2]],
    };
    let (mut json, buffer) = file(&mesh);
    let square = seen(&json, &buffer);
    let primitive = json["meshes"][0]["primitives"][0].as_object_mut().unwrap();
    primitive.remove("indices");
    primitive.insert("mode".to_owned(), 5.into());
    assert_eq!(seen(&json, &buffer), square);
}

#[test]
fn nothing_is_seen_beyond_the_clip_planes() {
    let (mut json, buffer) = file(&SPHERE.mesh());
    let all = seen(&json, &buffer);
    // The sphere reaches from 2.5 to 3.5 m before the camera, its rim is at about 3.
    for (near, far, wanted) in [
        (0.1, 10.0, all),
        (0.1, 2.4, 0),
        (3.6, 10.0, 0),
        (0.1, 2.6, all / 2),
    ] {
        json["cameras"][0]["perspective"]["znear"] = near.into();
        json["cameras"][0]["perspective"]["zfar"] = far.into();
        let found = seen(&json, &buffer);
        let is_part = wanted != 0 && wanted != all && 0 < found && found < all;
        assert!(found == wanted || is_part, "{near} {far}: {found} of {all}");
        let orthographic = json!({ "xmag": 1.0, "ymag": 0.75, "znear": near, "zfar": far });
        let mut other = json.clone();
        other["cameras"][0] = json!({ "type": "orthographic", "orthographic": orthographic });
        assert_eq!(seen(&other, &buffer) == 0, wanted == 0, "{near} {far}");
    }
    json["cameras"][0]["perspective"]["zfar"] = 0.05.into();
    let fault = read_with(&json, &buffer).unwrap_err();
    assert_eq!(fault.place, "cameras[0].perspective.zfar");
    assert!(fault.what.contains("greater than znear"), "{fault}");
    json["cameras"][0]["perspective"] = json!({ "yfov": 0.8, "znear": -1.0 });
    let fault = read_with(&json, &buffer).unwrap_err();
    assert_eq!(fault.place, "cameras[0].perspective.znear");
}

/// The file with colours of its corners, as bytes of accessors of a kind.
fn coloured(kind: (&str, u32), normalized: bool, colours: &[u8]) -> (Value, Vec<u8>) {
    let (mut json, mut buffer) = file(&CUBE.mesh());
    let corners = CUBE.mesh().vertices.len();
    let view = json["bufferViews"].as_array().unwrap().len();
    let at = buffer.len();
    buffer.extend(colours);
    json["buffers"][0]["byteLength"] = buffer.len().into();
    let length = colours.len();
    json["bufferViews"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "buffer": 0, "byteOffset": at, "byteLength": length }));
    json["accessors"].as_array_mut().unwrap().push(json!({
        "bufferView": view, "componentType": kind.1, "normalized": normalized, "count": corners, "type": kind.0,
    }));
    json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 3.into();
    json["materials"][0] = json!({ "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorFactor": [1, 1, 0.5, 1] } });
    (json, buffer)
}

#[test]
fn vertex_colours_multiply_the_base_colour() {
    let corners = CUBE.mesh().vertices.len();
    let floats = [0.5f32, 0.25, 1.0]
        .map(f32::to_le_bytes)
        .concat()
        .repeat(corners);
    let bytes = [128u8, 64, 255, 128].repeat(corners);
    let shorts = [32768u16, 16384, 65535].map(u16::to_le_bytes).concat();
    let shorts = [shorts, vec![0, 0]].concat().repeat(corners);
    for (kind, normalized, data) in [
        (("VEC3", 5126), false, &floats),
        (("VEC4", 5121), true, &bytes),
    ] {
        let (mut json, buffer) = coloured(kind, normalized, data);
        let pixel = read_with(&json, &buffer).unwrap().frame(0).of_material[0][0];
        // The light is (1, .5, .25).
        for (found, wanted) in pixel.other.iter().zip([0.5, 0.125, 0.125]) {
            assert!((found - wanted).abs() < 2e-3, "{kind:?} {:?}", pixel.other);
        }
        assert_eq!(pixel.coverage, 1.0, "{kind:?}");
        json["materials"][0]["alphaMode"] = "BLEND".into();
        let blended = read_with(&json, &buffer).unwrap().frame(0).of_material[0][0];
        let wanted = if kind.0 == "VEC4" { 128.0 / 255.0 } else { 1.0 };
        assert!((blended.coverage - wanted).abs() < 1e-6);
        json["materials"][0]["alphaMode"] = "MASK".into();
        assert_eq!(read_with(&json, &buffer).is_err(), kind.0 == "VEC4");
    }
    // A stride of eight bytes, and numbers that say nothing of their range.
    let (mut json, buffer) = coloured(("VEC3", 5123), true, &shorts);
    json["bufferViews"][2]["byteStride"] = 8.into();
    let pixel = read_with(&json, &buffer).unwrap().frame(0).of_material[0][0];
    assert!((pixel.other[0] - 0.5).abs() < 1e-4, "{:?}", pixel.other);
    json["accessors"][3]["normalized"] = false.into();
    let fault = read_with(&json, &buffer).unwrap_err();
    assert!(fault.what.contains("not normalized"), "{fault}");
    json["accessors"][3]["count"] = 3.into();
    json["accessors"][3]["normalized"] = true.into();
    let fault = read_with(&json, &buffer).unwrap_err();
    assert!(fault.what.contains("3 colours of 24 corners"), "{fault}");
}

/// A colour is mixed of its triangle's corners as positions are.
#[test]
fn vertex_colours_differ_across_a_face() {
    let mesh = CUBE.mesh();
    let red = |x: f64| [x as f32 + 0.5, 0.0, 0.0].map(f32::to_le_bytes).concat();
    let colours: Vec<u8> = mesh
        .vertices
        .iter()
        .flat_map(|vertex| red(vertex.position.x))
        .collect();
    let (json, buffer) = coloured(("VEC3", 5126), false, &colours);
    let frame = read_with(&json, &buffer).unwrap().frame(0);
    // The camera stands 3 m before the middle, the front face is half a metre nearer.
    let slope = (22.5f64).to_radians().tan() / 24.0;
    for pixel in &frame.of_material[0] {
        let x = (f64::from(pixel.place % 64) + 0.5 - 32.0) * slope * 2.5;
        assert!(
            (f64::from(pixel.other[0]) - (x + 0.5)).abs() < 1e-5,
            "{}",
            pixel.place
        );
    }
}

#[test]
fn a_chunk_that_is_padded_with_nul_is_read() {
    let (mut json, buffer) = file(&CUBE.mesh());
    json["buffers"][0].as_object_mut().unwrap().remove("uri");
    // Until its length wants padding.
    json["asset"]["generator"] = "".into();
    while serde_json::to_vec(&json).unwrap().len() % 4 != 1 {
        let name = format!("{}x", json["asset"]["generator"].as_str().unwrap());
        json["asset"]["generator"] = name.into();
    }
    let spaces = glb(&json, &buffer);
    let mut nul = spaces.clone();
    let end = 20 + serde_json::to_vec(&json).unwrap().len();
    assert_eq!(&nul[end..end + 3], b"   ");
    nul[end..end + 3].fill(0);
    let read = |bytes: &[u8]| {
        GltfScene::read(bytes, &VIEW, &mut no_file)
            .unwrap()
            .frame(0)
    };
    assert_eq!(read(&nul), read(&spaces));
}

#[test]
fn what_is_not_read_is_said() {
    let (mut json, buffer) = file(&CUBE.mesh());
    assert_eq!(read_with(&json, &buffer).unwrap().remarks, [""; 0]);
    json["images"] = json!([{ "uri": "a.png" }]);
    json["textures"] = json!([{ "source": 0 }]);
    json["materials"][0]["normalTexture"] = json!({ "index": 0 });
    json["materials"][0]["emissiveFactor"] = json!([1, 0, 0]);
    json["materials"][0]["extensions"] =
        json!({ "KHR_materials_clearcoat": { "clearcoatFactor": 1 } });
    json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_materials_ior"]);
    json["cameras"][0]["perspective"]["aspectRatio"] = 2.0.into();
    json["skins"] = json!([{ "joints": [0] }]);
    let remarks = read_with(&json, &buffer).unwrap().remarks;
    let wanted = [
        "Gold: not read: normalTexture, emissiveFactor",
        "Gold: planned as gold alone; KHR_materials_clearcoat: a coat over it",
        "not read: skins; the scene is drawn as its nodes stand",
        "the extension KHR_lights_punctual is not read",
        "a camera has an aspect of 2.000, and the frames 1.333 (--size)",
    ];
    assert_eq!(remarks.len(), wanted.len(), "{remarks:?}");
    for (remark, wanted) in remarks.iter().zip(wanted) {
        assert!(remark.starts_with(wanted), "{remark}");
    }
}

#[test]
fn a_file_for_later_versions_is_refused() {
    let (mut json, buffer) = file(&CUBE.mesh());
    json["asset"]["minVersion"] = "2.0".into();
    assert!(read_with(&json, &buffer).is_ok());
    json["asset"]["minVersion"] = "2.1".into();
    assert_eq!(
        read_with(&json, &buffer).unwrap_err().place,
        "asset.minVersion"
    );
}

#[test]
fn an_index_of_0_reflects_everything() {
    let (mut json, buffer) = file(&CUBE.mesh());
    let glass = |ior: f64| json!({ "pbrMetallicRoughness": { "metallicFactor": 0 }, "extensions": { "KHR_materials_ior": { "ior": ior } } });
    for (ior, says) in [
        (0.0, "reflects everything"),
        (1.0, "reflects nothing"),
        (0.5, "allows 0, and 1 or more"),
    ] {
        json["materials"][0] = glass(ior);
        let scene = read_with(&json, &buffer).unwrap();
        assert!(
            scene.unplanned[0].reason.contains(says),
            "{}",
            scene.unplanned[0].reason
        );
    }
}
