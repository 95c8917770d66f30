//! What the shapes of fitted methods are worth: with one vote a substance, met exactly at 90 degrees, and chosen without the
//! substance that they are judged by. Errors are on paper, over the measurements that `data/records/samples.csv` names.

use std::collections::BTreeSet;
use std::path::Path;

use super::samples;
use fresnel_gen::generator::fit::{
    Candidate, ErrorQuantiles, Exact, FitCurve, FitObjective, FitProblem, Tried, TriedShapes,
    candidates, search,
};
use fresnel_gen::physics::spectra::Gamut;

/// Forms are compared by what they can follow, without a limit to [0, 1].
fn free() -> FitObjective {
    FitObjective {
        gamut: Gamut::Keep,
        ..FitObjective::default()
    }
}

fn tried(shapes: &[Candidate], curves: &[FitCurve], aim: FitObjective) -> Vec<Tried> {
    let tasks: Vec<FitProblem> = curves
        .iter()
        .map(|curve| FitProblem::new(curve, aim))
        .collect();
    search(shapes, &tasks, &mut |_, _| ())
}

fn shipped() -> Vec<Candidate> {
    let all = [4, 5].into_iter().flat_map(candidates);
    let metals = |one: &Candidate| {
        one.method
            .is_some_and(|method| !method.name.starts_with("fitted_dielectric"))
    };
    all.filter(metals).collect()
}

/// The columns of the record.
const HEAD: [&str; 7] = [
    "what",
    "shape",
    "median",
    "p90",
    "worst",
    "median_by_substance",
    "p90_by_substance",
];

fn row(what: &str, shape: &str, figures: &ErrorQuantiles) -> [String; 7] {
    let ErrorQuantiles {
        median,
        p90,
        worst,
        median_by_substance,
        p90_by_substance,
    } = figures;
    let digits = |figure: &f64| format!("{figure:.3e}");
    [
        what.to_owned(),
        shape.to_owned(),
        digits(median),
        digits(p90),
        digits(worst),
        digits(median_by_substance),
        digits(p90_by_substance),
    ]
}

#[test]
fn what_shapes_are_worth_is_recorded() {
    let subjects = samples::shapes();
    let substances: Vec<String> = subjects
        .iter()
        .map(|subject| subject.material.substance.clone())
        .collect();
    let count = substances.iter().collect::<BTreeSet<_>>().len();
    println!("{count} substances");
    let curves: Vec<FitCurve> = subjects
        .iter()
        .map(|subject| FitCurve::unclipped(subject))
        .collect();
    let mut record = Vec::new();

    let at_90 = Exact {
        normal: false,
        grazing: true,
    };
    for (what, exact) in [("free", Exact::default()), ("exact at 90", at_90)] {
        let aim = FitObjective { exact, ..free() };
        for one in tried(&shipped(), &curves, aim) {
            let name = one.candidate.method.expect("it is shipped").name;
            let quantiles = ErrorQuantiles::new(&one.errors, &substances);
            record.push(row(what, name, &quantiles));
        }
    }
    for terms in [4, 5] {
        let errors = TriedShapes {
            substances: substances.clone(),
            tried: tried(&candidates(terms), &curves, free()),
        };
        let found = errors.leave_one_out(terms).expect("many substances");
        let shape = found.choice.shape.to_string();
        record.push(row(&format!("chosen of {terms}"), &shape, &found.seen));
        let (most, times) = found.chosen[0];
        let votes = format!("left out of {terms} ({times} of {count} choose this)");
        record.push(row(&votes, &most.shape.to_string(), &found.unseen));
        assert!(
            found.unseen.p90 < 2.0 * found.seen.p90,
            "the choice does not carry over"
        );
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/records/shapes.csv");
    super::bless::check(&path, super::records::text(HEAD, &record).as_bytes());
}
