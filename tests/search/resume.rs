//! A run that was stopped, killed or damaged and resumed ends with what the undisturbed run ends with.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use quadrille::grammar::Tokens;
use quadrille::random::{Rng, below, stream};
use quadrille::search::{
    Ended, Evaluation, Identity, Observer, Outcome, Preview, Problem, Progress, RuleOperator, Settings,
    Silent, StopFlag, Store, StoreError, ThreadServer, run,
};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::support::{Counting, island_settings, run_silently, run_stored, settings};

const SIGINT: i32 = 2;

fn config() -> Value {
    json!({"run": {"seed": 7, "threads": 1}, "search": {"generations": 8, "population": 16}})
}

fn resume(folder: &Path) -> Outcome {
    let mut store = Store::resume(folder, config()).expect("a folder that can be resumed");
    run_stored(&Counting::new(), &settings(8), &mut store, &StopFlag::new(), &mut Silent).expect("no errors")
}

/// Raises the flag after so many evaluations of this sitting.
struct StopAfter {
    left: u64,
    flag: StopFlag,
}

impl Observer for StopAfter {
    fn evaluated(&mut self, _progress: &Progress) {
        self.left = self.left.saturating_sub(1);
        if self.left == 0 {
            self.flag.raise(SIGINT);
        }
    }
}

/// Copies the folder after so many evaluations, as a kill would leave it then.
struct SnapshotAt {
    left: u64,
    from: TempDir,
    to: TempDir,
}

impl Observer for SnapshotAt {
    fn evaluated(&mut self, _progress: &Progress) {
        self.left = self.left.saturating_sub(1);
        if self.left == 0 {
            for entry in fs::read_dir(self.from.path()).expect("folder") {
                let entry = entry.expect("entry");
                fs::copy(entry.path(), self.to.path().join(entry.file_name())).expect("copy");
            }
            self.left = u64::MAX;
        }
    }
}

/// The folder of a run killed after `evaluations`.
fn killed_after(evaluations: u64) -> TempDir {
    killed(&settings(8), evaluations)
}

/// The same with other settings.
fn killed(settings: &Settings, evaluations: u64) -> TempDir {
    let new = || tempfile::tempdir().expect("folder");
    let mut snapshot = SnapshotAt { left: evaluations, from: new(), to: new() };
    let mut store = Store::create(snapshot.from.path(), config()).expect("store");
    let outcome =
        run_stored(&Counting::new(), settings, &mut store, &StopFlag::new(), &mut snapshot).expect("run");
    assert!(outcome.evaluated.len() as u64 > evaluations);
    snapshot.to
}

#[test]
fn stopped_at_any_evaluation_and_resumed() {
    let undisturbed = run_silently(&Counting::new(), &settings(8), 1);
    for every in [1, 2, 7, 15, 16, 17, 33, 100] {
        let folder = tempfile::tempdir().expect("folder");
        let mut store = Store::create(folder.path(), config()).expect("store");
        let mut sittings = 0;
        let last = loop {
            let flag = StopFlag::new();
            let mut observer = StopAfter { left: every, flag: flag.clone() };
            let outcome =
                run_stored(&Counting::new(), &settings(8), &mut store, &flag, &mut observer).expect("run");
            sittings += 1;
            // Recovered evaluations are counted too, so a sitting must be allowed to get beyond them.
            if outcome.ended != Ended::Interrupted(SIGINT) || sittings > 3 {
                break outcome;
            }
            drop(store);
            store = Store::resume(folder.path(), config()).expect("resumable");
        };
        drop(store);
        assert_eq!(resume(folder.path()), undisturbed, "stopped every {every}");
        assert!(last.evaluated.len() <= undisturbed.evaluated.len());
    }
}

#[test]
fn killed_at_fifty_moments_and_resumed() {
    let undisturbed = run_silently(&Counting::new(), &settings(8), 1);
    for moment in 0..50 {
        let evaluations = 1 + below(&mut stream(1, moment, 0), undisturbed.evaluated.len() - 2) as u64;
        let folder = killed_after(evaluations);
        let mut counting = Counting::new();
        counting.evaluated = 0.into();
        let mut store = Store::resume(folder.path(), config()).expect("resumable");
        let outcome =
            run_stored(&counting, &settings(8), &mut store, &StopFlag::new(), &mut Silent).expect("run");
        assert_eq!(outcome, undisturbed, "killed after {evaluations}");
        let again = counting.evaluated.into_inner();
        assert_eq!(again, undisturbed.evaluated.len() as u64 - evaluations, "only what was not finished");
    }
}

#[test]
fn islands_killed_at_any_moment_and_resumed() {
    let settings = island_settings(8);
    let undisturbed = run_silently(&Counting::new(), &settings, 1);
    for moment in 0..30 {
        let evaluations = 1 + below(&mut stream(2, moment, 0), undisturbed.evaluated.len() - 2) as u64;
        let folder = killed(&settings, evaluations);
        let counting = Counting::new();
        let mut store = Store::resume(folder.path(), config()).expect("resumable");
        let outcome =
            run_stored(&counting, &settings, &mut store, &StopFlag::new(), &mut Silent).expect("run");
        assert_eq!(outcome, undisturbed, "killed after {evaluations}");
        let again = counting.evaluated.into_inner();
        assert_eq!(again, undisturbed.evaluated.len() as u64 - evaluations, "only what was not finished");
    }
}

#[test]
fn damaged_files_cost_time_but_not_a_byte() {
    let undisturbed = run_silently(&Counting::new(), &settings(8), 1);
    let spoil = |what: &str, bytes: &mut Vec<u8>, at: usize| match what {
        "truncated" => bytes.truncate(at),
        "flipped" => bytes[at] ^= 4,
        _ => bytes.clear(),
    };
    for file in ["checkpoint.json", "checkpoint.previous.json", "evaluations.journal"] {
        for (k, what) in ["truncated", "flipped", "emptied"].into_iter().enumerate() {
            for round in 0..3 {
                let folder = killed_after(70);
                let path = folder.path().join(file);
                let mut bytes = fs::read(&path).expect(file);
                let at = below(&mut stream(9, round, k as u32), bytes.len());
                spoil(what, &mut bytes, at);
                fs::write(&path, bytes).expect(file);
                assert_eq!(resume(folder.path()), undisturbed, "{file} {what}");
            }
        }
        let folder = killed_after(70);
        fs::remove_file(folder.path().join(file)).expect(file);
        assert_eq!(resume(folder.path()), undisturbed, "{file} removed");
    }
}

#[test]
fn a_damaged_checkpoint_is_told_of_and_the_one_before_is_used() {
    struct Listener(Vec<String>, u64);
    impl Observer for Listener {
        fn evaluated(&mut self, progress: &Progress) {
            self.1 = self.1.max(u64::from(progress.generation == 2));
        }
        fn notice(&mut self, message: &str) {
            self.0.push(message.to_owned());
        }
    }
    let folder = killed_after(70);
    let path = folder.path().join("checkpoint.json");
    let mut bytes = fs::read(&path).expect("checkpoint");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, bytes).expect("checkpoint");
    let mut listener = Listener(Vec::new(), 0);
    let mut store = Store::resume(folder.path(), config()).expect("resumable");
    run_stored(&Counting::new(), &settings(8), &mut store, &StopFlag::new(), &mut listener).expect("run");
    assert!(listener.0[0].contains("checkpoint.json is not used"), "{:?}", listener.0);
    assert_eq!(listener.1, 0, "the checkpoint before was used, not the very beginning");
}

#[test]
fn another_config_is_refused_by_its_keys_but_limits_may_change() {
    let folder = killed_after(40);
    let other = json!({"run": {"seed": 8, "threads": 4}, "search": {"generations": 9, "population": 20}});
    match Store::resume(folder.path(), other) {
        Err(StoreError::OtherConfig { keys, .. }) => assert_eq!(keys, ["run.seed", "search.population"]),
        unexpected => panic!("{unexpected:?}"),
    }
    assert_eq!(Store::recorded_config(folder.path()).expect("readable"), Some(config()));

    // More generations than planned: the same as if they had been planned.
    resume(folder.path());
    let longer = json!({"run": {"seed": 7, "threads": 1}, "search": {"generations": 11, "population": 16}});
    let mut store = Store::resume(folder.path(), longer).expect("only a limit differs");
    let outcome =
        run_stored(&Counting::new(), &settings(11), &mut store, &StopFlag::new(), &mut Silent).expect("run");
    assert_eq!(outcome, run_silently(&Counting::new(), &settings(11), 1));
}

#[test]
fn a_budget_can_be_raised() {
    let folder = tempfile::tempdir().expect("folder");
    let budget = |evaluations| {
        let mut settings = settings(1000);
        settings.search.evaluations = Some(evaluations);
        settings
    };
    let mut store = Store::create(folder.path(), config()).expect("store");
    run_stored(&Counting::new(), &budget(50), &mut store, &StopFlag::new(), &mut Silent).expect("run");
    drop(store);
    let mut store = Store::resume(folder.path(), config()).expect("resumable");
    let outcome =
        run_stored(&Counting::new(), &budget(90), &mut store, &StopFlag::new(), &mut Silent).expect("run");
    assert_eq!(outcome, run_silently(&Counting::new(), &budget(90), 1));
}

#[test]
fn a_write_error_ends_the_run_which_resumes_when_it_is_gone() {
    let folder = killed_after(20);
    // A checkpoint cannot be renamed onto a folder.
    let obstacle = folder.path().join("checkpoint.previous.json");
    fs::create_dir(&obstacle).expect("obstacle");
    let mut store = Store::resume(folder.path(), config()).expect("resumable");
    let error = run_stored(&Counting::new(), &settings(8), &mut store, &StopFlag::new(), &mut Silent)
        .expect_err("the checkpoint cannot be written");
    assert!(error.to_string().contains("checkpoint.previous.json"), "{error}");
    drop(store);
    fs::remove_dir(&obstacle).expect("obstacle");
    assert_eq!(resume(folder.path()), run_silently(&Counting::new(), &settings(8), 1));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_named() {
    let folder = tempfile::tempdir().expect("folder");
    std::os::unix::fs::symlink("/dev/full", folder.path().join("evaluations.journal")).expect("symlink");
    let error = Store::create(folder.path(), config()).expect_err("no space left");
    assert!(error.to_string().contains("No space left"), "{error}");
}

/// Raises the flag when its n-th string is bred, as a signal during long breeding.
struct StopsBreeding {
    inner: Counting,
    bred: AtomicU64,
    stop_at: u64,
    flag: StopFlag,
}

impl StopsBreeding {
    fn count(&self) {
        if self.bred.fetch_add(1, Ordering::Relaxed) + 1 == self.stop_at {
            self.flag.raise(SIGINT);
        }
    }
}

impl Problem for StopsBreeding {
    fn identify(&self, tokens: &Tokens) -> Identity {
        self.inner.identify(tokens)
    }
    fn evaluate(&self, tokens: &Tokens) -> Evaluation {
        self.inner.evaluate(tokens)
    }
    fn random(&self, rng: &mut Rng) -> Tokens {
        self.count();
        self.inner.random(rng)
    }
    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
        self.count();
        self.inner.vary(operator, expressed, rng)
    }
}

#[test]
fn breeding_ends_with_the_string_in_hand() {
    let undisturbed = run_silently(&Counting::new(), &settings(8), 1);
    for stop_at in [1, 5, 16, 17, 19, 40] {
        let folder = tempfile::tempdir().expect("folder");
        let flag = StopFlag::new();
        let bred = AtomicU64::new(0);
        let problem = StopsBreeding { inner: Counting::new(), bred, stop_at, flag: flag.clone() };
        let mut store = Store::create(folder.path(), config()).expect("store");
        let server = ThreadServer::new(&problem, 2).expect("threads");
        let outcome =
            run(&problem, &server, &settings(8), &flag, Some(&mut store), &mut Silent).expect("run");
        assert_eq!(outcome.ended, Ended::Interrupted(SIGINT));
        assert_eq!(problem.bred.load(Ordering::Relaxed), stop_at, "nothing is bred after the signal");
        drop(store);
        assert_eq!(resume(folder.path()), undisturbed, "stopped at string {stop_at}");
    }
}

#[test]
fn without_a_checkpoint_to_go_on_from_a_run_warns_that_it_begins_again() {
    struct Warned(Vec<String>);
    impl Observer for Warned {
        fn warning(&mut self, message: &str) {
            self.0.push(message.to_owned());
        }
    }
    let warned = |damage: &dyn Fn(&Path)| {
        let folder = killed_after(70);
        damage(folder.path());
        let mut warned = Warned(Vec::new());
        let mut store = Store::resume(folder.path(), config()).expect("resumable");
        run_stored(&Counting::new(), &settings(8), &mut store, &StopFlag::new(), &mut warned).expect("run");
        warned.0
    };
    let both = ["checkpoint.json", "checkpoint.previous.json"];
    let spoilt =
        warned(&|folder| both.iter().for_each(|name| fs::write(folder.join(name), "{").expect("a file")));
    let [message] = spoilt.as_slice() else { panic!("{spoilt:?}") };
    let end =
        "the run begins again from generation 0; the 70 evaluations in evaluations.journal are used again";
    assert_eq!(*message, format!("neither checkpoint can be used: {end}"));
    let gone =
        warned(&|folder| both.iter().for_each(|name| fs::remove_file(folder.join(name)).expect("gone")));
    assert_eq!(gone, [format!("there is no checkpoint: {end}")]);
    assert_eq!(warned(&|_| ()), [""; 0]);
}

/// Raises the flag when its n-th preview is asked for.
struct StopsScreening {
    inner: Counting,
    asked: AtomicU64,
    stop_at: u64,
    flag: StopFlag,
}

impl Problem for StopsScreening {
    fn identify(&self, tokens: &Tokens) -> Identity {
        self.inner.identify(tokens)
    }
    fn evaluate(&self, tokens: &Tokens) -> Evaluation {
        self.inner.evaluate(tokens)
    }
    fn has_preview(&self) -> bool {
        true
    }
    fn preview(&self, tokens: &Tokens) -> Preview {
        if self.asked.fetch_add(1, Ordering::Relaxed) + 1 == self.stop_at {
            self.flag.raise(SIGINT);
        }
        self.inner.preview(tokens)
    }
    fn random(&self, rng: &mut Rng) -> Tokens {
        self.inner.random(rng)
    }
    fn vary(&self, operator: RuleOperator, expressed: &Tokens, rng: &mut Rng) -> Option<Tokens> {
        self.inner.vary(operator, expressed, rng)
    }
}

#[test]
fn screening_ends_with_the_preview_in_hand_and_goes_on() {
    let mut settings = settings(8);
    settings.search.screen = 3;
    let problem = |stop_at: u64, flag: &StopFlag| StopsScreening {
        inner: Counting::new(),
        asked: AtomicU64::new(0),
        stop_at,
        flag: flag.clone(),
    };
    let search = |problem: &StopsScreening, store: Option<&mut Store>, flag: &StopFlag| {
        let server = ThreadServer::new(problem, 2).expect("threads");
        run(problem, &server, &settings, flag, store, &mut Silent).expect("run")
    };
    let never = StopFlag::new();
    let undisturbed = search(&problem(u64::MAX, &never), None, &never);
    for stop_at in [1, 20, 48, 49, 130] {
        let folder = tempfile::tempdir().expect("folder");
        let flag = StopFlag::new();
        let stopping = problem(stop_at, &flag);
        let mut store = Store::create(folder.path(), config()).expect("store");
        assert_eq!(search(&stopping, Some(&mut store), &flag).ended, Ended::Interrupted(SIGINT));
        assert!(
            stopping.asked.load(Ordering::Relaxed) <= stop_at + 1,
            "two threads, one preview each in hand"
        );
        drop(store);
        let mut store = Store::resume(folder.path(), config()).expect("a folder that can be resumed");
        let resumed = search(&problem(u64::MAX, &never), Some(&mut store), &never);
        assert_eq!(resumed, undisturbed, "stopped at preview {stop_at}");
    }
}
