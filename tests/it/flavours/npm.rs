//! The flavour `npm`: packed and installed by npm, checked by TypeScript, bundled by esbuild, and drawn.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::block;
use super::host::{is_installed_by_the_script, packages, screenshot, shows_a_gold_sphere};
use crate::cli::{OUT, PROGRAM, Place};

/// The largest bundle of one metal for three.js, gzipped.
const MOST_BYTES: usize = 12_000;

/// What `fresnel-gen`, `npm` and `npx` are in the commands of the README: packages are there already, but for the one of the folder.
fn shell(place: &Place, folder: &str, commands: &str) {
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("target");
    let script = format!(
        r#"set -e
cd '{folder}'
own() {{
    HOME="$PWD" command npm install --silent --no-audit --no-fund --offline --legacy-peer-deps "$1"
    for name in three/node_modules/three engines/node_modules/playcanvas engines/node_modules/@babylonjs engines/node_modules/@types engines/node_modules/typescript engines/node_modules/esbuild; do
        [ -e "node_modules/${{name##*/}}" ] || ln -s "{target}/$name" node_modules/
    done
}}
npm() {{ own "$2"; }}
npx() {{ local tool="$1"; shift; local in=$tool; [ "$tool" != tsc ] || in=typescript; "node_modules/$in/bin/$tool" "$@"; }}
fresnel-gen() {{ '{PROGRAM}' "$@"; }}
{commands}
"#,
        target = target.display()
    );
    place.put("script.sh", script);
    let mut bash = Command::new("bash");
    bash.arg(place.path("script.sh"))
        .current_dir(place.path("."));
    let output = bash.output().unwrap();
    let said = [output.stdout, output.stderr].concat();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&said)
    );
}

#[track_caller]
fn is_there() -> bool {
    let what = "the package of npm";
    let parts = [
        ("three", "three", "0.187.0"),
        ("engines", "playcanvas", "2.23.3"),
        ("engines", "@babylonjs/core", "9.35.0"),
        ("engines", "typescript", "5.9.3"),
        ("engines", "@types/three", "0.185.4"),
    ];
    parts.iter().all(|(folder, package, version)| {
        is_installed_by_the_script(package, version);
        packages(what, folder, package, version).is_some()
    })
}

#[test]
fn the_page_of_the_readme_shows_a_gold_sphere() {
    if !is_there() {
        return;
    }
    let place = Place::new();
    place.done("--flavour npm --material gold");
    let readme = place.read(&format!("{OUT}/npm/README.md"));
    fs::create_dir(place.path("try")).unwrap();
    shell(&place, "try", &block(&readme, "sh"));
    shows_a_gold_sphere(&screenshot(&place, &place.path("try")));
}

/// Each module with all that it promises to types, and what must be an error.
const TYPED: &str = r#"
import * as THREE from "three";
import * as GPU from "three/webgpu";
import * as pc from "playcanvas";
import * as BABYLON from "@babylonjs/core";
import { type Material, fitted, gold, materials } from "fresnel-materials";
import { patch, patchWith } from "fresnel-materials/three";
import * as tsl from "fresnel-materials/three/tsl";
import * as playcanvas from "fresnel-materials/playcanvas";
import * as babylon from "fresnel-materials/babylon";

const coat: number | undefined = gold.coat?.index;
const all: Material[] = Object.values(materials);
export const physical: THREE.MeshPhysicalMaterial = patch(new THREE.MeshPhysicalMaterial(), "gold", { coat: 1.5 });
patchWith(new THREE.MeshStandardMaterial(), { method: fitted, coefficients: [[1, 1, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]] });
export const node = tsl.fresnelWith(gold, 0.5);
tsl.patchWith(new GPU.MeshStandardNodeMaterial(), gold);
playcanvas.patchWith(new pc.StandardMaterial(), gold, pc, { coat: 1.5 });
babylon.patch(new BABYLON.PBRMaterial("gold"), "gold", BABYLON);
console.log(coat, all);
// @ts-expect-error
patch(new THREE.MeshStandardMaterial(), "glod");
// @ts-expect-error
patchWith(new THREE.MeshStandardMaterial(), "gold");
// @ts-expect-error
patchWith(new THREE.MeshBasicMaterial(), gold);
// @ts-expect-error
patchWith(new THREE.MeshPhysicalMaterial(), gold, { coats: 1.5 });
// @ts-expect-error
patchWith(new THREE.MeshPhysicalMaterial(), gold, { coat: 1.6 });
// @ts-expect-error
patchWith(new THREE.MeshStandardMaterial(), gold, { coat: 1.5 });
// @ts-expect-error
playcanvas.patchWith(new pc.StandardMaterial(), gold);
"#;

#[test]
fn a_packed_package_is_installed_typed_and_bundled_small() {
    if !is_there() {
        return;
    }
    let place = Place::new();
    place.done("--flavour npm --material gold,water,copper,silver,oil_on_water");
    fs::create_dir(place.path("try")).unwrap();
    place.put("try/all.ts", TYPED);
    // A metal by its constant, with three.js apart.
    let engines = [
        ("three", "three", ""),
        ("three/tsl", "three/webgpu", ""),
        ("playcanvas", "playcanvas", ", THREE"),
        ("babylon", "@babylonjs/core", ", THREE"),
    ];
    for (module, engine, more) in engines {
        let name = module.replace('/', "_");
        let text = format!(
            "import * as THREE from \"{engine}\";\nimport {{ gold, patchWith }} from \"fresnel-materials/{module}\";\nexport default material => patchWith(material, gold{more});\n"
        );
        place.put(&format!("try/{name}.js"), text);
    }
    shell(
        &place,
        "try",
        &format!(
            r#"command npm pack --silent --pack-destination . ../{OUT}/npm >packed
npm install ./"$(cat packed)"
tar -tzf "$(cat packed)" | sort >listed
npx tsc --noEmit --strict --skipLibCheck --target es2022 --module esnext --moduleResolution bundler all.ts
for name in three three_tsl playcanvas babylon; do
    npx esbuild $name.js --bundle --minify --format=esm --external:three --external:three/* --external:playcanvas --external:@babylonjs/core --outfile=$name.out.js --log-level=error
    gzip -9 -c $name.out.js | wc -c >$name.size
done
"#
        ),
    );
    let listed = place.read("try/listed");
    for file in [
        "README.md",
        "package.json",
        "materials.js",
        "materials.d.ts",
        "three.js",
        "three.d.ts",
        "three.tsl.js",
        "three.tsl.d.ts",
        "playcanvas.js",
        "playcanvas.d.ts",
        "babylon.js",
        "babylon.d.ts",
    ] {
        assert!(
            listed.contains(&format!("package/{file}\n")),
            "{file}: {listed}"
        );
    }
    assert_eq!(listed.lines().count(), 12, "{listed}");
    for name in ["three", "three_tsl", "playcanvas", "babylon"] {
        let size: usize = place
            .read(&format!("try/{name}.size"))
            .trim()
            .parse()
            .unwrap();
        println!("{name}: one metal is {size} bytes, minified and gzipped");
        let text = place.read(&format!("try/{name}.out.js"));
        assert!(
            !text.contains("copper") && !text.contains("fitted_dielectric"),
            "{name}"
        );
        assert!(
            size < MOST_BYTES + if name == "babylon" { 500 } else { 0 },
            "{name}: {size}"
        );
    }
}

/// What the package says of versions is what is tried.
#[test]
fn versions_of_engines_are_those_that_are_tried() {
    let place = Place::new();
    place.done("--flavour npm --material gold");
    let json: serde_json::Value =
        serde_json::from_str(&place.read(&format!("{OUT}/npm/package.json"))).unwrap();
    let readme = place.read(&format!("{OUT}/npm/README.md"));
    let ranges = [
        (
            "three",
            ">=0.182.0 <0.188.0",
            "three.js r182 to r187",
            ["three-oldest@npm:three@0.182.0", "three@0.187.0"],
        ),
        (
            "playcanvas",
            ">=2.8.2 <2.24.0",
            "PlayCanvas 2.8.2 to 2.23",
            [
                "playcanvas-oldest@npm:playcanvas@2.8.2",
                "playcanvas@2.23.3",
            ],
        ),
        (
            "@babylonjs/core",
            ">=9.0.0 <9.36.0",
            "Babylon.js 9.0 to 9.35",
            [
                "babylon-oldest@npm:@babylonjs/core@9.0.0",
                "@babylonjs/core@9.35.0",
            ],
        ),
    ];
    let run = include_str!("../../run");
    for (package, range, words, tried) in ranges {
        assert_eq!(json["peerDependencies"][package], range);
        assert_eq!(json["peerDependenciesMeta"][package]["optional"], true);
        assert!(readme.contains(words), "{words}");
        for one in tried {
            assert!(run.contains(one), "tests/run does not install {one}");
        }
    }
    assert_eq!(json["private"], true);
}
