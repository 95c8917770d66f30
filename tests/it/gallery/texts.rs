//! The texts that a browser compiles: the functions in them are those of the shipped files, byte for byte.

use std::collections::BTreeMap;
use std::path::Path;

use super::subjects;
use fresnel_gen::generator::emit::validate_wgsl;
use fresnel_gen::physics::spectra::Space;
use fresnel_gen::pictures::gallery::{Gallery, find, gallery, methods_of};
use fresnel_gen::pictures::scene::RowText;

fn made() -> Gallery {
    gallery(&subjects()[..1], Space::Srgb, &mut |_, _, _| {}).expect("it is made")
}

/// Functions that the effects' files of another method than the usual one do not hold are read from those that are shipped.
#[test]
fn functions_stand_in_programs_byte_for_byte() {
    let gallery = made();
    let of = |language: fn(&fresnel_gen::pictures::gallery::FunctionTexts) -> String| {
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
    for row in &gallery.rows {
        for method in methods_of(find(row.name).unwrap()) {
            let text = RowText {
                row: find(row.name).unwrap(),
                method,
            };
            let module = row.module(method.name, &wgsl).expect("a method of the row");
            let faults = validate_wgsl(&module).err();
            assert_eq!(faults, None, "{} by {}", row.name, method.name);
            assert!(module.contains(&text.calls().unwrap()));
            for pass in 0..row.passes.len() {
                let fragment = row
                    .fragment(pass, method.name, &gles)
                    .expect("a method of the row");
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
