//! The supervisor: shares functions out among processes that each hold one compiler.

use core::time::Duration;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;

use crate::cost::{Dialect, Family};
use crate::process::{Error, Surroundings};

use super::function::Function;
use super::session::{Answer, Asker, Done};

/// How much a run may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For one shader.
    pub seconds: u64,
    /// Processes at once.
    pub workers: usize,
}

/// What came of asking a family's compiler.
#[derive(Clone, Debug)]
pub enum Told {
    /// It is here: its name and version, and an answer for each function.
    Fresh(String, Vec<Answer>),
    /// It is not, and why.
    Absent(String),
}

/// A part of the work: a family, and some of the functions.
struct Job {
    family: usize,
    functions: std::ops::Range<usize>,
}

/// Functions of one job: enough that starting a process, which takes as long as ten functions, does not count, and few
/// enough that all workers have some.
fn job_size(functions: usize, workers: usize) -> usize {
    functions.div_ceil(workers.max(1)).clamp(60, 400)
}

/// Asks the compilers of families about functions; nothing comes of a family that has none. `progress` hears how many answers
/// are there.
///
/// # Errors
/// No process can be started.
pub fn ask(
    families: &[&'static Family],
    functions: &[Function],
    limits: Limits,
    surroundings: &Surroundings,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Option<Told>>, Error> {
    let has_compiler = |family: &&'static Family| family.compiler.dialect().is_some();
    let asked: Vec<&'static Family> = families.iter().copied().filter(has_compiler).collect();
    let mut told = ask_compilers(&asked, functions, limits, surroundings, progress)?.into_iter();
    let of = |family: &&'static Family| has_compiler(family).then(|| told.next()).flatten();
    Ok(families.iter().map(of).collect())
}

fn ask_compilers(
    families: &[&'static Family],
    functions: &[Function],
    limits: Limits,
    surroundings: &Surroundings,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Told>, Error> {
    if families.is_empty() {
        return Ok(Vec::new());
    }
    let (functions, places) = once_each(functions);
    let size = job_size(functions.len(), limits.workers);
    let jobs: Vec<Job> = jobs(families.len(), functions.len(), size);
    let crew = Crew {
        families,
        functions: &functions,
        results: jobs.iter().map(|_| Mutex::default()).collect(),
        jobs: &jobs,
        limit: Duration::from_secs(limits.seconds),
        surroundings,
        next: AtomicUsize::new(0),
    };
    let whole = (families.len() * functions.len()) as u64;
    let (send, heard) = channel();
    thread::scope(|scope| {
        let start = |_| {
            let send = send.clone();
            let crew = &crew;
            scope.spawn(move || crew.work(&send))
        };
        let threads: Vec<_> = (0..limits.workers.max(1)).map(start).collect();
        drop(send);
        for (count, family) in heard.iter().enumerate() {
            progress(count as u64 + 1, whole, families[family].name);
        }
        let ends = threads.into_iter().map(|thread| {
            let end = thread.join();
            end.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        });
        ends.collect::<Result<Vec<()>, Error>>()
    })?;
    let results = crew.results.into_iter();
    let results = results.map(|result| result.into_inner().unwrap_or_default());
    let told = gathered(families.len(), functions.len(), &jobs, results);
    Ok(told.into_iter().map(|told| told.at(&places)).collect())
}

/// What the threads of a run share.
struct Crew<'a> {
    families: &'a [&'static Family],
    functions: &'a [&'a Function],
    jobs: &'a [Job],
    results: Vec<Mutex<Option<Done>>>,
    limit: Duration,
    surroundings: &'a Surroundings,
    next: AtomicUsize,
}

impl Crew<'_> {
    /// Takes jobs until there are none.
    fn work(&self, send: &Sender<usize>) -> Result<(), Error> {
        loop {
            let place = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = self.jobs.get(place) else {
                return Ok(());
            };
            let asker = Asker {
                family: self.families[job.family],
                limit: self.limit,
                surroundings: self.surroundings,
            };
            let done = asker.run(&self.functions[job.functions.clone()], &mut || {
                // Nobody listens any more where another process could not be started.
                let _ = send.send(job.family);
            })?;
            if let Ok(mut slot) = self.results[place].lock() {
                *slot = Some(done);
            }
        }
    }
}

/// Functions whose shaders are different, and for each function which of them is its own.
fn once_each(functions: &[Function]) -> (Vec<&Function>, Vec<usize>) {
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

impl Told {
    /// The same with the answers of these places.
    fn at(self, places: &[usize]) -> Told {
        match self {
            Told::Fresh(compiler, answers) => {
                let answers = places.iter().map(|place| answers[*place].clone());
                Told::Fresh(compiler, answers.collect())
            }
            absent => absent,
        }
    }
}

fn jobs(families: usize, functions: usize, size: usize) -> Vec<Job> {
    let parts = (0..functions)
        .step_by(size)
        .map(|start| start..functions.min(start + size));
    let parts: Vec<_> = parts.collect();
    (0..families)
        .flat_map(|family| {
            let job = move |functions: &std::ops::Range<usize>| Job {
                family,
                functions: functions.clone(),
            };
            parts.iter().map(job).collect::<Vec<_>>()
        })
        .collect()
}

/// The answers of each family, in the functions' order. Where one process could not start and others could, the functions
/// of that one have its reason.
fn gathered(
    families: usize,
    count: usize,
    jobs: &[Job],
    results: impl Iterator<Item = Option<Done>>,
) -> Vec<Told> {
    let unknown = || Err("it was not asked".to_owned());
    let mut compilers: Vec<Option<String>> = vec![None; families];
    let mut answers: Vec<Vec<Answer>> = (0..families).map(|_| vec![unknown(); count]).collect();
    for (job, done) in jobs.iter().zip(results) {
        let slots = &mut answers[job.family][job.functions.clone()];
        match done {
            Some(Done::Fresh(compiler, fresh)) => {
                compilers[job.family] = Some(compiler);
                slots.clone_from_slice(&fresh);
            }
            Some(Done::Absent(why)) => slots.fill(Err(why)),
            None => {}
        }
    }
    let told = compilers.into_iter().zip(answers);
    told.map(|(compiler, answers)| match (compiler, answers.first()) {
        (Some(compiler), _) => Told::Fresh(compiler, answers),
        (None, Some(Err(why))) => Told::Absent(why.clone()),
        (None, _) => Told::Absent("it was not asked".to_owned()),
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::Figures;

    const JOB: usize = 60;

    #[test]
    fn a_process_that_did_not_start_takes_nothing_from_others() {
        let jobs: Vec<Job> = jobs(1, 2 * JOB + 5, JOB);
        let fresh = |count| {
            Some(Done::Fresh(
                "X".to_owned(),
                vec![Ok(Figures::default()); count],
            ))
        };
        let done = [fresh(JOB), Some(Done::Absent("gone".to_owned())), fresh(5)];
        let told = gathered(1, 2 * JOB + 5, &jobs, done.into_iter());
        let [Told::Fresh(_, answers)] = told.as_slice() else {
            panic!("{told:?}");
        };
        assert!(answers[..JOB].iter().all(Result::is_ok));
        assert!(answers[JOB..2 * JOB].iter().all(Result::is_err));
        assert!(answers[2 * JOB..].iter().all(Result::is_ok));
    }
}
