//! A family's compiler in a process of its own: how it starts, what it is asked, and what it says.

use core::time::Duration;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::cost::{Compiler, Dialect, Family, Figures, Statistics, figures};
use crate::process::{Error, Silence, Surroundings, Worker, beside};

use super::function::{Function, empty};

/// What a compiler says of a function, or why it says nothing.
pub type Answer = Result<Figures, String>;

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

impl Said {
    /// The compiler that a worker's first line names.
    pub fn compiler(self) -> Result<String, String> {
        match self {
            Said::Compiler(name) => Ok(name),
            Said::Absent(why) | Said::Refused(why) => Err(why),
            Said::Told(_) => Err("it answers another question".to_owned()),
        }
    }

    /// What it says of a shader.
    pub fn statistics(self) -> Result<Statistics, String> {
        match self {
            Said::Told(statistics) => Ok(statistics),
            Said::Refused(why) | Said::Absent(why) | Said::Compiler(why) => Err(why),
        }
    }
}

/// What came of a job.
pub enum Done {
    /// The compiler's name and version, and an answer for each function.
    Fresh(String, Vec<Answer>),
    /// There is no compiler, and why.
    Absent(String),
}

/// Who asks one family's compiler.
pub struct Asker<'a> {
    pub family: &'static Family,
    pub limit: Duration,
    pub surroundings: &'a Surroundings,
}

impl Asker<'_> {
    /// Asks about functions in one process; `tick` hears each answer.
    ///
    /// # Errors
    /// No process can be started.
    pub fn run(&self, functions: &[&Function], tick: &mut dyn FnMut()) -> Result<Done, Error> {
        let Some(dialect) = self.family.compiler.dialect() else {
            return Ok(Done::Absent("it has no compiler".to_owned()));
        };
        let environment = match environment(self.family, self.surroundings) {
            Ok(environment) => environment,
            Err(why) => return Ok(Done::Absent(why)),
        };
        let (worker, hello) = self.start(&environment)?;
        let compiler = match hello.compiler() {
            Ok(name) => name,
            Err(why) => return Ok(Done::Absent(why)),
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
        let mut worker = Worker::start(&words, environment, self.surroundings)?;
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
            Ok(said) => said.statistics(),
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

/// The folder of a file among what tests/mesa-compilers builds: in the folder of tools that the user names, or beside this
/// program.
fn built(file: &str, tools: Option<&Path>) -> Option<PathBuf> {
    let own = beside();
    let places = tools.into_iter().chain(own.iter().map(PathBuf::as_path));
    let mut folders = places.map(|place| place.join("mesa"));
    folders.find(|folder| folder.join(file).is_file())
}

/// What a process needs in its environment to be that compiler, or why it cannot be.
pub fn environment(
    family: &Family,
    surroundings: &Surroundings,
) -> Result<Vec<(String, OsString)>, String> {
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
            let shim = format!("lib{shim}_noop_drm_shim.so");
            let Some(folder) = built(&shim, surroundings.tools.as_deref()) else {
                return Err("its compiler is not here; tests/mesa-compilers builds it".to_owned());
            };
            all.push(pair("LD_PRELOAD", folder.join(shim).into()));
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
