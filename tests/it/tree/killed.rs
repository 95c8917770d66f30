//! Runs that are killed: each file is old or new, and the next run cleans up.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use tempfile::TempDir;

use super::Snapshot;
use super::big_tree;
use super::provenance;
use super::snapshot;
use super::write;
use fresnel_gen::generator::output::manifest::Manifest;
use fresnel_gen::generator::output::tree::plan;
use fresnel_gen::generator::output::{folder, lock, manifest, ownership};

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_each_file_old_or_new() {
    let dir = TempDir::new().unwrap();
    let out = dir.path().join("out");
    let trees = [1, 2].map(|edition| TempDir::new().map(|dir| (edition, dir)).unwrap());
    let allowed = trees.each_ref().map(|(edition, dir)| {
        let (artifacts, scope) = big_tree(*edition, 40_000);
        write(&plan(dir.path(), &artifacts, &scope, &provenance()).unwrap()).unwrap();
        snapshot(dir.path())
    });
    let (mut seed, mut leftovers, mut seen) = (20_u64, 0, 0);
    for _ in 0..40 {
        let mut child = spawn_writer(&out);
        // Knuth's MMIX generator: the delays are arbitrary, and the same in every run.
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        std::thread::sleep(Duration::from_micros(5_000 + (seed >> 33) % 60_000));
        child.kill().unwrap();
        child.wait().unwrap();
        let found = snapshot(&out);
        assert_all_listed(&found);
        for (path, (bytes, _)) in found {
            if folder::is_temporary(&path) {
                leftovers += 1;
                continue;
            }
            if path == lock::FILE || path == manifest::FILE {
                continue;
            }
            let whole = allowed.iter().filter_map(|tree| tree.get(&path));
            assert!(whole.map(|old| &old.0).any(|old| *old == bytes), "{path}");
            seen += 1;
        }
    }
    assert!(seen > 0, "no run came far enough to write anything");
    eprintln!("{leftovers} temporary files were left behind by 40 killed runs");
    let (artifacts, scope) = big_tree(2, 40_000);
    write(&plan(&out, &artifacts, &scope, &provenance()).unwrap()).unwrap();
    let contents = |tree: &Snapshot| -> BTreeMap<String, Vec<u8>> {
        (tree
            .iter()
            .map(|(path, file)| (path.clone(), file.0.clone())))
        .collect()
    };
    assert_eq!(contents(&snapshot(&out)), contents(&allowed[1]));
}

/// A manifest names every file, by its bytes, of whatever step the run was killed in.
#[track_caller]
fn assert_all_listed(found: &Snapshot) {
    let Some((text, _)) = found.get(manifest::FILE) else {
        let named = |path: &String| folder::is_temporary(path) || path == lock::FILE;
        assert!(found.keys().all(named), "{:?}", found.keys());
        return;
    };
    let listed = Manifest::parse(Path::new(manifest::FILE), text)
        .unwrap()
        .files;
    for (path, (bytes, _)) in found {
        let own = listed.iter().find(|entry| entry.file == *path);
        let is_beside =
            folder::is_temporary(path) || [lock::FILE, manifest::FILE].contains(&&**path);
        assert!(
            is_beside || own.is_some_and(|entry| ownership::is_listed(entry, bytes)),
            "{path} is not listed as it is"
        );
    }
}

/// Names the folder to the child that is to be killed.
const CHILD: &str = "FRESNEL_GEN_TEST_CHILD";

/// Not a test of its own: the process that the next test kills.
#[test]
fn child_that_writes_until_killed() {
    let Some(out) = std::env::var_os(CHILD).map(PathBuf::from) else {
        return;
    };
    for turn in 0..10_000 {
        let (artifacts, scope) = big_tree(turn % 2 + 1, 40_000);
        write(&plan(&out, &artifacts, &scope, &provenance()).unwrap()).unwrap();
    }
}

fn spawn_writer(out: &Path) -> Child {
    // The name of the test, whichever binary this file is a module of.
    let module = module_path!().split_once("::").map(|parts| parts.1);
    let test = [module, Some("child_that_writes_until_killed")];
    let test = test.into_iter().flatten().collect::<Vec<_>>().join("::");
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", &test])
        .env(CHILD, out)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    // The process takes as long to start as the machine is busy: it says so when it has.
    let said = BufReader::new(child.stdout.take().unwrap()).lines();
    let started = said
        .map_while(Result::ok)
        .find(|line| line.starts_with("running"));
    assert!(started.is_some());
    child
}
