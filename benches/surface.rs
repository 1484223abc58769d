//! Bringing points back onto surfaces: the inner loop of relaxing (issue 5: 22,000 vertices, 100 sweeps in 0.5 s in all;
//! 22,000 points on a mesh of 50,000 triangles in 0.1 s).
#![allow(missing_docs, clippy::unwrap_used, reason = "criterion's macros; fixed inputs")]

use criterion::{Criterion, criterion_group, criterion_main};
use quadrille::io::Inputs;
use quadrille::random;
use quadrille::surface::{self, GreatCourt, HeightFunction as _, MeshSurface, Surface, SurfaceParams};
use std::hint::black_box;

const POINTS: usize = 22_000;

/// Points between the walls and the circle, off the roof by up to a metre.
fn points() -> Vec<[f64; 3]> {
    let mut rng = random::stream(1, 0, 0);
    let mut points = Vec::with_capacity(POINTS);
    while points.len() < POINTS {
        let [u, v, w] = std::array::from_fn(|_| random::unit(&mut rng));
        let (x, y) = (-36.625 + 73.25 * u, -51.125 + 97.15 * v);
        if x * x + y * y > 22.245 * 22.245 {
            points.push([x, y, GreatCourt.z(x, y) + w - 0.5]);
        }
    }
    points
}

/// 160 × 160 squares in 51,200 triangles over the whole rectangle.
fn triangles() -> MeshSurface {
    const N: u32 = 160;
    let at = |i: u32, n: f64, low: f64| low + n * f64::from(i) / f64::from(N);
    let vertices: Vec<_> = (0..=N)
        .flat_map(|j| (0..=N).map(move |i| (i, j)))
        .map(|(i, j)| {
            let (x, y) = (at(i, 73.25, -36.625), at(j, 97.15, -51.125));
            [x, y, GreatCourt.z(x, y)]
        })
        .collect();
    let faces: Vec<_> = (0..N)
        .flat_map(|j| (0..N).map(move |i| j * (N + 1) + i))
        .flat_map(|a| [vec![a, a + 1, a + N + 2], vec![a, a + N + 2, a + N + 1]])
        .collect();
    MeshSurface::new(&vertices, &faces).unwrap()
}

fn project(c: &mut Criterion) {
    let points = points();
    let surface = |text: &str| {
        let params: SurfaceParams = toml::from_str(text).unwrap();
        surface::build(&params, &Inputs::default()).unwrap()
    };
    let mesh = triangles();
    let roof = surface("kind = 'great-court'");
    let dome =
        surface("kind = 'height'\nexpression = 'h - x^2/a - y^2/a'\nconstants = { h = 10.0, a = 40.0 }");
    let mut group = c.benchmark_group("project_22000");
    group.sample_size(20);
    let all: [(&str, &dyn Surface); 3] =
        [("great_court", &*roof), ("expression", &*dome), ("mesh_51200_triangles", &mesh)];
    for (name, surface) in all {
        group.bench_function(name, |b| {
            b.iter(|| {
                let mut moved = points.clone();
                surface.project_all(black_box(&mut moved));
                moved
            });
        });
    }
    group.bench_function("great_court_normals", |b| {
        b.iter(|| points.iter().map(|&p| roof.normal(black_box(p))[2]).sum::<f64>());
    });
    group.finish();
}

criterion_group!(benches, project);
criterion_main!(benches);
