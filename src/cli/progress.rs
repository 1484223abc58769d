//! How a run tells of itself: a bar on a terminal, else one line a generation.

use super::console::{Console, Progress as How};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use quadrille::config::Config;
use quadrille::search::{GenerationRow, Observer, Progress};
use std::time::{Duration, Instant};

/// Shows the progress of a run on stderr.
pub struct Display {
    console: Console,
    bar: Option<ProgressBar>,
    generations: u32,
    /// Designs that the whole run would evaluate if nothing ends it early.
    expected: u64,
    started: Instant,
    now: Option<Progress>,
    front: u64,
    hypervolume: Option<f64>,
}

impl Display {
    /// A display for a run of a config.
    pub fn new(config: &Config, console: Console) -> Self {
        let generations = config.search.generations;
        let expected = config.search.population as u64 * (u64::from(generations) + 1);
        let bar = (console.progress() == How::Bar).then(|| {
            let bar = ProgressBar::with_draw_target(Some(expected), ProgressDrawTarget::stderr());
            bar.set_style(style());
            bar.enable_steady_tick(Duration::from_millis(200));
            bar
        });
        Self {
            console,
            bar,
            generations,
            expected,
            started: Instant::now(),
            now: None,
            front: 0,
            hypervolume: None,
        }
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    /// A line that does not tear the bar.
    fn say(&self, line: &str) {
        match &self.bar {
            Some(bar) => bar.suspend(|| self.console.note(line)),
            None => self.console.note(line),
        }
    }

    fn summary(&self, progress: &Progress) -> String {
        let fresh = progress.evaluations.saturating_sub(progress.recovered);
        let seconds = self.started.elapsed().as_secs_f64();
        let rate = if seconds > 0.0 { fresh as f64 / seconds } else { 0.0 };
        let share = 100.0 * progress.feasible as f64 / progress.evaluations.max(1) as f64;
        let left = self.expected.saturating_sub(progress.evaluations) as f64 / rate;
        format!(
            "generation {}/{}  {} evaluations  {rate:.1}/s  feasible {share:.0} %  front {}  hypervolume {}  {}",
            progress.generation,
            self.generations,
            progress.evaluations,
            self.front,
            self.hypervolume.map_or("–".to_owned(), |volume| format!("{volume:.4}")),
            if left.is_finite() { format!("{} left", duration(left)) } else { "time left unknown".into() }
        )
    }
}

impl Observer for Display {
    fn evaluated(&mut self, progress: &Progress) {
        self.now = Some(*progress);
        if let Some(bar) = &self.bar {
            bar.set_position(progress.evaluations.min(self.expected));
            bar.set_message(self.summary(progress));
        }
    }

    fn generation(&mut self, row: &GenerationRow) {
        self.front = row.front;
        self.hypervolume = row.hypervolume;
        let recovered = self.now.map_or(0, |now| now.recovered);
        let progress = Progress {
            generation: row.generation,
            evaluations: row.evaluations,
            structural: row.structural,
            feasible: row.feasible,
            pending: 0,
            recovered,
        };
        match (&self.bar, self.console.progress()) {
            (Some(bar), _) => bar.set_message(self.summary(&progress)),
            (None, How::Plain) => self.say(&self.summary(&progress)),
            _ => {}
        }
        let breeding = &row.breeding;
        self.console.detail(&format!(
            "  bred {}, duplicates refused {}, neighbours refused {}, rejected by topology {}, immigrants {}",
            breeding.bred, breeding.duplicates, breeding.neighbours, breeding.rejected, breeding.immigrants
        ));
    }

    fn notice(&mut self, message: &str) {
        self.say(&format!("note: {message}"));
    }
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{wide_bar} {percent}%\n{msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// A time as people say it.
pub fn duration(seconds: f64) -> String {
    let seconds = seconds.round() as u64;
    match seconds {
        0..60 => format!("{seconds} s"),
        60..3600 => format!("{} min {} s", seconds / 60, seconds % 60),
        _ => format!("{} h {} min", seconds / 3600, seconds / 60 % 60),
    }
}
