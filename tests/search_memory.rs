//! Memory per evaluated design. A test file of its own, because it measures its whole process.

#[path = "search/support.rs"]
#[allow(dead_code, reason = "shared with tests/search")]
mod support;

use quadrille::search::params::TokenBounds;

use support::{Counting, run_silently, settings};

/// Resident memory of this process, bytes.
#[cfg(target_os = "linux")]
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("status");
    let line = status.lines().find(|line| line.starts_with("VmRSS")).expect("VmRSS");
    let kilobytes: f64 = line.split_whitespace().nth(1).and_then(|n| n.parse().ok()).expect("a number");
    kilobytes * 1024.0
}

#[test]
#[cfg(target_os = "linux")]
fn an_evaluated_design_takes_less_than_a_kilobyte() {
    let mut settings = settings(u32::MAX - 1);
    settings.search.population = 100;
    settings.search.tokens = TokenBounds { min: 4, max: 40 };
    settings.search.evaluations = Some(20_000);
    let before = resident();
    let problem = Counting { bounds: settings.search.tokens, metrics: 40, ..Counting::new() };
    let outcome = run_silently(&problem, &settings, 2);
    let each = (resident() - before) / outcome.evaluated.len() as f64;
    println!("{} designs, {each:.0} bytes each", outcome.evaluated.len());
    assert!(outcome.evaluated.len() >= 20_000 && each < 1000.0, "{each} bytes");
}
