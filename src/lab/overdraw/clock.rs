//! The clocks: the wall clock, and the processor time of this process. No other file of this room reads clocks.

use std::time::Instant;

/// Nanoseconds that something took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spent {
    /// By the wall clock.
    pub wall: f64,
    /// Processor time of this process, all threads together, where the system reports it. It does not include other programs.
    pub processor: Option<f64>,
}

/// The result of some work, and how long it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Spent) {
    let (before, start) = (processor(), Instant::now());
    let done = work();
    let wall = start.elapsed().as_nanos() as f64;
    let between = |(before, after): (f64, f64)| after - before;
    let spent = Spent {
        wall,
        processor: before.zip(processor()).map(between),
    };
    (done, spent)
}

#[cfg(unix)]
fn processor() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 * 1e9 + time.tv_nsec as f64)
}

#[cfg(not(unix))]
fn processor() -> Option<f64> {
    None
}
