//! The compilers of a user's text, run by a worker: ending the worker ends a compiler that hangs.

use core::cell::RefCell;
use core::time::Duration;

use super::compilers::{Accepted, compiler_name};
use super::language::Language;
use super::worker::{AuditRequest, AuditResponse};
use crate::lab::fault::Fault;
use crate::lab::process::{Error, Launch, NoAnswer, Surroundings, Worker};
use crate::physics::num::Precision;

/// The process that asks them.
pub struct Compilers {
    limit: Duration,
    worker: RefCell<Worker>,
}

impl Compilers {
    /// Each step may take this long, however many compilers it asks.
    pub fn new(limit: Duration, surroundings: &Surroundings) -> Compilers {
        Compilers {
            limit,
            worker: RefCell::new(Worker::new(Launch::new(
                &["audit", "--worker"],
                surroundings,
            ))),
        }
    }

    /// What the compilers of a language say of a whole program.
    ///
    /// # Errors
    /// No process can be started.
    pub fn accepted(
        &self,
        language: Language,
        precision: Precision,
        program: String,
    ) -> Result<Accepted, Error> {
        let request = AuditRequest::Accept(language, precision, program);
        // This says nothing of the text: the compiler or the machine may be at fault.
        let silent = |words: String| Accepted {
            verdicts: vec![(
                compiler_name(language).to_owned(),
                Err(Fault::Absent(words.clone())),
            )],
            code: Err(Fault::Absent(words)),
        };
        let accepted = self.ask(&request, language, |response| match response {
            AuditResponse::Accepted(accepted) => Some(accepted),
            _ => None,
        })?;
        Ok(accepted.unwrap_or_else(silent))
    }

    /// The SPIR-V of a shader in a language.
    ///
    /// # Errors
    /// No process can be started.
    pub fn module(
        &self,
        language: Language,
        precision: Precision,
        shader: String,
    ) -> Result<Result<Vec<u8>, Fault>, Error> {
        let request = AuditRequest::Module(language, precision, shader);
        let made = self.ask(&request, language, |response| match response {
            AuditResponse::Module(made) => Some(made),
            _ => None,
        })?;
        Ok(made.unwrap_or_else(|words| Err(Fault::Absent(words))))
    }

    /// The response, or why there is none.
    fn ask<T>(
        &self,
        request: &AuditRequest,
        language: Language,
        read: impl Fn(AuditResponse) -> Option<T>,
    ) -> Result<Result<T, String>, Error> {
        let response = self.worker.borrow_mut().ask(request, self.limit)?;
        Ok(match response.map(read) {
            Ok(read) => read.ok_or_else(|| "the process answers another question".to_owned()),
            Err(no_answer) => Err(reason(&no_answer, self.limit, language)),
        })
    }
}

fn reason(no_answer: &NoAnswer, limit: Duration, language: Language) -> String {
    let compiler = compiler_name(language);
    match no_answer {
        NoAnswer::TooLong => format!(
            "{compiler} did not end within {} s, which is all that --limit allows",
            limit.as_secs()
        ),
        NoAnswer::Ended(status) => format!("the process that asks {compiler} ended ({status})"),
    }
}
