//! What the shapes of fitted methods are worth: with one vote a substance, met exactly at 90 degrees, and chosen without the
//! substance that they are judged by. Errors are on paper, over the 75 measurements that promises are about.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use fresnel_gen::fit::{
    Candidate, ErrorQuantiles, Exact, FitCurve, FitObjective, FitProblem, Tried, TriedShapes,
    candidates, search,
};
use fresnel_gen::reference::MaterialInMedium;

use super::fits::{catalogue, is_promised};

fn promised() -> Vec<&'static MaterialInMedium> {
    let own = catalogue().iter().filter(|subject| is_promised(subject));
    own.collect()
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
            .is_some_and(|method| method.name != "fitted_dielectric")
    };
    all.filter(metals).collect()
}

fn line(record: &mut String, what: &str, shape: &str, figures: &ErrorQuantiles) {
    let ErrorQuantiles {
        median,
        p90,
        worst,
        median_by_substance,
        p90_by_substance,
    } = figures;
    let _ = writeln!(
        record,
        "{what},{shape},{median:.3e},{p90:.3e},{worst:.3e},{median_by_substance:.3e},{p90_by_substance:.3e}"
    );
}

#[test]
fn what_shapes_are_worth_is_recorded() {
    let subjects = promised();
    let substances: Vec<String> = subjects
        .iter()
        .map(|subject| subject.material.substance.clone())
        .collect();
    assert_eq!(subjects.len(), 75);
    let count = substances.iter().collect::<BTreeSet<_>>().len();
    println!("{count} substances");
    let curves: Vec<FitCurve> = subjects
        .iter()
        .map(|subject| FitCurve::unclipped(subject))
        .collect();
    let mut record =
        String::from("what,shape,median,p90,worst,median_by_substance,p90_by_substance\n");

    let at_90 = Exact {
        normal: false,
        grazing: true,
    };
    for (what, exact) in [("free", Exact::default()), ("exact at 90", at_90)] {
        let aim = FitObjective {
            exact,
            ..FitObjective::default()
        };
        for one in tried(&shipped(), &curves, aim) {
            let name = one.candidate.method.expect("it is shipped").name;
            line(
                &mut record,
                what,
                name,
                &ErrorQuantiles::new(&one.errors, &substances),
            );
        }
    }
    for terms in [4, 5] {
        let errors = TriedShapes {
            substances: substances.clone(),
            tried: tried(&candidates(terms), &curves, FitObjective::default()),
        };
        let found = errors.leave_one_out(terms).expect("many substances");
        let shape = found.choice.shape.to_string();
        line(
            &mut record,
            &format!("chosen of {terms}"),
            &shape,
            &found.seen,
        );
        let (most, times) = found.chosen[0];
        let votes = format!("left out of {terms} ({times} of {count} choose this)");
        line(&mut record, &votes, &most.shape.to_string(), &found.unseen);
        assert!(
            found.unseen.p90 < 2.0 * found.seen.p90,
            "the choice does not carry over"
        );
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/records/shapes.csv");
    super::bless::check(&path, record.as_bytes());
}
