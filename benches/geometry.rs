//! From the Great Court's initial mesh to patterns (issue 5: at 22,000 vertices densifying and placing ≤ 0.3 s, 100 sweeps with
//! area weights on the roof ≤ 0.5 s), and the whole chain as the search runs it, at 2,000 panels.
#![allow(missing_docs, clippy::unwrap_used, reason = "criterion's macros; fixed inputs")]

#[path = "../tests/geometry_support/mod.rs"]
mod geometry_support;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use geometry_support::great_court;
use quadrille::geometry::coarse::Coarse;
use quadrille::geometry::dense::{Dense, Edges, densify};
use quadrille::geometry::params::RelaxParams;
use quadrille::geometry::place::{self, Folds, Placed};
use quadrille::geometry::{PatternParams, boundary, corners, density, develop, relax};
use quadrille::mesh::isomorphism::canonical_mesh;
use quadrille::study::Study;

/// Panels of the strips of a coarse design: about 22,000 vertices.
const PANELS: usize = 22_000;

/// Densified and placed, as a step of developing.
fn placed(
    study: &Study,
    coarse: &Coarse<'_>,
    parts: &[u32],
) -> (Dense, Edges, Vec<boundary::BoundaryLoop>, Placed) {
    let dense = densify(coarse, parts);
    let edges = Edges::of(dense.vertex_count, &dense.panels);
    let corners = corners::assign(coarse, &study.domain);
    let loops = boundary::anchor(coarse, &dense, &study.domain, &corners).unwrap();
    let placed =
        place::place(&study.domain, study.surface.as_ref(), &dense, &edges, &loops, Folds::Leave).unwrap();
    (dense, edges, loops, placed)
}

fn geometry(criterion: &mut Criterion) {
    let study = great_court();
    let mesh = canonical_mesh(&study.initial.mesh);
    let coarse = Coarse::of(&mesh);
    let fine = PatternParams { panels: PANELS, max_faces: 2 * PANELS, ..PatternParams::default() };
    let (probe, _, _, at) = placed(&study, &coarse, &vec![density::PROBE_PARTS; mesh.strips.len()]);
    let lengths = density::strip_lengths(&coarse, &probe, &at.positions);
    let parts = density::choose(&coarse, &lengths, &fine).unwrap().parts;

    let mut group = criterion.benchmark_group("geometry");
    group.sample_size(10);
    group.bench_function("densify_and_place_22000", |b| b.iter(|| placed(&study, &coarse, &parts).3));

    let (dense, edges, loops, start) = placed(&study, &coarse, &parts);
    let sweeps = relax::Mesh::new(dense.vertex_count, &dense.panels, &edges.list, &loops);
    let start = || Placed { positions: start.positions.clone(), along: start.along.clone() };
    group.bench_function("relax_22000_area_100", |b| {
        b.iter_batched(
            start,
            |mut placed| {
                let params = RelaxParams::default();
                relax::relax(&mut placed, &sweeps, &study.domain, study.surface.as_ref(), &params);
                placed
            },
            BatchSize::LargeInput,
        );
    });
    let params = PatternParams::default();
    group.bench_function("develop_2000", |b| {
        b.iter(|| develop(&mesh, &study.domain, study.surface.as_ref(), &params));
    });
    group.finish();
}

criterion_group!(benches, geometry);
criterion_main!(benches);
