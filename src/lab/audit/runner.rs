//! Runs a user's function in a worker within a time limit: the supervisor's side.

use core::cell::{Cell, OnceCell, RefCell};
use core::time::Duration;

use super::compilers::ProgramCode;
use super::cosine::CosineForm;
use super::loops::{MARK, TURNS};
use super::worker::{AuditRequest, AuditResponse, RunError, UniformBits};
use crate::generator::fit::{ModelError, Perceived, error_of, perceived};
use crate::generator::reference::ReferenceCurve;
use crate::lab::gpu::Uniform;
use crate::lab::process::{Error, Launch, NoAnswer, Surroundings, Worker};
use crate::language::ir::{Column, Value};
use crate::physics::num::each_channel;
use crate::physics::spectra::Space;

/// A callback that sees cosines and the result at each.
pub type Look<'a> = &'a dyn Fn(&[f32], &[[f32; 3]]);

/// A process that has compiled the function.
pub struct Runner {
    worker: RefCell<Worker>,
    limit: Duration,
    /// The form in which the function takes a cosine.
    form: CosineForm,
    /// The device that it runs on.
    pub device: String,
    /// The number of cosines that it has run at.
    pub points: Cell<usize>,
}

fn reason(no_answer: &NoAnswer, limit: Duration) -> RunError {
    RunError::Failed(match no_answer {
        NoAnswer::TooLong => format!(
            "it did not end within {} s: a loop without end, or more work than --limit allows",
            limit.as_secs()
        ),
        NoAnswer::Ended(status) => {
            format!(
                "the process that ran it ended ({status}): its compiler or driver fell over this text"
            )
        }
    })
}

fn unprepared(no_answer: &NoAnswer, limit: Duration) -> String {
    match no_answer {
        NoAnswer::TooLong => format!(
            "the driver's compiler did not end within {} s, which is all that --limit allows",
            limit.as_secs()
        ),
        NoAnswer::Ended(status) => {
            format!("the process that compiles it for the driver ended ({status})")
        }
    }
}

impl Runner {
    /// Starts a process and has it compile a program.
    ///
    /// # Errors
    /// No process can be started.
    pub fn start(
        code: ProgramCode,
        uniforms: &[Uniform],
        form: CosineForm,
        limit: Duration,
        surroundings: &Surroundings,
    ) -> Result<Result<Runner, RunError>, Error> {
        let mut worker = Worker::new(Launch::new(&["audit", "--worker"], surroundings));
        let uniforms = uniforms.iter().map(UniformBits::new);
        let request = AuditRequest::Prepare(code, uniforms.collect());
        Ok(match worker.ask(&request, limit)? {
            Ok(AuditResponse::Ready(device)) => Ok(Runner {
                worker: RefCell::new(worker),
                limit,
                form,
                device,
                points: Cell::new(0),
            }),
            Ok(response) => Err(run_error(response)),
            // The function has not run yet: its compiler, the driver or the machine may be at fault.
            Err(no_answer) => Err(RunError::Absent(unprepared(&no_answer, limit))),
        })
    }

    /// The results at these cosines.
    pub fn run(&self, cosines: &[f32]) -> Result<Vec<[f32; 3]>, RunError> {
        self.run_as(self.form, cosines)
    }

    /// The results at these cosines if the function takes them in this form.
    pub fn run_as(&self, form: CosineForm, cosines: &[f32]) -> Result<Vec<[f32; 3]>, RunError> {
        let taken = cosines.iter().map(|c| form.value_at(*c).to_bits());
        let request = AuditRequest::Run(taken.collect());
        let response = self.worker.borrow_mut().ask(&request, self.limit);
        let response = response.map_err(|error| RunError::Failed(error.to_string()))?;
        match response.map_err(|no_answer| reason(&no_answer, self.limit))? {
            AuditResponse::Ran(results) if results.len() == cosines.len() => {
                self.points.set(self.points.get() + cosines.len());
                let results = results.into_iter().map(|rgb| rgb.map(f32::from_bits));
                ended(cosines, results.collect())
            }
            other => Err(run_error(other)),
        }
    }

    /// The error against the reference. `look` sees every cosine with its result.
    pub fn error(&self, reference: &ReferenceCurve, look: Look) -> Result<ModelError, RunError> {
        self.measured(self.form, look, |values| error_of(reference, values))
    }

    /// The error against the reference if the function takes the cosine in this form.
    pub fn error_as(
        &self,
        form: CosineForm,
        reference: &ReferenceCurve,
    ) -> Result<ModelError, RunError> {
        self.measured(form, &|_, _| {}, |values| error_of(reference, values))
    }

    /// The error under viewing conditions.
    pub fn perceived(
        &self,
        reference: &ReferenceCurve,
        space: Space,
    ) -> Result<Perceived, RunError> {
        self.measured(self.form, &|_, _| {}, |values| {
            perceived(reference, space, values)
        })
    }

    /// A measurement of its values.
    fn measured<T>(
        &self,
        form: CosineForm,
        look: Look,
        measure: impl FnOnce(&dyn Fn(&[f64]) -> Value<f64>) -> T,
    ) -> Result<T, RunError> {
        let failed: OnceCell<RunError> = OnceCell::new();
        let measured = measure(&|cosines| {
            let single: Vec<f32> = cosines.iter().map(|c| *c as f32).collect();
            let nothing = || vec![[f32::NAN; 3]; single.len()];
            // After a failure it is not asked again, since each timeout costs time.
            let got = match failed.get() {
                Some(_) => nothing(),
                None => self.run_as(form, &single).unwrap_or_else(|error| {
                    let _ = failed.set(error);
                    nothing()
                }),
            };
            if failed.get().is_none() {
                look(&single, &got);
            }
            let channel =
                |i: usize| Column::Each(got.iter().map(|rgb| f64::from(rgb[i])).collect());
            Value::Rgb(each_channel(channel))
        });
        failed.into_inner().map_or(Ok(measured), Err)
    }
}

/// The results, unless a loop did not end at one of them.
fn ended(cosines: &[f32], results: Vec<[f32; 3]>) -> Result<Vec<[f32; 3]>, RunError> {
    let endless = results.iter().position(|rgb| *rgb == [MARK; 3]);
    endless.map_or(Ok(results), |at| {
        let cosine = cosines[at];
        Err(RunError::Failed(format!(
            "at cos_theta = {cosine:?} its loops have not ended after {TURNS} turns"
        )))
    })
}

fn run_error(response: AuditResponse) -> RunError {
    match response {
        AuditResponse::NoResult(error) => error,
        _ => RunError::Failed("it answers another question".to_owned()),
    }
}
