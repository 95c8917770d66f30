//! What verification needs of the machine: the environment, a clock.

use std::time::{Duration, Instant};

/// Whether GitHub runs this, and reads annotations.
pub fn is_github() -> bool {
    std::env::var_os("GITHUB_ACTIONS").is_some_and(|value| value == "true")
}

/// What a variable of the environment says, where it is set.
pub fn variable(name: &str) -> Option<String> {
    std::env::var_os(name).map(|value| value.to_string_lossy().into_owned())
}

/// Runs something, and tells how long it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed())
}

/// How many workers a machine takes.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
