//! A made-up run of realistic size, to look at and to measure the page: grids, O-grids and polar patterns on a paraboloid.
//! Its numbers mean nothing; its shapes, counts and oddities (missing values, awkward characters) are those of a real one.

use quadrille::output::report::{
    Design, Generation, Mark, Mesh, Metric, Obstacle, ReportData, Run, Sample, Singular, Singularities,
    Spread,
};
use quadrille::random::{Rng, stream, unit};
use std::collections::{BTreeMap, BTreeSet};

const RADIUS_M: f64 = 20.0;

/// A run whose front has `designs` designs of about `panels` panels each.
pub fn run(designs: usize, panels: usize) -> ReportData {
    let mut rng = stream(7, 0, 0);
    let front: Vec<Design> = (0..designs).map(|i| design(i, panels, &mut rng)).collect();
    let sample = |label: &str, count: usize, factor: f64, rng: &mut Rng| Sample {
        label: label.to_owned(),
        rows: (0..count)
            .map(|_| objectives(rng).iter().map(|v| Some(v * (factor + 0.2 * unit(rng)))).collect())
            .collect(),
    };
    ReportData {
        run: Run {
            name: "synthetic <court> & \"dome\"".to_owned(),
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            seed: u64::MAX.to_string(),
            evaluations: 1_248,
            feasible: 702,
            duplicates_refused: 311,
        },
        metrics: metrics(),
        objectives: (0..6).collect(),
        baseline: Some(baseline(panels, &mut rng)),
        obstacles: [("min_edge_m", 412), ("refused by topology", 97), ("max_valence", 37), ("folds", 3)]
            .map(|(name, designs)| Obstacle { name: name.to_owned(), designs })
            .to_vec(),
        misses: Vec::new(),
        front,
        generations: (0..26).map(generation).collect(),
        spread: Spread {
            first: sample("generation 0", 22, 1.25, &mut rng),
            last: sample("generation 25", 41, 0.95, &mut rng),
        },
        config_toml: "version = 1\n\n[run]\nname = \"</script><script>alert(1)</script>\"\n".repeat(12),
        design_files: [".obj", ".json", ".svg", ".vtu", "_nodes.csv", "_members.csv"]
            .map(str::to_owned)
            .to_vec(),
    }
}

/// A run in which nothing was feasible, with so many nearest misses.
#[allow(dead_code, reason = "not every test that uses this file needs it")]
pub fn without_front(misses: usize, panels: usize) -> ReportData {
    let mut data = run(misses, panels);
    data.misses = std::mem::take(&mut data.front);
    for (place, miss) in data.misses.iter_mut().enumerate() {
        miss.feasible = false;
        miss.reason =
            Some(format!("min_edge_m 0.{} (limit 0.5); deflection 0.2{place} (limit 0.14)", 48 - place));
    }
    data.run.feasible = 0;
    data.spread = Spread::default();
    for generation in &mut data.generations {
        (generation.feasible, generation.front, generation.hypervolume) = (0, 0, None);
    }
    data
}

fn metrics() -> Vec<Metric> {
    let metric = |label: &str, column: &str, unit: &str, meaning: &str| Metric {
        label: label.to_owned(),
        column: column.to_owned(),
        unit: unit.to_owned(),
        meaning: meaning.to_owned(),
        maximised: false,
    };
    vec![
        metric(
            "Deflection",
            "deflection_m",
            "m",
            "Largest displacement of a node, serviceability limit state",
        ),
        metric("Utilisation", "utilisation", "", "Largest stress ÷ allowed stress, ultimate limit state"),
        metric("Buckling", "buckling", "", "1 ÷ first load factor, ultimate limit state"),
        metric("Curvature", "curvature", "", "Mean distance of panel corners from their plane ÷ panel size"),
        metric("Skewness", "skewness", "", "Mean deviation of panel corners from 90° ÷ 90°"),
        metric("Edge spread", "edge_spread_m", "m", "Standard deviation of member lengths"),
        metric("Mass", "mass_kg", "kg", "Steel of all members"),
        metric("Panels", "faces", "", "Number of panels"),
    ]
}

fn baseline(panels: usize, rng: &mut Rng) -> Design {
    let mut baseline = design(0, panels, rng);
    baseline.id = "qba5e11ee0000".to_owned();
    baseline.string.clear();
    baseline.expressed.clear();
    baseline.generation = 0;
    baseline.feasible = false;
    baseline.reason = Some("deflection 0.1612 m > 0.14 m".to_owned());
    baseline.values[2] = None;
    baseline
}

fn generation(g: u32) -> Generation {
    let growth = 1.0 - (-f64::from(g) / 8.0).exp();
    let evaluations = 48 * (u64::from(g) + 1);
    Generation {
        generation: g,
        evaluations,
        feasible: (evaluations as f64 * (0.35 + 0.25 * growth)) as u64,
        front: 9 + (190.0 * growth) as u64,
        hypervolume: (g > 0).then_some(0.31 + 0.22 * growth),
        duplicates_refused: 4 + u64::from(g * 7 % 19),
    }
}

/// Six numbers of which one cannot have all small.
fn objectives(rng: &mut Rng) -> [f64; 6] {
    let raw: Vec<f64> = (0..3).map(|_| 0.15 + unit(rng)).collect();
    let length = raw.iter().map(|v| v * v).sum::<f64>().sqrt();
    let [a, b, c] = [raw[0] / length, raw[1] / length, raw[2] / length];
    let noise = |rng: &mut Rng| 0.92 + 0.16 * unit(rng);
    [
        0.05 + 0.09 * a * noise(rng),
        0.4 + 0.6 * a * noise(rng),
        0.03 + 0.12 * b * noise(rng),
        0.002 + 0.011 * c * noise(rng),
        0.08 + 0.3 * (1.0 - c) * noise(rng),
        0.1 + 0.5 * b * noise(rng),
    ]
}

fn design(i: usize, panels: usize, rng: &mut Rng) -> Design {
    let kind = i % 3;
    let mesh = match kind {
        0 => grid(panels, unit(rng)),
        1 => o_grid(panels, 0.3 + 0.4 * unit(rng)),
        _ => polar(panels),
    };
    let mut values: Vec<Option<f64>> = objectives(rng).map(Some).to_vec();
    values.extend([Some(2.0e5 + 1.0e5 * unit(rng)), Some(mesh.panels.len() as f64)]);
    let inner = match kind {
        0 => BTreeMap::new(),
        1 => BTreeMap::from([(3, 4)]),
        _ => BTreeMap::from([(12 + (i % 4), 1)]),
    };
    let string = ["ATTPA", "A*TPTPPA", "AoTTTAoPD", "ATPTTAPPDTATPTA"][i % 4].repeat(1 + i % 3);
    Design {
        id: format!("q{:012x}", 0x5eed_0000_0000_u64 + (i as u64).wrapping_mul(0x9e37_79b9) % 0xffff_ffff),
        expressed: string[..string.len().min(12)].to_owned(),
        string,
        generation: i as u32 % 26,
        feasible: true,
        reason: None,
        values,
        singularities: Some(Singularities {
            inner,
            boundary: BTreeMap::from([(2, 4)]),
            poles: usize::from(kind == 2),
        }),
        symmetry: ["mirror-x", "", "mirror-x mirror-y rotate-2"][kind].to_owned(),
        equal: 1 + kind as u64,
        preferred: None,
        family: None,
        mesh: Some(mesh),
    }
}

/// A square grid, its lines bent by `bend`.
fn grid(panels: usize, bend: f64) -> Mesh {
    let n = (panels as f64).sqrt().round() as u32;
    let line = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    let plan = |i: u32, j: u32| {
        let (u, v) = (line(i), line(j));
        [u + 0.25 * bend * (1.0 - u * u) * v * v, v + 0.2 * bend * (1.0 - v * v) * u]
    };
    let mut builder = Builder::default();
    patch(&mut builder, n, n, plan);
    builder.finish(&[])
}

/// A square in a disc and four patches around it: four vertices of valence 3.
fn o_grid(panels: usize, half: f64) -> Mesh {
    let n = ((panels as f64) / 5.0).sqrt().round() as u32;
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    let mut builder = Builder::default();
    patch(&mut builder, n, n, |i, j| [half * at(i), half * at(j)]);
    for quarter in 0..4 {
        patch(&mut builder, n, n, |i, j| {
            let angle = std::f64::consts::FRAC_PI_4 * at(i);
            let (inner, outer) = ([half, half * at(i)], [1.4 * angle.cos(), 1.4 * angle.sin()]);
            let t = f64::from(j) / f64::from(n);
            let [x, y] = [inner[0] + t * (outer[0] - inner[0]), inner[1] + t * (outer[1] - inner[1])];
            // Clockwise from inside out, so swap the patch's directions by mirroring.
            [[x, -y], [y, x], [-x, y], [-y, -x]][quarter]
        });
    }
    builder.finish(&[[half, half], [-half, half], [half, -half], [-half, -half]])
}

/// Rings and spokes about a pole.
fn polar(panels: usize) -> Mesh {
    let rings = ((panels as f64) / 2.5).sqrt().round() as u32;
    let spokes = (panels as f64 / f64::from(rings)).round() as u32;
    let mut builder = Builder::default();
    let at = |r: u32, s: u32| {
        let angle = std::f64::consts::TAU * f64::from(s % spokes) / f64::from(spokes);
        let radius = 1.3 * f64::from(r) / f64::from(rings);
        [radius * angle.cos(), radius * angle.sin()]
    };
    for r in 0..rings {
        for s in 0..spokes {
            match r {
                0 => builder.panel(&[at(0, 0), at(1, s), at(1, s + 1)]),
                _ => builder.panel(&[at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1)]),
            }
        }
    }
    builder.finish(&[[0.0, 0.0]])
}

fn patch(builder: &mut Builder, m: u32, n: u32, at: impl Fn(u32, u32) -> [f64; 2]) {
    for j in 0..n {
        for i in 0..m {
            builder.panel(&[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
}

/// Joins panels at equal plan positions and lifts them onto a paraboloid.
#[derive(Default)]
struct Builder {
    mesh: Mesh,
    vertex: BTreeMap<[i64; 2], u32>,
}

fn key(plan: [f64; 2]) -> [i64; 2] {
    plan.map(|c| (c * 1e7).round() as i64)
}

impl Builder {
    fn panel(&mut self, corners: &[[f64; 2]]) {
        let panel = corners.iter().map(|&c| self.at(c)).collect();
        self.mesh.panels.push(panel);
    }

    fn at(&mut self, plan: [f64; 2]) -> u32 {
        let positions = &mut self.mesh.positions;
        *self.vertex.entry(key(plan)).or_insert_with(|| {
            let height = 7.0 * (1.0 - (plan[0] * plan[0] + plan[1] * plan[1]) / 2.0);
            positions.push([RADIUS_M * plan[0], RADIUS_M * plan[1], height]);
            positions.len() as u32 - 1
        })
    }

    fn finish(mut self, singular: &[[f64; 2]]) -> Mesh {
        let mesh = &mut self.mesh;
        let edges: BTreeSet<[u32; 2]> = mesh
            .panels
            .iter()
            .flat_map(|p| (0..p.len()).map(|i| [p[i], p[(i + 1) % p.len()]]))
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        mesh.edges = edges.into_iter().collect();
        mesh.singular = singular
            .iter()
            .map(|&p| self.vertex[&key(p)])
            .map(|vertex| Singular {
                vertex,
                mark: [Mark::Pole, Mark::Fewer][usize::from(singular.len() > 1)],
            })
            .collect();
        let height = |v: u32| mesh.positions[v as usize][2];
        let far = |v: u32| mesh.positions[v as usize][0].hypot(mesh.positions[v as usize][1]) / RADIUS_M;
        let quads = |value: &dyn Fn(&[u32]) -> f64| -> Vec<Option<f64>> {
            mesh.panels.iter().map(|p| (p.len() == 4).then(|| value(p))).collect()
        };
        let curvature = quads(&|p| (height(p[0]) - height(p[1]) + height(p[2]) - height(p[3])).abs() / 2.0);
        let skewness = quads(&|p| 0.1 + 0.3 * far(p[0]).powi(2));
        let utilisation =
            mesh.edges.iter().map(|&[a, b]| Some(0.15 + 0.5 * far(a) * far(b).powi(3))).collect();
        (self.mesh.curvature, self.mesh.skewness, self.mesh.utilisation) = (curvature, skewness, utilisation);
        self.mesh
    }
}
