//! WGSL under naga, file by file and all in one module: it has no include guards, so that no two names may meet.

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::{Judgement, accepted, files, joined, text, tree};

#[test]
fn every_file_is_accepted() {
    accepted(&files("wgsl"), |file| {
        judge(text(file)).map_err(|complaint| format!("{}: {complaint}", file.path))
    });
}

#[test]
fn library_and_materials_stand_in_one_module() {
    judge(&joined(&tree("wgsl"))).unwrap();
}

#[test]
fn broken_files_are_refused() {
    let good = joined(&tree("wgsl"));
    judge(&good).unwrap();
    // A syntax error, a wrong type, an unknown function, a name used twice.
    for (from, to) in [
        (";", ""),
        ("-> f32", "-> u32"),
        ("saturate(", "saturated("),
        ("_scalar(", "("),
    ] {
        assert!(good.contains(from), "{from}");
        judge(&good.replace(from, to)).expect_err(to);
    }
}

fn judge(text: &str) -> Judgement {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let verdict = validator.validate(&module);
    verdict.map_err(|e| e.emit_to_string(text))?;
    Ok(String::new())
}
