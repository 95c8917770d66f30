//! From measured spectra to colour, held against tables computed by an independent program (numpy, 1 nm sums), and
//! against values that others published.

use std::collections::BTreeMap;

use fresnel_gen::generator::request::{Materials, Request, Source};
use fresnel_gen::generator::{fit, reference};
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::language::methods;
use fresnel_gen::physics::materials::{
    self, Channels, Material, MaterialKind, Surface, THESIS_NM, ViewingConditions,
};
use fresnel_gen::physics::optics::cosine;
use fresnel_gen::physics::spectra::{Adaptation, Gamut, Illuminant, Integration, Step};

/// The catalogue by page, without `.yml`.
fn by_page() -> BTreeMap<String, Material> {
    let all = materials::list()
        .expect("the catalogue is good")
        .into_iter();
    all.map(|m| (m.page.trim_end_matches(".yml").to_owned(), m))
        .collect()
}

fn unclipped(integration: Integration) -> ViewingConditions {
    ViewingConditions {
        integration,
        gamut: Gamut::Keep,
        ..ViewingConditions::default()
    }
}

fn integration(illuminant: Illuminant, adaptation: Adaptation, step: Step) -> Integration {
    Integration {
        illuminant,
        adaptation,
        step,
        ..Integration::default()
    }
}

/// The rows of a table of numbers below a head, after `words` columns of words.
fn rows(text: &str) -> impl Iterator<Item = (&str, Vec<f64>)> {
    text.lines()
        .skip(1)
        .filter(|line| !line.is_empty())
        .map(|line| {
            let (page, numbers) = line.split_once(',').expect("a page and numbers");
            let number = |cell: &str| cell.parse().expect("a number");
            (page, numbers.split(',').map(number).collect())
        })
}

/// The largest difference to three columns of the oracle, from this one on.
fn worst(integration: Integration, first: usize) -> f64 {
    let oracle = include_str!("../reference/spectral_rgb_oracle.csv");
    let (pages, viewing) = (by_page(), unclipped(integration));
    let mut worst: f64 = 0.0;
    let mut count = 0;
    for (page, numbers) in rows(oracle) {
        let surface =
            Surface::new(&pages[page], None, &viewing).expect("known over the whole spectrum");
        let degrees = numbers[0];
        let cos_theta = cosine(degrees);
        let got = surface.unpolarised(cos_theta).to_array();
        for (got, want) in got.iter().zip(&numbers[first..first + 3]) {
            worst = worst.max((got - want).abs());
            count += 1;
        }
    }
    assert_eq!(count, 84 * 3);
    worst
}

#[test]
fn integrated_colours_are_those_of_the_oracle() {
    let (scale, bradford) = (Adaptation::Scale, Adaptation::Bradford);
    for (light, adaptation, first) in [
        (Illuminant::D65, scale, 1),
        (Illuminant::D65, bradford, 4),
        (Illuminant::E, bradford, 7),
    ] {
        let fine = worst(integration(light.clone(), adaptation, Step::Nm1), first);
        let usual = worst(integration(light.clone(), adaptation, Step::Nm5), first);
        assert!(
            fine < 5e-6,
            "{} {}: {fine:e} at 1 nm",
            light.name(),
            adaptation.name()
        );
        assert!(
            usual < 2e-4,
            "{} {}: {usual:e} at 5 nm",
            light.name(),
            adaptation.name()
        );
        // And in the other direction: the two tables are not the same.
        assert!(usual > 5e-6);
    }
}

/// F0 of all pages of the catalogue, by an independent reader, rounded to four digits.
#[test]
fn every_metal_has_its_colour() {
    let (pages, viewing) = (
        by_page(),
        unclipped(integration(Illuminant::D65, Adaptation::Scale, Step::Nm1)),
    );
    let mut seen = 0;
    for (page, want) in rows(include_str!("../reference/f0_by_page.csv")) {
        let Some(material) = pages.get(page) else {
            continue;
        };
        let surface =
            Surface::new(material, None, &viewing).expect("known over the whole spectrum");
        let got = surface.unpolarised(1.0).to_array();
        for (got, want) in got.iter().zip(want) {
            assert!((got - want).abs() < 5.1e-5, "{page}: {got} is not {want}");
        }
        seen += 1;
    }
    assert!(seen >= 115, "{seen}");
}

/// Lagarde's chromium (2011), the one entry of his table whose source is in the database.
#[test]
fn chromium_is_lagardes() {
    let chromium = materials::find("chromium")
        .expect("it is there")
        .expect("it is good");
    let surface =
        Surface::new(&chromium, None, &unclipped(Integration::default())).expect("it is full");
    let got = surface.unpolarised(1.0).to_array();
    for (got, want) in got.iter().zip([0.549585, 0.556114, 0.554256]) {
        assert!((got - want).abs() < 2e-4, "{got} {want}");
    }
}

/// The pages that the thesis rounds in its Table 1.
#[test]
fn table_1_comes_out_of_its_pages() {
    for (page, thesis) in [
        ("gold_hagemann_2", "gold_thesis"),
        ("platinum", "platinum_thesis"),
        ("water", "water_thesis"),
        ("diamond", "diamond_thesis"),
    ] {
        let channels = |name: &str| -> Channels {
            let material = materials::find(name)
                .expect("it is there")
                .expect("it is good");
            material.channels(THESIS_NM).expect("it is known there")
        };
        let (page, thesis) = (channels(page), channels(thesis));
        let apart =
            |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
        assert!(
            apart(page.n, thesis.n) < 0.006 && apart(page.k, thesis.k) < 0.0063,
            "{page:?} {thesis:?}"
        );
    }
}

/// Every full-spectrum material has an index per channel, and it reflects nearly what the spectrum does.
#[test]
fn the_index_per_channel_stands_for_the_spectrum() {
    let mut worst: Vec<(f64, String)> = Vec::new();
    for material in materials::list().expect("the catalogue is good") {
        let Ok(surface) = Surface::new(&material, None, &ViewingConditions::default()) else {
            continue;
        };
        let truth = reference::ReferenceCurve::new(
            surface,
            fresnel_gen::language::methods::Light::Unpolarised,
        );
        let effective = reference::effective(&truth, material.kind);
        let known = fit::known(&effective.channels, &reference::Derivation::default());
        let seen = truth.at(1.0);
        for (by, (law, seen)) in effective.by.iter().zip(known.f0.iter().zip(seen)) {
            let met = *by != reference::IndexSource::F0AndF82 || (law - seen).abs() < 1e-9;
            assert!(met, "{}: {known:?}", material.name);
        }
        let apart = (0..=90).flat_map(|degree| {
            let cos_theta = cosine(f64::from(degree));
            let law = Surface::of_channels(&effective.channels)
                .unpolarised(cos_theta)
                .to_array();
            let seen = truth.at(cos_theta);
            (0..3).map(move |i| (law[i] - seen[i]).abs())
        });
        worst.push((apart.fold(0.0, f64::max), material.name));
    }
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    assert!(worst[0].0 < 0.02, "{:?}", &worst[..5]);
    assert!(
        worst[worst.len() / 2].0 < 1e-3,
        "{:?}",
        worst[worst.len() / 2]
    );
}

/// Classes tell metals from glass: what a medium may be hangs on it.
#[test]
fn dielectrics_hardly_absorb() {
    for material in materials::list().expect("the catalogue is good") {
        let viewing = ViewingConditions {
            beyond: materials::Extrapolate::Hold,
            ..ViewingConditions::default()
        };
        let surface = Surface::new(&material, None, &viewing).expect("held where it is not known");
        let most = surface.most_k();
        match material.kind {
            MaterialKind::Dielectric => assert!(most < 0.6, "{}: {most}", material.name),
            MaterialKind::Metal => assert!(most > 1.0, "{}: {most}", material.name),
            MaterialKind::Semiconductor => {}
        }
    }
}

/// Water seen from a medium of 1.5 reflects all from another angle on in each channel, where the error of one index a channel has a
/// cusp: a dense scan finds no more than the model error says.
#[test]
fn an_error_at_a_critical_angle_is_not_missed() {
    let request = Request {
        materials: Materials::These(vec![Source::Named("water".to_owned())]),
        medium: Some(Source::Named("1.5".to_owned())),
        ..Request::default()
    };
    let subjects = request.subjects().expect("both are known").materials();
    let subject = &subjects[0];
    let method = methods::find("dielectric_exact").expect("it is a method");
    let function = method.specialise(&fit::values_for_material(subject, method));
    let function = function.expect("it is specialised");
    let truth = subject.truth_for(method);
    let error = fit::model_error(&function, &truth).max_abs;
    let mut scanned = 0.0_f64;
    for step in 0..6000 {
        let c = cosine(61.0 + f64::from(step) * 5e-4);
        let given = evaluate(&function, &[Value::<f64>::scalar(c)]).at(0);
        let want = truth.at(c);
        let off = (0..3).map(|i| (given[i] - want[i]).abs());
        scanned = off.fold(scanned, f64::max);
    }
    println!("{error}, by a scan {scanned}");
    assert!(
        scanned > 0.095 && error > scanned - 1e-6,
        "{error} {scanned}"
    );
}
