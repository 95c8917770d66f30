//! The worker process that draws for the measurement: its supervisor's side, the requests and responses, and the worker's loop.
//! The worker opens the device, and answers what it is and how long drawings take. It is replaced whenever it hangs or crashes.

use core::time::Duration;
use std::collections::BTreeSet;
use std::io;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::drawing_device::{DeviceFacts, DrawingDevice};
use super::measure::{Draw, Reading, Stop};
use super::plan::DrawingPlan;
use crate::lab::fault::Fault;
use crate::lab::gpu::{AdapterKind, Backend, Device, Wanted};
use crate::lab::process::{self, Inbox, Launch, NoAnswer, Surroundings, Worker};

/// How long opening a device and compiling a shader may take. Where they are slow, both take seconds.
const PATIENCE: Duration = Duration::from_secs(30);
/// How far a drawing may exceed its limit before its process is ended: it may be late without hanging.
const GRACE: Duration = Duration::from_secs(2);

/// Makes Mesa's llvmpipe draw on one thread. Two threads share resources of the processor's cores and slow each other at times.
/// Shares that repeat within 2 % then differ by 15 %.
const ONE_THREAD: [(&str, &str); 1] = [("LP_NUM_THREADS", "1")];

/// The process, and what is known of it.
pub struct DrawingWorker {
    worker: Worker,
    /// Removed after the process.
    _surroundings: Surroundings,
    limit: Duration,
    /// The device that it draws on.
    pub device: DeviceFacts,
    /// Whether each drawing computes in half precision.
    in_half: Vec<bool>,
    /// The drawings whose shaders it has compiled.
    compiled: BTreeSet<usize>,
}

impl DrawingWorker {
    /// Starts the process. One submission may take this long. [`DrawingWorker::takes`] sets what it draws.
    ///
    /// # Errors
    /// There is no device, or it cannot be opened.
    pub fn start(limit: Duration) -> Result<DrawingWorker, Error> {
        let surroundings = Surroundings::new(None)?;
        let environment = ONE_THREAD.map(|(name, value)| (name.to_owned(), value.into()));
        let launch = Launch::with_own_words(&surroundings);
        let mut worker = Worker::new(launch.with_environment(environment.into()));
        let device = facts(&mut worker)?;
        Ok(DrawingWorker {
            worker,
            _surroundings: surroundings,
            limit,
            device,
            in_half: Vec::new(),
            compiled: BTreeSet::new(),
        })
    }

    /// Sets the plan whose drawings it draws.
    pub fn takes(&mut self, plan: &DrawingPlan) {
        let drawings = plan.drawings.iter();
        self.in_half = drawings.map(|one| one.precision.is_half()).collect();
    }

    /// Replaces a process that is lost.
    fn restart(&mut self) -> Result<(), Stop> {
        self.worker.end();
        self.compiled.clear();
        let facts = facts(&mut self.worker);
        facts.map(drop).map_err(|why| Stop::All(why.to_string()))
    }

    fn too_long(&self, seconds: f64) -> Stop {
        let limit = self.limit.as_secs_f64();
        Stop::One(format!(
            "a submission took {seconds:.3} s, and --limit allows {limit} s"
        ))
    }
}

impl Draw for DrawingWorker {
    fn draw(&mut self, drawing: usize, draws: u32) -> Result<Reading, Stop> {
        if self.in_half[drawing] && !self.device.has_half {
            return Err(Stop::One(self.device.no_half()));
        }
        let patience = if self.compiled.contains(&drawing) {
            self.limit + GRACE
        } else {
            self.limit + GRACE + PATIENCE
        };
        let request = DrawRequest::Draw { drawing, draws };
        let response: Result<Result<DrawAnswer, NoAnswer>, _> = self.worker.ask(&request, patience);
        let response = match response.map_err(|why| Stop::All(why.to_string()))? {
            Ok(response) => response,
            Err(NoAnswer::TooLong) => {
                self.restart()?;
                return Err(self.too_long(patience.as_secs_f64()));
            }
            Err(NoAnswer::Ended(status)) => {
                self.restart()?;
                let why = format!("the process that drew it ended ({status}): its driver failed");
                return Err(Stop::One(why));
            }
        };
        self.compiled.insert(drawing);
        match response {
            Ok(DrawResponse::Reading(reading)) if reading.wall > self.limit.as_nanos() as f64 => {
                Err(self.too_long(reading.wall / 1e9))
            }
            Ok(DrawResponse::Reading(reading)) => Ok(reading),
            Err(fault) => {
                // A lost device draws nothing more.
                self.restart()?;
                Err(Stop::One(fault.to_string()))
            }
            Ok(DrawResponse::Device(_)) => Err(Stop::All("a process that only greets".to_owned())),
        }
    }
}

/// The device that the process draws on.
fn facts(worker: &mut Worker) -> Result<DeviceFacts, Error> {
    match worker.ask(&DrawRequest::Device, PATIENCE)? {
        Ok(Ok(DrawResponse::Device(device))) => Ok(device),
        Ok(Ok(DrawResponse::Reading(_))) => Err(Error::Protocol),
        Ok(Err(fault)) => Err(Error::Device(fault)),
        Err(NoAnswer::TooLong) => Err(Error::Hangs(PATIENCE.as_secs())),
        Err(NoAnswer::Ended(status)) => Err(Error::Ended(status)),
    }
}

/// Why nothing can be drawn.
#[derive(Debug, Error)]
pub enum Error {
    /// The process that draws cannot be started.
    #[error(transparent)]
    Process(#[from] process::Error),
    /// There is no graphics device, or its driver fails, with this message.
    #[error(transparent)]
    Device(Fault),
    /// The process that should open the device gives an unexpected answer.
    #[error("a process that does not greet")]
    Protocol,
    /// The driver hangs.
    #[error("no graphics device opened within {0} s: its driver hangs")]
    Hangs(u64),
    /// The driver crashes its process.
    #[error("the process that opens the graphics device ended ({0}): its driver failed")]
    Ended(String),
}

impl Error {
    /// Whether the machine lacks something. Otherwise the user's flags are at fault.
    pub fn is_lacking(&self) -> bool {
        match self {
            Error::Process(error) => error.is_lacking(),
            _ => true,
        }
    }
}

/// A request to the worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum DrawRequest {
    /// For the device.
    Device,
    /// For a reading.
    Draw {
        /// The index of a drawing in the plan.
        drawing: usize,
        /// How many times it is drawn.
        draws: u32,
    },
}

/// The worker's answer, or why there is none.
type DrawAnswer = Result<DrawResponse, Fault>;

/// What the worker answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum DrawResponse {
    /// The device that it draws on.
    Device(DeviceFacts),
    /// A reading.
    Reading(Reading),
}

/// Serves until the supervisor is gone. Only drawings of the plan are drawn. The plan depends on whether the device is software.
///
/// # Errors
/// The pipe is gone.
pub fn serve(
    inbox: Inbox,
    plan: &dyn Fn(bool) -> DrawingPlan,
    wanted: &Wanted,
    size: Option<u32>,
) -> io::Result<()> {
    let opened = open(wanted);
    let plan = &plan(
        opened
            .as_ref()
            .is_ok_and(|device| device.adapter.kind == AdapterKind::Software),
    );
    let mut device = opened.and_then(|device| DrawingDevice::new(plan, &device, size));
    inbox.serve(|request| -> DrawAnswer {
        let device = device.as_mut().map_err(|fault| fault.clone())?;
        match request {
            DrawRequest::Device => Ok(DrawResponse::Device(device.facts())),
            DrawRequest::Draw { drawing, .. } if drawing >= plan.drawings.len() => {
                Err(Fault::Failed("the plan has no such drawing".to_owned()))
            }
            DrawRequest::Draw { drawing, draws } => {
                device.draw(drawing, draws).map(DrawResponse::Reading)
            }
        }
    })
}

/// Opens the requested device. OpenGL draws as well as the others, so it is used where there is nothing else.
fn open(wanted: &Wanted) -> Result<Device, Fault> {
    let opengl = Wanted {
        backend: Some(Backend::OpenGl),
        ..wanted.clone()
    };
    match Device::open(wanted) {
        Err(fault @ Fault::Absent(_)) if wanted.backend.is_none() => {
            Device::open(&opengl).map_err(|_| fault)
        }
        opened => opened,
    }
}
