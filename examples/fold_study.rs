//! How often patterns fold: random strings with distinct codes, developed on one of three domains (issue 5, point 3).
//!
//! ```text
//! cargo run --release --example fold_study -- great_court|three_holes|l structured|aware [designs] [seed] [folder for SVG of the worst]
//! ```
//!
//! Flat and pinched designs are set aside beforehand and their share is reported.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

use quadrille::domain::{Domain, DomainParams};
use quadrille::geometry::params::Pinched;
use quadrille::geometry::{
    PatternParams, Rejection, check, develop, limits, metrics, shape, topological_rejection,
};
use quadrille::grammar::{Decoded, Rules, Tokens, decode};
use quadrille::mesh::{BaseMesh, InitialMesh, isomorphism::canonical_mesh};
use quadrille::random::stream;
use quadrille::search::operators::Growth;
use quadrille::search::params::{Initialiser, TokenBounds};
use quadrille::surface::{Surface, SurfaceParams, build};
use std::collections::BTreeSet;
use std::error::Error;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

const GREAT_COURT: &str = r#"
[[loop]]
kind = "polyline"
points_m = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]]
[[loop]]
kind = "circle"
center_m = [0.0, 0.0]
radius_m = 22.245
"#;
const THREE_HOLES: &str = r#"
[[loop]]
kind = "polyline"
points_m = [[0.0, 0.0], [70.0, 0.0], [70.0, 30.0], [0.0, 30.0]]
[[loop]]
kind = "circle"
center_m = [15.0, 15.0]
radius_m = 5.0
[[loop]]
kind = "circle"
center_m = [35.0, 15.0]
radius_m = 5.0
[[loop]]
kind = "circle"
center_m = [55.0, 15.0]
radius_m = 5.0
"#;
const L: &str = r#"
[[loop]]
kind = "polyline"
points_m = [[0.0, 0.0], [40.0, 0.0], [40.0, 20.0], [20.0, 20.0], [20.0, 40.0], [0.0, 40.0]]
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let arg = |i: usize, default: &str| args.get(i).cloned().unwrap_or_else(|| default.to_owned());
    let name = arg(0, "great_court");
    let kind_name = arg(1, "structured");
    let kind = if kind_name == "aware" { Initialiser::Aware } else { Initialiser::Structured };
    let (wanted, seed): (usize, u64) = (arg(2, "500").parse()?, arg(3, "1").parse()?);
    let folder = args.get(4);
    let (initial, domain, surface) = site(&name)?;
    let params = PatternParams::default();
    let growth = Growth { initial: &initial, rules: Rules::Domain, bounds: TokenBounds { min: 10, max: 40 } };

    let mut codes = BTreeSet::new();
    let (mut flat, mut pinched, mut other, mut folded, mut slow) = (0, 0, 0, 0, 0.0f64);
    let (mut off_count, mut feasible, mut seconds) = (0usize, 0, 0.0);
    let mut kept = [0usize; 4];
    let mut worst: Vec<(usize, Tokens)> = Vec::new();
    let mut index = 0;
    let mut developed = 0;
    while developed < wanted && index < 200 * wanted as u32 {
        let mut rng = stream(seed, 0, index);
        index += 1;
        let tokens = growth.random(kind, &mut rng);
        let Decoded { mesh, .. } = decode(&initial, &tokens, Rules::Domain);
        let mesh = canonical_mesh(&mesh);
        if !codes.insert(mesh.code) {
            continue;
        }
        match topological_rejection(&mesh, &domain, Pinched::Reject) {
            Some(Rejection::Flat { .. }) => flat += 1,
            Some(Rejection::Pinched { .. }) => pinched += 1,
            Some(_) => other += 1,
            None => {
                developed += 1;
                let start = Instant::now();
                let result = develop(&mesh, &domain, surface.as_ref(), &params);
                let took = start.elapsed().as_secs_f64();
                seconds += took;
                slow = slow.max(took);
                match result {
                    Ok(pattern) => {
                        off_count += usize::from(
                            pattern.panels.len().abs_diff(params.panels) * 100 > 3 * params.panels,
                        );
                        let rows = limits::excesses(&pattern, &params.limits, 0.5);
                        feasible += usize::from(rows.iter().all(|row| row.excess == 0.0));
                        for (kept, row) in kept.iter_mut().zip(&rows) {
                            *kept += usize::from(row.excess == 0.0);
                        }
                        if let Some(folder) = folder.filter(|_| developed <= 10) {
                            let file = Path::new(folder).join(format!("{name}_{kind_name}_{developed}.svg"));
                            std::fs::write(file, svg(&pattern, &[]))?;
                        }
                        let _ = metrics::measure(&pattern, &mesh);
                    }
                    Err(rejection) => {
                        folded += 1;
                        println!("  {tokens}: {rejection}");
                        if let Rejection::Folds { folded, .. } = rejection {
                            worst.push((folded, tokens));
                        }
                    }
                }
            }
        }
    }
    let codes = codes.len();
    let share = |n: usize, of: usize| 100.0 * n as f64 / of.max(1) as f64;
    println!(
        "{name}, {kind_name}: {index} strings, {codes} distinct codes: {flat} flat ({:.1} %), {pinched} pinched ({:.1} %), {other} other",
        share(flat, codes),
        share(pinched, codes)
    );
    println!(
        "  {developed} developed: {folded} with folds, {:.1} % without; {:.1} ms each, slowest {:.1} ms",
        share(developed - folded, developed),
        1e3 * seconds / developed.max(1) as f64,
        1e3 * slow
    );
    println!(
        "  panels off by more than 3 %: {off_count}; limits kept by {feasible} ({:.1} %): edges not too short {}, not too long {}, angles {}, valence {}",
        share(feasible, developed),
        kept[0],
        kept[1],
        kept[2],
        kept[3]
    );
    worst.sort_by_key(|(folds, _)| std::cmp::Reverse(*folds));
    if let Some(folder) = folder {
        for (i, (_, tokens)) in worst.iter().take(9).enumerate() {
            let Decoded { mesh, .. } = decode(&initial, tokens, Rules::Domain);
            if let Ok(pattern) = shape(&canonical_mesh(&mesh), &domain, surface.as_ref(), &params) {
                let folds = check::folded_panels(&pattern, surface.as_ref());
                std::fs::write(
                    Path::new(folder).join(format!("{name}_{kind_name}_worst_{i}.svg")),
                    svg(&pattern, &folds),
                )?;
            }
        }
    }
    Ok(())
}

/// Where strings are developed.
type Site = (InitialMesh, Domain, Arc<dyn Surface>);

fn site(name: &str) -> Result<Site, Box<dyn Error>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (domain, surface, base) = match name {
        "great_court" => {
            let file = here.join("tests/data/grammar/bases/great_court.json");
            (
                GREAT_COURT,
                SurfaceParams::GreatCourt {},
                quadrille::mesh::base_json::read(&std::fs::read_to_string(file)?)?,
            )
        }
        "three_holes" => (
            THREE_HOLES,
            SurfaceParams::Plane { z_m: 0.0 },
            cells(7, 3, 10.0, |i, j| j == 1 && i % 2 == 1, &[[0, 0], [7, 0], [7, 3], [0, 3]]),
        ),
        "l" => (
            L,
            SurfaceParams::Plane { z_m: 0.0 },
            cells(4, 4, 10.0, |i, j| i > 1 && j > 1, &[[0, 0], [4, 0], [4, 2], [2, 2], [2, 4], [0, 4]]),
        ),
        _ => return Err(format!("no domain {name}: great_court, three_holes or l").into()),
    };
    let surface = build(&surface, here)?;
    let params: DomainParams = toml::from_str(domain)?;
    Ok((InitialMesh::from_base(&base)?, Domain::resolve(&params, &surface, here)?, surface))
}

/// A grid of square cells without some of them.
fn cells(m: u32, n: u32, size: f64, missing: impl Fn(u32, u32) -> bool, corners: &[[u32; 2]]) -> BaseMesh {
    let mut number = std::collections::BTreeMap::new();
    let mut base = BaseMesh::default();
    for j in 0..n {
        for i in 0..m {
            if missing(i, j) {
                continue;
            }
            let face = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|at| {
                *number.entry(at).or_insert_with(|| {
                    base.vertices.push([size * f64::from(at[0]), size * f64::from(at[1]), 0.0]);
                    base.vertices.len() as u32 - 1
                })
            });
            base.faces.push(face.to_vec());
        }
    }
    base.corners = corners.iter().map(|at| vec![number[at]]).collect();
    base
}

/// A plan picture with the coarse vertices and the folded panels marked.
fn svg(pattern: &quadrille::geometry::Pattern, folds: &[u32]) -> String {
    let at = |v: u32| pattern.positions[v as usize];
    let bound = |k: usize, pick: fn(f64, f64) -> f64, start: f64| {
        pattern.positions.iter().map(|p| p[k]).fold(start, pick)
    };
    let (x0, x1) = (bound(0, f64::min, f64::MAX) - 1.0, bound(0, f64::max, f64::MIN) + 1.0);
    let (y0, y1) = (bound(1, f64::min, f64::MAX) - 1.0, bound(1, f64::max, f64::MIN) + 1.0);
    let (width, height) = (x1 - x0, y1 - y0);
    let mut text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='700' height='{:.0}' viewBox='{x0} {} {width} {height}'><rect x='{x0}' y='{}' width='{width}' height='{height}' fill='white'/>\n",
        700.0 * height / width,
        -y1,
        -y1
    );
    for &p in folds {
        let points: Vec<String> = pattern.panels[p as usize]
            .corners()
            .iter()
            .map(|&v| format!("{},{}", at(v)[0], -at(v)[1]))
            .collect();
        text += &format!("<polygon points='{}' fill='red'/>\n", points.join(" "));
    }
    let stroke = 0.0008 * width;
    for &[u, v] in &pattern.edges {
        text += &format!(
            "<line x1='{:.3}' y1='{:.3}' x2='{:.3}' y2='{:.3}' stroke='black' stroke-width='{stroke:.4}'/>\n",
            at(u)[0],
            -at(u)[1],
            at(v)[0],
            -at(v)[1]
        );
    }
    for &v in &pattern.coarse {
        text += &format!(
            "<circle cx='{:.3}' cy='{:.3}' r='{:.3}' fill='magenta'/>\n",
            at(v)[0],
            -at(v)[1],
            5.0 * stroke
        );
    }
    text + "</svg>\n"
}
