//! The audit of one function for several materials. Compilers are asked once about equal texts, since materials differ in values
//! and seldom in the text around the function.

use core::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

use super::bind::{Bound, BoundArgument, bind};
use super::choose::choose;
use super::comparison::{self, ExactFit, recognised};
use super::compile::{self, Compilers};
use super::compilers::Accepted;
use super::cosine::CosineForm;
use super::cost::{self, AuditCost};
use super::error::{Error, FunctionPlace};
use super::language::Language;
use super::loops::{Branch, branch};
use super::ours::{CostedMethods, Ours};
use super::program::AuditProgram;
use super::request::Audit;
use super::row::{AuditRow, Audited, Ran};
use super::runner::Runner;
use super::slice::{Slice, SlicedText};
use super::worker::RunError;
use super::{admission, edges};
use crate::generator::emit::FunctionForm;
use crate::generator::reference::MaterialInMedium;
use crate::lab::fault::Fault;
use crate::lab::gpu::Uniform;
use crate::lab::process::{Pool, Surroundings};
use crate::lab::verify::compilers::Verdict;
use crate::lab::verify::function_head::FunctionHead;
use crate::physics::num::each_channel;

/// An audit under way.
pub struct Auditor<'a> {
    audit: &'a Audit,
    function: FunctionHead,
    /// What compilers see of the text.
    slice: Slice,
    branch: Option<Branch>,
    surroundings: Surroundings,
    compilers: Compilers,
    /// What compilers say of programs, by the program's text.
    accepted: RefCell<BTreeMap<String, Accepted>>,
    /// The costs of programs, by the program's text.
    costs: RefCell<BTreeMap<String, Vec<AuditCost>>>,
    ours: OnceCell<CostedMethods>,
}

impl<'a> Auditor<'a> {
    /// Reads the file.
    ///
    /// # Errors
    /// It does not hold the function, or no process can be started.
    pub fn new(audit: &'a Audit) -> Result<Auditor<'a>, Error> {
        let (file, text, language) = (&audit.file, &audit.text, audit.language);
        let live = admission::admitted(file, text, language, &audit.defines)?;
        let text = SlicedText::new(language, &live, &audit.defines);
        let function = choose(file, text.functions(), audit.function.as_deref(), language)?;
        admission::check_name(file, &live.text, language, &function.name)?;
        let given: Vec<&str> = audit
            .given
            .iter()
            .map(|given| given.name.as_str())
            .collect();
        let slice = text.around(&function, &given);
        let slice = slice.map_err(|(line, why)| Error::Unread {
            place: FunctionPlace::new(file, &function),
            line,
            why,
        })?;
        admission::check_needed(file, &slice.text, language)?;
        let surroundings = Surroundings::new(audit.tools.as_deref())?;
        Ok(Auditor {
            audit,
            branch: branch(&slice.text, language, &function.name),
            function,
            slice,
            compilers: Compilers::new(audit.limit(), &surroundings),
            surroundings,
            accepted: RefCell::default(),
            costs: RefCell::default(),
            ours: OnceCell::new(),
        })
    }

    /// The row of one of these materials.
    ///
    /// # Errors
    /// The arguments are not bound, or no process can be started.
    pub fn row(
        &self,
        subject: &MaterialInMedium,
        subjects: &[MaterialInMedium],
        progress: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<AuditRow, Error> {
        let audit = self.audit;
        let bound = bind(
            &audit.file,
            self.function.clone(),
            &self.slice,
            &audit.given,
            subject,
        )?;
        let mut verdicts = self.accepted(&self.program(&bound).0)?.verdicts;
        let ran = match self.runner(&bound)? {
            Ok(runner) => self.ran(&runner, &bound, subject)?,
            Err(error) => Err(error),
        };
        self.accept(&mut verdicts, &ran);
        let (costs, ours) = match &ran {
            Ok(_) => self.compared(&bound, subject, subjects, progress)?,
            Err(_) => (Vec::new(), Vec::new()),
        };
        Ok(Audited {
            audit,
            slice: &self.slice,
            bound: &bound,
            subject,
            verdicts: &verdicts,
            ran: &ran,
            costs: &costs,
            ours: &ours,
            cost_remark: self.cost_remark(&bound),
        }
        .audit_row())
    }

    fn program(&self, bound: &Bound) -> (AuditProgram, AuditProgram) {
        AuditProgram::pair(self.audit.language, &self.slice, bound)
    }

    /// What the compilers of the language say of a program.
    fn accepted(&self, program: &AuditProgram) -> Result<Accepted, Error> {
        let (precision, program) = (program.precision, program.harnessed());
        if let Some(known) = self.accepted.borrow().get(&program) {
            return Ok(known.clone());
        }
        let language = self.audit.language;
        let accepted = self
            .compilers
            .accepted(language, precision, program.clone())?;
        let mut all = self.accepted.borrow_mut();
        all.insert(program, accepted.clone());
        Ok(accepted)
    }

    /// A process that has compiled the function with these values.
    fn runner(&self, bound: &Bound) -> Result<Result<Runner, RunError>, Error> {
        let (program, run) = self.program(bound);
        // Only text that its compilers accept unchanged gets counters and is run.
        let code = match self.accepted(&program)?.code {
            Ok(_) if run.text != program.text => self.accepted(&run)?.code,
            code => code,
        };
        let uniforms: Vec<Uniform> = run.uniforms();
        match code {
            Ok(code) => {
                let limit = self.audit.limit();
                Ok(Runner::start(
                    code,
                    &uniforms,
                    bound.form,
                    limit,
                    &self.surroundings,
                )?)
            }
            Err(Fault::Absent(why)) => Ok(Err(RunError::Absent(why))),
            Err(Fault::Failed(words)) => Ok(Err(RunError::Refused(String::new(), words))),
        }
    }

    /// The result of running it, and which of our methods it computes.
    fn ran(
        &self,
        runner: &Runner,
        bound: &Bound,
        subject: &MaterialInMedium,
    ) -> Result<Result<Ran, RunError>, Error> {
        let mut ran = match self.measured(runner, bound, subject) {
            Ok(ran) => ran,
            Err(error) => return Ok(Err(error)),
        };
        ran.computes = computed(runner, bound, subject);
        if ran.computes.is_none() {
            ran.exact_fit = match cosine_fit(runner, bound, subject) {
                Some(fit) => Some(fit),
                None => self.exact_fit(bound, subject)?,
            };
        }
        Ok(Ok(ran))
    }

    fn measured(
        &self,
        runner: &Runner,
        bound: &Bound,
        subject: &MaterialInMedium,
    ) -> Result<Ran, RunError> {
        let largest = largest_valid(bound);
        let results = runner.run(&edges::cosines())?;
        let mut edges = edges::judged(&results, largest);
        let between = edges::FaultBetweenEdges::new(largest);
        let error = runner.error(&subject.reference, &|cosines, got| {
            between.look(cosines, got)
        })?;
        edges.findings.extend(between.finding());
        let perceived = runner.perceived(&subject.reference, self.audit.space)?;
        Ok(Ran {
            device: runner.device.clone(),
            points: runner.points.get(),
            edges,
            error,
            perceived,
            computes: None,
            exact_fit: None,
        })
    }

    /// The first argument for which another quantity of its name makes the function compute one of our methods.
    fn exact_fit(
        &self,
        bound: &Bound,
        subject: &MaterialInMedium,
    ) -> Result<Option<ExactFit>, Error> {
        for (place, argument) in bound.arguments.iter().enumerate() {
            let is_tried =
                |quantity: &&_| argument.is_by_name && Some(**quantity) != argument.quantity;
            for quantity in argument.meanings.iter().filter(is_tried) {
                let Some(other) = bound.with(place, *quantity, subject) else {
                    continue;
                };
                let Ok(runner) = self.runner(&other)? else {
                    continue;
                };
                let Some(method) = computed(&runner, &other, subject) else {
                    continue;
                };
                if let Ok(error) = runner.error(&subject.reference, &|_, _| {}) {
                    return Ok(Some(ExactFit {
                        argument: argument.name.clone(),
                        quantity: quantity.name,
                        method,
                        max_abs: error.max_abs,
                    }));
                }
            }
        }
        Ok(None)
    }

    /// Adds the verdict of the compiler that ran it, and puts the place in the user's file before each message.
    fn accept(&self, verdicts: &mut Vec<(String, Verdict)>, ran: &Result<Ran, RunError>) {
        let own = match self.audit.language {
            Language::Wgsl => "naga",
            Language::Gles => "the OpenGL ES driver",
            Language::Glsl | Language::Hlsl | Language::Slang => "the Vulkan driver",
        };
        let verdict = match ran {
            Err(RunError::Refused(who, _)) if who.is_empty() => None,
            Err(RunError::Refused(_, words)) if compile::names_place(words) => {
                Some(Err(Fault::Failed(words.clone())))
            }
            // The driver or the machine may be at fault.
            Err(RunError::Refused(_, words)) => Some(Err(Fault::Absent(words.clone()))),
            Err(RunError::Absent(why) | RunError::Failed(why)) => {
                Some(Err(Fault::Absent(why.clone())))
            }
            Ok(_) => Some(Ok(())),
        };
        verdicts.extend(verdict.map(|verdict| (own.to_owned(), verdict)));
        let lines = self.audit.text.lines().count();
        for (_, verdict) in verdicts {
            if let Err(Fault::Failed(words)) = verdict {
                *words = compile::placed(&self.audit.file, lines, words);
            }
        }
    }

    /// The cost of the function, and our methods for the material.
    fn compared(
        &self,
        bound: &Bound,
        subject: &MaterialInMedium,
        subjects: &[MaterialInMedium],
        progress: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<(Vec<AuditCost>, Vec<Ours>), Error> {
        let audit = self.audit;
        let costs = self.costs(bound)?;
        let is_known = costs.iter().any(|cost| cost.net.is_some());
        let form = compared_form(bound).filter(|_| is_known && self.cost_remark(bound).is_none());
        let Some(form) = form else {
            return Ok((costs, Vec::new()));
        };
        let ours = match self.ours.get() {
            Some(ours) => ours,
            None => {
                let pool = Pool {
                    limit: audit.limit(),
                    workers: audit.workers,
                };
                let (families, surroundings) = (&audit.families, &self.surroundings);
                let asked =
                    CostedMethods::ask(form, subjects, families, pool, surroundings, progress)?;
                self.ours.get_or_init(|| asked)
            }
        };
        Ok((costs, ours.for_material(subject, audit.max_inputs)))
    }

    /// The cost of the function on each family.
    fn costs(&self, bound: &Bound) -> Result<Vec<AuditCost>, Error> {
        let audit = self.audit;
        let program = AuditProgram::measured(audit.language, &self.slice, bound);
        if let Some(known) = self.costs.borrow().get(&program.text) {
            return Ok(known.clone());
        }
        let (limit, surroundings) = (audit.limit(), &self.surroundings);
        let each = audit.families.iter();
        let each =
            each.map(|family| cost::cost(&program, family, &self.compilers, limit, surroundings));
        let costs: Vec<AuditCost> = each.collect::<Result<_, _>>()?;
        let mut all = self.costs.borrow_mut();
        all.insert(program.text, costs.clone());
        Ok(costs)
    }

    /// Why the function's cost is not compared with ours.
    fn cost_remark(&self, bound: &Bound) -> Option<String> {
        let alone = || {
            let why = "not compared with ours: none of one channel is without arguments";
            compared_form(bound).is_none().then(|| why.to_owned())
        };
        let half = || {
            let word = self.slice.half.as_ref()?;
            Some(format!(
                "not compared with ours: `{word}` has 16 bits, and ours have 32"
            ))
        };
        let branch = self.branch.as_ref().map(Branch::reason);
        branch.or_else(half).or_else(alone)
    }
}

/// The form of our functions that a user's is compared with: the same number of channels, with arguments if the user's takes some.
fn compared_form(bound: &Bound) -> Option<FunctionForm> {
    match (bound.is_one_channel(), bound.arguments.is_empty()) {
        (true, true) => None,
        (true, false) => Some(FunctionForm::Scalar),
        (false, true) => Some(FunctionForm::Specialised),
        (false, false) => Some(FunctionForm::Library),
    }
}

/// Which of our methods a function computes with these values.
fn computed(runner: &Runner, bound: &Bound, subject: &MaterialInMedium) -> Option<&'static str> {
    let results = runner.run(&comparison::cosines()).ok()?;
    recognised(&results, bound, subject)
}

/// Another form of the cosine's argument with which the function computes one of our methods.
fn cosine_fit(runner: &Runner, bound: &Bound, subject: &MaterialInMedium) -> Option<ExactFit> {
    let others = CosineForm::NAMED
        .iter()
        .filter(|(_, form)| *form != bound.form);
    others.into_iter().find_map(|(name, form)| {
        let results = runner.run_as(*form, &comparison::cosines()).ok()?;
        let method = recognised(&results, bound, subject)?;
        let error = runner.error_as(*form, &subject.reference).ok()?;
        // A constant is constant in every form of the argument.
        (method != "constant_f0").then(|| ExactFit {
            argument: bound.function.params[bound.cosine].name.clone(),
            quantity: name,
            method,
            max_abs: error.max_abs,
        })
    })
}

/// The largest valid result of each channel: 1, or a given F0 above 1, up to [`BRIGHTEST`]. Our own functions take such an F0 too.
fn largest_valid(bound: &Bound) -> [f32; 3] {
    let raises = |argument: &&BoundArgument| {
        let meaning = argument.meaning();
        meaning.is_some_and(|quantity| quantity.input.raises_limit)
    };
    bound
        .arguments
        .iter()
        .filter(raises)
        .fold([1.0; 3], |largest, argument| {
            each_channel(|i| largest[i].max(argument.value[i].min(BRIGHTEST)))
        })
}

/// A bound on F0. The largest channel of a metal's F0 in any working space is 1.06, that of gold in sRGB.
const BRIGHTEST: f32 = 1.25;
