//! The only leaf of this room that reads clocks: that on the wall, and the processor's for this process.

use std::time::Instant;

/// Nanoseconds that something took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spent {
    /// By the wall.
    pub wall: f64,
    /// What the processor worked for this process, all threads together, where the system tells: what other programs take
    /// from it is not in there.
    pub processor: Option<f64>,
}

/// Does something, and tells how long it took.
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
