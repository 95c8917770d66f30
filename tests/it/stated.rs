//! Figures in sentences and tables of the pages: how much less ours err than Schlick's, over the metals of the catalogue. `BLESS=1`
//! rewrites them.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;

use glam::DVec3;

use super::fits::catalogue;
use super::gamut;
use super::readme::page;
use super::readme::replaced;
use fresnel_gen::generator::emit::FunctionForm;
use fresnel_gen::generator::fit::{InputChoice, MaterialTruth, MethodErrors, colour_errors};
use fresnel_gen::generator::reference::{MaterialClass, MaterialInMedium};
use fresnel_gen::lab::cost::{FunctionId, records};
use fresnel_gen::language::methods;
use fresnel_gen::physics::materials::{ConstantIndex, MaterialKind, Surface, ViewingConditions};
use fresnel_gen::physics::num::Precision;
use fresnel_gen::physics::num::statistics::{median, quantile};
use fresnel_gen::physics::spectra::{Gamut, Illuminant, Space};

/// A figure in a page: what stands before it, what after it, and what it is. Digits and points between them are replaced.
pub struct Stated {
    page: &'static str,
    before: &'static str,
    after: &'static str,
    figure: String,
}

pub fn stated(
    page: &'static str,
    before: &'static str,
    after: &'static str,
    figure: impl ToString,
) -> Stated {
    Stated {
        page,
        before,
        after,
        figure: figure.to_string(),
    }
}

/// Compares the figures of the pages with what they should be, or rewrites them.
#[track_caller]
pub fn check_stated(all: Vec<Stated>) {
    let mut pages: BTreeMap<&str, String> = BTreeMap::new();
    for one in &all {
        let text = pages.entry(one.page).or_insert_with(|| page(one.page));
        let found = text.match_indices(one.before).find_map(|(place, before)| {
            let (head, rest) = text.split_at(place + before.len());
            let rest = rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
            let same = rest.starts_with(one.after);
            same.then(|| format!("{head}{}{rest}", one.figure))
        });
        *text = found.unwrap_or_else(|| {
            panic!(
                "{}: no figure between `{}` and `{}`",
                one.page, one.before, one.after
            )
        });
    }
    for (path, text) in pages {
        let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        super::bless::check(&whole, text.as_bytes());
    }
}

/// The materials of a class in the catalogue, as `--material all` takes them.
fn class(class: MaterialClass) -> Vec<&'static MaterialInMedium> {
    let all = catalogue().iter();
    all.filter(|subject| MaterialClass::containing(subject) == Some(class))
        .collect()
}

/// The largest errors of a method's library function over the materials of a class.
fn errors(of: MaterialClass, name: &str, inputs: InputChoice) -> Vec<f64> {
    let method = methods::find(name).expect("it is a method");
    let function = method.function(false).expect("it builds");
    let error = |subject: &&MaterialInMedium| {
        let truth = MaterialTruth::new(subject, Space::Srgb);
        let errors = MethodErrors::new((method, &function), inputs, &truth);
        errors.max_abs.expect("it is no texture")
    };
    class(of).iter().map(error).collect()
}

fn of_metals(name: &str) -> Vec<f64> {
    errors(MaterialClass::Metals, name, InputChoice::Intended)
}

fn at_best(name: &str) -> Vec<f64> {
    errors(MaterialClass::Metals, name, InputChoice::Best)
}

/// A reflectance as pages write it: so many digits, without the 0.
pub fn short(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    text.strip_prefix('0').map_or(text.clone(), str::to_owned)
}

fn units(name: &str, gpu: &str) -> f64 {
    records(gpu)
        .library(methods::find(name).unwrap())
        .expect("a cost")
        .cost()
}

/// What a function of gold costs on RDNA 2, its constants in the code.
fn units_of_gold(name: &str) -> f64 {
    let method = methods::find(name).expect("it is a method");
    let key = FunctionId {
        material: Some("gold".to_owned()),
        ..FunctionId::library(method, FunctionForm::Specialised, Precision::F32)
    };
    records("rdna2").of(&key).expect("a cost").cost()
}

/// Of `schlick` over `fitted`: what medians are of each other, the median of what each material gains, and what gold gains.
struct Gain {
    medians: f64,
    of_ratios: f64,
    gold: f64,
}

fn gain(schlick: &[f64], ours: &[f64]) -> Gain {
    let ratios: Vec<f64> = schlick.iter().zip(ours).map(|(a, b)| a / b).collect();
    let metals = class(MaterialClass::Metals);
    let gold = metals.iter().position(|subject| subject.name == "gold");
    Gain {
        medians: median(schlick) / median(ours),
        of_ratios: median(&ratios),
        gold: ratios[gold.expect("gold is a metal")],
    }
}

/// The gains of `fitted` with a material's own coefficients, and with those of the catalogue.
fn gains() -> &'static [Gain; 2] {
    static GAINS: OnceLock<[Gain; 2]> = OnceLock::new();
    GAINS.get_or_init(|| {
        let fitted = methods::find("fitted").expect("it is a method");
        let metals = class(MaterialClass::Metals);
        let kept = metals
            .iter()
            .map(|subject| gamut::error(subject, fitted, Gamut::Clip));
        let kept: Vec<f64> = kept.collect();
        let schlick = of_metals("schlick");
        [gain(&schlick, &of_metals("fitted")), gain(&schlick, &kept)]
    })
}

#[test]
fn what_is_gained_over_schlick_is_what_the_pages_say() {
    let [own, kept] = gains();
    let count = class(MaterialClass::Metals).len();
    let whole = |value: f64| format!("{value:.0}");
    let best = gain(&at_best("schlick"), &of_metals("fitted"));
    let generalised = gain(&at_best("schlick_generalised"), &of_metals("fitted"));
    let nearest = "belcour_decomposition";
    let nearest = [median(&of_metals(nearest)), median(&at_best(nearest))];
    let share = units("fitted", "rdna2") / units("schlick", "rdna2");
    let readme = "README.md";
    let costs = "docs/accuracy-and-cost.md";
    check_stated(vec![
        stated(
            readme,
            "for gold `schlick` costs ",
            ", `fitted` ",
            units_of_gold("schlick"),
        ),
        stated(
            readme,
            ", `fitted` ",
            " and `conductor_exact`",
            units_of_gold("fitted"),
        ),
        stated(
            readme,
            " and `conductor_exact` ",
            "; `--material gold --budget",
            units_of_gold("conductor_exact"),
        ),
        stated(
            costs,
            "largest errors over the catalogue's ",
            " metals",
            count,
        ),
        stated(
            costs,
            " metals is ",
            " times smaller with `fitted`",
            whole(own.medians),
        ),
        stated(
            costs,
            "Schlick's costs ",
            " times less",
            format!("{share:.1}"),
        ),
        stated(
            costs,
            "without a clamp, and err ",
            " times less",
            whole(kept.medians),
        ),
        stated(costs, "the median gain is ", " times", whole(own.of_ratios)),
        stated(
            costs,
            "`fitted` errs ",
            " times less than Schlick with its F0",
            whole(own.medians),
        ),
        stated(
            costs,
            "with its F0, and ",
            " times less",
            whole(best.medians),
        ),
        stated(
            costs,
            "fitted to each material: ",
            " times the error",
            format!("{:.1}", generalised.medians),
        ),
        stated(
            costs,
            "exact law: ",
            " with its own inputs",
            short(nearest[0], 4),
        ),
        stated(
            costs,
            "own inputs and ",
            " with the best",
            short(nearest[1], 4),
        ),
        stated(
            costs,
            "there are, for ",
            " units",
            units("belcour_decomposition", "rdna2"),
        ),
        stated(
            costs,
            "units; `fitted` ",
            " for ",
            short(median(&of_metals("fitted")), 4),
        ),
    ]);
}

/// What `fitted` gains over Schlick's approximation, as README's head says it: cost and error in one row are of one function.
fn gain_table() -> String {
    let [own, kept] = gains();
    let library = |name: &str| units(name, "rdna2");
    format!(
        "Metals in your shader, {:.0} times nearer to measurement than with Schlick's approximation, for {} cycles more: fresnel-gen turns\nmeasured optical \
         constants (n and k by wavelength) into short reflectance functions. One of them, `fitted`, beside Schlick's:\n\n\
         | the function's numbers | cost on AMD's RDNA 2: Schlick's, `fitted` | error of `fitted`, of {} metals, and of gold |\n\
         |---|---:|---:|\n\
         | constants in the code | {}, {} | {:.0} times less than Schlick's, {:.0} times |\n\
         | read at run time from the catalogue | {}, {} | {:.0} times less, {:.0} times |\n",
        own.medians,
        units_of_gold("fitted") - units_of_gold("schlick"),
        class(MaterialClass::Metals).len(),
        units_of_gold("schlick"),
        units_of_gold("fitted"),
        own.medians,
        own.gold,
        library("schlick"),
        library("fitted"),
        kept.medians,
        kept.gold,
    )
}

/// Which method to take, as README says it: error, cost, and what for.
fn which_table() -> String {
    let error = |name: &str, digits| short(median(&of_metals(name)), digits);
    let cost = |name: &str| {
        ["rdna2", "adreno330"]
            .map(|gpu| units(name, gpu).to_string())
            .join(", ")
    };
    let glass = errors(
        MaterialClass::Dielectrics,
        "fitted_dielectric",
        InputChoice::Intended,
    );
    let exact = errors(
        MaterialClass::Dielectrics,
        "dielectric_exact",
        InputChoice::Intended,
    );
    let row = |name: &str, digits, what: &str| {
        format!(
            "| `{name}` | {} | {} | {what} |\n",
            error(name, digits),
            cost(name)
        )
    };
    [
        "| method | largest error (median of the catalogue's metals) | cost on RDNA 2, on Adreno 330, its numbers known at run time only | use it |\n|---|---:|---:|---|\n".to_owned(),
        row("schlick", 3, "if you know only F0, the reflectance at normal incidence"),
        row("fitted_f82", 4, "for textures of F0 and F82, of metals and dielectrics"),
        row("fitted", 4, "for metals"),
        row("fitted_five", 4, "for semiconductors, or where the error of `fitted` is visible"),
        format!(
            "| `fitted_dielectric` | {} (dielectrics) | {} | for glass, water, plastics |\n",
            short(median(&glass), 4),
            cost("fitted_dielectric")
        ),
        format!(
            "| `dielectric_exact`, `conductor_exact` | {} (dielectrics), {} | {}; {} | for total internal reflection, or if the index is known only at run time |\n",
            short(median(&exact), 4),
            error("conductor_exact", 4),
            cost("dielectric_exact"),
            cost("conductor_exact")
        ),
    ]
    .concat()
}

/// What two colours are worth, as `docs/methods.md` says it.
fn two_colours_table() -> String {
    let rows = [
        ("schlick", "F0"),
        ("hoffman_f82", "F0, F82"),
        ("f82_tint", "F0, tint"),
        ("fitted_f82", "F0, F82"),
        ("fitted_f82_metal", "F0, F82"),
    ];
    let row = |(name, takes): (&str, &str)| {
        let metals = of_metals(name);
        let semiconductors = errors(MaterialClass::Semiconductors, name, InputChoice::Intended);
        format!(
            "| `{name}` | {takes} | {}, {} | {}, {} | {} | {} |\n",
            short(median(&metals), 4),
            short(quantile(&metals, 0.9), 4),
            short(median(&semiconductors), 4),
            short(quantile(&semiconductors, 0.9), 4),
            units(name, "rdna2"),
            units(name, "gcn4")
        )
    };
    let head = format!(
        "| method | takes | {} metals: median, 90th percentile | {} semiconductors | RDNA 2 | GCN 4 |\n|---|---|---|---|---:|---:|\n",
        class(MaterialClass::Metals).len(),
        class(MaterialClass::Semiconductors).len()
    );
    head + &rows.map(row).concat()
}

#[test]
fn tables_of_classes_are_of_the_catalogues() {
    for (path, name, table) in [
        ("README.md", "gain", gain_table()),
        ("README.md", "which", which_table()),
        ("docs/methods.md", "colours", two_colours_table()),
    ] {
        let text = replaced(&page(path), name, &table);
        let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        super::bless::check(&whole, text.as_bytes());
    }
}

/// How many spectra, rows, materials and classes there are.
#[test]
fn counts_of_the_catalogue_are_what_the_pages_say() {
    let spectra = || {
        catalogue()
            .iter()
            .filter(|subject| subject.material.rgb_nm.is_none())
    };
    let of = |kind| {
        spectra()
            .filter(|subject| subject.material.kind == kind)
            .count()
    };
    let metals = class(MaterialClass::Metals).len();
    assert_eq!(metals, of(MaterialKind::Metal), "no metal is in no class");
    let semiconductors = class(MaterialClass::Semiconductors).len();
    assert_eq!(semiconductors, of(MaterialKind::Semiconductor));
    let all = catalogue().len();
    let measured = spectra().count();
    let page = "docs/materials.md";
    check_stated(vec![
        stated(page, "`--material all` takes ", ":", all),
        stated(page, "these four, and the ", " spectra", measured),
        stated(page, "Of these ", " spectra", measured),
        stated(page, " spectra ", " are metals", metals),
        stated(page, " are metals, ", " semiconductors", semiconductors),
        stated(
            page,
            " semiconductors and ",
            " dielectrics of n",
            class(MaterialClass::Dielectrics).len(),
        ),
    ]);
}

/// Under a coat of 1.5 only cosines of .745 and more occur at the base.
#[test]
fn what_schlick_errs_under_a_coat_is_what_the_page_says() {
    let gold = fresnel_gen::physics::materials::find("gold")
        .expect("it is there")
        .expect("it is good");
    let medium = ConstantIndex::parse("1.5")
        .expect("a number")
        .expect("within limits");
    let surface = Surface::new(
        &gold,
        Some(&medium.material()),
        &ViewingConditions::default(),
    );
    let surface = surface.expect("gold is known everywhere");
    let within = |cosine: f64| surface.unpolarised(cosine).clamp(DVec3::ZERO, DVec3::ONE);
    let f0 = within(1.0);
    let least = (1.0 - 1.0 / 2.25_f64).sqrt();
    let error = |step: u32| {
        let cosine = least + (1.0 - least) * f64::from(step) / 1000.0;
        let schlick = f0 + (1.0 - f0) * (1.0 - cosine).powi(5);
        (schlick - within(cosine)).abs().z
    };
    let most = (0..=1000).map(error).fold(0.0, f64::max);
    check_stated(vec![
        stated(
            "docs/materials.md",
            "only cosines of ",
            " and more",
            short(least, 3),
        ),
        stated(
            "docs/materials.md",
            "\n",
            " there. Where that counts",
            short(most, 4),
        ),
    ]);
}

/// What three channels in place of a spectrum are off by under an incandescent lamp.
#[test]
fn colour_errors_under_illuminant_a_are_what_the_page_says() {
    let viewing = ViewingConditions::default();
    let error = |name: &str| {
        let material = fresnel_gen::physics::materials::find(name).expect("it is there");
        let material = material.expect("it is good");
        let surface = Surface::new(&material, None, &viewing).expect("it is known");
        let errors = colour_errors(&surface, &viewing.integration).expect("a spectrum");
        let under_a = errors.iter().find(|(light, _)| *light == Illuminant::A);
        format!("{:.1}", under_a.expect("a named light").1[0])
    };
    let page = "docs/verification.md";
    check_stated(vec![
        stated(
            page,
            "`gold_johnson` is off by ΔE₀₀ ",
            ",",
            error("gold_johnson"),
        ),
        stated(page, "`brass` by ", ", `aluminium", error("brass")),
        // The point that ends the sentence is replaced with the figure.
        stated(
            page,
            "`aluminium_rakic` by ",
            " `materials",
            error("aluminium_rakic") + ".",
        ),
    ]);
}

/// Of the exact laws and of Schlick's approximation half precision is said to stay within .0015 for every material.
#[test]
fn half_precision_is_as_near_as_its_page_says() {
    let text = page("docs/half-precision.md");
    let worst = |name: &str| -> f64 {
        let row = text
            .lines()
            .find(|line| line.starts_with(&format!("| `{name}` |")));
        let cell = row
            .and_then(|row| row.split('|').nth(3))
            .expect("a row of the table");
        let number = cell.split_whitespace().next().expect("a figure");
        number.parse().expect("a number")
    };
    let said = [
        "schlick",
        "dielectric_exact",
        "conductor_exact",
        "conductor_exact_metal",
    ];
    let most = said.map(worst).into_iter().fold(0.0, f64::max);
    assert!(text.contains("stay within .0015"));
    assert!((0.0013..0.0015).contains(&most), "{most}");
}

/// No page holds a place that somebody forgot to fill in.
#[test]
fn no_page_holds_a_placeholder() {
    for path in super::readme::pages() {
        assert!(!page(&path).contains("OWNER"), "{path}");
    }
}

/// Whose a form is: its file, the text above a function, and the page of methods say the same.
#[test]
fn whose_a_form_is_is_said_everywhere() {
    let methods_page = page("docs/methods.md");
    for method in methods::ALL {
        let name = method.name;
        let file = page(&format!("src/language/methods/formulas/{name}.rs"));
        let says = file.contains("//! Source: ours");
        assert_eq!(says, method.is_ours(), "{name}: the header of its file");
        let above = method.source_in_short();
        assert_eq!(
            above.contains("the form is fresnel-gen's"),
            method.is_ours(),
            "{name}"
        );
        let row = methods_page
            .lines()
            .find(|line| line.starts_with(&format!("| `{name}`")));
        let row = row.expect("a row of the table");
        assert_eq!(
            row.contains("| fresnel-gen; "),
            method.is_ours(),
            "{name}: {row}"
        );
        assert!(method.is_ours() || !method.is_fitted(), "{name}");
    }
}
