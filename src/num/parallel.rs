//! The same work many times, shared among the processor's cores. What comes of it does not depend on how many there are.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// The results of so many calls, in order. `progress` hears how many are done, of how many.
pub fn in_parallel<T: Send>(
    count: usize,
    one: &(impl Fn(usize) -> T + Sync),
    progress: &mut dyn FnMut(u64, u64),
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    let mut results: Vec<Option<T>> = (0..count).map(|_| None).collect();
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            let (send, next) = (send.clone(), &next);
            scope.spawn(move || {
                let own = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
                for i in own.take_while(|i| *i < count) {
                    if send.send((i, one(i))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
        for (done, (i, result)) in receive.iter().enumerate() {
            results[i] = Some(result);
            progress(done as u64 + 1, count as u64);
        }
    });
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn results_stand_in_order() {
        let mut heard = 0;
        let made = super::in_parallel(37, &|i| i * i, &mut |done, of| heard = done + of);
        assert_eq!(heard, 37 + 37);
        assert!(made.iter().enumerate().all(|(i, square)| *square == i * i));
    }
}
