//! The compilers of a user's text, asked in a process of their own: one that does not end, ends with it.

use core::cell::RefCell;
use core::time::Duration;
use std::ffi::OsString;

use crate::process::Surroundings;
use crate::process::{Silence, Worker};
use crate::verify::compilers::{Fault, Verdict};

use super::accept::Accepted;
use super::error::Error;
use super::job::{Asked, Said};
use super::language::Language;

/// The process, started when it is first needed and again after it has ended.
pub struct Compilers<'a> {
    limit: Duration,
    surroundings: &'a Surroundings,
    worker: RefCell<Option<Worker>>,
}

impl Compilers<'_> {
    /// Each step may take so long, however many compilers it asks.
    pub fn new(limit: Duration, surroundings: &Surroundings) -> Compilers<'_> {
        Compilers {
            limit,
            surroundings,
            worker: RefCell::new(None),
        }
    }

    /// What the compilers of a language say of a whole program.
    ///
    /// # Errors
    /// No process can be started.
    pub fn accepted(&self, language: Language, program: String) -> Result<Accepted, Error> {
        let asked = Asked::Accept(language, program);
        let silent = |words: String| Accepted {
            verdicts: vec![(language.compiler().to_owned(), Verdict::No(words.clone()))],
            code: Err(Fault::Refused(words)),
        };
        Ok(match self.ask(&asked, language)? {
            Ok(Said::Accepted(accepted)) => accepted,
            Ok(_) => silent("the process answers another question".to_owned()),
            Err(words) => silent(words),
        })
    }

    /// A shader of a language as SPIR-V.
    ///
    /// # Errors
    /// No process can be started.
    pub fn module(
        &self,
        language: Language,
        shader: String,
    ) -> Result<Result<Vec<u8>, Fault>, Error> {
        Ok(
            match self.ask(&Asked::Module(language, shader), language)? {
                Ok(Said::Module(made)) => made,
                Ok(_) => Err(Fault::Refused(
                    "the process answers another question".to_owned(),
                )),
                Err(words) => Err(Fault::Refused(words)),
            },
        )
    }

    /// The answer, or why there is none.
    fn ask(&self, asked: &Asked, language: Language) -> Result<Result<Said, String>, Error> {
        let line = serde_json::to_string(asked).expect("text and names alone");
        let mut place = self.worker.borrow_mut();
        let mut worker = match place.take() {
            Some(worker) => worker,
            None => {
                let words = ["audit", "--worker"].map(OsString::from);
                Worker::start(&words, &[], self.surroundings)?
            }
        };
        Ok(match worker.ask(&line, self.limit) {
            Ok(said) => {
                *place = Some(worker);
                Ok(said)
            }
            Err(silence) => Err(reason(&silence, self.limit, language)),
        })
    }
}

fn reason(silence: &Silence, limit: Duration, language: Language) -> String {
    let compiler = language.compiler();
    match silence {
        Silence::TooLong => format!(
            "{compiler} did not end within {} s, which is all that --limit allows",
            limit.as_secs()
        ),
        Silence::Ended(status) => format!("the process that asks {compiler} ended ({status})"),
    }
}
