//! From coarse designs of the Great Court to patterns: at 22,000 vertices densifying and placing, and 100 sweeps with area weights on the
//! roof; the whole chain as the search runs it at 2,000 panels, optimised and with the paper's smoothing (issue 14: 20 random designs
//! optimised cost no more than smoothed).
#![allow(missing_docs, clippy::unwrap_used, reason = "criterion's macros; fixed inputs")]

#[path = "../tests/geometry/support.rs"]
mod geometry_support;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use geometry_support::great_court;
use quadrille::geometry::coarse::Coarse;
use quadrille::geometry::dense::{Dense, Edges, densify};
use quadrille::geometry::params::{RelaxKind, RelaxParams};
use quadrille::geometry::place::{self, Folds, Placed};
use quadrille::geometry::{PatternParams, boundary, corners, develop, relax};
use quadrille::mesh::isomorphism::canonical_mesh;
use quadrille::study::Study;

/// Rows of each strip of the initial mesh: about 22,000 vertices.
const ROWS: u32 = 43;

/// Random `aware` strings.
const STRINGS: [&str; 20] = [
    "PDTTTATTTTAo",
    "ATPPTAPTTPAoTTTPTPPTPTAPT",
    "TPA*PPPTTPTTTPTA",
    "DTPPTPPPAoTPPPPTTPTTPTPTTTTPTTTTPTPPPTA",
    "TTA*TPTAPPTPDPPTPPDTTAPTTA",
    "APPPPPPTPPTTPTTTA",
    "TTPTA*PTPPTPPPPTTTTAo",
    "TTPAoPTTTPPPTPPTPPTTPTTPPPPTA",
    "TPTTPTAPPTTPTTPATAPTPTPAT",
    "PPATTTPATPTPPAoTPPPPPPTTTTPPTTTTTPPA",
    "ATTPTTPTTTTPPPA",
    "TATPTPTAAPPTTPTA*",
    "PPPAoPTPTTTTPPPTTTTTPTTTPTTPTAo",
    "AoTPPPPPPTPTPPTTPPPTPTPPTPTPTAPTTTPDPTT",
    "PDPTDTTPAoTPTTPTTPTTTPTTAPTPPAoPPTTTTAP",
    "PDPDAPPTTPPPA",
    "PA*PTTPPTA",
    "TPTATPPTPPPTPA",
    "PTPTTPAoPTTTPPTPPTTPAo",
    "PPPTTTDPTDT",
];

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
    let parts = vec![ROWS; mesh.strips.len()];

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
                let params = RelaxParams { kind: RelaxKind::Area, ..RelaxParams::default() };
                relax::relax(&mut placed, &sweeps, &study.domain, study.surface.as_ref(), &params);
                placed
            },
            BatchSize::LargeInput,
        );
    });
    let meshes: Vec<_> = STRINGS.iter().map(|string| study.topology(&string.parse().unwrap())).collect();
    for (name, kind) in [("optimised", RelaxKind::Optimise), ("smoothed", RelaxKind::Area)] {
        let relax = RelaxParams { kind, ..RelaxParams::default() };
        let params = PatternParams { relax, ..PatternParams::default() };
        group.bench_function(format!("develop_20_designs_{name}"), |b| {
            b.iter(|| {
                let developed = |mesh| develop(mesh, &study.domain, study.surface.as_ref(), &params).is_ok();
                meshes.iter().filter(|mesh| developed(mesh)).count()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, geometry);
criterion_main!(benches);
