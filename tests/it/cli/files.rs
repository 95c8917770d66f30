//! A user's files: nothing is removed or replaced that the program did not write and can prove so; runs at once in one
//! folder lose nothing.

use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use super::MY_METAL;
use super::OUT;
use super::Place;
use super::contents;
use fresnel_gen::generator::output::folder;
use fresnel_gen::generator::output::lock::{self, Lock};
use fresnel_gen::language::methods;
use fresnel_gen::physics::digest::sha256;

/// Files that look like ours and are the user's: a shader with a pasted function, a copy, what `-o` wrote.
#[test]
fn a_run_without_flags_removes_nothing_of_others() {
    let place = Place::new();
    let pasted = place.run("--method schlick --target gles -o -").ends(0).out;
    let mine = [
        ("gles/water.glsl", format!("{pasted}\nvoid main() {{}}\n")),
        ("gles/materials/old_gold.glsl", pasted.clone()),
        ("wgsl/fresnel_mine.wgsl", pasted),
    ];
    for (path, text) in &mine {
        place.put(&format!("{OUT}/{path}"), text);
    }
    let ran = place.done("generate");
    for (path, text) in &mine {
        assert_eq!(&place.read(&format!("{OUT}/{path}")), text);
        assert!(ran.err.contains(&format!("left alone: {path}")), "{ran:?}");
    }
    let check = place.done("--check");
    assert_eq!(check.out, "", "what stays is no finding");
    assert!(
        check.err.contains("left alone: gles/water.glsl"),
        "{check:?}"
    );
}

/// An orphan that somebody edited stays, is named once, and leaves the manifest.
#[test]
fn an_edited_orphan_stays() {
    let place = Place::new();
    place.done("--target gles --method schlick --prefix old_");
    let path = format!("{OUT}/gles/old_schlick.glsl");
    place.put(&path, place.read(&path) + "// mine\n");
    let check = place.run("--target gles --method schlick --check").ends(1);
    assert!(!check.out.contains("orphan"), "{check:?}");
    let ran = place.done("--target gles --method schlick");
    assert!(
        ran.err.contains("left alone: gles/old_schlick.glsl"),
        "{ran:?}"
    );
    assert!(place.read(&path).ends_with("// mine\n"));
    assert_eq!(place.listed(), ["gles/fresnel_schlick.glsl"]);
    let again = place.done("--target gles --method schlick");
    assert!(!again.err.contains("left alone"), "{again:?}");
}

#[test]
fn a_hostile_manifest_removes_nothing() {
    let place = Place::new();
    place.put("src/main.rs", "fn main() {}\n");
    let hash = sha256(b"fn main() {}\n");
    for hash in ["0", &hash] {
        place.put(
            "manifest.json",
            format!(
                r#"{{"tool":"fresnel-gen","version":"0.1.0","naga":"","inputs":[],"files":[{{"file":"src/main.rs","target":"gles","method":"schlick","material":null,"sha256":"{hash}"}}]}}"#
            ),
        );
        place.done("--target gles --method schlick --material none --out-dir .");
        assert_eq!(place.read("src/main.rs"), "fn main() {}\n");
        assert!(place.read("manifest.json").contains("src/main.rs"));
    }
}

#[test]
fn a_newer_manifest_is_not_touched() {
    let place = Place::new();
    place.done("--target gles --method schlick");
    let manifest = format!("{OUT}/manifest.json");
    let text = place.read(&manifest);
    assert!(text.contains("\"schema\": 1,"), "{text}");
    place.put(&manifest, text.replace("\"schema\": 1,", "\"schema\": 2,"));
    for line in ["--target gles --method schlick", "--target gles --check"] {
        place.refused(line, &["manifest.json:3:", "a newer fresnel-gen wrote it"]);
    }
    let conflict = text.replace(
        "  \"schema\": 1,",
        "<<<<<<< HEAD\n\"schema\": 1,\n>>>>>>> x",
    );
    place.put(&manifest, conflict);
    place.refused(
        "--target gles --method schlick",
        &["manifest.json:3:1: it holds a merge conflict", "--theirs"],
    );
}

/// A file of the user's own lies at an output path: nothing is written, and `--overwrite` takes it.
#[test]
fn what_is_not_ours_is_not_replaced() {
    let lut = format!("{OUT}/lut/gold.png");
    let shader = format!("{OUT}/gles/fresnel_schlick.glsl");
    for (line, path) in [
        ("--target gles --method schlick,fitted", shader.as_str()),
        ("bake --material gold,water", lut.as_str()),
        ("chart --material gold,platinum --out-dir .", "chart.svg"),
        ("chart --material gold,platinum --out-dir .", "chart.html"),
        ("stability --method schlick --out-dir .", "index.html"),
        ("stability --method schlick --out-dir .", "schlick_eta.png"),
        ("reproduce figures --out-dir .", "figure-1-gold.svg"),
    ] {
        let path = match path {
            "figure-1-gold.svg" => &some_figure(),
            other => other,
        };
        let place = Place::new();
        place.put(path, "mine\n");
        place.refused(
            line,
            &[path, "did not write", "nothing was written", "--overwrite"],
        );
        place.done(&format!("{line} --overwrite"));
        assert_ne!(place.path(path).metadata().unwrap().len(), 5, "{line}");
        // What a run wrote bears its mark, or is listed: the next one replaces it.
        place.done(line);
    }
}

/// The name of a figure that `reproduce` draws.
fn some_figure() -> String {
    let place = Place::new();
    place.done("reproduce figures --out-dir .");
    let mut names = contents(&place.path("")).into_keys();
    names.find(|name| name.ends_with(".svg")).unwrap()
}

/// What is named on the command line is replaced, as a compiler replaces its output.
#[test]
fn what_the_user_names_is_replaced() {
    let place = Place::new();
    for (line, path) in [
        ("--method schlick --target wgsl -o mine", "mine"),
        ("--method schlick --depfile mine", "mine"),
        ("methods --json mine", "mine"),
        ("materials show gold --svg mine", "mine"),
    ] {
        place.put(path, "mine\n");
        place.done(line);
        assert_ne!(place.read(path), "mine\n", "{line}");
    }
}

#[test]
fn an_edited_file_of_ours_is_replaced_and_named() {
    let place = Place::new();
    place.done("--target gles --method schlick");
    let path = format!("{OUT}/gles/fresnel_schlick.glsl");
    let text = place.read(&path);
    place.put(&path, text.clone() + "// mine\n");
    let ran = place.done("--target gles --method schlick");
    let said = "replaced: gles/fresnel_schlick.glsl, which was changed";
    assert!(ran.err.contains(said), "{ran:?}");
    assert_eq!(place.read(&path), text);
    // Version control that changes ends of lines makes no difference.
    place.put(&path, text.replace('\n', "\r\n"));
    place.done("--target gles --method schlick --check");
}

#[test]
fn tables_that_bake_writes_are_listed_and_stay() {
    let place = Place::new();
    place.done("bake --material gold,silver --format c,png8 --target gles");
    let tables: BTreeSet<String> = place.listed().into_iter().collect();
    let there = contents(&place.path(OUT)).into_keys();
    let there: BTreeSet<String> = there.filter(|path| path != "manifest.json").collect();
    assert_eq!(tables, there);
    place.done("generate");
    let listed: BTreeSet<String> = place.listed().into_iter().collect();
    assert!(tables.is_subset(&listed));
    assert!(
        tables
            .iter()
            .all(|path| place.path(OUT).join(path).exists())
    );
    place.done("--check");
    // The same tables by `bake` or by a run without flags: the same manifest.
    let manifest = place.manifest();
    place.done("bake --atlas");
    assert_eq!(place.manifest(), manifest);
}

/// Binary files say who wrote them as well.
#[test]
fn binary_files_bear_the_mark() {
    let place = Place::new();
    place.done("bake --material gold --format exr-half,exr-float,png8,png16,ktx2 --out-dir .");
    place.done("stability --method schlick --out-dir maps");
    fs::remove_file(place.path("manifest.json")).unwrap();
    let files = contents(&place.path(""));
    for (path, bytes) in &files {
        assert!(
            fresnel_gen::generator::output::ownership::bears_mark(bytes),
            "{path}"
        );
    }
    // Without a manifest the mark is what lets a run replace them.
    place.done(
        "bake --material gold --size 32 --format exr-half,exr-float,png8,png16,ktx2 --out-dir .",
    );
}

/// Runs at once, of different methods, targets and materials and of the same: every one ends well, and the manifest
/// lists all.
#[test]
fn runs_at_once_lose_nothing() {
    for count in [2, 8, 32] {
        let place = Place::new();
        let names: Vec<&str> = methods::ALL.iter().map(|method| method.name).collect();
        let lines: Vec<String> = (0..count)
            .map(|at| match at % 4 {
                0 => format!("--target wgsl --method {}", names[at / 2 % names.len()]),
                1 => format!("--target gles,hlsl --method {}", names[at % names.len()]),
                2 => "--target gles --method schlick,fitted".to_owned(),
                _ => format!(
                    "bake --material {} --size 16",
                    ["gold", "water"][at / 4 % 2]
                ),
            })
            .collect();
        let start = |line: &String| -> Child {
            let words: Vec<&str> = line.split(' ').collect();
            let mut command = place.command(&words);
            let command = command.stdout(Stdio::null()).stderr(Stdio::piped());
            command.spawn().unwrap()
        };
        let children: Vec<Child> = lines.iter().map(start).collect();
        for (line, child) in lines.iter().zip(children) {
            let output = child.wait_with_output().unwrap();
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success(), "{count} at once: {line}: {said}");
        }
        let there = contents(&place.path(OUT)).into_keys();
        let there: BTreeSet<String> = there.filter(|path| path != "manifest.json").collect();
        assert_eq!(there, place.listed().into_iter().collect(), "{count}");
        for line in lines.iter().filter(|line| !line.starts_with("bake")) {
            place.done(&format!("{line} --check"));
        }
    }
}

/// A run that waits for another says so after a second, and goes on when the other ends.
#[test]
fn a_wait_is_announced() {
    let place = Place::new();
    let held = Lock::take(&place.path(OUT), &|_| ());
    let words = ["--target", "gles", "--method", "schlick"];
    let mut child = (place.command(&words).stderr(Stdio::piped()))
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let said = lines.next().unwrap().unwrap();
    assert!(said.contains("another run writes there; waiting"), "{said}");
    assert!(!place.path(OUT).join("gles").exists());
    // `--check` waits for nobody.
    place.run("--target gles --method schlick --check").ends(1);
    drop(held);
    assert!(child.wait().unwrap().success());
    assert!(!place.path(OUT).join(lock::FILE).exists());
}

/// Something of the user's own in the lock's place is neither removed nor waited for.
#[test]
fn a_file_of_others_in_the_locks_place_stays() {
    let place = Place::new();
    let path = format!("{OUT}/{}", lock::FILE);
    place.put(&path, "mine\n");
    let ran = place.done("--target gles --method schlick");
    assert!(ran.err.contains("is not a lock of fresnel-gen"), "{ran:?}");
    assert_eq!(place.read(&path), "mine\n");
    #[cfg(unix)]
    {
        fs::remove_file(place.path(&path)).unwrap();
        std::os::unix::fs::symlink("/dev/null", place.path(&path)).unwrap();
        place.done("--target hlsl --method schlick");
        assert!(
            fs::symlink_metadata(place.path(&path))
                .unwrap()
                .is_symlink()
        );
    }
}

/// A run that finds nothing to write leaves no folder behind, nor a lock.
#[test]
fn a_refused_run_leaves_nothing() {
    let place = Place::new();
    place.refused("--target gles --method nothing", &["there is no method"]);
    assert!(!place.path(OUT).exists());
    place.done("--target gles --method schlick");
    assert!(!place.path(OUT).join(lock::FILE).exists());
}

/// A run never writes over what it reads, nor one of its outputs over another.
#[test]
fn an_output_is_no_input_and_no_other_output() {
    let place = Place::new();
    place.put("my.toml", MY_METAL);
    place.put("t.csv", "nm,n,k\n380,1.4,1.7\n780,0.2,3.9\n");
    place.put("light.txt", "380 1\n780 1\n");
    place.done("--method schlick --target gles --material none");
    let shader = format!("{OUT}/gles/fresnel_schlick.glsl");
    let manifest = format!("{OUT}/manifest.json");
    for line in [
        "--material my.toml --method schlick -o my.toml",
        "--material my.toml --method schlick --target gles --depfile my.toml",
        "--material gold --method schlick --illuminant light.txt -o light.txt",
        "materials params my.toml --json my.toml",
        "materials show my.toml --svg my.toml",
        "materials import t.csv --name tt -o t.csv",
        "bake --material my.toml --json my.toml",
        "fit --material my.toml --json my.toml",
        "chart --material my.toml --json my.toml",
        "stability --material my.toml --json my.toml",
    ] {
        place.refused(line, &["this run reads that file"]);
    }
    let line = "--method schlick --target wgsl -o s.wgsl --depfile s.wgsl";
    place.refused(line, &["two outputs of this run"]);
    for line in [
        format!("--method schlick --target gles --material none --depfile {shader}"),
        format!("--method schlick --target gles --material none --depfile {manifest}"),
        format!("bake --material gold --json {manifest}"),
        format!("bake --material gold --json {OUT}/lut/gold.json"),
    ] {
        place.refused(&line, &["a file of the generated tree lies there"]);
    }
}

#[test]
fn a_report_says_which_files_it_replaced() {
    let place = Place::new();
    let line = "chart --material gold,platinum --out-dir .";
    place.done(line);
    assert!(!place.done(line).err.contains("replaced"));
    place.put("chart.html", place.read("chart.html") + "<!-- mine -->\n");
    let ran = place.done(line);
    assert!(ran.err.contains("replaced: ./chart.html"), "{ran:?}");
}

/// What a killed run left beside an output that the user names: the next run of that output removes it. Nobody waits for a run that
/// is at work, nor touches its file. What else lies under such a name is left alone.
#[cfg(unix)]
#[test]
fn an_output_leaves_no_temporary_file_for_ever() {
    let place = Place::new();
    let temporary = || folder::temporary_of(&place.path("a.wgsl"));
    let (left, other) = (temporary(), temporary());
    assert_ne!(left, other, "nobody knows the name before");
    place.put(&left, "half a function");
    place.put(&other, "half a function");
    place.done("--method schlick -o a.wgsl");
    assert_eq!(place.files().keys().collect::<Vec<_>>(), ["a.wgsl"]);

    let (link, at_work) = (temporary(), temporary());
    place.put("mine.txt", "mine");
    std::os::unix::fs::symlink(place.path("mine.txt"), place.path(&link)).unwrap();
    let held = lock::create_held(&place.path(&at_work)).unwrap();
    let pipe = temporary();
    let made = Command::new("mkfifo").arg(place.path(&pipe)).status();
    assert!(made.unwrap().success());
    fs::create_dir(place.path(&temporary())).unwrap();
    place.done("--method schlick_f90 -o a.wgsl");
    assert!(place.read("a.wgsl").contains("fn fresnel_schlick_f90("));
    assert_eq!(place.read("mine.txt"), "mine");
    assert!(place.path(&link).is_symlink() && place.path(&at_work).exists());
    assert!(place.path(&pipe).exists());
    drop(held);
    place.done("--method schlick -o a.wgsl");
    assert!(!place.path(&at_work).exists());
}

/// Outputs of two runs at once, crosswise: none waits for the other for ever.
#[test]
fn named_outputs_of_runs_at_once_are_whole() {
    let place = Place::new();
    let start = |at: usize| {
        let (one, two) = [("a", "b"), ("b", "a")][at % 2];
        let line = format!("--method schlick --target wgsl -o {one} --depfile {two}");
        let words: Vec<&str> = line.split(' ').collect();
        place.command(&words).spawn().unwrap()
    };
    let children: Vec<Child> = (0..16).map(start).collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    assert_eq!(place.files().keys().collect::<Vec<_>>(), ["a", "b"]);
    for file in ["a", "b"] {
        let text = place.read(file);
        assert!(
            text.ends_with("}\n") || text.ends_with(":\n"),
            "{file}: {text}"
        );
    }
}

/// Keys of others in the manifest stay, a file listed twice is removed once and named once.
#[test]
fn a_manifest_keeps_the_keys_of_others() {
    let place = Place::new();
    place.done("--target gles --method schlick,schlick_f90 --material none");
    let file = format!("{OUT}/manifest.json");
    let mut manifest: serde_json::Value = serde_json::from_str(&place.read(&file)).unwrap();
    manifest["team"] = "lighting".into();
    place.put(&file, serde_json::to_string_pretty(&manifest).unwrap());
    place.done("--target gles --method schlick --material none");
    let mut manifest: serde_json::Value = serde_json::from_str(&place.read(&file)).unwrap();
    assert_eq!(manifest["team"], "lighting");

    // An orphan, listed twice.
    let old = format!("{OUT}/gles/old_schlick.glsl");
    let text = "// @generated by fresnel-gen\n// old_schlick\n";
    place.put(&old, text);
    let mut entry = manifest["files"][0].clone();
    entry["file"] = "gles/old_schlick.glsl".into();
    entry["method"] = "schlick".into();
    entry["sha256"] = sha256(text.as_bytes()).into();
    let files = manifest["files"].as_array_mut().unwrap();
    files.extend([entry.clone(), entry]);
    place.put(&file, manifest.to_string());
    let ran = place.done("--target gles");
    assert!(!place.path(&old).exists());
    assert_eq!(
        ran.err.matches("removed: gles/old_schlick.glsl").count(),
        1,
        "{}",
        ran.err
    );
}

/// A link that leads to nothing is no free place: it is somebody's.
#[cfg(unix)]
#[test]
fn a_dangling_link_is_not_replaced() {
    let place = Place::new();
    fs::create_dir_all(place.path(&format!("{OUT}/wgsl"))).unwrap();
    fs::create_dir_all(place.path("drawn")).unwrap();
    let schlick = place.path(&format!("{OUT}/wgsl/fresnel_schlick.wgsl"));
    let nowhere = place.path("nothing");
    std::os::unix::fs::symlink(&nowhere, &schlick).unwrap();
    std::os::unix::fs::symlink(&nowhere, place.path("drawn/chart.svg")).unwrap();
    let library = "--target wgsl --method schlick --material none";
    place.refused(
        library,
        &["fresnel_schlick.wgsl: a link to ", "--overwrite"],
    );
    place.refused(
        "chart --material gold --out-dir drawn",
        &["chart.svg: a link to ", "--overwrite"],
    );
    assert!(schlick.is_symlink());
    place.done(&format!("{library} --overwrite"));
    assert!(!schlick.is_symlink());

    // A file that the user names is made where the link leads.
    std::os::unix::fs::symlink(place.path("target.wgsl"), place.path("link.wgsl")).unwrap();
    place.done("--method schlick -o link.wgsl");
    assert!(place.path("link.wgsl").is_symlink());
    assert!(place.read("target.wgsl").contains("fresnel_schlick"));
    std::os::unix::fs::symlink(place.path("share/nothing"), place.path("lost.wgsl")).unwrap();
    place.refused("--method schlick -o lost.wgsl", &["lost.wgsl"]);
}

/// Functions that an earlier run put into a file, and the next does not, are named.
#[test]
fn functions_that_a_run_drops_are_named() {
    let place = Place::new();
    place.done("--target gles --material gold --method f82_tint,fitted,conductor_exact");
    let line = "--target gles --material gold";
    let says = "no longer in gles/materials/gold.glsl: fresnel_gold_f82_tint";
    assert!(
        place
            .run(&format!("{line} --check"))
            .ends(1)
            .err
            .contains(says)
    );
    assert!(place.done(line).err.contains(says));
    assert!(!place.done(line).err.contains("no longer"));
}

/// Two functions of one name never meet in one output, and no table takes the place of the one for all materials.
#[test]
fn names_that_meet_are_refused() {
    let place = Place::new();
    place.put("a.toml", MY_METAL.replace("my_metal", "gold_fitted"));
    place.refused(
        "--target wgsl --material gold,a.toml --method conductor_exact,fitted -o x.wgsl",
        &["`fresnel_gold_fitted` would stand in"],
    );
    place.done("--target gles --material gold --method conductor_exact,fitted");
    place.refused(
        "--target gles --material a.toml --method conductor_exact",
        &["`fresnel_gold_fitted` would stand in gles/materials/gold_fitted.glsl and stands in gles/materials/gold.glsl"],
    );
    place.put("d.toml", MY_METAL.replace("my_metal", "dfg_fitted"));
    place.refused("bake --material d.toml", &["--dfg"]);
    fs::create_dir_all(place.path("pages")).unwrap();
    place.put("pages/a.yml", "REFERENCES: x\n");
    place.refused(
        "materials survey pages --json pages/a.yml",
        &["this run reads that file"],
    );
}

#[cfg(target_os = "linux")]
#[test]
fn help_on_a_full_disk_is_an_error() {
    let place = Place::new();
    for word in ["--help", "--version", "methods"] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let ended = place.command(&[word]).stdout(full).status().unwrap();
        assert_eq!(ended.code(), Some(2), "{word}");
    }
}

/// A path through a folder that a run would make, and a link that leads to nothing yet, are where they will lead.
#[cfg(unix)]
#[test]
fn outputs_are_told_apart_before_they_are_made() {
    let place = Place::new();
    place.put("m.toml", MY_METAL);
    for line in [
        "--material m.toml --method schlick -o new/../m.toml",
        "--target wgsl --material m.toml --method schlick --depfile new/deep/../../m.toml",
        "materials params m.toml --json new/../m.toml",
        "fit --material m.toml --json ./new/.././m.toml",
    ] {
        place.refused(line, &["this run reads that file"]);
    }
    let absolute = place.path("new/../m.toml");
    place.refused(
        &format!("materials params m.toml --json {}", absolute.display()),
        &["this run reads that file"],
    );
    std::os::unix::fs::symlink("q.wgsl", place.path("link")).unwrap();
    for line in [
        "--method schlick -o q.wgsl --depfile link",
        "--method schlick -o q.wgsl --depfile sub/../q.wgsl",
    ] {
        place.refused(line, &["two outputs of this run"]);
    }
    let library = "--target wgsl --method schlick --material none";
    place.done(library);
    place.refused(
        &format!("{library} --depfile new/../{OUT}/manifest.json"),
        &["a file of the generated tree lies there"],
    );
    assert_eq!(place.read("m.toml"), MY_METAL);
}

/// What the user names lies in the place of no file that an earlier run wrote into a tree, by whatever command.
#[test]
fn an_output_replaces_no_file_of_a_tree() {
    let place = Place::new();
    place.done("--target wgsl,gles --method schlick --material gold");
    let shader = format!("{OUT}/wgsl/materials/gold.wgsl");
    for line in [
        format!("--target gles --method schlick -o {shader}"),
        format!("--target gles --method schlick --material none --depfile {shader}"),
        format!("--target gles --method schlick -o {OUT}/manifest.json"),
        format!("--target gles --method schlick -o {OUT}/new/../wgsl/materials/gold.wgsl"),
        format!("materials show gold --svg {shader}"),
        format!("fit --material gold --json {shader}"),
    ] {
        place.refused(&line, &["a file of the generated tree lies there"]);
    }
    assert!(
        place
            .done("--target wgsl --check --method schlick --material gold")
            .err
            .is_empty()
    );
    // Beside them there is room.
    place.done(&format!(
        "--target gles --method schlick -o {OUT}/wgsl/mine.glsl"
    ));
}

/// A run that adds a method under other viewing conditions says that the functions that stay change too.
#[test]
fn other_viewing_conditions_are_named() {
    let place = Place::new();
    place.done("--target gles --material gold --method schlick --space acescg --gamut keep");
    let ran = place.done("--target gles --material gold --method f82_tint");
    for words in [
        "gles/materials/gold.glsl: other viewing conditions, so that all of its functions change",
        "ACEScg",
    ] {
        assert!(ran.err.contains(words), "{words} is not in {}", ran.err);
    }
    let again = place.done("--target gles --material gold --method f82_tint");
    assert!(!again.err.contains("viewing conditions"), "{}", again.err);
}

/// A new version of a file is read by whom the old one was; a run that fails leaves none of two files.
#[cfg(unix)]
#[test]
fn a_named_output_keeps_its_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new();
    place.put("private.wgsl", "old");
    let path = place.path("private.wgsl");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
    place.done("--method schlick -o private.wgsl");
    assert_ne!(place.read("private.wgsl"), "old");
    assert_eq!(
        fs::metadata(&path).unwrap().permissions().mode() & 0o777,
        0o600
    );
    place.refused(
        "--method schlick -o new/s.wgsl --depfile private.wgsl/s.d",
        &["private.wgsl"],
    );
    assert!(!place.path("new").exists());
}

/// A report replaces a link with `--overwrite`, and never what lies behind it.
#[cfg(unix)]
#[test]
fn a_report_is_not_written_through_a_link() {
    let place = Place::new();
    place.put("mine.svg", "mine");
    place.put("drawn/note.txt", "");
    std::os::unix::fs::symlink("../mine.svg", place.path("drawn/chart.svg")).unwrap();
    let line = "chart --material gold --out-dir drawn";
    place.refused(line, &["chart.svg: a link to ../mine.svg lies there"]);
    place.done(&format!("{line} --overwrite"));
    assert_eq!(place.read("mine.svg"), "mine");
    assert!(!place.path("drawn/chart.svg").is_symlink());
}
