//! Who draws for the measurement: a process of its own, and a new one whenever it hangs or falls over.

use core::time::Duration;
use std::collections::BTreeSet;

use crate::process::{Silence, Surroundings, Worker, own_words};

use super::drawing_device::DeviceFacts;
use super::error::Error;
use super::measure::{Draw, Reading, Stop};
use super::plan::Plan;
use super::serve::{Answer, HELLO};

/// How long opening a device and compiling a shader may take: both are seconds where they are slow.
const PATIENCE: Duration = Duration::from_secs(30);
/// How much longer than it says a drawing may take before its process is ended: it need not hang, it may be late.
const GRACE: Duration = Duration::from_secs(2);

/// Mesa's llvmpipe draws on one thread. Two of them share what the processor's cores share, each slows the other at times,
/// and shares that repeat within 2 % differ by 15.
const ONE_THREAD: [(&str, &str); 1] = [("LP_NUM_THREADS", "1")];

/// The process, and what it knows.
pub struct DrawingWorker<'a> {
    plan: &'a Plan,
    worker: Worker,
    surroundings: Surroundings,
    limit: Duration,
    /// What it draws on.
    pub device: DeviceFacts,
    /// What it has compiled.
    compiled: BTreeSet<usize>,
}

impl<'a> DrawingWorker<'a> {
    /// Starts it; one submission may take so long.
    ///
    /// # Errors
    /// There is no device, or it cannot be opened.
    pub fn start(plan: &'a Plan, limit: Duration) -> Result<DrawingWorker<'a>, Error> {
        let surroundings = Surroundings::new(None)?;
        let (worker, device) = open(&surroundings)?;
        Ok(DrawingWorker {
            plan,
            worker,
            surroundings,
            limit,
            device,
            compiled: BTreeSet::new(),
        })
    }

    /// Another process in place of one that is lost.
    fn restart(&mut self) -> Result<(), Stop> {
        let (worker, _) = open(&self.surroundings).map_err(|why| Stop::All(why.to_string()))?;
        self.worker = worker;
        self.compiled.clear();
        Ok(())
    }

    fn too_long(&self, seconds: f64) -> Stop {
        let limit = self.limit.as_secs_f64();
        Stop::One(format!(
            "a submission took {seconds:.3} s, and --limit allows {limit} s"
        ))
    }
}

impl Draw for DrawingWorker<'_> {
    fn draw(&mut self, drawing: usize, draws: u32) -> Result<Reading, Stop> {
        if self.plan.drawings[drawing].precision.is_half() && !self.device.has_half {
            return Err(Stop::One(self.device.no_half()));
        }
        let patience = if self.compiled.contains(&drawing) {
            self.limit + GRACE
        } else {
            self.limit + GRACE + PATIENCE
        };
        let answer = match self.worker.ask(&format!("{drawing} {draws}"), patience) {
            Ok(answer) => answer,
            Err(Silence::TooLong) => {
                self.restart()?;
                return Err(self.too_long(patience.as_secs_f64()));
            }
            Err(Silence::Ended(status)) => {
                self.restart()?;
                let why = format!("the process that drew it ended ({status}): its driver failed");
                return Err(Stop::One(why));
            }
        };
        self.compiled.insert(drawing);
        match answer {
            Answer::Reading(reading) if reading.wall > self.limit.as_nanos() as f64 => {
                Err(self.too_long(reading.wall / 1e9))
            }
            Answer::Reading(reading) => Ok(reading),
            Answer::Failed(why) | Answer::Absent(why) => {
                // A device that is lost draws nothing more.
                self.restart()?;
                Err(Stop::One(why))
            }
            Answer::DeviceFacts(_) => Err(Stop::All("a process that only greets".to_owned())),
        }
    }
}

fn open(surroundings: &Surroundings) -> Result<(Worker, DeviceFacts), Error> {
    let mut words = own_words();
    words.push("--worker".into());
    let environment = ONE_THREAD.map(|(name, value)| (name.to_owned(), value.into()));
    let mut worker = Worker::start(&words, &environment, surroundings)?;
    match worker.ask(HELLO, PATIENCE) {
        Ok(Answer::DeviceFacts(device)) => Ok((worker, device)),
        Ok(Answer::Absent(why) | Answer::Failed(why)) => Err(Error::Device(why)),
        Ok(Answer::Reading(_)) => Err(Error::Protocol),
        Err(Silence::TooLong) => Err(Error::Hangs(PATIENCE.as_secs())),
        Err(Silence::Ended(status)) => Err(Error::Ended(status)),
    }
}
