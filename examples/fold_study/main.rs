//! How often patterns fold: random strings with distinct codes, developed on the domain of a config.
//!
//! ```text
//! cargo run --release --example fold_study -- CONFIG.toml structured|aware [designs] [seed] [folder for pictures]
//! ```
//!
//! Configs: `configs/great_court.toml`, and `three_holes.toml` and `l.toml` beside this file. Flat and pinched designs are set
//! aside beforehand and their share is reported. Pictures are of the first ten designs and of those with most folds, or, if
//! there are none, with the least angles.
#![allow(clippy::print_stdout, reason = "a program")]

use quadrille::config;
use quadrille::geometry::params::Pinched;
use quadrille::geometry::{Pattern, Rejection, check, develop, limits, shape, topological_rejection};
use quadrille::grammar::Tokens;
use quadrille::output::svg::{Shade, svg};
use quadrille::random::stream;
use quadrille::search::operators::Growth;
use quadrille::search::params::{Initialiser, TokenBounds};
use quadrille::study::Study;
use std::collections::BTreeSet;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

/// At most this many strings are tried for each design wanted.
const TRIES: usize = 200;
/// Pictures of the first designs, and of the worst.
const PICTURES: usize = 10;
/// So many of the slowest designs and of those with the shortest members are named.
const NAMED: usize = 5;

#[derive(Default)]
struct Count {
    flat: usize,
    pinched: usize,
    other: usize,
    developed: usize,
    folded: usize,
    /// More than 3 % from the number of panels asked for.
    off: usize,
    feasible: usize,
    seconds: f64,
    /// Seconds and string of each, the slowest first once sorted.
    times: Vec<(f64, Tokens)>,
    /// Shortest member over the target length, of each without folds.
    shortest: Vec<(f64, Tokens)>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let arg = |i: usize, default: &str| args.get(i).cloned().unwrap_or_else(|| default.to_owned());
    let file = arg(0, "configs/great_court.toml");
    let (file, kind) = (Path::new(&file), arg(1, "structured"));
    let (wanted, seed): (usize, u64) = (arg(2, "500").parse()?, arg(3, "1").parse()?);
    let folder = args.get(4).map(Path::new);
    let config = config::load(file, &[])?;
    let study = Study::new(&config, config::folder_of(file))?;
    let bounds = TokenBounds { min: 10, max: 40 };
    let kept = limits::Limits::of(&config.pattern.limits, config.pattern.target_length(&study.domain));
    let growth = Growth { initial: &study.initial, rules: study.rules, bounds };
    let initialiser = if kind == "aware" { Initialiser::Aware } else { Initialiser::Structured };
    let name = format!("{}_{kind}", file.file_stem().unwrap_or_default().to_string_lossy());

    let mut codes = BTreeSet::new();
    let mut count = Count::default();
    // Folds or, without any, how far the least angle is below its limit; the worst come first.
    let mut worst: Vec<(f64, Tokens)> = Vec::new();
    let mut strings = 0;
    while count.developed < wanted && strings < TRIES * wanted {
        let tokens = growth.random(initialiser, &mut stream(seed, 0, strings as u32));
        strings += 1;
        let mesh = study.topology(&tokens);
        if !codes.insert(mesh.code) {
            continue;
        }
        match topological_rejection(&mesh, &study.domain, Pinched::Reject, None) {
            Some(Rejection::Flat { .. }) => count.flat += 1,
            Some(Rejection::Pinched { .. }) => count.pinched += 1,
            Some(_) => count.other += 1,
            None => {
                let start = Instant::now();
                let developed = develop(&mesh, &study.domain, study.surface.as_ref(), &config.pattern);
                let took = start.elapsed().as_secs_f64();
                count.developed += 1;
                count.seconds += took;
                count.times.push((took, tokens.clone()));
                match developed {
                    Ok(pattern) => {
                        let panels = config.pattern.panels;
                        if pattern.panels.len().abs_diff(panels) * 100 > 3 * panels {
                            println!("  {tokens}: {} panels", pattern.panels.len());
                            count.off += 1;
                        }
                        let rows = limits::excesses(&limits::Extremes::of(&pattern, &study.domain), &kept);
                        let edge = rows.iter().find(|row| row.name == "min_edge_m");
                        count
                            .shortest
                            .extend(edge.map(|row| (row.value / pattern.target_length, tokens.clone())));
                        count.feasible += usize::from(rows.iter().all(|row| row.excess == 0.0));
                        let angle = rows.iter().find(|row| row.name == "min_angle_deg");
                        worst.push((angle.map_or(0.0, |row| row.excess), tokens));
                        if count.developed <= PICTURES {
                            draw(&study, &pattern, folder, &format!("{name}_{}", count.developed))?;
                        }
                    }
                    Err(rejection) => {
                        println!("  {tokens}: {rejection}");
                        if let (true, Ok(pattern)) = (
                            count.developed <= PICTURES,
                            shape(&mesh, &study.domain, study.surface.as_ref(), &config.pattern),
                        ) {
                            draw(&study, &pattern, folder, &format!("{name}_{}", count.developed))?;
                        }
                        count.folded += 1;
                        worst.push((1.0 + rejection.measure(), tokens));
                    }
                }
            }
        }
    }
    count.times.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    count.shortest.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    report(&name, strings, codes.len(), &count);
    worst.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    for (i, (badness, tokens)) in worst.iter().take(PICTURES).enumerate() {
        if let Ok(pattern) =
            shape(&study.topology(tokens), &study.domain, study.surface.as_ref(), &config.pattern)
        {
            draw(&study, &pattern, folder, &format!("{name}_worst_{i}"))?;
        }
        if i == 0 {
            println!("  worst: {tokens} ({badness:.3})");
        }
    }
    Ok(())
}

fn report(name: &str, strings: usize, codes: usize, count: &Count) {
    let share = |n: usize, of: usize| 100.0 * n as f64 / of.max(1) as f64;
    println!(
        "{name}: {strings} strings, {codes} distinct codes: {} flat ({:.1} %), {} pinched ({:.1} %), {} other",
        count.flat,
        share(count.flat, codes),
        count.pinched,
        share(count.pinched, codes),
        count.other
    );
    println!(
        "  {} developed: {} with folds, {:.1} % without; {:.1} ms each",
        count.developed,
        count.folded,
        share(count.developed - count.folded, count.developed),
        1e3 * count.seconds / count.developed.max(1) as f64
    );
    for (seconds, tokens) in count.times.iter().take(NAMED) {
        println!("  slow: {:.0} ms {tokens}", 1e3 * seconds);
    }
    let quantile =
        |q: usize| count.shortest.get(q * count.shortest.len() / 100).map_or(f64::NAN, |(length, _)| *length);
    println!(
        "  shortest member ÷ target length: least {:.2e}, of 10 % of designs below {:.3}, half {:.3}, 90 % {:.3}",
        quantile(0),
        quantile(10),
        quantile(50),
        quantile(90)
    );
    for (length, tokens) in count.shortest.iter().take(NAMED) {
        println!("  short: {length:.1e} {tokens}");
    }
    println!(
        "  panels off by more than 3 %: {}; all limits kept by {} ({:.1} %)",
        count.off,
        count.feasible,
        share(count.feasible, count.developed)
    );
}

/// The plan, folded panels dark.
fn draw(study: &Study, pattern: &Pattern, folder: Option<&Path>, name: &str) -> Result<(), Box<dyn Error>> {
    let Some(folder) = folder else { return Ok(()) };
    let mut values = vec![0.0; pattern.panels.len()];
    for panel in check::folded_panels(pattern, study.surface.as_ref()) {
        values[panel as usize] = 1.0;
    }
    let shade = Shade { label: "folded", values: &values, darkest: 1.0 };
    std::fs::write(folder.join(format!("{name}.svg")), svg(pattern, name, Some(&shade)))?;
    Ok(())
}
