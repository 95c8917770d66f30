//! Is `shaders-generated/` what the program writes today? The set of files, orphans included.

use std::path::Path;

use fresnel_gen::app::{Request, check, generate, tree, write};

#[test]
fn the_committed_tree_is_what_a_run_writes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-generated");
    let generated = generate(&Request::default()).expect("the catalogue generates");
    let plan = tree::plan(
        &folder,
        &generated.artifacts,
        &generated.scope,
        &generated.provenance,
    )
    .expect("a plan");
    if super::bless::is_on() {
        write::write(&plan).expect("the repository can be written");
        return;
    }
    let (report, drift) = check::report(&plan);
    assert!(!drift, "{report}\nBLESS=1 cargo test rewrites it");
}

#[test]
fn generated_text_is_plain() {
    for artifact in generate(&Request {
        targets: all(),
        ..Request::default()
    })
    .expect("it generates")
    .artifacts
    {
        if artifact.path.ends_with(".spv") {
            continue;
        }
        let text = String::from_utf8(artifact.bytes).expect("text");
        let path = &artifact.path;
        assert!(text.is_ascii(), "{path}: only ASCII, for old compilers");
        assert!(
            text.ends_with('\n') && !text.ends_with("\n\n"),
            "{path}: one line end at the end"
        );
        assert!(!text.contains("\n\n\n"), "{path}: two blank lines");
        assert!(
            text.lines().all(|line| line.trim_end() == line),
            "{path}: space at a line's end"
        );
        for (number, line) in text.lines().enumerate() {
            assert!(
                line.len() <= 130,
                "{path}:{}: {} characters",
                number + 1,
                line.len()
            );
        }
        for forbidden in ["pow(", "for (", "while", "NaN", "inf("] {
            let code: Vec<&str> = text
                .lines()
                .map(|line| line.split("//").next().unwrap_or(""))
                .collect();
            assert!(!code.join("\n").contains(forbidden), "{path}: {forbidden}");
        }
    }
}

fn all() -> Vec<String> {
    fresnel_gen::targets::ALL
        .iter()
        .map(|target| target.name.to_owned())
        .collect()
}
