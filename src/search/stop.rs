//! The flag that ends a run early, and the signals that raise it.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Asks a run to finish the evaluations in flight, write its checkpoint and return.
#[derive(Clone, Debug, Default)]
pub struct StopFlag(Arc<AtomicUsize>);

impl StopFlag {
    /// A flag that nobody has raised.
    pub fn new() -> Self {
        Self::default()
    }

    /// Raises the flag as `signal` would.
    pub fn raise(&self, signal: i32) {
        self.0.store(usize::try_from(signal).unwrap_or(1), Ordering::SeqCst);
    }

    /// The signal that raised it, if one did.
    pub fn raised(&self) -> Option<i32> {
        match self.0.load(Ordering::SeqCst) {
            0 => None,
            signal => i32::try_from(signal).ok(),
        }
    }

    /// Lets SIGINT and SIGTERM raise the flag; a second one of either ends the program at once, with exit code
    /// 130 or 143.
    ///
    /// # Errors
    /// If the operating system refuses the handlers.
    pub fn install(&self) -> io::Result<()> {
        let armed = Arc::new(AtomicBool::new(false));
        for signal in [SIGINT, SIGTERM] {
            // Order matters: actions run as registered, and the first signal must find the second's trap unarmed.
            flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&armed))?;
        }
        for signal in [SIGINT, SIGTERM] {
            flag::register(signal, Arc::clone(&armed))?;
            flag::register_usize(signal, Arc::clone(&self.0), usize::try_from(signal).unwrap_or(1))?;
        }
        Ok(())
    }
}
