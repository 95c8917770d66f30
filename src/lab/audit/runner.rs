//! A user's function run in a process of its own, within a time.

use core::cell::{Cell, OnceCell, RefCell};
use core::time::Duration;

use crate::generator::fit::{ModelError, Perceived, error_of, perceived};
use crate::generator::reference::ReferenceCurve;
use crate::lab::gpu::Uniform;
use crate::lab::process::{Error, Launch, Silence, Surroundings, Worker};
use crate::language::ir::{Column, Value};
use crate::physics::num::each_channel;
use crate::physics::spectra::Space;

use super::cosine::CosineForm;
use super::loops::{MARK, TURNS};
use super::protocol::{AuditRequest, AuditResponse, ProgramCode, UniformBits};

/// What sees cosines, and the result at each.
pub type Look<'a> = &'a dyn Fn(&[f32], &[[f32; 3]]);

/// Why there are no results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// Something is missing here.
    Absent(String),
    /// It is not accepted: by whom, and in which words.
    Refused(String, String),
    /// It does not end, or took its process down.
    Failed(String),
}

/// A process that has the function compiled.
pub struct Runner {
    worker: RefCell<Worker>,
    limit: Duration,
    /// What the function takes for a cosine.
    form: CosineForm,
    /// On what it runs.
    pub device: String,
    /// At how many cosines it has run.
    pub points: Cell<usize>,
}

fn reason(silence: &Silence, limit: Duration) -> Trouble {
    Trouble::Failed(match silence {
        Silence::TooLong => format!(
            "it did not end within {} s: a loop without end, or more work than --limit allows",
            limit.as_secs()
        ),
        Silence::Ended(status) => {
            format!(
                "the process that ran it ended ({status}): its compiler or driver fell over this text"
            )
        }
    })
}

fn unprepared(silence: &Silence, limit: Duration) -> String {
    match silence {
        Silence::TooLong => format!(
            "the driver's compiler did not end within {} s, which is all that --limit allows",
            limit.as_secs()
        ),
        Silence::Ended(status) => {
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
    ) -> Result<Result<Runner, Trouble>, Error> {
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
            Ok(response) => Err(trouble(response)),
            // Nothing of the function has run: its compiler, its driver or the machine may be at fault.
            Err(silence) => Err(Trouble::Absent(unprepared(&silence, limit))),
        })
    }

    /// The results at these cosines.
    pub fn run(&self, cosines: &[f32]) -> Result<Vec<[f32; 3]>, Trouble> {
        self.run_as(self.form, cosines)
    }

    /// The same where the function takes this for a cosine.
    pub fn run_as(&self, form: CosineForm, cosines: &[f32]) -> Result<Vec<[f32; 3]>, Trouble> {
        let taken = cosines.iter().map(|c| form.value_at(*c).to_bits());
        let request = AuditRequest::Run(taken.collect());
        let response = self.worker.borrow_mut().ask(&request, self.limit);
        let response = response.map_err(|error| Trouble::Failed(error.to_string()))?;
        match response.map_err(|silence| reason(&silence, self.limit))? {
            AuditResponse::Ran(results) if results.len() == cosines.len() => {
                self.points.set(self.points.get() + cosines.len());
                let results = results.into_iter().map(|rgb| rgb.map(f32::from_bits));
                ended(cosines, results.collect())
            }
            other => Err(trouble(other)),
        }
    }

    /// The error against the reference. `look` sees every cosine with its result.
    pub fn error(&self, reference: &ReferenceCurve, look: Look) -> Result<ModelError, Trouble> {
        self.measured(self.form, look, |values| error_of(reference, values))
    }

    /// The same where the function takes this for a cosine.
    pub fn error_as(
        &self,
        form: CosineForm,
        reference: &ReferenceCurve,
    ) -> Result<ModelError, Trouble> {
        self.measured(form, &|_, _| {}, |values| error_of(reference, values))
    }

    /// The error as it is seen.
    pub fn perceived(
        &self,
        reference: &ReferenceCurve,
        space: Space,
    ) -> Result<Perceived, Trouble> {
        self.measured(self.form, &|_, _| {}, |values| {
            perceived(reference, space, values)
        })
    }

    /// What is measured of its values.
    fn measured<T>(
        &self,
        form: CosineForm,
        look: Look,
        measure: impl FnOnce(&dyn Fn(&[f64]) -> Value<f64>) -> T,
    ) -> Result<T, Trouble> {
        let failed: OnceCell<Trouble> = OnceCell::new();
        let measured = measure(&|cosines| {
            let single: Vec<f32> = cosines.iter().map(|c| *c as f32).collect();
            let nothing = || vec![[f32::NAN; 3]; single.len()];
            // What has failed once is not asked again: each wait takes its time.
            let got = match failed.get() {
                Some(_) => nothing(),
                None => self.run_as(form, &single).unwrap_or_else(|trouble| {
                    let _ = failed.set(trouble);
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

/// The results, unless a loop has not ended at one of them.
fn ended(cosines: &[f32], results: Vec<[f32; 3]>) -> Result<Vec<[f32; 3]>, Trouble> {
    let endless = results.iter().position(|rgb| *rgb == [MARK; 3]);
    endless.map_or(Ok(results), |at| {
        let cosine = cosines[at];
        Err(Trouble::Failed(format!(
            "at cos_theta = {cosine:?} its loops have not ended after {TURNS} turns"
        )))
    })
}

fn trouble(response: AuditResponse) -> Trouble {
    match response {
        AuditResponse::Absent(why) => Trouble::Absent(why),
        AuditResponse::Refused(who, words) => Trouble::Refused(who, words),
        _ => Trouble::Failed("it answers another question".to_owned()),
    }
}
