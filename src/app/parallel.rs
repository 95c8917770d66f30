//! Work that is the same for many things, shared among the processor's cores. The order of results is that of the things.

/// What this makes of each thing. `done` hears how many are made.
pub fn each<T: Sync, R: Send>(
    things: &[T],
    make: impl Fn(&T) -> R + Sync,
    done: &mut dyn FnMut(usize),
) -> Vec<R> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut made = Vec::with_capacity(things.len());
    for batch in things.chunks(cores) {
        std::thread::scope(|scope| {
            let make = &make;
            let start = |thing| scope.spawn(move || make(thing));
            let threads: Vec<_> = batch.iter().map(start).collect();
            let ended = threads.into_iter().map(|thread| {
                let end = thread.join();
                end.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            });
            made.extend(ended);
        });
        done(made.len());
    }
    made
}

#[cfg(test)]
mod tests {
    #[test]
    fn results_stand_in_the_order_of_things() {
        let things: Vec<usize> = (0..37).collect();
        let mut heard = 0;
        let made = super::each(&things, |thing| thing * thing, &mut |done| heard = done);
        assert_eq!(heard, 37);
        assert!(made.iter().enumerate().all(|(i, square)| *square == i * i));
    }
}
