//! How many topologies become patterns that can be built: strings of a file, or random ones with distinct codes, developed on the domain
//! of a config without its structure.
//!
//! ```text
//! cargo run --release --example pattern_study -- CONFIG.toml STRINGS.csv [folder]
//! cargo run --release --example pattern_study -- CONFIG.toml structured|aware [designs] [seed] [folder]
//! ```
//!
//! Configs: any; `three_holes.toml` and `l.toml` beside this file. What topology refuses is counted apart. The folder gets a table of
//! all designs (`designs.csv`), and pictures of the first and the worst ones. With `--set key=value` keys of the config are changed.
#![allow(clippy::print_stdout, reason = "a program")]

use quadrille::config::ResolvedConfig;
use quadrille::domain::Domain;
use quadrille::domain::params::Pinched;
use quadrille::geometry::metrics::{Fabrication, measure};
use quadrille::geometry::{Pattern, Shaped, check, develop, limits, shape, topological_rejection};
use quadrille::grammar::Tokens;
use quadrille::grammar::random::{self, Shares};
use quadrille::mesh::CanonicalMesh;
use quadrille::output::svg::{Plan, Shade, svg};
use quadrille::random::stream;
use quadrille::search::operators::Growth;
use quadrille::search::params::TokenBounds;
use quadrille::study::Study;
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

/// At most this many strings are tried for each design wanted.
const TRIES: usize = 200;
/// Pictures of the first designs, and of the worst.
const PICTURES: usize = 10;

/// One developed design.
struct Row {
    tokens: Tokens,
    /// Sum of the relative excesses, or more than a thousand for one without a pattern.
    excess: f64,
    /// Limits that are broken, or why there is no pattern.
    broken: String,
    figures: Option<Fabrication>,
    seconds: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let (args, changes) = arguments();
    let arg = |i: usize, default: &str| args.get(i).cloned().unwrap_or_else(|| default.to_owned());
    let (file, source) = (arg(0, "configs/great_court.toml"), arg(1, "structured"));
    let file = Path::new(&file);
    let resolved = ResolvedConfig::open(file, &changes)?;
    let config = resolved.config();
    let study = Study::of(&resolved)?;
    let is_file = source.ends_with(".csv");
    let folder = args.get(if is_file { 2 } else { 4 }).map(Path::new);
    let strings: Vec<Tokens> = if is_file {
        read_strings(Path::new(&source))?
    } else {
        random_strings(&study, &source, arg(2, "500").parse()?, arg(3, "1").parse()?)
    };

    let limits = limits::Limits::of(&config.pattern.limits, config.pattern.target_length(&study.domain));
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    let mut rows = Vec::new();
    for tokens in &strings {
        let mesh = study.topology(tokens);
        if let Some(rejection) =
            topological_rejection(&mesh, &study.domain, config.topology.pinched, Some(&limits))
        {
            let kind = rejection.to_string().split(':').next().unwrap_or_default().to_owned();
            *refused.entry(kind).or_default() += 1;
            if is_file {
                println!("  refused: {tokens} ({rejection})");
            }
            continue;
        }
        let start = Instant::now();
        let pattern = develop(&mesh, &study.domain, study.surface.as_ref(), &config.pattern);
        let seconds = start.elapsed().as_secs_f64();
        rows.push(judge(&study.domain, tokens, &mesh, pattern, &limits, seconds));
    }
    report(&file.file_stem().unwrap_or_default().to_string_lossy(), &refused, &rows, limits.target_length);
    if let Some(folder) = folder {
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join("designs.csv"), table(&rows))?;
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by(|&i, &j| rows[j].excess.total_cmp(&rows[i].excess));
        let first = (0..rows.len().min(PICTURES)).map(|i| (i, format!("first_{i}")));
        let worst = order.iter().take(PICTURES).enumerate().map(|(k, &i)| (i, format!("worst_{k}")));
        for (i, name) in first.chain(worst) {
            draw(&study, &config.pattern, &rows[i], folder, &name)?;
        }
    }
    Ok(())
}

/// Arguments, and the changes of `--set`.
fn arguments() -> (Vec<String>, Vec<String>) {
    let (mut args, mut changes) = (Vec::new(), Vec::new());
    let mut given = std::env::args().skip(1);
    while let Some(arg) = given.next() {
        match arg.as_str() {
            "--set" => changes.extend(given.next()),
            _ => args.push(arg),
        }
    }
    (args, changes)
}

fn read_strings(file: &Path) -> Result<Vec<Tokens>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(file)?;
    let mut strings = Vec::new();
    for record in reader.records() {
        strings.push(record?.get(0).unwrap_or_default().parse()?);
    }
    Ok(strings)
}

/// Strings with distinct codes, none of them flat or pinched.
fn random_strings(study: &Study, kind: &str, wanted: usize, seed: u64) -> Vec<Tokens> {
    let growth =
        Growth { initial: &study.start.part, rules: study.rules, bounds: TokenBounds { min: 10, max: 40 } };
    let mut codes = BTreeSet::new();
    let mut strings = Vec::new();
    for i in 0..TRIES * wanted {
        let mut rng = stream(seed, 0, i as u32);
        let tokens = match kind {
            "aware" => growth.random(&mut rng),
            _ => random::structured(&mut rng, 10..=40, &Shares::default()),
        };
        let mesh = study.topology(&tokens);
        let is_new = codes.insert(mesh.code);
        if is_new && topological_rejection(&mesh, &study.domain, Pinched::Reject, None).is_none() {
            strings.push(tokens);
            if strings.len() == wanted {
                break;
            }
        }
    }
    strings
}

fn judge(
    domain: &Domain,
    tokens: &Tokens,
    mesh: &CanonicalMesh,
    pattern: Result<Pattern, quadrille::geometry::Rejection>,
    limits: &limits::Limits,
    seconds: f64,
) -> Row {
    let tokens = tokens.clone();
    match pattern {
        Ok(pattern) => {
            let figures = measure(&pattern, mesh, domain);
            let rows = limits::excesses(&(&figures).into(), limits);
            let broken: Vec<_> = rows.into_iter().filter(|row| row.excess > 0.0).collect();
            Row {
                tokens,
                excess: broken.iter().map(|row| row.excess).sum(),
                broken: broken.iter().map(|row| row.name).collect::<Vec<_>>().join(" "),
                figures: Some(figures),
                seconds,
            }
        }
        Err(rejection) => Row {
            tokens,
            excess: 1e3 + rejection.measure(),
            broken: rejection.to_string(),
            figures: None,
            seconds,
        },
    }
}

fn report(name: &str, refused: &BTreeMap<String, usize>, rows: &[Row], t: f64) {
    let good: Vec<&Row> = rows.iter().filter(|row| row.excess == 0.0).collect();
    println!("{name}: t = {t:.4} m; refused by topology: {refused:?}");
    println!(
        "  {} developed, {} keep all limits ({:.1} %)",
        rows.len(),
        good.len(),
        100.0 * good.len() as f64 / rows.len().max(1) as f64
    );
    let mut broken: BTreeMap<&str, usize> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.excess > 0.0) {
        println!("  {}: {} ({:.3})", row.tokens, row.broken, row.excess);
        for kind in row.broken.split(' ').filter(|kind| row.figures.is_some() && !kind.is_empty()) {
            *broken.entry(kind).or_default() += 1;
        }
    }
    println!("  broken: {broken:?}");
    let quantiles = |value: &dyn Fn(&Row) -> f64| {
        let mut values: Vec<f64> = rows.iter().map(value).filter(|v| v.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let at = |q: usize| values.get((q * values.len() / 100).min(values.len().max(1) - 1)).copied();
        format!("{:.5} ({:.5} … {:.5})", at(50).unwrap_or(0.0), at(10).unwrap_or(0.0), at(90).unwrap_or(0.0))
    };
    let figure = |f: fn(&Fabrication) -> f64| move |row: &Row| row.figures.as_ref().map_or(f64::NAN, f);
    println!("  medians (10 % … 90 %):");
    println!("  skewness    {}", quantiles(&figure(|f| f.skewness)));
    println!("  edge spread {} m", quantiles(&figure(|f| f.edge_spread)));
    println!("  curvature   {}", quantiles(&figure(|f| f.curvature)));
    println!("  panels      {}", quantiles(&figure(|f| f.panels as f64)));
    println!("  milliseconds {}", quantiles(&|row| 1e3 * row.seconds));
    println!(
        "  mean {:.1} ms",
        1e3 * rows.iter().map(|row| row.seconds).sum::<f64>() / rows.len().max(1) as f64
    );
}

fn table(rows: &[Row]) -> String {
    let mut text = "string,excess,broken,curvature,skewness,edge_spread_m,panels,milliseconds\n".to_owned();
    for row in rows {
        let (c, s, l, n) = row.figures.as_ref().map_or((f64::NAN, f64::NAN, f64::NAN, 0), |f| {
            (f.curvature, f.skewness, f.edge_spread, f.panels)
        });
        let milliseconds = 1e3 * row.seconds;
        let _ =
            writeln!(text, "{},{},{},{c},{s},{l},{n},{milliseconds:.1}", row.tokens, row.excess, row.broken);
    }
    text
}

/// The plan, folded panels dark.
fn draw(
    study: &Study,
    params: &quadrille::geometry::PatternParams,
    row: &Row,
    folder: &Path,
    name: &str,
) -> Result<(), Box<dyn Error>> {
    let mesh = study.topology(&row.tokens);
    let Ok(Shaped { pattern, .. }) = shape(&mesh, &study.domain, study.surface.as_ref(), params) else {
        return Ok(());
    };
    let mut values = vec![0.0; pattern.panels.len()];
    for panel in check::folded_panels(&pattern, study.surface.as_ref()) {
        values[panel as usize] = 1.0;
    }
    let shade = Some(Shade { label: "folded", values: &values, darkest: 1.0 });
    let title = format!("{} {}", row.tokens, row.broken);
    std::fs::write(
        folder.join(format!("{name}.svg")),
        svg(&pattern, &title, &Plan { shade, ..Plan::default() }),
    )?;
    Ok(())
}
