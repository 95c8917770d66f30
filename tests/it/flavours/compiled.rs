//! Adapters that are compiled and not run: each file alone, each two of them in both orders and each twice, all of them together, and the code
//! of the README.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::block;
use super::written;
use crate::cli::{MY_METAL, OUT, Place};
use crate::not_checked;

/// How a compiler takes a program that includes files of a flavour.
struct Way {
    flavour: &'static str,
    /// What tells this way from others.
    name: &'static str,
    command: &'static str,
    package: &'static str,
    options: &'static [&'static str],
    /// The file that the compiler reads.
    program: &'static str,
    /// What stands before the includes.
    before: &'static str,
    /// What stands behind them, with `{gold}` in the place of a use of gold's functions.
    behind: &'static str,
    /// A use of gold's functions.
    gold: &'static str,
    /// The language of the README's code, and what of it stands for a path of the host.
    readme: (&'static str, &'static str),
    /// A use of what the README's code declares.
    readme_use: &'static str,
}

const HLSL_MAIN: &str = "\nTexture2D a;\nTexture2D b;\nSamplerState s;\nfloat4 main(float4 u : TEXCOORD0) : SV_Target\n{\n{gold}\n}\n";
const UNITY_GOLD: &str = "float3 f, i, c; half3 g, j, d; FresnelGold_float(u.x, f); FresnelGold_half((half)u.x, g); FresnelGoldImage_float(u, u.y, i, c); FresnelGoldImage_half((half4)u, (half)u.y, j, d); FresnelOilOnWaterImage_float(u, u.xy, u.y, i, c); FresnelOilOnWaterImage_half((half4)u, (half2)u.xy, (half)u.y, j, d); return float4(f + i + c + float3(g + j + d) + fresnel_gold_fitted(u.y), 1);";
const UNITY_README: &str =
    "return float4(lamp(1, u.xyz, u.yzx, u.zxy, 1, u.xyz) + image(a, b, s, u.x, u.y, 1), 1);";
const UNREAL_GOLD: &str = "return float4(fresnel_gold_fitted(u.x) + fresnel_gold_fitted_image(u) * fresnel_gold_fitted_compensation(u, u.y) + fresnel_oil_on_water_fitted_film_image(u, u.xy) * fresnel_oil_on_water_fitted_film_compensation(u, u.xy, u.y), 1);";
const UNREAL_README: &str =
    "return float4(Lamp(1, u.xyz, u.yzx, u.zxy, 1, u, u.y) + Image(a, b, s, u.x, u.y, 1), 1);";
const DXC: (&str, &str) = ("dxc", "of PyPI, which tests/run fetches");

const fn in_unity(
    name: &'static str,
    before: &'static str,
    options: &'static [&'static str],
) -> Way {
    Way {
        flavour: "unity",
        name,
        command: DXC.0,
        package: DXC.1,
        options,
        program: "program.hlsl",
        before,
        behind: HLSL_MAIN,
        gold: UNITY_GOLD,
        readme: ("hlsl", ""),
        readme_use: UNITY_README,
    }
}

const fn in_unreal(name: &'static str, options: &'static [&'static str]) -> Way {
    Way {
        flavour: "unreal",
        name,
        command: DXC.0,
        package: DXC.1,
        options,
        program: "program.hlsl",
        before: "",
        behind: HLSL_MAIN,
        gold: UNREAL_GOLD,
        readme: ("hlsl", "/Project/fresnel/"),
        readme_use: UNREAL_README,
    }
}

/// Unity defines `half` by the platform (Common.hlsl of its core library).
const WAYS: &[Way] = &[
    in_unity(
        "half is float, as on desktops",
        "#define half float\n#define half2 float2\n#define half3 float3\n#define half4 float4\n#define real float\n#define real3 float3\n",
        &["-HV", "2018", "-T", "ps_6_2", "-E", "main"],
    ),
    in_unity(
        "half is min16float, as on phones",
        "#define half min16float\n#define half2 min16float2\n#define half3 min16float3\n#define half4 min16float4\n#define real half\n#define real3 half3\n#define SHADER_API_MOBILE 1\n",
        &["-HV", "2018", "-T", "ps_6_2", "-E", "main"],
    ),
    in_unity(
        "half is half",
        "",
        &[
            "-HV",
            "2021",
            "-enable-16bit-types",
            "-T",
            "ps_6_2",
            "-E",
            "main",
        ],
    ),
    in_unreal("HLSL 2021", &["-HV", "2021", "-T", "ps_6_2", "-E", "main"]),
    in_unreal(
        "HLSL 2021 to SPIR-V",
        &["-HV", "2021", "-spirv", "-T", "ps_6_2", "-E", "main"],
    ),
    Way {
        flavour: "godot",
        name: "GLSL ES 3.00",
        command: "glslangValidator",
        package: "glslang-tools of Debian",
        options: &["-S", "frag"],
        program: "program.frag",
        // Godot's compatibility renderer writes this head. Its shading language has these names of constants.
        before: "#version 300 es\nprecision highp float;\n#define PI 3.14159265\n#define TAU 6.28318531\nout vec4 seen;\n",
        behind: "\nvoid main() { vec4 u = gl_FragCoord; {gold} }\n",
        gold: "seen = vec4(fresnel_gold_fitted(u.x) + fresnel_gold_fitted_image(u) * fresnel_gold_fitted_compensation(u, u.y), 1.0);",
        readme: ("", ""),
        readme_use: "",
    },
];

/// The text with what it includes, as often as it does: a compiler sees what the host's preprocessor would give it.
fn inlined(folder: &Path, text: &str) -> String {
    let line = |line: &str| match line
        .strip_prefix("#include \"")
        .and_then(|rest| rest.strip_suffix('"'))
    {
        Some(name) => {
            let path = folder.join(name);
            let text = std::fs::read_to_string(&path)
                .unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
            inlined(folder, &text)
        }
        None => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

/// Whether HLSL's `#pragma once` must be left to the compiler, which knows files by their names.
fn includes_itself(way: &Way) -> bool {
    way.command == DXC.0
}

struct Host<'a> {
    way: &'a Way,
    compiler: PathBuf,
    folder: PathBuf,
}

impl Host<'_> {
    #[track_caller]
    fn takes(&self, what: &str, includes: &[&str], use_of_gold: &str) {
        let includes: String = includes
            .iter()
            .map(|name| format!("#include \"{name}\"\n"))
            .collect();
        self.takes_text(what, &includes, use_of_gold);
    }

    #[track_caller]
    fn takes_text(&self, what: &str, text: &str, use_of_gold: &str) {
        let way = self.way;
        let behind = way.behind.replace("{gold}", use_of_gold);
        let text = if includes_itself(way) {
            text.to_owned()
        } else {
            inlined(&self.folder, text)
        };
        let program = self.folder.join(way.program);
        std::fs::write(&program, format!("{}{text}{behind}", way.before)).unwrap();
        let mut command = Command::new(&self.compiler);
        command
            .args(way.options)
            .arg(&program)
            .current_dir(&self.folder);
        let output = command.output().unwrap();
        let said = [output.stdout, output.stderr].concat();
        let said = String::from_utf8_lossy(&said);
        assert!(
            output.status.success(),
            "{}, {}: {what}: {said}",
            way.flavour,
            way.name
        );
    }
}

/// A compiler on the path, or where `tests/run` puts it.
fn find(command: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let fetched = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/tools");
    let mut folders = std::env::split_paths(&path).chain([fetched]);
    folders.find_map(|folder| Some(folder.join(command)).filter(|file| file.is_file()))
}

/// Materials whose names would be one in capitals, or a guard's and a constant's.
const NEAR: [&str; 5] = ["a1", "a_1", "gen", "c0", "included"];

/// What is included: it ends as gold's file does.
fn includable(written: &BTreeSet<String>) -> Vec<String> {
    let gold = written.iter().find(|file| file.contains("/gold."));
    let ending = gold.and_then(|file| file.split_once('.')).map(|it| it.1);
    let ending = format!(".{}", ending.expect("gold has a file"));
    let names = written.iter().filter_map(|file| file.split_once('/'));
    let names = names.map(|(_, name)| name.to_owned());
    names.filter(|name| name.ends_with(&ending)).collect()
}

fn compiles(way: &Way) {
    let Some(compiler) = find(way.command) else {
        let remark = format!(
            "{} for {}: package {}",
            way.command, way.flavour, way.package
        );
        assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
        not_checked(&remark);
        return;
    };
    let place = Place::new();
    let line = format!(
        "--flavour {} --material diamond,gold,oil_on_water,water",
        way.flavour
    );
    let names = includable(&written(&place, &line));
    let host = Host {
        way,
        compiler,
        folder: place.path(&format!("{OUT}/{}", way.flavour)),
    };
    let nothing = if way.command == DXC.0 {
        "return u;"
    } else {
        ""
    };
    for one in &names {
        for other in &names {
            host.takes(&format!("{one}, {other}"), &[one, other], nothing);
        }
    }
    for name in NEAR {
        let material = MY_METAL.replace("\"my_metal\"", &format!("\"{name}\""));
        place.put(&format!("{name}.toml"), material);
    }
    let near = NEAR.map(|name| format!("{name}.toml")).join(",");
    let line = format!("--flavour {} --material {near}", way.flavour);
    let all = includable(&written(&place, &line));
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    host.takes("all files, twice", &all.repeat(2), way.gold);
    let (language, path) = way.readme;
    if !way.readme_use.is_empty() {
        let readme = place.read(&format!("{OUT}/{}/README.md", way.flavour));
        let code = block(&readme, language).replace(path, "");
        host.takes_text("the code of the README", &code, way.readme_use);
    }
}

#[test]
fn compilers_take_what_is_not_run() {
    WAYS.iter().for_each(compiles);
}
