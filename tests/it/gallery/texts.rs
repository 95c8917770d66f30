//! The texts that a browser compiles: the functions in them are those of the shipped files, byte for byte.

use std::collections::BTreeMap;
use std::path::Path;

use super::subjects;
use fresnel_gen::generator::emit::validate_wgsl;
use fresnel_gen::physics::spectra::Space;
use fresnel_gen::pictures::gallery::{
    FunctionTexts, Gallery, GalleryRow, MethodCalls, gallery, methods_of, rows,
};
use fresnel_gen::pictures::scene::{FRAME, RowText, WGSL_CALLS};

fn made() -> Gallery {
    gallery(&subjects()[..1], Space::Srgb, &mut |_, _, _| {}).expect("it is made")
}

/// The WGSL module of a row with a method, as the page puts it together.
fn module(row: &GalleryRow, calls: &MethodCalls, texts: &BTreeMap<String, String>) -> String {
    let called = calls
        .functions
        .iter()
        .filter(|name| !row.functions.contains(name));
    let names = row.functions.iter().chain(called);
    let functions: String = names.map(|name| texts[name].as_str()).collect();
    functions + FRAME + &calls.wgsl + row.text
}

/// The GLSL ES fragment shader of a pass with a method, as the page puts it together.
fn fragment(
    row: &GalleryRow,
    pass: usize,
    calls: &MethodCalls,
    texts: &BTreeMap<String, String>,
) -> String {
    let part = &row.programs[pass].fragment;
    let mut names: Vec<&String> = part.functions.iter().collect();
    if part.calls {
        let is_new = |name: &&String| !part.functions.contains(name);
        names.extend(calls.functions.iter().filter(is_new));
        // The functions that compute a call's arguments.
        let is_named = |name: &&String| calls.gles.contains(&format!("{name}("));
        names.extend(row.functions.iter().filter(is_named).filter(is_new));
    }
    names.dedup();
    let functions: String = names.iter().map(|name| texts[*name].as_str()).collect();
    let called = if part.calls { calls.gles.as_str() } else { "" };
    [&part.before, functions.as_str(), called, &part.after].concat()
}

/// Functions that the effects' files of another method than the usual one do not hold are read from those that are shipped.
#[test]
fn functions_stand_in_programs_byte_for_byte() {
    let gallery = made();
    let of = |language: fn(&FunctionTexts) -> String| {
        let all = gallery.functions.iter();
        all.map(|one| (one.name.clone(), language(one)))
            .collect::<BTreeMap<_, _>>()
    };
    let (wgsl, gles) = (of(|one| one.wgsl.clone()), of(|one| one.gles.clone()));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-generated/gles/effects");
    let files = std::fs::read_dir(folder).unwrap();
    let shipped: String = files
        .map(|file| std::fs::read_to_string(file.unwrap().path()).unwrap())
        .collect();
    let (mut programs, mut found) = (0, 0);
    for (row, drawn) in gallery.rows.iter().zip(rows()) {
        assert_eq!(row.name, drawn.name);
        for (calls, method) in row.calls.iter().zip(methods_of(drawn)) {
            let calls = &gallery.calls[*calls];
            assert_eq!(calls.method, method.name);
            let text = RowText { row: drawn, method };
            let module = module(row, calls, &wgsl);
            let faults = validate_wgsl(&module).err();
            assert_eq!(faults, None, "{} by {}", row.name, method.name);
            assert!(module.contains(&text.calls(&WGSL_CALLS, &text.called_functions().unwrap())));
            for pass in 0..row.passes.len() {
                let fragment = fragment(row, pass, calls, &gles);
                for (name, text) in &gles {
                    let head = format!(" {name}(");
                    let is_defined = fragment
                        .lines()
                        .any(|line| line.starts_with("highp") && line.contains(&head));
                    let is_called = fragment.contains(&format!("{name}("));
                    assert_eq!(is_called, is_defined, "{}: {name}", row.name);
                    if is_defined {
                        let once = fragment.matches(text.as_str()).count();
                        assert_eq!(once, 1, "{} by {}: {name}", row.name, method.name);
                        found += usize::from(shipped.contains(text.as_str()));
                    }
                }
                programs += 1;
            }
        }
    }
    println!("{programs} programs, {found} functions as shipped");
    assert!(programs > 300 && found > 300);
}
