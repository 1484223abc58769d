//! How the writing of designs is shown: a bar on a terminal, else a line now and then.

use super::console::{Console, Progress as How};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use quadrille::output::results::Writing;
use quadrille::search::StopFlag;
use std::time::{Duration, Instant};

/// Between two lines.
const PAUSE: Duration = Duration::from_secs(2);

/// Shows on stderr how many designs are written; with `-v` each.
pub struct WritingDisplay<'a> {
    console: Console,
    stop: &'a StopFlag,
    bar: Option<ProgressBar>,
    told: Instant,
}

impl<'a> WritingDisplay<'a> {
    /// A display for designs that are written until `stop` is raised.
    pub fn new(stop: &'a StopFlag, console: Console) -> Self {
        let bar = (console.progress() == How::Bar).then(|| {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{wide_bar} {percent}%\n{msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self { console, stop, bar, told: Instant::now() }
    }
}

impl Writing for WritingDisplay<'_> {
    fn written(&mut self, done: usize, all: usize) {
        let told = format!("writing designs: {done} of {all}");
        if let Some(bar) = &self.bar {
            bar.set_length(all as u64);
            bar.set_position(done as u64);
            bar.set_message(told);
        } else if self.console.progress() == How::Plain && self.told.elapsed() >= PAUSE {
            self.told = Instant::now();
            self.console.note(&told);
        } else {
            self.console.detail(&told);
        }
    }

    fn stop(&self) -> bool {
        self.stop.raised().is_some()
    }
}

impl Drop for WritingDisplay<'_> {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
