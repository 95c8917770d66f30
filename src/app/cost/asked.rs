//! The supervisor: shares functions out among processes that each hold one compiler, and ends those that come to no end.

use core::time::Duration;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;

use serde::Deserialize;

use crate::app::error::Error;
use crate::app::worker::{Silence, Worker, scratch};
use crate::cost::{Compiler, Dialect, Family, Figures, Statistics, figures};

use super::function::{Function, empty};

/// How much a run may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For one shader.
    pub seconds: u64,
    /// Processes at once.
    pub workers: usize,
}

/// What a compiler says of a function, or why it says nothing.
pub type Answer = Result<Figures, String>;

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

/// What a worker answers.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Said {
    /// It is here: its name and version.
    Compiler(String),
    /// It is not, and why.
    Absent(String),
    /// What it says of a shader.
    Told(Statistics),
    /// It refuses a shader, and why.
    Refused(String),
}

/// What came of a job.
enum Done {
    Fresh(String, Vec<Answer>),
    Absent(String),
}

/// Functions of one job: enough that starting a process, which takes as long as ten functions, does not count, and few
/// enough that all workers have some.
fn job_size(functions: usize, workers: usize) -> usize {
    functions.div_ceil(workers.max(1)).clamp(60, 400)
}

/// Asks the compilers of families about functions. `progress` hears how many answers are there.
///
/// # Errors
/// No process can be started.
pub fn ask(
    families: &[&'static Family],
    functions: &[Function],
    limits: Limits,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<Vec<Told>, Error> {
    if families.is_empty() {
        return Ok(Vec::new());
    }
    let (functions, places) = once_each(functions);
    let scratch = scratch()?;
    let size = job_size(functions.len(), limits.workers);
    let jobs: Vec<Job> = jobs(families.len(), functions.len(), size);
    let crew = Crew {
        families,
        functions: &functions,
        results: jobs.iter().map(|_| Mutex::default()).collect(),
        jobs: &jobs,
        limit: Duration::from_secs(limits.seconds),
        scratch: scratch.path(),
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
    scratch: &'a Path,
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
                scratch: self.scratch,
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

/// Who asks one family's compiler.
struct Asker<'a> {
    family: &'static Family,
    limit: Duration,
    scratch: &'a Path,
}

impl Asker<'_> {
    fn run(&self, functions: &[&Function], tick: &mut dyn FnMut()) -> Result<Done, Error> {
        let Some(dialect) = self.family.compiler.dialect() else {
            return Ok(Done::Absent("it has no compiler".to_owned()));
        };
        let environment = match environment(self.family) {
            Ok(environment) => environment,
            Err(why) => return Ok(Done::Absent(why)),
        };
        let (worker, hello) = self.start(&environment)?;
        let compiler = match hello {
            Said::Compiler(name) => name,
            Said::Absent(why) | Said::Refused(why) => return Ok(Done::Absent(why)),
            Said::Told(_) => return Ok(Done::Absent("it answers another question".to_owned())),
        };
        let mut session = Session {
            asker: self,
            dialect,
            environment,
            worker,
            empty: BTreeMap::new(),
            hangs: 0,
            is_silent: false,
        };
        let mut answers = Vec::new();
        for function in functions {
            answers.push(session.answer(function)?);
            tick();
        }
        Ok(Done::Fresh(compiler, answers))
    }

    fn start(&self, environment: &[(String, OsString)]) -> Result<(Worker, Said), Error> {
        let words = ["cost", "--worker", self.family.name].map(OsString::from);
        let mut worker = Worker::start(&words, environment, self.scratch)?;
        let hello = worker.ask::<Said>("", self.limit);
        let hello = hello.unwrap_or_else(|silence| Said::Absent(reason(&silence, self.limit)));
        Ok((worker, hello))
    }
}

/// Hangs after which a process is asked no more.
const HANGS: usize = 3;

/// A compiler at work.
struct Session<'a> {
    asker: &'a Asker<'a>,
    dialect: Dialect,
    environment: Vec<(String, OsString)>,
    worker: Worker,
    /// The chains of the empty function, of one channel or not, in each precision.
    empty: BTreeMap<(bool, bool), [Statistics; 2]>,
    hangs: usize,
    is_silent: bool,
}

impl Session<'_> {
    fn answer(&mut self, function: &Function) -> Result<Answer, Error> {
        if self.hangs >= HANGS {
            let why = format!("not asked: the compiler hung {HANGS} times before");
            return Ok(Err(why));
        }
        if function.precision.is_half() && !self.asker.family.half {
            return Ok(Err("it has no 16-bit arithmetic".to_owned()));
        }
        let answer = self.figures(function);
        if std::mem::take(&mut self.is_silent) {
            // It is gone, or at work without end.
            self.worker = self.asker.start(&self.environment)?.0;
        }
        Ok(answer)
    }

    fn figures(&mut self, function: &Function) -> Answer {
        let empty = self.empty(function)?;
        let chains = self.both(function.chains(self.dialect))?;
        let columns = &self.asker.family.columns;
        figures(columns, self.dialect.chains(), &chains, &empty)
            .ok_or_else(|| "the compiler does not tell instructions".to_owned())
    }

    fn empty(&mut self, function: &Function) -> Result<[Statistics; 2], String> {
        let kind = (function.is_scalar(), function.precision.is_half());
        if let Some(known) = self.empty.get(&kind) {
            return Ok(known.clone());
        }
        let chains = empty(function.is_scalar(), function.precision, self.dialect);
        let told = self.both(chains)?;
        self.empty.insert(kind, told.clone());
        Ok(told)
    }

    fn both(&mut self, [short, long]: [String; 2]) -> Result<[Statistics; 2], String> {
        Ok([self.shader(&short)?, self.shader(&long)?])
    }

    fn shader(&mut self, text: &str) -> Result<Statistics, String> {
        let line = serde_json::to_string(text).map_err(|why| why.to_string())?;
        match self.worker.ask::<Said>(&line, self.asker.limit) {
            Ok(Said::Told(statistics)) => Ok(statistics),
            Ok(Said::Refused(why) | Said::Absent(why) | Said::Compiler(why)) => Err(why),
            Err(silence) => {
                self.is_silent = true;
                self.hangs += usize::from(silence == Silence::TooLong);
                Err(reason(&silence, self.asker.limit))
            }
        }
    }
}

/// Why a compiler gave no answer.
pub fn reason(silence: &Silence, limit: Duration) -> String {
    match silence {
        Silence::TooLong => format!("the compiler did not end within {} s", limit.as_secs()),
        Silence::Ended(status) => format!("the process with the compiler ended ({status})"),
    }
}

/// Where tests/mesa-compilers puts what it builds.
fn built() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("target/tools/mesa")
}

/// What a process needs in its environment to be that compiler, or why it cannot be.
pub fn environment(family: &Family) -> Result<Vec<(String, OsString)>, String> {
    let pair = |name: &str, value: OsString| (name.to_owned(), value);
    let mut all = vec![
        pair("MESA_SHADER_CACHE_DISABLE", "true".into()),
        // A driver with a thread of its own remarks nothing.
        pair("GALLIUM_THREAD", "0".into()),
    ];
    match family.compiler {
        Compiler::Radv(chip) => all.push(pair("RADV_FORCE_FAMILY", chip.into())),
        Compiler::Mesa {
            shim, environment, ..
        } => {
            let folder = built();
            let shim = folder.join(format!("lib{shim}_noop_drm_shim.so"));
            if !shim.is_file() {
                return Err("its compiler is not here; tests/mesa-compilers builds it".to_owned());
            }
            all.push(pair("LD_PRELOAD", shim.into()));
            all.push(pair("LIBGL_DRIVERS_PATH", folder.join("dri").into()));
            all.push(pair("LD_LIBRARY_PATH", folder.into()));
            all.extend(
                environment
                    .iter()
                    .map(|(name, value)| pair(name, value.into())),
            );
        }
        Compiler::Operations | Compiler::None(_) => {}
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

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
