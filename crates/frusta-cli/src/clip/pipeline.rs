//! Reader, workers, writer: in order, in bounded memory, with any number of
//! threads.
//!
//! Job `k` goes to worker `k mod n` and its result is taken from there in turn,
//! so that results come in the order of the jobs without being sorted, and
//! the first failure in that order is the one reported. The channels hold a few
//! jobs each, which bounds the memory.

use crate::failure::Failure;
use std::hint::black_box;
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

/// Number of jobs that may wait for each worker, and of results that may wait for the sink.
const DEPTH: usize = 2;

/// A producer calls this with each job. An error means that the workers have ended;
/// the producer returns it.
pub(crate) type Emit<'a, J> = dyn FnMut(J) -> Result<(), Failure> + 'a;

/// Runs all jobs that `produce` emits through workers made by `worker`, one a
/// thread, and their results through `sink` in order.
pub(crate) fn run<J: Send, R: Send, W: FnMut(J) -> Result<R, Failure>>(
    threads: usize,
    produce: impl FnOnce(&mut Emit<'_, J>) -> Result<(), Failure> + Send,
    worker: impl Fn() -> W + Sync,
    mut sink: impl FnMut(R) -> Result<(), Failure>,
) -> Result<(), Failure> {
    thread::scope(|scope| {
        let mut inputs = Vec::new();
        let mut outputs = Vec::new();
        for _ in 0..threads.max(1) {
            let (input, jobs) = sync_channel::<Result<J, Failure>>(DEPTH);
            let (results, output) = sync_channel(DEPTH);
            inputs.push(input);
            outputs.push(output);
            let worker = &worker;
            start(scope, move || work(worker(), &jobs, &results))?;
        }
        start(scope, move || distribute(produce, &inputs))?;
        for output in outputs.iter().cycle() {
            // A worker that hangs up has no job left, nor has any after it.
            let Ok(result) = output.recv() else {
                return Ok(());
            };
            sink(result?)?;
        }
        Ok(())
    })
}

/// Starts a thread. Those that run already end when their channels do.
fn start<'scope>(
    scope: &'scope thread::Scope<'scope, '_>,
    body: impl FnOnce() + Send + 'scope,
) -> Result<(), Failure> {
    let spawn = |runs: SyncSender<()>| {
        let body = move || {
            let _ = runs.send(());
            body();
        };
        thread::Builder::new().spawn_scoped(scope, body)
    };
    start_by(spawn).map_err(|e| Failure::new(format_args!("threads: {e}")))
}

/// A thread's stack, and as much again for what else it allocates as it starts.
const THREAD_MEMORY: usize = 4 << 20;

/// Fails if the system has not that much memory.
///
/// Asks for a little more each time: an allocator that has freed a large block may serve the
/// next one of that size from its own store (glibc's threshold follows such blocks up to
/// 32 MiB), which a stack cannot use.
fn check_memory_for_a_thread() -> io::Result<()> {
    static ASKED: AtomicUsize = AtomicUsize::new(0);
    let more = ASKED.fetch_add(1, Ordering::Relaxed) % 1024 * (16 << 10);
    let mut piece = Vec::<u8>::new();
    let room = piece.try_reserve_exact(THREAD_MEMORY + more);
    // Otherwise the compiler removes the allocation.
    black_box(&piece);
    room.map_err(|_| io::Error::from(io::ErrorKind::OutOfMemory))
}

/// Starts a thread, if there is one left and memory for it, and waits until it runs: it sends
/// through the channel that it is given.
///
/// The standard library allocates the signal stack in the new thread, and aborts the program
/// if it cannot. Waiting prevents several new threads from counting on the same memory.
pub(crate) fn start_by<T>(spawn: impl FnOnce(SyncSender<()>) -> io::Result<T>) -> io::Result<()> {
    check_memory_for_a_thread()?;
    let (runs, is_running) = sync_channel(1);
    spawn(runs)?;
    // A thread that ended without sending ran, too.
    let _ = is_running.recv();
    Ok(())
}

fn work<J, R>(
    mut worker: impl FnMut(J) -> Result<R, Failure>,
    jobs: &Receiver<Result<J, Failure>>,
    results: &SyncSender<Result<R, Failure>>,
) {
    for job in jobs {
        let result = job.and_then(&mut worker);
        let failed = result.is_err();
        if results.send(result).is_err() || failed {
            return;
        }
    }
}

/// Deals out the jobs; a failure to read travels with them, in its place.
fn distribute<J>(
    produce: impl FnOnce(&mut Emit<'_, J>) -> Result<(), Failure>,
    inputs: &[SyncSender<Result<J, Failure>>],
) {
    let mut turns = inputs.iter().cycle();
    let mut deal = |job| match turns.next().map(|input| input.send(job)) {
        Some(Ok(())) => Ok(()),
        _ => Err(Failure::new("the workers have ended")),
    };
    if let Err(failure) = produce(&mut |job| deal(Ok(job))) {
        // If the workers have ended, a failure has been reported already.
        let _ = deal(Err(failure));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn squares(threads: usize, fail_at: Option<u64>) -> (Vec<u64>, Result<(), Failure>) {
        let mut seen = Vec::new();
        let result = run(
            threads,
            |emit| (0..1000_u64).try_for_each(emit),
            || {
                move |job: u64| match fail_at {
                    Some(at) if job >= at => Err(Failure::new(job)),
                    _ => Ok(job * job),
                }
            },
            |square| {
                seen.push(square);
                Ok(())
            },
        );
        (seen, result)
    }

    #[test]
    fn results_come_in_order_from_any_number_of_threads() {
        let expected: Vec<u64> = (0..1000).map(|i| i * i).collect();
        for threads in [0, 1, 2, 3, 7] {
            assert_eq!(squares(threads, None), (expected.clone(), Ok(())));
        }
    }

    #[test]
    fn the_first_failure_in_order_ends_the_run() {
        for threads in [1, 2, 5] {
            let (seen, result) = squares(threads, Some(17));
            assert_eq!(seen.len(), 17);
            assert_eq!(result, Err(Failure::new(17)));
        }
    }

    #[test]
    fn a_failing_reader_or_sink_ends_the_run() {
        let read = run(
            2,
            |emit| {
                (1..5).try_for_each(emit)?;
                Err(Failure::new("torn"))
            },
            || Ok,
            |_| Ok(()),
        );
        assert_eq!(read, Err(Failure::new("torn")));
        let full = run(
            2,
            |emit| (0..).try_for_each(emit),
            || Ok,
            |_| Err(Failure::new("full")),
        );
        assert_eq!(full, Err(Failure::new("full")));
    }
}
