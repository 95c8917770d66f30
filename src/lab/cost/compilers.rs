//! Asks the compilers of families about functions, each compiler in processes of its own.

use std::collections::BTreeMap;

use super::family::{Dialect, Family};
use super::function::CostedFunction;
use super::session::{CompilerFigures, CompilerSession, answered, launch};
use crate::lab::process::{Error, Launch, Pool, Surroundings, Task};

/// The answers of a family's compiler.
#[derive(Clone, Debug)]
pub enum FamilyAnswers {
    /// The compiler's name and version, and for each function its answer. None for a function that it was not asked about.
    Fresh(String, Vec<Option<CompilerFigures>>),
    /// The compiler is not here or was asked about nothing, and why.
    Absent(String),
}

/// A part of the work: a family, and the indices of some functions.
struct Job {
    family: usize,
    launch: Launch,
    functions: Vec<usize>,
}

/// The number of functions in a job: enough that the start of a process, which takes as long as ten functions, does not matter,
/// and few enough that all workers have some.
fn job_size(functions: usize, workers: usize) -> usize {
    functions.div_ceil(workers.max(1)).clamp(60, 400)
}

/// Asks the compilers of families about those functions that `is_asked` chooses. None for a family without a compiler. `progress` is
/// told how many answers have come, of how many, and for which family.
///
/// # Errors
/// No process can be started.
pub fn ask_compilers(
    families: &[&'static Family],
    functions: &[CostedFunction],
    is_asked: &dyn Fn(&Family, &CostedFunction) -> bool,
    pool: Pool,
    surroundings: &Surroundings,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Option<FamilyAnswers>>, Error> {
    let asked = families.iter().copied();
    let asked: Vec<(&'static Family, Dialect)> = asked
        .filter_map(|family| Some((family, family.compiler.dialect()?)))
        .collect();
    let parts = asked.iter().map(|(family, _)| {
        let chosen: Vec<usize> = (0..functions.len())
            .filter(|place| is_asked(family, &functions[*place]))
            .collect();
        once_each(functions, &chosen)
    });
    let parts: Vec<FamilyPart> = parts.collect();
    let launches = asked.iter().zip(&parts).map(|((family, _), part)| {
        if part.different.is_empty() {
            return Err(NOT_ASKED.to_owned());
        }
        launch(family, surroundings)
    });
    let launches: Vec<Result<Launch, String>> = launches.collect();
    let jobs = jobs(&launches, &parts, pool.workers);
    let task = Task {
        jobs: &jobs,
        launch: &|job: &Job| job.launch.clone(),
        work: &|worker, job, tick| {
            let (family, dialect) = asked[job.family];
            let session = CompilerSession::new(family, dialect, pool.limit, worker);
            let functions = job.functions.iter().map(|place| &functions[*place]);
            answers(session, functions, tick)
        },
    };
    let whole: usize = parts.iter().map(|part| part.different.len()).sum();
    let (mut count, whole) = (0, whole as u64);
    let done = pool.run(&task, &mut |job: &Job| {
        count += 1;
        progress(count, whole, asked[job.family].0.name);
    })?;
    let mut answers = gathered(&launches, &parts, &jobs, done).into_iter();
    let of_family = |family: &&'static Family| {
        family.compiler.dialect()?;
        answers.next()
    };
    Ok(families.iter().map(of_family).collect())
}

/// Why a family's compiler gave no answer.
pub(super) const NOT_ASKED: &str = "its compiler was not asked";

/// Asks about the functions of a job.
fn answers<'a>(
    mut session: CompilerSession,
    functions: impl Iterator<Item = &'a CostedFunction>,
    tick: &dyn Fn(),
) -> Result<FamilyAnswers, Error> {
    let compiler = match answered(session.compiler())? {
        Ok(name) => name,
        Err(why) => return Ok(FamilyAnswers::Absent(why)),
    };
    let mut answers = Vec::new();
    for function in functions {
        answers.push(Some(session.answer(function)?));
        tick();
    }
    Ok(FamilyAnswers::Fresh(compiler, answers))
}

/// What a family's compiler is asked.
struct FamilyPart {
    /// The indices of functions with distinct shaders.
    different: Vec<usize>,
    /// For each function the place among these of the one that has its shader. None for a function that is not asked about.
    places: Vec<Option<usize>>,
}

/// Those functions of the chosen ones that have distinct shaders.
fn once_each(functions: &[CostedFunction], chosen: &[usize]) -> FamilyPart {
    let mut known: BTreeMap<&str, usize> = BTreeMap::new();
    let mut different = Vec::new();
    let mut places = vec![None; functions.len()];
    for index in chosen.iter().copied() {
        let place = known
            .entry(functions[index].hash(Dialect::Wgsl))
            .or_insert_with(|| {
                different.push(index);
                different.len() - 1
            });
        places[index] = Some(*place);
    }
    FamilyPart { different, places }
}

/// The jobs of all families whose compilers can be started.
fn jobs(launches: &[Result<Launch, String>], parts: &[FamilyPart], workers: usize) -> Vec<Job> {
    let mut jobs = Vec::new();
    for (family, (launch, part)) in launches.iter().zip(parts).enumerate() {
        let Ok(launch) = launch else { continue };
        for functions in part
            .different
            .chunks(job_size(part.different.len(), workers))
        {
            jobs.push(Job {
                family,
                launch: launch.clone(),
                functions: functions.to_vec(),
            });
        }
    }
    jobs
}

/// The answers of each family, in the functions' order. If one process could not start and others could, the functions of that
/// one get its reason.
fn gathered(
    launches: &[Result<Launch, String>],
    parts: &[FamilyPart],
    jobs: &[Job],
    done: Vec<FamilyAnswers>,
) -> Vec<FamilyAnswers> {
    let mut compilers: Vec<Option<String>> = vec![None; launches.len()];
    let mut answers: Vec<Vec<Option<CompilerFigures>>> = vec![Vec::new(); launches.len()];
    for (job, done) in jobs.iter().zip(done) {
        match done {
            FamilyAnswers::Fresh(compiler, fresh) => {
                compilers[job.family] = Some(compiler);
                answers[job.family].extend(fresh);
            }
            FamilyAnswers::Absent(why) => {
                let lacking = job.functions.iter().map(|_| Some(Err(why.clone())));
                answers[job.family].extend(lacking);
            }
        }
    }
    let families = compilers.into_iter().zip(answers).zip(launches).zip(parts);
    families
        .map(|(((compiler, answers), launch), part)| {
            let absent = || match (launch, answers.first()) {
                (Err(why), _) | (_, Some(Some(Err(why)))) => why.clone(),
                _ => NOT_ASKED.to_owned(),
            };
            let Some(compiler) = compiler else {
                return FamilyAnswers::Absent(absent());
            };
            let of_place = |place: &Option<usize>| place.and_then(|place| answers[place].clone());
            FamilyAnswers::Fresh(compiler, part.places.iter().map(of_place).collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::cost::CostFigures;

    const JOB: usize = 60;

    fn all_of(count: usize) -> FamilyPart {
        FamilyPart {
            different: (0..count).collect(),
            places: (0..count).map(Some).collect(),
        }
    }

    #[test]
    fn a_process_that_did_not_start_takes_nothing_from_others() {
        let launches = [Ok(Launch::default()), Err("elsewhere".to_owned())];
        let parts = [all_of(2 * JOB + 5), all_of(2 * JOB + 5)];
        let jobs: Vec<Job> = jobs(&launches, &parts, 100);
        let fresh = |count| {
            let answers = vec![Some(Ok(CostFigures::default())); count];
            FamilyAnswers::Fresh("X".to_owned(), answers)
        };
        let absent = FamilyAnswers::Absent("gone".to_owned());
        let done = vec![fresh(JOB), absent, fresh(5)];
        let all = gathered(&launches, &parts, &jobs, done);
        let [FamilyAnswers::Fresh(_, answers), FamilyAnswers::Absent(why)] = all.as_slice() else {
            panic!("{all:?}");
        };
        let is_known = |answer: &Option<CompilerFigures>| matches!(answer, Some(Ok(_)));
        assert!(answers[..JOB].iter().all(is_known));
        assert!(!answers[JOB..2 * JOB].iter().any(is_known));
        assert!(answers[2 * JOB..].iter().all(is_known));
        assert_eq!(why, "elsewhere");
    }

    #[test]
    fn what_was_not_asked_has_no_answer() {
        let launches = [Ok(Launch::default()), Err(NOT_ASKED.to_owned())];
        let some = FamilyPart {
            different: vec![1],
            places: vec![None, Some(0), None, Some(0)],
        };
        let none = FamilyPart {
            different: Vec::new(),
            places: vec![None; 4],
        };
        let parts = [some, none];
        let jobs: Vec<Job> = jobs(&launches, &parts, 2);
        let answer = vec![Some(Ok(CostFigures::default()))];
        let done = vec![FamilyAnswers::Fresh("X".to_owned(), answer)];
        let all = gathered(&launches, &parts, &jobs, done);
        let [FamilyAnswers::Fresh(_, answers), FamilyAnswers::Absent(why)] = all.as_slice() else {
            panic!("{all:?}");
        };
        let is_asked = answers.iter().map(Option::is_some);
        assert_eq!(is_asked.collect::<Vec<bool>>(), [false, true, false, true]);
        assert_eq!(why, NOT_ASKED);
    }
}
