//! Compilers that are not ours accept every file of every target. What is not installed is named as not checked; where
//! `CI` is set that is a failure.

mod accepts;
mod catalogue;
mod msl;
mod second;
mod spirv;

use std::ffi::OsStr;
use std::process::Command;
use std::sync::{LazyLock, Mutex};

use serde_json::json;

use crate::not_checked;
use fresnel_gen::generator::emit::Artifact;
use fresnel_gen::generator::emit::Detail;
use fresnel_gen::generator::lut::{self, TableAxis};
use fresnel_gen::generator::request::{DEFAULT_MATERIALS, Materials, Methods, Request, Source};
use fresnel_gen::generator::{emit, generate};
use fresnel_gen::language::methods::Method;
use fresnel_gen::language::targets::Target;
use fresnel_gen::language::{effects, methods, targets};
use fresnel_gen::physics::num::Precision;

/// A program that only the tests call, and the Debian package that holds it.
pub struct Tool {
    pub command: &'static str,
    pub package: &'static str,
}

impl Tool {
    /// Whether it is there. Where it is not, the run says what stays unchecked.
    #[track_caller]
    pub fn is_here(&self, what: &str) -> bool {
        let found = Command::new(self.command).arg("--version").output().is_ok();
        if !found {
            let (command, package) = (self.command, self.package);
            let remark = format!("{what}: no {command} (Debian package {package})");
            assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
            not_checked(&remark);
        }
        found
    }

    /// What it prints, or all that it printed when it refused.
    pub fn run<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Judgement {
        let output = Command::new(self.command).args(arguments).output().unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let stdout = text(&output.stdout);
        if output.status.success() {
            return Ok(stdout);
        }
        Err(format!("{stdout}{}", text(&output.stderr)))
    }
}

/// What a compiler says of a file: its output, or its complaints.
pub type Judgement = Result<String, String>;

/// Everything that is to be compiled.
static FILES: LazyLock<Vec<Artifact>> = LazyLock::new(all_files);

/// All files of a target.
pub fn files(target: &str) -> Vec<&'static Artifact> {
    let files: Vec<_> = FILES.iter().filter(|file| file.target == target).collect();
    assert!(files.len() > methods::ALL.len(), "{target} has few files");
    files
}

/// The library and the materials of the tree without flags: names of these must not meet in one unit.
pub fn tree(target: &str) -> Vec<&'static Artifact> {
    let folder = format!("{target}/");
    let mut files = files(target);
    files.retain(|file| file.path.starts_with(&folder));
    let count = methods::ALL.len() + DEFAULT_MATERIALS.len() + effects::ALL.len();
    assert_eq!(files.len(), count);
    files
}

pub fn text(file: &Artifact) -> &str {
    std::str::from_utf8(&file.bytes).unwrap()
}

/// One unit of all these files.
pub fn joined(files: &[&Artifact]) -> String {
    files.iter().map(|file| text(file)).collect()
}

/// Judges all of these on a few threads, and fails with every complaint.
#[track_caller]
pub fn accepted<T: Sync>(items: &[T], judge: impl Fn(&T) -> Judgement + Sync) {
    let complaints = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for part in items.chunks(items.len().div_ceil(4).max(1)) {
            scope.spawn(|| {
                let refused = part.iter().filter_map(|item| judge(item).err());
                complaints.lock().unwrap().extend(refused);
            });
        }
    });
    let complaints = complaints.into_inner().unwrap();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// The tree without flags in all languages; each material with all methods that it can have, and in a medium; the
/// library without a prefix, where names are most likely to meet a language's own.
fn all_files() -> Vec<Artifact> {
    let mut files = made(&Request::default(), "");
    let named = |name: &str| Source::Named(name.to_string());
    for material in DEFAULT_MATERIALS {
        let request = Request {
            materials: Materials::These(vec![named(material)]),
            ..Request::default()
        };
        let every = Request {
            methods: methods_of(&request),
            ..request.clone()
        };
        files.extend(specialised(made(&every, "every/")));
        let immersed = Request {
            medium: Some(named("water_thesis")),
            ..request
        };
        files.extend(specialised(made(&immersed, "immersed/")));
    }
    let unprefixed = Request {
        materials: Materials::None,
        prefix: String::new(),
        ..Request::default()
    };
    files.extend(made(&unprefixed, "unprefixed/"));
    files.extend(in_half());
    files.extend(lookups(&files[0].detail));
    files
}

/// All methods in half precision, those too that cannot be saved there: as a library, and for each material.
fn in_half() -> Vec<Artifact> {
    let half = Request {
        precision: Precision::F16,
        force: true,
        ..Request::default()
    };
    let mut files = made(&half, "half/");
    for material in DEFAULT_MATERIALS {
        let request = Request {
            materials: Materials::These(vec![Source::Named(material.to_owned())]),
            ..half.clone()
        };
        let every = Request {
            methods: methods_of(&request),
            ..request
        };
        files.extend(specialised(made(&every, "half-every/")));
    }
    files
}

/// What a file's functions compute in.
pub fn precision(file: &Artifact) -> Precision {
    let detail = json!(file.detail);
    let said = detail["precision"].as_str();
    said.map_or(Precision::F32, |name| Precision::find(name).unwrap())
}

/// Functions that read baked tables: along every axis, with row and scale as constants and as arguments.
fn lookups(detail: &Detail) -> Vec<Artifact> {
    let text = targets::ALL.iter().copied();
    let text = text.filter(|target| target.finish != targets::Finish::Spirv);
    let kinds = [(Some(1.0), 1), (Some(1.058_7), 4), (None, 1), (None, 4)];
    let every = text.flat_map(|target| TableAxis::ALL.map(|axis| (target, axis)));
    every
        .flat_map(|(target, axis)| {
            kinds.map(|(scale, rows)| lookup(target, axis, (scale, rows), detail))
        })
        .collect()
}

/// A file with the detail of another, which tells the name of the function.
fn lookup(
    target: &'static Target,
    axis: TableAxis,
    (scale, rows): (Option<f32>, usize),
    detail: &Detail,
) -> Artifact {
    let name = format!("fresnel_{}_{rows}_{}_table", axis.name(), scale.is_some());
    let function = lut::lookup(axis, 64, scale, rows).unwrap();
    let bytes = emit::lookup(target, name.clone(), function, Vec::new()).unwrap();
    let mut detail = detail.clone();
    if let Detail::Functions(file) = &mut detail {
        file.functions.truncate(1);
        file.functions[0].name.clone_from(&name);
    }
    Artifact {
        path: format!("lookups/{name}.{}", target.extension),
        target: target.name.to_owned(),
        effect: None,
        method: None,
        material: None,
        detail,
        bytes,
    }
}

/// What a request gives in all languages, its paths below a folder of this name.
fn made(request: &Request, variant: &str) -> Vec<Artifact> {
    let request = Request {
        targets: targets::ALL.to_vec(),
        ..request.clone()
    };
    let mut files = generate(&request).unwrap().artifacts;
    for file in &mut files {
        file.path.insert_str(0, variant);
    }
    files
}

/// Without the library, which the tree without flags holds already.
fn specialised(files: Vec<Artifact>) -> impl Iterator<Item = Artifact> {
    files.into_iter().filter(|file| file.material.is_some())
}

/// The methods that can be specialised to the material of a request: those that generation does not refuse.
fn methods_of(request: &Request) -> Methods {
    let is_possible = |method: &&'static Method| {
        let alone = Request {
            targets: vec![Target::HLSL],
            methods: Methods::These(vec![method]),
            ..request.clone()
        };
        generate(&alone).is_ok()
    };
    let all = methods::ALL.iter().copied();
    let possible: Vec<&Method> = all.filter(is_possible).collect();
    assert!(possible.len() > 3, "{possible:?}");
    Methods::These(possible)
}
