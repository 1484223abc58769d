//! docs/reference/files.md §5.2: a run that is killed, interrupted, damaged or out of space goes on with `--resume` and ends
//! with the bytes of the undisturbed one. Here the program itself is treated so; `search_resume.rs` does it to the
//! library.
//!
//! `KILLS=50 cargo test --release --test program run_kills` kills more often than continuous integration does.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::thread::sleep;
use std::time::{Duration, Instant};

use quadrille::random::{below, stream};
use tempfile::TempDir;

const TABLES: [&str; 3] = ["pareto.csv", "history.csv", "generations.csv"];
const PROGRAM: &str = env!("CARGO_BIN_EXE_quadrille");
const RUN: [&str; 6] = ["run", "configs/ci.toml", "--quiet", "--threads", "2", "--out"];

fn command(folder: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(RUN).arg(folder).args(more);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn begin(folder: &Path, more: &[&str]) -> Child {
    command(folder, more).spawn().unwrap()
}

fn resume(folder: &Path) -> Output {
    command(folder, &["--resume"]).output().unwrap()
}

fn tables(folder: &Path) -> Vec<Vec<u8>> {
    TABLES.iter().map(|name| fs::read(folder.join(name)).unwrap()).collect()
}

/// What the undisturbed run writes, and how long it takes.
fn undisturbed() -> &'static (Vec<Vec<u8>>, Duration) {
    static RESULT: OnceLock<(Vec<Vec<u8>>, Duration)> = OnceLock::new();
    RESULT.get_or_init(|| {
        let folder = TempDir::new().unwrap();
        let clock = Instant::now();
        assert!(command(folder.path(), &[]).status().unwrap().success());
        (tables(folder.path()), clock.elapsed())
    })
}

fn check(folder: &Path, what: &str) {
    for ((now, expected), name) in tables(folder).iter().zip(&undisturbed().0).zip(TABLES) {
        assert!(now == expected, "{what}: {name} differs");
    }
    let left: Vec<_> = files(folder).filter(|name| name.ends_with(".tmp")).collect();
    assert!(left.is_empty(), "{what}: left behind: {left:?}");
}

fn files(folder: &Path) -> impl Iterator<Item = String> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
}

/// Lines of the journal so far.
fn journalled(folder: &Path) -> usize {
    fs::read(folder.join("evaluations.journal"))
        .map_or(0, |bytes| bytes.iter().filter(|b| **b == b'\n').count())
}

/// A run that has come to so many lines of its journal.
fn begin_and_wait(folder: &Path, lines: usize) -> Child {
    let mut child = begin(folder, &[]);
    while journalled(folder) < lines {
        assert!(child.try_wait().unwrap().is_none(), "it ended before {lines} evaluations");
        sleep(Duration::from_millis(1));
    }
    child
}

/// A run with islands, killed twice and resumed.
#[test]
fn islands_killed_and_resumed() {
    const ISLANDS: [&str; 8] = [
        "--set",
        "search.islands=2",
        "--set",
        "search.migrate=2",
        "--set",
        "search.local=0.5",
        "--set",
        "search.initial.kind=near",
    ];
    let whole = TempDir::new().unwrap();
    assert!(command(whole.path(), &ISLANDS).status().unwrap().success());
    let folder = TempDir::new().unwrap();
    let resumed = [ISLANDS.as_slice(), &["--resume"]].concat();
    for (lines, more) in [(20, ISLANDS.as_slice()), (70, resumed.as_slice())] {
        let mut child = begin(folder.path(), more);
        while journalled(folder.path()) < lines && child.try_wait().unwrap().is_none() {
            sleep(Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let last = command(folder.path(), &resumed).output().unwrap();
    assert!(last.status.success(), "{}", stderr(&last));
    assert_eq!(tables(folder.path()), tables(whole.path()));
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn killed_at_random_moments_and_resumed_each_time() {
    let kills: u32 = std::env::var("KILLS").map_or(6, |kills| kills.parse().unwrap());
    let longest = undisturbed().1.as_micros() as usize * 6 / 10;
    let mut folder = TempDir::new().unwrap();
    let (mut killed, mut finished, mut sittings) = (0, 0, 0);
    while killed < kills {
        let begun = fs::exists(folder.path().join(".quadrille.lock")).unwrap();
        let mut child = begin(folder.path(), if begun { &["--resume"] } else { &[] });
        sleep(Duration::from_micros(below(&mut stream(50, sittings, 0), longest) as u64));
        sittings += 1;
        if child.try_wait().unwrap().is_none() {
            child.kill().unwrap();
            killed += 1;
        }
        let output = child.wait_with_output().unwrap();
        eprintln!(
            "kill {killed}: {} evaluations are there, ended with {}",
            journalled(folder.path()),
            output.status
        );
        // It may have come to its end just before the kill.
        if let Some(code) = output.status.code() {
            assert_eq!(code, 0, "{}", stderr(&output));
            check(folder.path(), "between the kills");
            finished += 1;
            folder = TempDir::new().unwrap();
        }
    }
    eprintln!("{killed} kills, {finished} runs finished among them");
    if fs::exists(folder.path().join(".quadrille.lock")).unwrap() {
        let last = resume(folder.path());
        assert!(last.status.success(), "{}", stderr(&last));
        check(folder.path(), "after the last kill");
    }
}

#[test]
fn stopped_by_signals_with_a_command_that_goes_on() {
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let folder = TempDir::new().unwrap();
        let child = begin_and_wait(folder.path(), 30);
        assert!(
            Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap().success()
        );
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{signal}: {}", stderr(&output));
        assert!(fs::exists(folder.path().join("checkpoint.json")).unwrap());
        // The command is printed even with --quiet, and works as it is printed.
        let told = stderr(&output);
        let line = told.lines().find_map(|line| line.split_once("go on with: quadrille ")).unwrap().1;
        let words = [PROGRAM, line].join(" ");
        let status = Command::new("sh")
            .args(["-c", &words])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        assert!(status.unwrap().success(), "{words}");
        check(folder.path(), signal);
    }
}

#[test]
fn a_damaged_newest_checkpoint_is_told_of_and_the_one_before_serves() {
    for damage in ["truncated", "flipped"] {
        let folder = TempDir::new().unwrap();
        let mut child = begin_and_wait(folder.path(), 60);
        child.kill().unwrap();
        child.wait().unwrap();
        let path = folder.path().join("checkpoint.json");
        let mut bytes = fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        match damage {
            "truncated" => bytes.truncate(middle),
            _ => bytes[middle] ^= 1,
        }
        fs::write(&path, bytes).unwrap();
        // Without --quiet, since it is a notice.
        let output = Command::new(PROGRAM)
            .args(["run", "configs/ci.toml", "--resume", "--out"])
            .arg(folder.path())
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert!(stderr(&output).contains("checkpoint.json is not used"), "{}", stderr(&output));
        check(folder.path(), damage);
    }
}

/// Files may not grow beyond so many kB: every write beyond fails, as on a full disk, without any rights needed.
fn run_with_small_files(folder: &Path, kilobytes: u32, more: &str) -> Output {
    let out = folder.to_str().unwrap();
    // A POSIX shell counts in blocks of 512 bytes; an ignored signal stays ignored in the program.
    let script = format!(
        "trap '' XFSZ; ulimit -f {}; exec '{PROGRAM}' {} '{out}' {more}",
        2 * kilobytes,
        RUN.join(" ")
    );
    Command::new("sh").args(["-c", &script]).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap()
}

#[test]
fn a_write_error_ends_the_run_with_exit_1_and_it_goes_on_afterwards() {
    // In the journal, in the tables, and in the report.
    for (kilobytes, file) in [(20, "evaluations.journal"), (300, "report.html")] {
        let folder = TempDir::new().unwrap();
        let output = run_with_small_files(folder.path(), kilobytes, "");
        assert_eq!(output.status.code(), Some(1), "{kilobytes} kB: {}", stderr(&output));
        assert!(stderr(&output).contains(file), "{}", stderr(&output));
        // Still no room: still exit 1, and nothing is lost by trying.
        assert_eq!(run_with_small_files(folder.path(), kilobytes, "--resume").status.code(), Some(1));
        let output = resume(folder.path());
        assert!(output.status.success(), "{}", stderr(&output));
        check(folder.path(), file);
    }
}

/// A real full disk, where this user may mount one: a file system in memory, in a name space of its own.
#[test]
fn a_full_disk_ends_the_run_with_exit_1_and_it_goes_on_when_there_is_space() {
    let may_mount = Command::new("unshare").args(["-rm", "mount", "-t", "tmpfs", "none", "/mnt"]).output();
    if !may_mount.is_ok_and(|output| output.status.success()) {
        eprintln!("NOT TESTED: this user may not mount a file system; see the write errors instead");
        return;
    }
    let copy = TempDir::new().unwrap();
    for size in ["16k", "60k", "400k", "900k"] {
        let script = format!(
            "mount -t tmpfs -o size={size} none /mnt && '{PROGRAM}' {run} /mnt/r; first=$?
             mount -o remount,size=50m /mnt && '{PROGRAM}' {run} /mnt/r --resume; second=$?
             cp /mnt/r/*.csv '{to}'; ls -A /mnt/r >&2; echo \"exits $first $second\"",
            run = RUN.join(" "),
            to = copy.path().display(),
        );
        let output = Command::new("unshare")
            .args(["-rm", "sh", "-c", &script])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        let told = format!("{size}: {}{}", String::from_utf8_lossy(&output.stdout), stderr(&output));
        assert!(told.contains("exits 1 0"), "{told}");
        assert!(told.contains("No space left on device"), "{told}");
        assert!(!told.contains(".tmp\n"), "{told}");
        check(copy.path(), size);
    }
}

/// Sends a signal to a run.
fn send(child: &Child, signal: &str) {
    assert!(Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap().success());
}

#[test]
fn signals_that_come_together_are_one() {
    // As `timeout` sends them, to the program and to its group; and as a terminal that is closed does.
    for signals in [["TERM", "TERM"], ["INT", "TERM"], ["INT", "INT"]] {
        let folder = TempDir::new().unwrap();
        let child = begin_and_wait(folder.path(), 30);
        signals.iter().for_each(|signal| send(&child, signal));
        let output = child.wait_with_output().unwrap();
        let exit = output.status.code();
        assert!(exit == Some(130) || exit == Some(143), "{signals:?}: {}", stderr(&output));
        assert!(stderr(&output).contains("interrupted; go on with: "), "{}", stderr(&output));
        assert!(resume(folder.path()).status.success());
        check(folder.path(), "after two signals");
    }
}

#[test]
fn a_second_signal_later_aborts() {
    // An evaluation of this size takes minutes, but for a design that is refused early: a run that happens to be at such
    // ones ends by itself, and the next is given more time to come to a long one.
    for seconds in 1..=6 {
        let folder = TempDir::new().unwrap();
        let mut child =
            begin(folder.path(), &["--set", "pattern.panels=60000", "--set", "pattern.max_faces=1000000"]);
        while !fs::exists(folder.path().join("evaluations.journal")).unwrap() {
            sleep(Duration::from_millis(2));
        }
        sleep(Duration::from_secs(seconds));
        send(&child, "INT");
        let clock = Instant::now();
        while child.try_wait().unwrap().is_none() {
            sleep(Duration::from_millis(100));
            if clock.elapsed() > Duration::from_secs(2) {
                send(&child, "INT");
            }
            if clock.elapsed() > Duration::from_secs(60) {
                child.kill().unwrap();
                panic!("signals for a minute have not ended it");
            }
        }
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130));
        if !stderr(&output).contains("go on with") {
            return;
        }
    }
    panic!("it ended by itself each time");
}

#[test]
#[cfg(target_os = "linux")]
fn a_closed_terminal_interrupts_unless_it_is_to_be_ignored() {
    let through = |wrapper: &[&str], folder: &Path| {
        let mut command = Command::new(wrapper[0]);
        command
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(&wrapper[1..])
            .arg(PROGRAM)
            .args(RUN)
            .arg(folder);
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        while journalled(folder) < 30 {
            sleep(Duration::from_millis(1));
        }
        send(&child, "HUP");
        child.wait_with_output().unwrap()
    };
    let folder = TempDir::new().unwrap();
    let output = through(&["env", "--default-signal=HUP"], folder.path());
    assert_eq!(output.status.code(), Some(129), "{}", stderr(&output));
    assert!(stderr(&output).contains("go on with: "), "{}", stderr(&output));
    assert!(resume(folder.path()).status.success());
    check(folder.path(), "hung up");
    let folder = TempDir::new().unwrap();
    let output = through(&["nohup"], folder.path());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

fn manifest(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&fs::read(folder.join("manifest.json")).unwrap()).unwrap()
}

#[test]
fn seconds_add_up_over_kills_and_repairs() {
    let folder = TempDir::new().unwrap();
    let endless = ["--set", "search.generations=100000"];
    let mut child = begin(folder.path(), &endless);
    let seconds = |folder: &Path| manifest(folder)["seconds"].as_f64().unwrap();
    // The manifest tells how long the run has been on while it is.
    let told = || fs::exists(folder.path().join("manifest.json")).unwrap() && seconds(folder.path()) > 1.0;
    while !told() {
        assert!(child.try_wait().unwrap().is_none());
        sleep(Duration::from_millis(10));
    }
    assert_eq!(manifest(folder.path())["status"], "running");
    child.kill().unwrap();
    child.wait().unwrap();
    let killed = manifest(folder.path());
    let generations = killed["counts"]["generations"].as_u64().unwrap() + 2;
    let limit = format!("search.generations={generations}");
    let more = ["--resume", "--set", &limit];
    assert!(command(folder.path(), &more).output().unwrap().status.success());
    let (resumed, last) = (manifest(folder.path()), seconds(folder.path()));
    assert!(last > killed["seconds"].as_f64().unwrap(), "{last}");
    assert_eq!(resumed["started"], killed["started"]);
    // Both checkpoints are lost: the run is done again, and that takes its time too.
    for name in ["checkpoint.json", "checkpoint.previous.json"] {
        fs::write(folder.path().join(name), "{").unwrap();
    }
    assert!(command(folder.path(), &more).output().unwrap().status.success());
    assert!(seconds(folder.path()) > last);
    assert_eq!(manifest(folder.path())["counts"], resumed["counts"]);
}
