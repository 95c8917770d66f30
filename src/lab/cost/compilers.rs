//! Asks the compilers of families about functions, each compiler in processes of its own.

use std::collections::BTreeMap;

use super::family::{Dialect, Family};
use super::function::CostedFunction;
use super::session::{CompilerFigures, CompilerSession, answered, launch};
use crate::lab::process::{Error, Launch, Pool, Surroundings, Task};

/// The answers of a family's compiler.
#[derive(Clone, Debug)]
pub enum FamilyAnswers {
    /// The compiler's name and version, and an answer for each function.
    Fresh(String, Vec<CompilerFigures>),
    /// The compiler is not here, and why.
    Absent(String),
}

/// A part of the work: a family, and some of the functions.
struct Job {
    family: usize,
    launch: Launch,
    functions: std::ops::Range<usize>,
}

/// The number of functions in a job: enough that the start of a process, which takes as long as ten functions, does not matter,
/// and few enough that all workers have some.
fn job_size(functions: usize, workers: usize) -> usize {
    functions.div_ceil(workers.max(1)).clamp(60, 400)
}

/// Asks the compilers of families about functions. None for a family without a compiler. `progress` is told how many answers have
/// come, of how many, and for which family.
///
/// # Errors
/// No process can be started.
pub fn ask_compilers(
    families: &[&'static Family],
    functions: &[CostedFunction],
    pool: Pool,
    surroundings: &Surroundings,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Option<FamilyAnswers>>, Error> {
    let asked = families.iter().copied();
    let asked: Vec<(&'static Family, Dialect)> = asked
        .filter_map(|family| Some((family, family.compiler.dialect()?)))
        .collect();
    let (functions, places) = once_each(functions);
    let launches = asked.iter().map(|(family, _)| launch(family, surroundings));
    let launches: Vec<Result<Launch, String>> = launches.collect();
    let size = job_size(functions.len(), pool.workers);
    let jobs = jobs(&launches, functions.len(), size);
    let task = Task {
        jobs: &jobs,
        launch: &|job: &Job| job.launch.clone(),
        work: &|worker, job, tick| {
            let (family, dialect) = asked[job.family];
            let session = CompilerSession::new(family, dialect, pool.limit, worker);
            answers(session, &functions[job.functions.clone()], tick)
        },
    };
    let (mut count, whole) = (0, (asked.len() * functions.len()) as u64);
    let done = pool.run(&task, &mut |job: &Job| {
        count += 1;
        progress(count, whole, asked[job.family].0.name);
    })?;
    let mut answers = gathered(&launches, functions.len(), &jobs, done).into_iter();
    let of_family = |family: &&'static Family| {
        family.compiler.dialect()?;
        Some(answers.next()?.at(&places))
    };
    Ok(families.iter().map(of_family).collect())
}

/// Asks about the functions of a job.
fn answers(
    mut session: CompilerSession,
    functions: &[&CostedFunction],
    tick: &dyn Fn(),
) -> Result<FamilyAnswers, Error> {
    let compiler = match answered(session.compiler())? {
        Ok(name) => name,
        Err(why) => return Ok(FamilyAnswers::Absent(why)),
    };
    let mut answers = Vec::new();
    for function in functions {
        answers.push(session.answer(function)?);
        tick();
    }
    Ok(FamilyAnswers::Fresh(compiler, answers))
}

/// The functions with distinct shaders, and for each function the index of the one that has its shader.
fn once_each(functions: &[CostedFunction]) -> (Vec<&CostedFunction>, Vec<usize>) {
    let mut known: BTreeMap<&str, usize> = BTreeMap::new();
    let mut different = Vec::new();
    let mut places = Vec::new();
    for function in functions {
        let place = known
            .entry(function.hash(Dialect::Wgsl))
            .or_insert_with(|| {
                different.push(function);
                different.len() - 1
            });
        places.push(*place);
    }
    (different, places)
}

impl FamilyAnswers {
    /// The answers with these indices.
    fn at(self, places: &[usize]) -> FamilyAnswers {
        match self {
            FamilyAnswers::Fresh(compiler, answers) => {
                let answers = places.iter().map(|place| answers[*place].clone());
                FamilyAnswers::Fresh(compiler, answers.collect())
            }
            absent => absent,
        }
    }
}

/// The jobs of all families whose compilers can be started.
fn jobs(launches: &[Result<Launch, String>], functions: usize, size: usize) -> Vec<Job> {
    let mut jobs = Vec::new();
    for (family, launch) in launches.iter().enumerate() {
        let Ok(launch) = launch else { continue };
        for start in (0..functions).step_by(size) {
            jobs.push(Job {
                family,
                launch: launch.clone(),
                functions: start..functions.min(start + size),
            });
        }
    }
    jobs
}

/// The answers of each family, in the functions' order. If one process could not start and others could, the functions of that
/// one get its reason.
fn gathered(
    launches: &[Result<Launch, String>],
    count: usize,
    jobs: &[Job],
    done: Vec<FamilyAnswers>,
) -> Vec<FamilyAnswers> {
    let unknown = |launch: &Result<Launch, String>| {
        let why = launch.as_ref().err().cloned();
        Err(why.unwrap_or_else(|| "it was not asked".to_owned()))
    };
    let mut compilers: Vec<Option<String>> = vec![None; launches.len()];
    let mut answers: Vec<Vec<CompilerFigures>> = launches
        .iter()
        .map(|launch| vec![unknown(launch); count])
        .collect();
    for (job, done) in jobs.iter().zip(done) {
        let slots = &mut answers[job.family][job.functions.clone()];
        match done {
            FamilyAnswers::Fresh(compiler, fresh) => {
                compilers[job.family] = Some(compiler);
                slots.clone_from_slice(&fresh);
            }
            FamilyAnswers::Absent(why) => slots.fill(Err(why)),
        }
    }
    let families = compilers.into_iter().zip(answers);
    families
        .map(|(compiler, answers)| match (compiler, answers.first()) {
            (Some(compiler), _) => FamilyAnswers::Fresh(compiler, answers),
            (None, Some(Err(why))) => FamilyAnswers::Absent(why.clone()),
            (None, _) => FamilyAnswers::Absent("it was not asked".to_owned()),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::cost::CostFigures;

    const JOB: usize = 60;

    #[test]
    fn a_process_that_did_not_start_takes_nothing_from_others() {
        let launches = [Ok(Launch::default()), Err("elsewhere".to_owned())];
        let jobs: Vec<Job> = jobs(&launches, 2 * JOB + 5, JOB);
        let fresh =
            |count| FamilyAnswers::Fresh("X".to_owned(), vec![Ok(CostFigures::default()); count]);
        let absent = FamilyAnswers::Absent("gone".to_owned());
        let done = vec![fresh(JOB), absent, fresh(5)];
        let all = gathered(&launches, 2 * JOB + 5, &jobs, done);
        let [FamilyAnswers::Fresh(_, answers), FamilyAnswers::Absent(why)] = all.as_slice() else {
            panic!("{all:?}");
        };
        assert!(answers[..JOB].iter().all(Result::is_ok));
        assert!(answers[JOB..2 * JOB].iter().all(Result::is_err));
        assert!(answers[2 * JOB..].iter().all(Result::is_ok));
        assert_eq!(why, "elsewhere");
    }
}
