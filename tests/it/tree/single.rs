//! Single outputs: one file, and the depfile.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::put;
use super::snapshot;
use fresnel_gen::generator::error::Error;
use fresnel_gen::generator::output::depfile::depfile;
use fresnel_gen::generator::output::write::write_file;

#[test]
fn a_single_file_is_written_if_it_differs() {
    let dir = TempDir::new().unwrap();
    let path = dir.path().join("new/gold.glsl");
    assert!(write_file(&path, b"one").unwrap());
    let before = snapshot(dir.path());
    assert!(!write_file(&path, b"one").unwrap());
    assert_eq!(snapshot(dir.path()), before);
    assert!(write_file(&path, b"two").unwrap());
    assert_eq!(fs::read(&path).unwrap(), b"two");
    assert!(matches!(
        write_file(dir.path(), b"one"),
        Err(Error::NotAFile { .. })
    ));
    assert!(matches!(
        write_file(&path.join("x/y"), b"one"),
        Err(Error::Stage { .. })
    ));
    assert_eq!(snapshot(dir.path()).len(), 1);
}

#[cfg(unix)]
#[test]
fn a_single_file_goes_through_links_and_into_devices() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let dir = TempDir::new().unwrap();
    put(dir.path(), "real", "old");
    let (real, link) = (dir.path().join("real"), dir.path().join("link"));
    symlink(&real, &link).unwrap();
    assert!(write_file(&link, b"new").unwrap());
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read(&real).unwrap(), b"new");
    let probe = dir.path().join("probe");
    fs::write(&probe, "").unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&real), mode(&probe), "permissions obey the umask");
    write_file(Path::new("/dev/null"), b"new").unwrap();
    let null = fs::metadata("/dev/null").unwrap().file_type();
    assert!(null.is_char_device());
}

#[test]
fn a_depfile_quotes_as_make_and_ninja_read() {
    let cases = [
        ("plain/x.glsl", "plain/x.glsl"),
        ("a b", "a\\ b"),
        ("a#b", "a\\#b"),
        ("a$b", "a$$b"),
        ("C:\\dir\\file", "C\\:\\dir\\file"),
        ("a\\ b", "a\\\\\\ b"),
        ("end\\", "end\\\\"),
        ("12:30", "12\\:30"),
    ];
    for (path, quoted) in cases {
        let text = depfile(&["out".to_string()], &[path.to_string()]).unwrap();
        assert_eq!(text, format!("out: {quoted}\n{quoted}:\n"));
    }
    let strings = |names: &[&str]| names.iter().map(|n| n.to_string()).collect::<Vec<_>>();
    let text = depfile(&strings(&["o2", "o1"]), &strings(&["i2", "i1", "i2"])).unwrap();
    // Ninja takes the first output for its own: their order is the caller's.
    assert_eq!(text, "o2 o1: i1 i2\ni1:\ni2:\n");
    let text = depfile(&strings(&["o"]), &strings(&["i", "o"])).unwrap();
    assert_eq!(text, "o: i o\ni:\n");
    assert_eq!(depfile(&strings(&["o1"]), &[]).unwrap(), "o1:\n");
    for path in [
        "a;b", "a=b", "a|b", "a\tb", "a\nb", "a*b", "a?b", "a'b", "a\"b", "a&b", "a%b", "a\\#b",
        "a\\:b",
    ] {
        for (outputs, inputs) in [([path], ["i"]), (["o"], [path])] {
            let fault = depfile(&strings(&outputs), &strings(&inputs)).expect_err(path);
            assert!(fault.to_string().contains("--depfile: the path"), "{fault}");
        }
    }
}
