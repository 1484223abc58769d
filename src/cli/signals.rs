//! Signals that end a run early.

use quadrille::search::StopFlag;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// `timeout` and batch systems send a signal to the program and another to its process group: within this time they are
/// one.
const ONE: Duration = Duration::from_secs(1);
/// How often it is looked whether a signal has come.
const LOOK: Duration = Duration::from_millis(50);

#[cfg(unix)]
const SIGNALS: [i32; 3] = [signal_hook::consts::SIGHUP, SIGINT, SIGTERM];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// Lets SIGINT, SIGTERM and SIGHUP raise the flag, and `tell` that they did; one that comes more than a second later ends
/// the program at once, with exit code 128 + its number. A SIGHUP that the program was started to ignore (`nohup`) stays
/// ignored.
///
/// # Errors
/// If the operating system refuses the handlers or the thread.
pub fn install(stop: &StopFlag, tell: impl FnOnce() + Send + 'static) -> io::Result<()> {
    let (seen, armed) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
    for signal in SIGNALS.into_iter().filter(|&signal| !is_ignored_hangup(signal)) {
        flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&armed))?;
        flag::register_usize(signal, Arc::clone(&seen), usize::try_from(signal).unwrap_or(1))?;
    }
    let stop = stop.clone();
    let watch = move || {
        while seen.load(Ordering::SeqCst) == 0 {
            thread::sleep(LOOK);
        }
        let first = Instant::now();
        stop.raise(i32::try_from(seen.load(Ordering::SeqCst)).unwrap_or(SIGTERM));
        tell();
        thread::sleep(ONE.saturating_sub(first.elapsed()));
        armed.store(true, Ordering::SeqCst);
    };
    thread::Builder::new().name("signals".into()).spawn(watch).map(|_| ())
}

/// Whether this is SIGHUP and was ignored when the program began; known on Linux only.
fn is_ignored_hangup(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    signal != SIGINT && signal != SIGTERM && mask >> (signal - 1) & 1 == 1
}
