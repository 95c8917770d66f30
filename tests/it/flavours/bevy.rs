//! The flavour `bevy`: composed by naga_oil as Bevy up to 0.19 does it, and run through wgpu. Its WESL holds the same functions.

use std::process::Command;

use naga::back::wgsl;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, NagaModuleDescriptor, get_preprocessor_data,
};

use super::block;
use super::coefficients;
use super::host::shows_a_gold_sphere;
use crate::catalogue::evaluated;
use crate::cli::{OUT, PROGRAM, Place};
use crate::gpu;
use fresnel_gen::lab::gpu::{Backend, ShaderCode};

const MATERIALS: [&str; 6] = [
    "anodised_titanium_purple",
    "diamond",
    "gold",
    "oil_on_water",
    "silver",
    "water",
];
const POINTS: u32 = 512;

fn place() -> Place {
    let place = Place::new();
    place.done(&format!(
        "--flavour bevy --material {}",
        MATERIALS.join(",")
    ));
    place
}

/// The files of an ending: name and text.
fn files(place: &Place, ending: &str) -> Vec<(String, String)> {
    let listed = place
        .listed()
        .into_iter()
        .filter(|file| file.ends_with(ending));
    listed
        .map(|file| {
            let text = place.read(&format!("{OUT}/{file}"));
            (file, text)
        })
        .collect()
}

/// The module of `top`, which imports from files by naga_oil's rules. Every file is composed, in whatever order they lie.
fn composed(files: &[(String, String)], top: &str) -> Result<naga::Module, String> {
    let mut composer = Composer::default();
    // A file waits until those are known that it imports.
    let mut waiting: Vec<&(String, String)> = files.iter().collect();
    while !waiting.is_empty() {
        let before = waiting.len();
        let mut faults = String::new();
        waiting.retain(|(name, text)| {
            let (_, imports, _) = get_preprocessor_data(text);
            let is_known = |import: &str| composer.contains_module(import);
            if !imports.iter().all(|import| is_known(&import.import)) {
                return true;
            }
            let descriptor = ComposableModuleDescriptor {
                source: text,
                file_path: name,
                ..Default::default()
            };
            match composer.add_composable_module(descriptor) {
                Ok(_) => false,
                Err(fault) => {
                    faults += &format!("{name}: {:?}\n", fault.inner);
                    true
                }
            }
        });
        if waiting.len() == before {
            return Err(format!("{} waits for ever; {faults}", waiting[0].0));
        }
    }
    let descriptor = NagaModuleDescriptor {
        source: top,
        file_path: "top.wgsl",
        ..Default::default()
    };
    let made = composer.make_naga_module(descriptor);
    made.map_err(|fault| fault.emit_to_string(&composer))
}

/// The text of a module that naga finds valid.
fn valid(module: &naga::Module) -> String {
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator.validate(module).expect("naga finds it valid");
    wgsl::write_string(module, &info, wgsl::WriterFlags::empty()).expect("it is WGSL")
}

/// The name of the function of each material.
fn functions() -> Vec<(&'static str, String)> {
    let rows = coefficients(&MATERIALS);
    let pairs = MATERIALS.iter().zip(&rows);
    pairs
        .map(|(name, (method, _))| (*name, format!("fresnel_{name}_{method}")))
        .collect()
}

/// A compute shader that evaluates a material, by its place, at a cosine.
fn sweep() -> String {
    let all = functions();
    let imports = all
        .iter()
        .map(|(material, function)| format!("#import fresnel_gen::{material}::{function}\n"));
    let imports: String = imports.collect();
    let cases = all
        .iter()
        .enumerate()
        .map(|(i, (_, function))| format!("        case {i}u: {{ f = {function}(asked.y); }}\n"));
    let cases: String = cases.collect();
    format!(
        "{imports}
@group(0) @binding(1) var<storage, read> points: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> results: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) invocation: vec3<u32>) {{
    let index = invocation.x;
    if index >= arrayLength(&points) {{
        return;
    }}
    let asked = points[index];
    var f = vec3<f32>(0.0);
    switch u32(asked.x) {{
{cases}        default: {{}}
    }}
    results[index] = vec4<f32>(f, 1.0);
}}
"
    )
}

#[test]
fn naga_oil_composes_it_and_wgpu_runs_it() {
    let place = place();
    let module =
        composed(&files(&place, ".wgsl"), &sweep()).unwrap_or_else(|fault| panic!("{fault}"));
    let program = valid(&module);
    let Some(device) = gpu::device(Backend::Vulkan) else {
        return;
    };
    let cosines: Vec<f64> = (0..=POINTS)
        .map(|i| f64::from(i) / f64::from(POINTS))
        .collect();
    let points: Vec<[f32; 4]> = (0..MATERIALS.len())
        .flat_map(|i| cosines.iter().map(move |c| [i as f32, *c as f32, 0.0, 0.0]))
        .collect();
    let batch = device.prepare_batch(&gpu::program(ShaderCode::Wgsl(&program), &[]), 1);
    let results = batch.unwrap().run(&points, None).unwrap();
    let rows = coefficients(&MATERIALS);
    for ((got, (method, coefficients)), name) in results
        .chunks_exact(cosines.len())
        .zip(&rows)
        .zip(MATERIALS)
    {
        let want = evaluated(method, coefficients, &cosines);
        let pairs = got.iter().flatten().zip(want.iter().flatten());
        let off = pairs
            .map(|(got, want)| (f64::from(*got) - want).abs())
            .fold(0.0, f64::max);
        assert!(off < 2e-6, "{name} is off by {off}");
    }
}

#[test]
fn a_material_comes_twice() {
    let place = place();
    let mut files = files(&place, ".wgsl");
    let between = |name: &str| {
        let text = format!(
            "#define_import_path mine::{name}\n#import fresnel_gen::gold::fresnel_gold_fitted\nfn {name}(c: f32) -> vec3<f32> {{ return fresnel_gold_fitted(c); }}\n"
        );
        (format!("{name}.wgsl"), text)
    };
    files.extend(["first_user", "second_user"].map(between));
    let top = "#import mine::first_user::first_user\n#import mine::second_user::second_user\n#import fresnel_gen::gold::fresnel_gold_fitted\n@fragment\nfn main() -> @location(0) vec4<f32> { return vec4<f32>(first_user(0.5) + second_user(0.5) + fresnel_gold_fitted(0.5), 1.0); }\n";
    valid(&composed(&files, top).unwrap_or_else(|fault| panic!("{fault}")));
}

/// Stand-ins for modules of Bevy that the README's shader imports: a lamp above and before the sphere, and an eye at z = 4.
const BEVY: [(&str, &str); 2] = [
    (
        "forward_io.wgsl",
        "#define_import_path bevy_pbr::forward_io
struct VertexOutput {
    @builtin(position) position: vec4<f32>,
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
}
",
    ),
    (
        "mesh_view_bindings.wgsl",
        "#define_import_path bevy_pbr::mesh_view_bindings
struct DirectionalLight { color: vec4<f32>, direction_to_light: vec3<f32> }
struct Lights { directional_lights: array<DirectionalLight, 1> }
struct View { world_position: vec3<f32>, exposure: f32 }
const lights: Lights = Lights(array<DirectionalLight, 1>(DirectionalLight(vec4<f32>(1.0), vec3<f32>(0.40824829, 0.40824829, 0.81649658))));
const view: View = View(vec3<f32>(0.0, 0.0, 4.0), 0.8);
",
    ),
];

/// The README's shader on a sphere, as its program draws it: the fragment of each point that an eye sees.
const SPHERE: &str = "
@group(0) @binding(1) var<storage, read> points: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> results: array<vec4<f32>>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) invocation: vec3<u32>) {
    if invocation.x >= arrayLength(&points) {
        return;
    }
    let ray = normalize(vec3<f32>(points[invocation.x].xy, -1.0));
    let nearest = -4.0 * ray.z;
    let under_root = nearest * nearest - 15.0;
    var seen = vec4<f32>(0.0);
    if under_root > 0.0 {
        let at = vec3<f32>(0.0, 0.0, 4.0) + (nearest - sqrt(under_root)) * ray;
        seen = fragment(VertexOutput(vec4<f32>(0.0), vec4<f32>(at, 1.0), at));
    }
    results[invocation.x] = seen;
}
";

/// The README as a newcomer follows it, but for Cargo, and its shader on a sphere.
#[test]
fn the_readme_shows_a_gold_sphere() {
    const SIDE: u32 = 128;
    let place = Place::new();
    place.done("--flavour bevy --material gold");
    let readme = place.read(&format!("{OUT}/bevy/README.md"));
    let commands = block(&readme, "sh");
    let count = commands
        .lines()
        .filter(|line| !line.starts_with('#'))
        .count();
    assert!(count < 10, "{count} commands: {commands}");
    let script = format!(
        "set -e\ncargo() {{ if [ \"$1\" = new ]; then mkdir \"$2\"; fi; }}\nfresnel-gen() {{ '{PROGRAM}' \"$@\"; }}\n{commands}"
    );
    place.put("script.sh", script);
    let mut shell = Command::new("bash");
    let ran = shell.arg("script.sh").current_dir(place.path("."));
    assert!(ran.status().unwrap().success(), "{commands}");
    let mut files: Vec<(String, String)> = ["fresnel", "gold"]
        .map(|name| {
            let file = format!("sphere/assets/fresnel/{name}.wgsl");
            (name.to_owned(), place.read(&file))
        })
        .into();
    files.extend(BEVY.map(|(name, text)| (name.to_owned(), text.to_owned())));
    let shader = block(&readme, "wgsl");
    valid(&composed(&files, &shader).unwrap_or_else(|fault| panic!("{fault}")));
    // An entry cannot be called.
    let called = shader
        .replace("@fragment\n", "")
        .replace("@location(0) ", "");
    let module = composed(&files, &(called + SPHERE)).unwrap_or_else(|fault| panic!("{fault}"));
    let Some(device) = gpu::device(Backend::Vulkan) else {
        return;
    };
    let across = |i: u32| 0.6 * (f64::from(i) + 0.5) / f64::from(SIDE) - 0.3;
    let points: Vec<[f32; 4]> = (0..SIDE * SIDE)
        .map(|i| [across(i % SIDE) as f32, -across(i / SIDE) as f32, 0.0, 0.0])
        .collect();
    let batch = device.prepare_batch(&gpu::program(ShaderCode::Wgsl(&valid(&module)), &[]), 1);
    let seen = batch.unwrap().run(&points, None).unwrap();
    let picture = image::RgbImage::from_fn(SIDE, SIDE, |x, y| {
        let pixel = seen[(y * SIDE + x) as usize];
        let code = |v: f32| 255.0 * f64::from(v).clamp(0.0, 1.0).powf(1.0 / 2.2);
        image::Rgb([0, 1, 2].map(|channel| code(pixel[channel]).round() as u8))
    });
    shows_a_gold_sphere(&picture);
}

/// What tells the two languages apart: comments, and lines that import.
fn is_code(line: &&str) -> bool {
    let is_other = ["//", "#define_import_path", "#import", "import "];
    !line.is_empty() && !is_other.iter().any(|start| line.starts_with(start))
}

/// No linker of WESL takes the Rust that this project states, so its files are held to their twins and to naga without their imports.
#[test]
fn wesl_holds_the_same_functions() {
    let place = place();
    let twins = files(&place, ".wgsl");
    let mut whole = String::new();
    for (name, text) in files(&place, ".wesl") {
        let twin = name.replace(".wesl", ".wgsl");
        let (_, other) = twins
            .iter()
            .find(|(name, _)| *name == twin)
            .expect("it has a twin");
        let code: Vec<&str> = text.lines().filter(is_code).collect();
        assert_eq!(
            code,
            other.lines().filter(is_code).collect::<Vec<_>>(),
            "{name}"
        );
        whole += &(code.join("\n") + "\n");
    }
    let module = naga::front::wgsl::parse_str(&whole);
    valid(&module.unwrap_or_else(|fault| panic!("{}", fault.emit_to_string(&whole))));
}
