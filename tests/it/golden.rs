//! Is `shaders-generated/` what the program writes today? The set of files, orphans included.

use fresnel_gen::generator::emit::Artifact;
use fresnel_gen::generator::emit::HeaderForm;
use fresnel_gen::generator::generate;
use fresnel_gen::generator::request::Request;
use fresnel_gen::language::{methods, targets};
use fresnel_gen::physics::num::Precision;

/// The tree as a whole. The library alone bakes no tables.
mod tree_of_a_run {
    use std::collections::BTreeSet;
    use std::path::Path;

    use fresnel_gen::generator::bake::as_tables_are_seen;
    use fresnel_gen::generator::generate;
    use fresnel_gen::generator::generate::catalogue::add_catalogue;
    use fresnel_gen::generator::generate::tables::add_tables;
    use fresnel_gen::generator::output::lock::Lock;
    use fresnel_gen::generator::output::{tree, write};
    use fresnel_gen::generator::request::Request;

    /// All files below a folder, as paths in it.
    fn files(folder: &Path, below: &str, found: &mut BTreeSet<String>) {
        for entry in std::fs::read_dir(folder.join(below)).into_iter().flatten() {
            let entry = entry.expect("readable");
            let name = format!("{below}{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                files(folder, &format!("{name}/"), found);
            } else {
                found.insert(name);
            }
        }
    }

    #[test]
    fn the_committed_tree_is_what_a_run_into_an_empty_folder_writes() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-generated");
        let request = Request::default();
        let mut generated = generate(&request).expect("the catalogue generates");
        add_catalogue(&mut generated, &request).expect("the catalogue is fitted");
        let viewing = as_tables_are_seen(&request.viewing, false);
        let tables = Request { viewing, ..request };
        add_tables(&mut generated, &tables).expect("the tables are baked");
        if crate::bless::is_on() {
            std::fs::remove_dir_all(&folder).expect("it is there");
        }
        let plan = tree::plan(
            &folder,
            &generated.artifacts,
            &generated.scope,
            &generated.provenance,
        )
        .expect("a plan");
        if crate::bless::is_on() {
            let mut lock = Lock::take(&folder, &|_| ());
            write::write(&plan, &[], false, &mut lock).expect("the repository can be written");
            drop(lock);
            return;
        }
        let (report, drift) = tree::report(&plan);
        assert!(!drift, "{report}\nBLESS=1 cargo test rewrites it");
        let mut found = BTreeSet::new();
        files(&folder, "", &mut found);
        let paths = generated
            .artifacts
            .iter()
            .map(|artifact| artifact.path.clone());
        let wanted: BTreeSet<String> = paths.chain(["manifest.json".to_owned()]).collect();
        assert_eq!(
            found, wanted,
            "a file too many, which BLESS=1 cargo test removes"
        );
    }
}

#[test]
fn generated_text_is_plain() {
    let forms = [HeaderForm::Short, HeaderForm::Full];
    for artifact in forms.into_iter().flat_map(in_both_precisions) {
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
            // A link is not broken.
            assert!(
                line.len() <= 130 || line.contains("    https://"),
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

/// Whether a line of a text's comments begins so.
fn says(text: &str, what: &str) -> bool {
    text.lines()
        .any(|line| line.trim_start_matches("//").trim_start().starts_with(what))
}

/// What each short head must say; what it leaves out stands in the manifest.
#[test]
fn short_heads_say_what_is_needed_and_the_manifest_says_the_rest() {
    for artifact in of_functions(HeaderForm::Short) {
        let (path, text) = (&artifact.path, String::from_utf8_lossy(&artifact.bytes));
        let argument = match artifact.method {
            Some(_) => "Arguments: cos_theta",
            None => "Argument: cos_theta",
        };
        for what in [
            "Regenerate: fresnel-gen --target ",
            "Licence of this file: ",
            "Source: ",
            "Model error",
            "Cost: ",
            argument,
        ] {
            let is_module = path.ends_with(".spv");
            assert!(
                is_module || says(&text, what),
                "{path}: no line begins with `{what}`"
            );
        }
        let mut commands = text.lines().filter(|line| line.contains("Regenerate: "));
        assert!(!commands.any(|line| line.contains("--header")), "{path}");
        let detail = serde_json::json!(artifact.detail);
        for function in detail["functions"]
            .as_array()
            .expect("a file has functions")
        {
            let method =
                methods::find(function["method"].as_str().expect("it has one")).expect("a method");
            assert_eq!(function["domain"], method.domain, "{path}");
            assert_eq!(
                function["formula"],
                serde_json::json!(method.formula),
                "{path}"
            );
            let source = function["source"].as_str().expect("a source");
            assert!(source.contains(method.source.title), "{path}: {source}");
            assert!(function["code_error"].is_object(), "{path}");
            let fails = matches!(method.contract, methods::Contract::Exempt(_));
            assert_eq!(function["fails"].is_string(), fails, "{path}");
            assert_eq!(
                function["promises"].is_array(),
                function["form"] != "specialised",
                "{path}"
            );
        }
        let data = detail["data"]["reference"].is_string();
        assert_eq!(data, artifact.material.is_some(), "{path}");
    }
}

/// Above a function of a material stand at most six lines, links and what is broken over two lines included.
#[test]
fn short_heads_are_short() {
    for artifact in of_functions(HeaderForm::Short) {
        let text = String::from_utf8_lossy(&artifact.bytes);
        if artifact.material.is_none() || artifact.path.ends_with(".spv") {
            continue;
        }
        for block in text.split("\n\n").skip(1) {
            let above = block.lines().take_while(|line| line.starts_with("//"));
            assert!(above.count() <= 6, "{}: {block}", artifact.path);
        }
    }
}

/// What each full head must say, as the beginning of a comment line.
#[test]
fn heads_say_all_that_they_must() {
    for artifact in of_functions(HeaderForm::Full)
        .iter()
        .filter(|artifact| !artifact.path.ends_with(".spv"))
    {
        let text = String::from_utf8_lossy(&artifact.bytes);
        let mut wanted = vec![
            "Regenerate: fresnel-gen --target ",
            "Source: ",
            "Model error",
            "Code error",
            "Licence of this file: ",
        ];
        let library = artifact.method.is_some();
        wanted.push(if library {
            "Domain: "
        } else {
            "Argument: cos_theta"
        });
        for what in wanted {
            assert!(
                says(&text, what),
                "{}: no line begins with `{what}`",
                artifact.path
            );
        }
        assert!(
            text.contains("scalar operations"),
            "{}: no cost",
            artifact.path
        );
        // Of a film it depends on the film.
        let told = [
            "it is the exact law",
            " degrees",
            "the head of a material's function has it",
        ];
        let error = told.iter().any(|words| text.contains(words));
        assert!(error, "{}: no angle of the worst error", artifact.path);
        for formula in methods::find(artifact.method.as_deref().unwrap_or(""))
            .map_or(&[][..], |method| method.formula)
        {
            let words: Vec<&str> = formula.split_whitespace().collect();
            let all = words.iter().all(|word| text.contains(word));
            assert!(all, "{}: the formula is not there", artifact.path);
        }
    }
}

/// Of the tree of all targets the files of methods and materials.
fn of_functions(header: HeaderForm) -> Vec<Artifact> {
    let mut all = in_both_precisions(header);
    all.retain(|artifact| artifact.effect.is_none());
    all
}

/// What the head of an effect must say, and the comments above each of its functions.
#[test]
fn heads_of_effects_say_what_they_must() {
    let all = in_both_precisions(HeaderForm::Short);
    let mut of_effects = all
        .iter()
        .filter(|one| one.effect.is_some() && !one.path.ends_with(".spv"));
    assert!(of_effects.clone().count() >= 5 * fresnel_gen::language::effects::ALL.len());
    for artifact in &mut of_effects {
        let (path, text) = (&artifact.path, String::from_utf8_lossy(&artifact.bytes));
        let command = "Regenerate: fresnel-gen --target ";
        for what in [command, "Licence of this file: ", "Source: ", "Wrong: "] {
            assert!(says(&text, what), "{path}: no line begins with `{what}`");
        }
        let functions = artifact.detail.functions();
        let stated = text.lines().filter(|line| line.contains("Code error: "));
        assert_eq!(stated.count(), functions.len(), "{path}");
        let detail = serde_json::json!(artifact.detail);
        for function in detail["functions"].as_array().expect("functions") {
            for key in ["gives", "source", "signature", "code_error"] {
                assert!(!function[key].is_null(), "{path}: {key}");
            }
        }
    }
}

/// The tree of all targets, its comments in this form.
fn in_both_precisions(header: HeaderForm) -> Vec<Artifact> {
    let one = |precision| {
        let request = Request {
            targets: targets::ALL.to_vec(),
            precision,
            header,
            ..Request::default()
        };
        generate(&request).expect("it generates").artifacts
    };
    Precision::ALL.into_iter().flat_map(one).collect()
}
