//! Searches the forms of a method. Equality saturation finds expressions that mean the same by the identities in [`rules`]; some
//! hundreds are drawn from them by many models of cost; those that keep the method's promise in f32 are compiled by the compilers of
//! GPUs. A row of what is printed is the cheapest text on a family, beside the usual form and the one that is written there.
//!
//!     tests/forms METHOD [library|scalar] [DRAWS] [KEPT,...]

mod error;
mod formula;
mod rules;

use core::time::Duration;
use std::collections::BTreeSet;
use std::process::ExitCode;

use egg::{Extractor, RecExpr, Runner};
use fresnel_gen::generator::emit::FunctionForm;
use fresnel_gen::lab::cost::find as find_family;
use fresnel_gen::lab::cost::{
    CostedFunction, FAMILIES, FamilyAnswers, FunctionId, ask_compilers, records, serve,
};
use fresnel_gen::lab::process::{Pool, Surroundings};
use fresnel_gen::language::methods::{self, Gpu, Method};
use fresnel_gen::physics::num::Precision;

use error::Judge;
use formula::{Formula, checked, expression};
use rules::{Drawn, Known, rules};

/// The most nodes of an e-graph, and the most seconds that it may grow.
const NODES: usize = 30_000;
const SECONDS: u64 = 20;
/// The most texts that are compiled.
const COMPILED: usize = 400;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        // This program is its own worker.
        ["cost", "--worker", family] => {
            let served = find_family(family).map(serve);
            ExitCode::from(u8::from(!matches!(served, Some(Ok(())))))
        }
        [name, ref rest @ ..] => {
            let form = match rest.first() {
                Some(&"scalar") => FunctionForm::Scalar,
                _ => FunctionForm::Library,
            };
            let draws = rest.get(1).and_then(|word| word.parse().ok());
            let Some(method) = methods::find(name) else {
                eprintln!("there is no method `{name}`");
                return ExitCode::from(2);
            };
            let kept: Vec<&str> = rest
                .get(2)
                .map_or(Vec::new(), |words| words.split(',').collect());
            match search(method, form, draws.unwrap_or(1500), &kept) {
                Ok(()) => ExitCode::SUCCESS,
                Err(why) => {
                    eprintln!("{name}: {why}");
                    ExitCode::from(3)
                }
            }
        }
        [] => {
            eprintln!("METHOD [library|scalar] [DRAWS] [KEPT,...]");
            ExitCode::from(2)
        }
    }
}

/// A text that keeps the promise.
struct Found {
    expression: RecExpr<Formula>,
    ulp: f64,
    function: CostedFunction,
}

fn search(
    method: &'static Method,
    form: FunctionForm,
    draws: u64,
    kept: &[&str],
) -> Result<(), String> {
    let usual = method
        .function(form.is_scalar())
        .map_err(|fault| fault.to_string())?;
    let start = expression(&usual, kept)?;
    let judge = Judge::new(method, form.is_scalar());
    let texts = drawn(&start, &usual, draws);
    eprintln!("{}: {} texts", method.name, texts.len());
    let mut found = Vec::new();
    for text in &texts {
        let text: RecExpr<Formula> = text.parse().map_err(|fault| format!("{fault}"))?;
        let Ok(graph) = checked(&text, &usual) else {
            continue;
        };
        let Some(ulp) = judge.ulp(&graph) else {
            continue;
        };
        let is_kept = ulp <= judge.promised() && judge.holds_at_ends(&graph, &usual);
        if is_kept && found.len() < COMPILED {
            let id = FunctionId::library(method, form, Precision::F32);
            found.push(Found {
                expression: text,
                ulp,
                function: CostedFunction::new(id, graph),
            });
        }
    }
    eprintln!(
        "{}: {} keep {} ulp",
        method.name,
        found.len(),
        judge.promised()
    );
    reported(method, form, texts.len(), &found)
}

/// Different expressions of the same meaning, by many models of cost.
fn drawn(
    start: &RecExpr<Formula>,
    usual: &fresnel_gen::language::ir::Checked,
    draws: u64,
) -> Vec<String> {
    let runner = Runner::<Formula, Known>::new(Known::of(usual))
        .with_expr(start)
        .with_node_limit(NODES)
        .with_iter_limit(12)
        .with_time_limit(Duration::from_secs(SECONDS))
        .run(&rules());
    eprintln!(
        "{} nodes in {} classes: {:?}",
        runner.egraph.total_size(),
        runner.egraph.number_of_classes(),
        runner.stop_reason
    );
    let mut texts = BTreeSet::from([start.to_string()]);
    for seed in 0..draws {
        let extractor = Extractor::new(&runner.egraph, Drawn::new(&runner.egraph, seed));
        let (_, best) = extractor.find_best(runner.roots[0]);
        texts.insert(best.to_string());
    }
    texts.into_iter().collect()
}

/// Prints a row for each family.
fn reported(
    method: &'static Method,
    form: FunctionForm,
    texts: usize,
    found: &[Found],
) -> Result<(), String> {
    let functions: Vec<CostedFunction> = found.iter().map(|one| one.function.clone()).collect();
    let families: Vec<_> = FAMILIES
        .iter()
        .filter(|one| one.compiler.dialect().is_some())
        .collect();
    let pool = Pool {
        limit: Duration::from_secs(60),
        workers: std::thread::available_parallelism().map_or(1, usize::from),
    };
    let tools = std::env::var_os("FRESNEL_TOOLS").map(std::path::PathBuf::from);
    let surroundings = Surroundings::new(tools.as_deref()).map_err(|fault| fault.to_string())?;
    let answers = ask_compilers(
        &families,
        &functions,
        &|_, _| true,
        pool,
        &surroundings,
        &mut |_, _, _| {},
    );
    let answers = answers.map_err(|fault| fault.to_string())?;
    for (family, answer) in families.iter().zip(answers) {
        let Some(FamilyAnswers::Fresh(_, figures)) = answer else {
            eprintln!("{}: its compiler is not here", family.name);
            continue;
        };
        let costs = figures.iter().zip(found);
        let costs =
            costs.filter_map(|(figures, one)| Some((figures.as_ref()?.as_ref().ok()?.cost(), one)));
        let best = costs.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.ulp.total_cmp(&b.1.ulp)));
        let record = records(family.name);
        let of = |written: &'static Method| {
            let figures = record.of(&FunctionId::library(written, form, Precision::F32));
            figures.map_or(f64::NAN, |figures| figures.cost())
        };
        let gpu = Gpu::find(family.name);
        let written = gpu.map_or(method, |gpu| {
            method.written_for(gpu, form.name(), Precision::F32)
        });
        if let Some((cost, one)) = best {
            println!(
                "{},{},{},{texts},{},{},{},{cost},{:.2},{}",
                method.name,
                form.name(),
                family.name,
                found.len(),
                of(method),
                of(written),
                one.ulp,
                one.expression
            );
        }
    }
    Ok(())
}
