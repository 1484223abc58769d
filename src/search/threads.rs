//! The threads that evaluate.

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// The system does not give as many threads as are asked for.
#[derive(Debug, thiserror::Error)]
#[error(
    "cannot start {}: {source}; ask for fewer (--set run.threads=N, or RAYON_NUM_THREADS=N in the environment), or \
     raise what limits them (`ulimit -u`, `ulimit -v`, pids.max of the container)",
    wanted(*.threads)
)]
pub struct ThreadsError {
    /// How many; 0 = one per core.
    threads: usize,
    /// What the system says.
    source: ThreadPoolBuildError,
}

fn wanted(threads: usize) -> String {
    match threads {
        0 => "a thread for each core".into(),
        1 => "a thread".into(),
        _ => format!("{threads} threads"),
    }
}

/// A pool of `threads` threads; 0 = one per core.
///
/// # Errors
/// [`ThreadsError`] if the operating system does not give the threads.
pub fn thread_pool(threads: usize) -> Result<ThreadPool, ThreadsError> {
    ThreadPoolBuilder::new().num_threads(threads).build().map_err(|source| ThreadsError { threads, source })
}
