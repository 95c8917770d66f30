//! The pool of workers, which distributes jobs among processes, one for each thread.

use core::time::Duration;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::{panic, thread};

use super::error::Error;
use super::worker::{Launch, Worker};

/// The limits of a run.
#[derive(Clone, Copy, Debug)]
pub struct Pool {
    /// The time limit of one response.
    pub limit: Duration,
    /// The number of processes at once.
    pub workers: usize,
}

/// Does a job in a process, and calls its last argument whenever there is progress.
pub type Work<'a, Job, Done> =
    dyn Fn(&mut Worker, &Job, &dyn Fn()) -> Result<Done, Error> + Sync + 'a;

/// The jobs of a run, and how they are done.
pub struct Task<'a, Job, Done> {
    /// All jobs.
    pub jobs: &'a [Job],
    /// The launch of a job's process. A thread keeps its process as long as the launch is the same.
    pub launch: &'a (dyn Fn(&Job) -> Launch + Sync),
    /// Does a job. It calls the last argument whenever there is progress.
    pub work: &'a Work<'a, Job, Done>,
}

impl Pool {
    /// The results of all jobs, in order. `progress` is called with a job whenever there is progress in it.
    ///
    /// # Errors
    /// A process cannot be started.
    pub fn run<Job: Sync, Done: Send>(
        self,
        task: &Task<Job, Done>,
        progress: &mut dyn FnMut(&Job),
    ) -> Result<Vec<Done>, Error> {
        let next = AtomicUsize::new(0);
        let (send, ticks) = channel();
        let shares = thread::scope(|scope| {
            let start = |_| {
                let (send, next) = (send.clone(), &next);
                scope.spawn(move || task.share(next, &send))
            };
            let workers = self.workers.clamp(1, task.jobs.len().max(1));
            let threads: Vec<_> = (0..workers).map(start).collect();
            drop(send);
            for place in ticks {
                progress(&task.jobs[place]);
            }
            let shares = threads.into_iter().map(|thread| {
                let share = thread.join();
                share.unwrap_or_else(|fault| panic::resume_unwind(fault))
            });
            shares.collect::<Result<Vec<_>, Error>>()
        })?;
        let mut done: Vec<(usize, Done)> = shares.into_iter().flatten().collect();
        done.sort_by_key(|(place, _)| *place);
        Ok(done.into_iter().map(|(_, done)| done).collect())
    }
}

impl<Job, Done> Task<'_, Job, Done> {
    /// The results of one thread's share of the jobs, each with its index.
    fn share(
        &self,
        next: &AtomicUsize,
        ticks: &Sender<usize>,
    ) -> Result<Vec<(usize, Done)>, Error> {
        let mut kept: Option<Worker> = None;
        let mut share = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = self.jobs.get(place) else {
                return Ok(share);
            };
            let launch = (self.launch)(job);
            let mut worker = match kept.take() {
                Some(worker) if worker.is_of(&launch) => worker,
                _ => Worker::new(launch),
            };
            // The receiver is gone if the run has failed.
            let tick = || ticks.send(place).unwrap_or_default();
            share.push((place, (self.work)(&mut worker, job, &tick)?));
            kept = Some(worker);
        }
    }
}
