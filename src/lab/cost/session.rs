//! A family's compiler in a worker process: its launch, the requests and responses, and the worker's loop. The worker opens the
//! compiler that its environment selects, and answers with its name and its statistics of shaders.

use core::time::Duration;
use std::collections::BTreeMap;
use std::ffi::{CString, OsString};
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::family::{Dialect, Family, GpuCompiler};
use super::figures::{CostFigures, Statistics, figures, remarked};
use super::function::CostedFunction;
use super::probe::{ENTRY, VERTEX, WGSL_VERTEX, gles_vertex};
use crate::generator::emit::wgsl_to_spirv;
use crate::lab::fault::Fault;
use crate::lab::gpu::{GlesCompiler, ModuleEntry, VulkanCompiler};
use crate::lab::process::{Error, Inbox, Launch, NoAnswer, Surroundings, Worker, beside};
use crate::language::ir::Ty;

/// A compiler's figures of a function, or why there are none.
pub type CompilerFigures = Result<CostFigures, String>;

/// Why a compiler gave no answer.
#[derive(Debug, thiserror::Error)]
pub enum CompilerError {
    /// No process can be started.
    #[error(transparent)]
    Process(#[from] Error),
    /// The compiler is absent, hangs, fails or refuses the shader.
    #[error("{0}")]
    Compiler(String),
}

/// A compiler's answer, or why there is none.
///
/// # Errors
/// No process can be started.
pub fn answered<T>(asked: Result<T, CompilerError>) -> Result<Result<T, String>, Error> {
    match asked {
        Ok(answered) => Ok(Ok(answered)),
        Err(CompilerError::Compiler(why)) => Ok(Err(why)),
        Err(CompilerError::Process(error)) => Err(error),
    }
}

/// The number of hangs after which a compiler is not asked again.
const HANGS: usize = 3;

/// A session with a compiler in a worker.
pub struct CompilerSession<'a> {
    family: &'static Family,
    dialect: Dialect,
    limit: Duration,
    worker: &'a mut Worker,
    /// The statistics of the empty function's chains, by the types of its argument and its result, and by whether it is in half
    /// precision.
    empty: BTreeMap<(Ty, Ty, bool), [Statistics; 2]>,
    hangs: usize,
}

impl<'a> CompilerSession<'a> {
    /// A session with the compiler of a family that has one.
    pub fn new(
        family: &'static Family,
        dialect: Dialect,
        limit: Duration,
        worker: &'a mut Worker,
    ) -> CompilerSession<'a> {
        CompilerSession {
            family,
            dialect,
            limit,
            worker,
            empty: BTreeMap::new(),
            hangs: 0,
        }
    }

    /// The compiler's name and version.
    ///
    /// # Errors
    /// It is absent.
    pub fn compiler(&mut self) -> Result<String, CompilerError> {
        match self.ask(&CompilerRequest::Name)? {
            CompilerResponse::Name(name) => Ok(name),
            CompilerResponse::Statistics(_) => Err(another_question()),
        }
    }

    /// The compiler's figures of a function.
    ///
    /// # Errors
    /// No process can be started.
    pub fn answer(&mut self, function: &CostedFunction) -> Result<CompilerFigures, Error> {
        if self.hangs >= HANGS {
            let why = format!("not asked: the compiler hung {HANGS} times before");
            return Ok(Err(why));
        }
        if function.id.precision.is_half() && !self.family.half {
            return Ok(Err("it has no 16-bit arithmetic".to_owned()));
        }
        answered(self.figures(function))
    }

    /// The compiler's figures from shaders with the shorter and the longer chain of a function, then of the empty function.
    ///
    /// # Errors
    /// There is no answer for one of them.
    pub fn figures_of_shaders(
        &mut self,
        [short, long, empty_short, empty_long]: [FragmentShader; 4],
    ) -> Result<CostFigures, CompilerError> {
        let chains = self.both([short, long])?;
        let empty = self.both([empty_short, empty_long])?;
        self.net_figures(&chains, &empty)
    }

    fn statistics(&mut self, shader: FragmentShader) -> Result<Statistics, CompilerError> {
        match self.ask(&CompilerRequest::Measure(shader))? {
            CompilerResponse::Statistics(statistics) => Ok(statistics),
            CompilerResponse::Name(_) => Err(another_question()),
        }
    }

    fn ask(&mut self, request: &CompilerRequest) -> Result<CompilerResponse, CompilerError> {
        let answer: Result<CompilerAnswer, NoAnswer> = self.worker.ask(request, self.limit)?;
        let answer = answer.unwrap_or_else(|no_answer| {
            self.hangs += usize::from(no_answer == NoAnswer::TooLong);
            Err(reason(&no_answer, self.limit))
        });
        answer.map_err(CompilerError::Compiler)
    }

    fn figures(&mut self, function: &CostedFunction) -> Result<CostFigures, CompilerError> {
        let empty = self.empty(function)?;
        let chains = self.both(function.chains(self.dialect).map(FragmentShader::Text))?;
        let figures = self.net_figures(&chains, &empty)?;
        Ok(if function.graph.computes_nothing() {
            figures.of_nothing()
        } else {
            figures
        })
    }

    fn net_figures(
        &self,
        chains: &[Statistics; 2],
        empty: &[Statistics; 2],
    ) -> Result<CostFigures, CompilerError> {
        let figures = figures(&self.family.columns, self.dialect.chains(), chains, empty);
        let silent = "the compiler does not tell instructions";
        figures.ok_or_else(|| CompilerError::Compiler(silent.to_owned()))
    }

    fn empty(&mut self, function: &CostedFunction) -> Result<[Statistics; 2], CompilerError> {
        let (first, result) = function.ends();
        let kind = (first, result, function.id.precision.is_half());
        if let Some(known) = self.empty.get(&kind) {
            return Ok(known.clone());
        }
        let chains = function.empty_chains(self.dialect);
        let found = self.both(chains.map(FragmentShader::Text))?;
        self.empty.insert(kind, found.clone());
        Ok(found)
    }

    fn both(
        &mut self,
        [short, long]: [FragmentShader; 2],
    ) -> Result<[Statistics; 2], CompilerError> {
        Ok([self.statistics(short)?, self.statistics(long)?])
    }
}

fn another_question() -> CompilerError {
    CompilerError::Compiler("it answers another question".to_owned())
}

/// Why a compiler gave no answer.
fn reason(no_answer: &NoAnswer, limit: Duration) -> String {
    match no_answer {
        NoAnswer::TooLong => format!("the compiler did not end within {} s", limit.as_secs()),
        NoAnswer::Ended(status) => format!("the process with the compiler ended ({status})"),
    }
}

/// The launch of a process with a family's compiler, or why there is none.
///
/// # Errors
/// The family's compiler was not built here.
pub fn launch(family: &Family, surroundings: &Surroundings) -> Result<Launch, String> {
    let launch = Launch::new(&["cost", "--worker", family.name], surroundings);
    Ok(launch.with_environment(environment(family, surroundings)?))
}

/// The folder of a file that tests/mesa-compilers builds: in the user's folder of tools, or beside this program.
fn built(file: &str, tools: Option<&Path>) -> Option<PathBuf> {
    let own = beside();
    let places = tools.into_iter().chain(own.iter().map(PathBuf::as_path));
    let mut folders = places.map(|place| place.join("mesa"));
    folders.find(|folder| folder.join(file).is_file())
}

/// The environment that makes a process that compiler, or why there is none.
fn environment(
    family: &Family,
    surroundings: &Surroundings,
) -> Result<Vec<(String, OsString)>, String> {
    let pair = |name: &str, value: OsString| (name.to_owned(), value);
    let mut all = vec![
        pair("MESA_SHADER_CACHE_DISABLE", "true".into()),
        // A driver with a thread of its own sends no debug messages.
        pair("GALLIUM_THREAD", "0".into()),
    ];
    match family.compiler {
        GpuCompiler::Radv(chip) => all.push(pair("RADV_FORCE_FAMILY", chip.into())),
        GpuCompiler::Mesa {
            shim, environment, ..
        } => {
            let shim = format!("lib{shim}_noop_drm_shim.so");
            let Some(folder) = built(&shim, surroundings.tools.as_deref()) else {
                return Err("its compiler is not here; tests/mesa-compilers builds it".to_owned());
            };
            all.push(pair("LD_PRELOAD", folder.join(shim).into()));
            all.push(pair("LIBGL_DRIVERS_PATH", folder.join("dri").into()));
            all.push(pair("LD_LIBRARY_PATH", folder.into()));
            let own = environment.iter();
            all.extend(own.map(|(name, value)| pair(name, value.into())));
        }
        GpuCompiler::Operations | GpuCompiler::None(_) => {}
    }
    Ok(all)
}

/// A request to a worker with a compiler.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum CompilerRequest {
    /// For the compiler's name and version.
    Name,
    /// For the statistics of a shader.
    Measure(FragmentShader),
}

/// A fragment shader.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum FragmentShader {
    /// In the compiler's language, or in WGSL for one that takes SPIR-V.
    Text(String),
    /// A module of SPIR-V.
    Module(Vec<u8>),
}

/// What the worker answers.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum CompilerResponse {
    /// The compiler's name and version.
    Name(String),
    /// Its statistics of a shader.
    Statistics(Statistics),
}

/// The worker's answer, or why there is none: the compiler is not here, or refuses the shader.
type CompilerAnswer = Result<CompilerResponse, String>;

/// An opened compiler.
enum Open {
    Radv(Box<VulkanCompiler>, [CString; 2]),
    Mesa(Box<GlesCompiler>, Dialect),
}

/// Serves until the supervisor is gone.
///
/// # Errors
/// The pipe is gone.
pub fn serve(family: &Family) -> io::Result<()> {
    let inbox = Inbox::open();
    let opened = open(family);
    inbox.serve(|request| -> CompilerAnswer {
        let open = opened.as_ref().map_err(Fault::to_string)?;
        match request {
            CompilerRequest::Name => Ok(CompilerResponse::Name(open.compiler())),
            CompilerRequest::Measure(shader) => {
                open.measure(&shader).map(CompilerResponse::Statistics)
            }
        }
    })
}

fn open(family: &Family) -> Result<Open, Fault> {
    match family.compiler {
        GpuCompiler::Radv(_) => {
            let vertex = wgsl_to_spirv(WGSL_VERTEX).expect("the vertex shader is a constant");
            let names = [VERTEX, ENTRY].map(|name| CString::new(name).unwrap_or_default());
            Ok(Open::Radv(Box::new(VulkanCompiler::open(&vertex)?), names))
        }
        GpuCompiler::Mesa { dialect, .. } => {
            let major = if dialect == Dialect::Es100 { 2 } else { 3 };
            Ok(Open::Mesa(Box::new(GlesCompiler::open(major)?), dialect))
        }
        GpuCompiler::Operations | GpuCompiler::None(_) => Err(Fault::Absent(format!(
            "{} has no compiler; none is needed",
            family.name
        ))),
    }
}

impl Open {
    fn compiler(&self) -> String {
        match self {
            Open::Radv(null, _) => format!("{}, {}", null.driver, null.name),
            Open::Mesa(node, _) => format!("{}, {}", node.driver, node.name),
        }
    }

    fn measure(&self, shader: &FragmentShader) -> Result<Statistics, String> {
        match (self, shader) {
            (Open::Radv(..), FragmentShader::Text(text)) => {
                self.measure(&FragmentShader::Module(wgsl_to_spirv(text)?))
            }
            (Open::Radv(null, [vertex, entry]), FragmentShader::Module(module)) => {
                let name = entry;
                let statistics = null.measure(vertex, ModuleEntry { module, name });
                statistics
                    .map(Statistics::from_iter)
                    .map_err(|why| why.to_string())
            }
            (Open::Mesa(..), FragmentShader::Module(_)) => {
                Err("it takes GLSL ES, no SPIR-V".to_owned())
            }
            (Open::Mesa(node, dialect), FragmentShader::Text(text)) => {
                let remarks = node
                    .link(&gles_vertex(*dialect), text)
                    .map_err(|why| why.to_string())?;
                let silent = || format!("the driver does not say what became of it: {remarks:?}");
                remarked(&remarks).ok_or_else(silent)
            }
        }
    }
}
