//! Parallel calls, distributed over the CPU's cores. The results do not depend on the number of cores.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;

/// The results of `count` calls, in order. `progress` is called with the number done and the total.
pub fn in_parallel<T: Send>(
    count: usize,
    one: &(impl Fn(usize) -> T + Sync),
    progress: &mut dyn FnMut(u64, u64),
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let results: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    let (send, receive) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            let (send, next, results) = (send.clone(), &next, &results);
            scope.spawn(move || {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(slot) = results.get(i) else { break };
                    let result = one(i);
                    *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
                    if send.send(()).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
        for (done, ()) in receive.iter().enumerate() {
            progress(done as u64 + 1, count as u64);
        }
    });
    let result = |slot: Mutex<Option<T>>| slot.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.into_iter().filter_map(result).collect()
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
