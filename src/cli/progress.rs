//! How a run tells of itself: a bar on a terminal, else one line a generation.

use super::console::{Console, Progress as How};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use quadrille::config::Config;
use quadrille::evolve::{Redundancy, redundancies};
use quadrille::mesh::Code;
use quadrille::output::designs::id;
use quadrille::output::number::significant;
use quadrille::output::obstacles::{Obstacles, initial_mesh};
use quadrille::search::{Evaluation, GenerationRow, ObjectivesParams, Observer, Progress};
use std::time::Instant;

/// Shows the progress of a run on stderr.
pub struct Display {
    console: Console,
    bar: Option<ProgressBar>,
    generations: u32,
    limits: Limits,
    started: Instant,
    now: Option<Progress>,
    /// The one under way.
    generation: u32,
    front: u64,
    hypervolume: Option<f64>,
    /// What came of the designs before the end of the first generation.
    first: Obstacles,
    /// Their objectives, as far as they have all of them; the names of these.
    values: Vec<Vec<f64>>,
    objectives: ObjectivesParams,
    /// Code of the initial mesh, and how it stands once that is known.
    baseline: Code,
    initial: Option<String>,
}

impl Display {
    /// A display for a run of a config whose initial mesh has the given code.
    pub fn new(config: &Config, baseline: Code, console: Console) -> Self {
        let generations = config.search.generations;
        let limits = Limits::of(config);
        let bar = (console.progress() == How::Bar).then(|| {
            let expected = limits.expected(0, 0);
            let bar = ProgressBar::with_draw_target(Some(expected), ProgressDrawTarget::stderr());
            bar.set_style(style());
            bar
        });
        Self {
            console,
            bar,
            generations,
            limits,
            started: Instant::now(),
            now: None,
            generation: 0,
            front: 0,
            hypervolume: None,
            first: Obstacles::default(),
            values: Vec::new(),
            objectives: config.objectives.clone(),
            baseline,
            initial: None,
        }
    }

    /// Says a line from another thread.
    pub fn teller(&self) -> impl Fn(&str) + Send + 'static {
        let (console, bar) = (self.console, self.bar.clone());
        move |line| match &bar {
            Some(bar) => bar.suspend(|| console.note(line)),
            None => console.note(line),
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
        self.beside_the_bar(|| self.console.note(line));
    }

    fn beside_the_bar(&self, print: impl FnOnce()) {
        match &self.bar {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }

    /// What blocks designs, how the initial mesh stands, and which objectives say nothing: early enough to change the
    /// config.
    fn tell_first_generation(&self) {
        for redundancy in redundancies(&self.values) {
            let told = redundant(redundancy, &self.objectives, self.values.len());
            self.beside_the_bar(|| self.console.warn(&told));
        }
        if self.console.progress() != How::None {
            self.say(&self.first.first_generation());
            if let Some(initial) = &self.initial {
                self.say(initial);
            }
        }
    }

    fn summary(&self, progress: &Progress) -> String {
        let fresh = progress.evaluations.saturating_sub(progress.recovered);
        let seconds = self.started.elapsed().as_secs_f64();
        let rate = if seconds > 0.0 { fresh as f64 / seconds } else { 0.0 };
        let share = 100.0 * progress.feasible as f64 / progress.evaluations.max(1) as f64;
        let expected = self.limits.expected(progress.evaluations, progress.structural);
        let left = expected.saturating_sub(progress.evaluations) as f64 / rate;
        let left = self.limits.seconds.map_or(left, |limit| left.min((limit - seconds).max(0.0)));
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
    fn design(&mut self, code: Code, evaluation: &Evaluation) {
        if self.generation == 0 {
            self.first.add(evaluation.violation, &evaluation.reason);
            if !evaluation.objectives.is_empty() {
                self.values.push(evaluation.objectives.clone());
            }
        }
        if code == self.baseline {
            self.initial = Some(initial_mesh(evaluation.violation, &evaluation.reason));
        }
        if self.console.tells_designs() {
            let told = match evaluation.violation.stage {
                0 => "feasible".to_owned(),
                stage => format!("stage {stage}, {}", evaluation.reason),
            };
            self.say(&format!("  {}: {told}", id(code)));
        }
    }

    fn evaluated(&mut self, progress: &Progress) {
        self.now = Some(*progress);
        if let Some(bar) = &self.bar {
            bar.set_length(self.limits.expected(progress.evaluations, progress.structural));
            bar.set_position(progress.evaluations);
            bar.set_message(self.summary(progress));
        }
    }

    fn generation(&mut self, row: &GenerationRow) {
        self.limits.finished = (u64::from(row.generation) + 1, row.evaluations);
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
        if row.generation == 0 {
            self.tell_first_generation();
            self.values = Vec::new();
        }
        self.generation = row.generation + 1;
        let breeding = &row.breeding;
        let told = format!(
            "  bred {}, duplicates refused {}, neighbours refused {}, rejected by topology {}, immigrants {}",
            breeding.bred, breeding.duplicates, breeding.neighbours, breeding.rejected, breeding.immigrants
        );
        self.beside_the_bar(|| self.console.detail(&told));
    }

    fn notice(&mut self, message: &str) {
        self.say(&format!("note: {message}"));
    }

    fn warning(&mut self, message: &str) {
        self.beside_the_bar(|| self.console.warn(message));
    }
}

/// What ends the run, and how far it has come: for the time left.
struct Limits {
    population: u64,
    /// Generations, the first population among them.
    generations: u64,
    structural: Option<u64>,
    seconds: Option<f64>,
    /// Finished generations, and the evaluations made in them.
    finished: (u64, u64),
}

impl Limits {
    fn of(config: &Config) -> Self {
        Self {
            population: config.search.population as u64,
            generations: u64::from(config.search.generations) + 1,
            structural: config.search.evaluations,
            seconds: config.search.minutes.map(|minutes| 60.0 * minutes),
            finished: (0, 0),
        }
    }

    /// How many evaluations the run will have made at its end, if it goes on as before: a generation in which many
    /// designs fail early evaluates more than the population.
    fn expected(&self, evaluations: u64, structural: u64) -> u64 {
        let (finished, made) = self.finished;
        let a_generation = if finished > 0 { made as f64 / finished as f64 } else { self.population as f64 };
        let by_generations = (a_generation * self.generations as f64).round() as u64;
        let by_budget = match self.structural {
            Some(budget) if structural > 0 => (evaluations as f64 * budget as f64 / structural as f64) as u64,
            _ => u64::MAX,
        };
        by_generations.min(by_budget).max(evaluations)
    }
}

/// What is said of objectives that add nothing, and what to do.
fn redundant(redundancy: Redundancy, params: &ObjectivesParams, designs: usize) -> String {
    let name = |m: usize| params.names().nth(m).map_or("", String::as_str);
    let designs = format!("all {designs} designs of the first generation");
    match redundancy {
        Redundancy::Constant { objective, value } => format!(
            "objective \"{}\" is {} for {designs}: it tells none from another; leave it out",
            name(objective),
            significant(if params.is_maximised(objective) { -value } else { value })
        ),
        Redundancy::Dependent { objectives: [a, b], opposed: false } => format!(
            "objectives \"{}\" and \"{}\" put {designs} in the same order, so one is a function of the other; \
             leave one out",
            name(a),
            name(b)
        ),
        Redundancy::Dependent { objectives: [a, b], opposed: true } => format!(
            "objectives \"{}\" and \"{}\" put {designs} in opposite orders, so one is a function of the other and no \
             design is better than another in both; leave one out",
            name(a),
            name(b)
        ),
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

#[cfg(test)]
mod tests {
    use super::Limits;

    #[test]
    fn what_is_left_follows_what_generations_have_taken() {
        let limits = |finished, structural| Limits {
            population: 24,
            generations: 16,
            structural,
            seconds: None,
            finished,
        };
        assert_eq!(limits((0, 0), None).expected(0, 0), 384);
        assert_eq!(limits((4, 300), None).expected(310, 90), 1200);
        assert_eq!(limits((16, 1100), None).expected(1100, 380), 1100);
        // A budget of structural evaluations, half of it used up.
        assert_eq!(limits((4, 300), Some(200)).expected(310, 100), 620);
    }
}
