//! The memory that reading takes.

use std::sync::Once;

/// Bytes for any file: the buffers of a reader and a block.
const ALWAYS: u64 = 1 << 20;

/// Bytes of memory for a byte of a file, at most. JSON takes the most: an empty
/// array of two bytes is a value of 32 in a growing list, which is copied.
const EACH: u64 = 256;

/// Reads a file of so many bytes; panics if that took more memory at once than
/// the bounds above.
pub(crate) fn in_proportion<T>(bytes: usize, read: impl FnOnce() -> T) -> T {
    static ONE_THREAD: Once = Once::new();
    // Only allocations of this thread are counted, so rayon's work must be done on it.
    ONE_THREAD.call_once(|| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
        let built = pool.use_current_thread().build_global();
        assert!(built.is_ok(), "{built:?}");
    });
    let mut result = None;
    let memory = allocation_counter::measure(|| result = Some(read()));
    let most = ALWAYS + EACH * bytes as u64;
    assert!(
        memory.bytes_max <= most,
        "{} bytes of memory for a file of {bytes}",
        memory.bytes_max
    );
    result.expect("the reader has been called")
}
