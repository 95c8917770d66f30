//! Audit: a user's own function compared with the reference reflectance of a material, and with our methods.
//!
//! This room reads only heads of functions (`scan`) and loops (`loops`) of the text; compilers read the rest. A program of ours
//! goes around the user's function (`program`). It runs in a worker (`runner`, `serve`), so that a function that hangs or
//! crashes a driver is a line of the report. Compilers run in workers too (`compile`).

mod accept;
mod bind;
mod comparison;
mod compile;
mod cost;
mod directives;
mod edges;
mod error;
mod language;
mod loops;
mod ours;
mod place;
mod program;
mod protocol;
mod row;
mod runner;
mod scan;
mod serve;

use core::time::Duration;
use std::path::PathBuf;

use crate::cost::Family;
use crate::gpu::Uniform;
use crate::methods::find_input;
use crate::num::each_channel;
use crate::reference::MaterialInMedium;
use crate::spectra::Space;
use crate::verify::compilers::{CompilerFault, Verdict};

use crate::process::{Pool, Surroundings};

pub use bind::Given;
pub use edges::EdgeRow;
pub use error::{Error, FunctionPlace, ValueFault};
pub use language::Language;
pub use row::{ArgumentValue, AuditCost, AuditRow, Dominating, PerceivedFigures};
pub use serve::serve;

use bind::{Bound, BoundArgument};
use compile::Compilers;
use program::AuditProgram;
use row::{Audited, Ran};
use runner::{Runner, Trouble};

/// What is audited.
#[derive(Clone, Debug)]
pub struct Audit {
    /// The file's name, for messages.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Its language.
    pub language: Language,
    /// The function; where none is named the file holds one.
    pub function: Option<String>,
    /// Values of its arguments.
    pub given: Vec<Given>,
    /// The space of colours, for errors as they are seen.
    pub space: Space,
    /// The GPUs whose compilers are asked.
    pub families: Vec<&'static Family>,
    /// The folder of compilers that the user names.
    pub tools: Option<PathBuf>,
    /// Seconds that one step may take.
    pub seconds: u64,
    /// Processes at once.
    pub workers: usize,
}

impl Audit {
    /// The row of a material.
    ///
    /// # Errors
    /// The file does not hold the function, or its arguments are not bound.
    pub fn audit_row(
        &self,
        subject: &MaterialInMedium,
        progress: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<AuditRow, Error> {
        program::check(&self.file, &self.text, self.language)?;
        let found = scan::functions(&self.text, self.language);
        let chosen = bind::choose(&self.file, found, self.function.as_deref())?;
        program::check_name(&self.file, &self.text, self.language, &chosen.name)?;
        let bound = bind::bind(&self.file, chosen, &self.given, subject)?;
        let (program, run) = AuditProgram::pair(self.language, &self.text, &bound);
        let surroundings = Surroundings::new(self.tools.as_deref())?;
        let compilers = Compilers::new(self.limit(), &surroundings);
        let mut accepted = compilers.accepted(self.language, program.harnessed())?;
        // Only what its compilers accept as it is gets counters, or is run at all.
        let code = match accepted.code {
            Ok(_) if run.text != program.text => {
                compilers.accepted(self.language, run.harnessed())?.code
            }
            code => code,
        };
        let ran = match code {
            Ok(code) => self.run(code, &run, &bound, subject, &surroundings)?,
            Err(CompilerFault::NotChecked(why)) => Err(Trouble::Absent(why)),
            Err(CompilerFault::Refused(words)) => Err(Trouble::Refused(String::new(), words)),
        };
        self.accept(&mut accepted.verdicts, &ran);
        let (costs, rivals) = match &ran {
            Ok(_) => self.costs(&program, subject, &compilers, &surroundings, progress)?,
            Err(_) => (Vec::new(), Vec::new()),
        };
        Ok(Audited {
            audit: self,
            bound: &bound,
            subject,
            verdicts: &accepted.verdicts,
            ran: &ran,
            costs: &costs,
            ours: &rivals,
        }
        .audit_row())
    }

    fn limit(&self) -> Duration {
        Duration::from_secs(self.seconds)
    }

    /// The function run at the edges and over all angles.
    fn run(
        &self,
        code: protocol::ProgramCode,
        program: &AuditProgram,
        bound: &Bound,
        subject: &MaterialInMedium,
        surroundings: &Surroundings,
    ) -> Result<Result<Ran, Trouble>, Error> {
        let uniforms: Vec<Uniform> = program.uniforms();
        let runner = match Runner::start(code, &uniforms, self.limit(), surroundings)? {
            Ok(runner) => runner,
            Err(trouble) => return Ok(Err(trouble)),
        };
        Ok(measured(&runner, subject, self.space, most(bound)))
    }

    /// Adds the verdict of the compiler that ran it, and puts places in the user's file before all messages.
    fn accept(&self, verdicts: &mut Vec<(String, Verdict)>, ran: &Result<Ran, Trouble>) {
        let own = match self.language {
            Language::Wgsl => "naga",
            Language::Gles => "the OpenGL ES driver",
            Language::Hlsl => "the Vulkan driver",
        };
        let verdict = match ran {
            Err(Trouble::Refused(who, _)) if who.is_empty() => None,
            Err(Trouble::Refused(_, words)) => Some(Verdict::No(words.clone())),
            Err(Trouble::Absent(why) | Trouble::Failed(why)) => {
                Some(Verdict::NotChecked(why.clone()))
            }
            Ok(_) => Some(Verdict::Yes),
        };
        verdicts.extend(verdict.map(|verdict| (own.to_owned(), verdict)));
        let lines = self.text.lines().count();
        for (_, verdict) in verdicts {
            if let Verdict::No(words) = verdict {
                *words = place::placed(&self.file, lines, words);
            }
        }
    }

    /// The cost of the function and of ours.
    fn costs(
        &self,
        program: &AuditProgram,
        subject: &MaterialInMedium,
        compilers: &Compilers,
        surroundings: &Surroundings,
        progress: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<(Vec<AuditCost>, Vec<ours::Ours>), Error> {
        let each = self.families.iter();
        let limit = self.limit();
        let each = each.map(|family| cost::cost(program, family, compilers, limit, surroundings));
        let costs: Vec<AuditCost> = each.collect::<Result<_, _>>()?;
        if costs.iter().all(|cost| cost.figures.is_err()) {
            return Ok((costs, Vec::new()));
        }
        let pool = Pool {
            limit: self.limit(),
            workers: self.workers,
        };
        let takes_arguments = program.params.len() > 1;
        let ours = ours::ours(
            subject,
            takes_arguments,
            &self.families,
            pool,
            surroundings,
            progress,
        )?;
        Ok((costs, ours))
    }
}

/// What a result may reach: 1, or an F0 that is given above it, as our own functions take it.
fn most(bound: &Bound) -> [f32; 3] {
    let raises = |argument: &&BoundArgument| {
        let input = find_input(&argument.name.to_lowercase());
        input.is_some_and(|input| input.raises_limit)
    };
    bound
        .arguments
        .iter()
        .filter(raises)
        .fold([1.0; 3], |most, argument| {
            each_channel(|i| most[i].max(argument.value[i]))
        })
}

fn measured(
    runner: &Runner,
    subject: &MaterialInMedium,
    space: Space,
    most: [f32; 3],
) -> Result<Ran, Trouble> {
    let results = runner.run(&edges::cosines())?;
    let mut edges = edges::judged(&results, most);
    let between = edges::FaultBetweenEdges::new(most);
    let error = runner.error(&subject.reference, &|cosines, got| {
        between.look(cosines, got)
    })?;
    edges.findings.extend(between.finding());
    let perceived = runner.perceived(&subject.reference, space)?;
    Ok(Ran {
        device: runner.device.clone(),
        points: runner.points.get(),
        edges,
        error,
        perceived,
    })
}
