//! Several forms of one method: which is written for which GPU, that nobody's function is cheaper there, and the page that shows them.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use fresnel_gen::generator::emit::{self, FunctionForm, Naming};
use fresnel_gen::lab::cost::{CostRecord, FunctionId, records};
use fresnel_gen::language::methods::{self, Gpu, MIXES, Method};
use fresnel_gen::language::targets::GLES;
use fresnel_gen::physics::num::Precision;

use crate::bless;
use crate::cli::Place;
use crate::published_costs::{families, own, recorded};

/// Library functions that have forms: the method, what the function takes.
const FORMS: [FunctionForm; 2] = [FunctionForm::Library, FunctionForm::Scalar];

fn cost(record: &CostRecord, written: &'static Method, form: FunctionForm) -> f64 {
    let id = FunctionId::library(written, form, Precision::F32);
    record
        .of(&id)
        .expect("no cost is recorded of a form: run tests/costs")
        .cost()
}

fn several() -> impl Iterator<Item = &'static Method> {
    let all = methods::ALL.iter().copied();
    all.filter(|method| !method.variants.is_empty())
}

/// The record of choices follows from the record of costs.
#[test]
fn each_family_gets_its_cheapest_form() {
    for name in families() {
        let (record, gpu) = (records(name), Gpu::find(name).expect("it is recorded"));
        for method in several() {
            for form in FORMS {
                if form.is_scalar() && !method.has_scalar_form() {
                    continue;
                }
                let all = method.with_variants();
                let least = all
                    .map(|one| cost(&record, one, form))
                    .fold(f64::INFINITY, f64::min);
                let chosen = method.written_for(gpu, form.name(), Precision::F32);
                let own = cost(&record, chosen, form);
                assert_eq!(
                    own, least,
                    "{name}: {} as {:?}",
                    method.name, chosen.variant
                );
                let usual = cost(&record, method, form);
                assert!(
                    own < usual || chosen.variant.is_empty(),
                    "{name}: {}",
                    method.name
                );
            }
        }
    }
    // Of a mix each family counts alike, by what a form costs there beside the usual one.
    for mix in &MIXES {
        let all: Vec<CostRecord> = mix.families.iter().map(|name| records(name)).collect();
        for method in several() {
            let share = |one: &'static Method| -> f64 {
                let form = FunctionForm::Library;
                let shares = all
                    .iter()
                    .map(|of| cost(of, one, form) / cost(of, method, form));
                shares.sum::<f64>() / all.len() as f64
            };
            let least = method
                .with_variants()
                .map(share)
                .fold(f64::INFINITY, f64::min);
            let chosen = method.written_for(mix.gpu, "library", Precision::F32);
            assert!(share(chosen) < least + 1e-9, "{}: {}", mix.gpu, method.name);
        }
    }
}

/// Every form is the cheapest somewhere: one that is not is a burden.
#[test]
fn every_form_is_of_use() {
    let gpus: Vec<Gpu> = Gpu::all().collect();
    for method in several() {
        let chosen = |gpu: &Gpu| {
            FORMS.map(|form| {
                method
                    .written_for(*gpu, form.name(), Precision::F32)
                    .variant
            })
        };
        let used: BTreeSet<&str> = gpus.iter().flat_map(chosen).collect();
        for variant in method.variants {
            assert!(
                used.contains(variant.variant),
                "{} as {}: no GPU of data/records/variants.csv gets it; run tests/costs, or remove the form",
                method.name,
                variant.variant
            );
        }
    }
}

/// Where a published function is cheaper than ours, and why.
const CHEAPER: [(&str, &str, usize, &str); 11] = [
    ("videocore6", "schlick", 3, UNLIMITED),
    ("videocore6", "schlick", 1, UNLIMITED),
    ("videocore6", "schlick_spherical_gaussian", 3, UNLIMITED),
    ("hd4000", "schlick", 3, POWER),
    ("hd530", "schlick", 3, POWER),
    ("xe", "dielectric_exact", 1, DIGITS),
    ("videocore6", "dielectric_exact", 1, DIGITS),
    ("rdna", "dielectric_exact", 1, DIGITS),
    ("videocore6", "dielectric_tinted", 3, UNLIMITED),
    ("adreno630", "schlick_f82_f90", 3, POWER),
    ("malit860", "schlick_f82_f90", 3, POWER),
];
const UNLIMITED: &str = "it takes no cosine outside of 0 to 1";
const POWER: &str = "it takes a power, which is one instruction there";
const DIGITS: &str = "it has no digits next to an index of 1";

/// Ours cost no more than any published function, in the form that is written for the family, but where it is said.
#[test]
fn no_published_function_is_cheaper_but_where_it_is_said() {
    let mut used = BTreeSet::new();
    for row in recorded() {
        let ours = own(&row.gpu, &row.ours, row.channels);
        let is_said = |(place, (gpu, method, channels, _)): (usize, &(&str, &str, usize, &str))| {
            let is_one =
                row.gpu.starts_with(gpu) && row.ours == *method && row.channels == *channels;
            is_one.then_some(place)
        };
        if ours > row.cost {
            let said = CHEAPER.iter().enumerate().find_map(is_said);
            let fault = || {
                format!(
                    "{}: {} {ours}, {} {}",
                    row.gpu, row.ours, row.function, row.cost
                )
            };
            used.insert(said.unwrap_or_else(|| panic!("{}", fault())));
        }
    }
    let unused = (0..CHEAPER.len()).filter(|place| !used.contains(place));
    let unused: Vec<_> = unused.map(|place| CHEAPER[place]).collect();
    assert!(unused.is_empty(), "won meanwhile: {unused:?}");
}

/// Text for a family differs from that for others where its form does, and says for what it was chosen.
#[test]
fn a_file_says_for_which_gpu_it_is() {
    let place = Place::new();
    let text = |more: &str| place.done(&format!("--method f82_tint {more} -o -")).out;
    let (usual, phones) = (text("--target hlsl"), text("--target gles"));
    assert!(
        usual.contains("Form: usual; the cheapest on desktops (RDNA 2, Intel Xe and NVIDIA"),
        "{usual}"
    );
    assert!(
        phones.contains("Form: dip_first; the cheapest on phones (Adreno 630, Mali-G57 and"),
        "{phones}"
    );
    let adreno = text("--target hlsl --gpu adreno330");
    assert!(
        adreno.contains("Form: dip_first; the cheapest on adreno330"),
        "{adreno}"
    );
    assert!(adreno.contains(" --gpu adreno330 "), "{adreno}");
    assert_eq!(text("--target gles --gpu phones"), phones);
    place.refused(
        "--method schlick --gpu adreno33 -o -",
        &["there is no GPU `adreno33`", "adreno330"],
    );
    place.refused(
        "--material gold --budget .01 --gpu phones -o -",
        &["one family"],
    );
}

/// A tree for a GPU is verified as what it is, and each form runs on every target.
#[test]
fn forms_are_verified() {
    let place = Place::new();
    place.done("--target hlsl,wgsl --method f82_tint --gpu adreno330 --out-dir .");
    let ran = place.run("verify --target wgsl --method f82_tint --points 200 --out-dir . --json -");
    if ran.code == Some(3) {
        assert!(std::env::var_os("CI").is_none(), "not checked: {ran:?}");
        return crate::not_checked(&format!("forms by verify: {}", ran.err));
    }
    let rows = ran.ends(0).json()["rows"].as_array().unwrap().clone();
    // The mean over the hemisphere has one form.
    let mut own = rows.iter().filter(|row| row["form"] == "library");
    assert!(
        own.all(|row| row["variant"] == "dip_first" && row["shipped"] == true),
        "{rows:?}"
    );
    let all = place.run("verify --target wgsl,gles,spirv --method hoffman_f82,schlick --gpu all --points 200 --out-dir none --json -");
    let rows = all.ends(0).json()["rows"].as_array().unwrap().clone();
    for target in ["wgsl", "gles", "spirv"] {
        let of = |row: &&serde_json::Value| row["target"] == target;
        let variants = rows.iter().filter(of).map(|row| row["variant"].to_string());
        let variants: BTreeSet<String> = variants.collect();
        let wanted = ["\"\"", "\"dip_first\"", "\"parabola\"", "\"rise\""];
        assert_eq!(variants, wanted.map(str::to_owned).into(), "{target}");
    }
}

/// The methods whose forms the page shows.
const SHOWN: [(&str, FunctionForm); 3] = [
    ("f82_tint", FunctionForm::Library),
    ("hoffman_f82", FunctionForm::Library),
    ("dielectric_exact", FunctionForm::Scalar),
];

fn section(name: &str, form: FunctionForm) -> String {
    let method = methods::find(name).expect("it is a method");
    let mut text = format!(
        "## `{name}`{}\n",
        if form.is_scalar() {
            ", one channel"
        } else {
            ""
        }
    );
    let all: Vec<&'static Method> = method.with_variants().collect();
    let title = |one: &&'static Method| match one.variant {
        "" => "usual".to_owned(),
        variant => format!("`{variant}`"),
    };
    for one in &all {
        let mut functions =
            emit::library_functions(one, &Naming::default()).expect("it is written");
        functions.retain(|emitted| emitted.form == form);
        let body = emit::bare_text(&GLES, &functions).expect("naga takes it");
        let _ = write!(text, "\n{}:\n\n```glsl\n{}\n```\n", title(one), body.trim());
    }
    let titles: Vec<String> = all.iter().map(title).collect();
    let _ = write!(
        text,
        "\n| family | {} |\n|---|{}\n",
        titles.join(" | "),
        "---:|".repeat(all.len())
    );
    for gpu in families() {
        let record = records(gpu);
        let costs: Vec<f64> = all.iter().map(|one| cost(&record, one, form)).collect();
        let least = costs.iter().copied().fold(f64::INFINITY, f64::min);
        let cell = |cost: &f64| match *cost == least {
            true => format!("**{}**", number(*cost)),
            false => number(*cost),
        };
        let _ = writeln!(
            text,
            "| {gpu} | {} |",
            costs.iter().map(cell).collect::<Vec<_>>().join(" | ")
        );
    }
    text
}

fn number(cost: f64) -> String {
    let text = format!("{cost:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The part of the page that is computed.
#[test]
fn the_page_shows_the_forms_and_their_costs() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/forms.md");
    let page = std::fs::read_to_string(&path).expect("the page is there");
    let (head, _) = page
        .split_once("<!-- BEGIN forms -->")
        .expect("it has the mark");
    let sections = SHOWN.map(|(name, form)| section(name, form));
    let whole = format!(
        "{head}<!-- BEGIN forms -->\n{}<!-- END forms -->\n",
        sections.join("\n")
    );
    bless::check(&path, whole.as_bytes());
}
