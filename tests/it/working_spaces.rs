//! What comes of a material's numbers in hosts that compute otherwise than the file means, as `docs/materials.md` says it. `BLESS=1`
//! rewrites the figures.

use glam::{DMat3, DVec3};

use super::fits::catalogue;
use super::readme::page;
use super::stated::check_stated;
use super::stated::short;
use super::stated::stated;
use fresnel_gen::generator::exchange::{self, EngineMaterial};
use fresnel_gen::generator::reference::{MaterialClass, MaterialInMedium};
use fresnel_gen::physics::materials::{Surface, ViewingConditions};
use fresnel_gen::physics::num::statistics::quantile;
use fresnel_gen::physics::spectra::{Adaptation, Integration, Space, bradford};

const PAGE: &str = "docs/materials.md";

/// Linear sRGB as a host that computes in ACEScg takes it: white stays white.
fn to_acescg() -> DMat3 {
    let (from, to) = (Space::Srgb, Space::AcesCg);
    to.xyz_to_rgb() * bradford(from.white(), to.white()) * from.rgb_to_xyz()
}

fn schlick(f0: DVec3, cosine: f64) -> DVec3 {
    f0 + (1.0 - f0) * (1.0 - cosine).powi(5)
}

/// F82-tint: Schlick's approximation less what takes it to the tint at a cosine of 1/7.
fn f82_tint(f0: DVec3, tint: DVec3, cosine: f64) -> DVec3 {
    const AT: f64 = 1.0 / 7.0;
    let lowered = schlick(f0, AT) * (1.0 - tint) / (AT * (1.0 - AT).powi(6));
    schlick(f0, cosine) - lowered * cosine * (1.0 - cosine).powi(6)
}

/// The numbers of a metal as OpenPBR has them: F0 and tint, 1 at most.
fn colours(metal: &MaterialInMedium) -> [DVec3; 2] {
    let metal = EngineMaterial::new(metal, &ViewingConditions::default()).expect("it is a metal");
    [metal.f0.into(), DVec3::from(metal.tint).min(DVec3::ONE)]
}

/// The largest difference over all angles: of F in ACEScg, moved back, against F in sRGB. First where both colours were moved, then where
/// the tint was not.
fn differences(metal: &MaterialInMedium) -> [f64; 2] {
    let there = to_acescg();
    let back = there.inverse();
    let [f0, tint] = colours(metal);
    [there * tint, tint].map(|taken| {
        let at = |step: u32| {
            let cosine = f64::from(step) / 1000.0;
            let own = f82_tint(f0, tint, cosine);
            let other = back * f82_tint(there * f0, taken, cosine);
            (own - other).abs().max_element()
        };
        (0..=1000).map(at).fold(0.0, f64::max)
    })
}

fn metals() -> Vec<&'static MaterialInMedium> {
    let is_metal =
        |one: &&MaterialInMedium| MaterialClass::containing(one) == Some(MaterialClass::Metals);
    catalogue().iter().filter(is_metal).collect()
}

fn named(name: &str) -> &'static MaterialInMedium {
    let mut all = catalogue().iter();
    all.find(|one| one.name == name)
        .expect("it is in the catalogue")
}

#[test]
fn what_moves_with_the_working_space_is_what_the_page_says() {
    let [gold, copper] = ["gold", "copper"].map(|name| differences(named(name)));
    let moved: Vec<f64> = metals().iter().map(|metal| differences(metal)[0]).collect();
    let most = moved.iter().copied().fold(0.0, f64::max);
    let four = |value| short(value, 4);
    check_stated(vec![
        stated(PAGE, "differs: by ", " for gold", four(gold[0])),
        stated(PAGE, " for gold and ", " for copper,", four(copper[0])),
        stated(
            PAGE,
            "for copper, by ",
            " at the 90th",
            four(quantile(&moved, 0.9)),
        ),
        stated(PAGE, "metals and ", " at most", four(most)),
        stated(PAGE, "as it is: by ", " for gold", four(gold[1])),
        stated(PAGE, " for gold and ", " for copper.", four(copper[1])),
    ]);
    for metal in metals() {
        let (there, [f0, _]) = (to_acescg(), colours(metal));
        let moved = there.inverse() * schlick(there * f0, 0.1);
        let off = (moved - schlick(f0, 0.1)).abs().max_element();
        assert!(off < 1e-12, "{}: Schlick's differs by {off}", metal.name);
    }
}

/// A page as one line: its lines end anywhere.
fn flat(path: &str) -> String {
    page(path).split_whitespace().collect::<Vec<_>>().join(" ")
}

fn in_words(colour: DVec3, digits: usize) -> String {
    let words = colour.to_array().map(|value| short(value, digits));
    format!("({})", words.join(", "))
}

#[track_caller]
fn says(text: &str, words: &str) {
    assert!(text.contains(words), "{PAGE} does not say: {words}");
}

#[test]
fn n_and_k_of_another_space_give_what_the_page_says() {
    let gold = named("gold");
    let channels = gold.effective.channels;
    let (n, k) = (DVec3::from(channels.n), DVec3::from(channels.k));
    let taken = ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
    // From the spectrum, since linear sRGB cut red off at 1.
    let there = ViewingConditions {
        integration: Integration {
            space: Space::AcesCg,
            adaptation: Adaptation::Bradford,
            ..Integration::default()
        },
        ..ViewingConditions::default()
    };
    let surface = Surface::new(&gold.material, None, &there).expect("a spectrum");
    let right = surface.unpolarised(1.0);
    says(
        &flat(PAGE),
        &format!(
            "gives gold an F0 of {}, where {} is right",
            in_words(taken, 2),
            in_words(right, 2)
        ),
    );
    says(&flat(PAGE), &format!("gold is {}", in_words(right, 4)));
}

#[test]
fn what_hosts_compute_is_what_the_page_says() {
    let text = flat(PAGE);
    let gold = EngineMaterial::new(named("gold"), &ViewingConditions::default());
    let gold = gold.expect("it is a metal");
    // Rounded up to five digits, as the files themselves say it.
    let error = |format: &str, node: &str| {
        let format = exchange::ALL.iter().find(|one| one.name == format);
        let exported = format.expect("it is one").export(&gold, "");
        let errors = exported.expect("it takes sRGB").errors;
        let error = errors.iter().find(|one| one.node == node);
        short(
            (error.expect("it has the node").max_abs * 1e5).ceil() / 1e5,
            5,
        )
    };
    says(
        &text,
        &format!(
            "gold is off by {} in glTF, by {} in OpenPBR, by {} as a `conductor_bsdf`",
            error("gltf", "material"),
            error("openpbr", "open_pbr_surface"),
            error("materialx", "conductor_bsdf")
        ),
    );
    // F90 = min(16.5 (R + G + B) of F0, 1) of a grey F0.
    let whole = (1e4_f64 / (3.0 * 16.5)).ceil() / 1e4;
    says(
        &text,
        &format!("which is 1 from an F0 of {} on", short(whole, 4)),
    );
    let blue = short(colours(named("gold"))[1].z, 3);
    says(&text, &format!("gold ends at {blue} in blue"));
}
