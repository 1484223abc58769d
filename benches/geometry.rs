//! Developing the Great Court's initial design: the whole chain at 2,000 and 22,000 panels, and relaxing alone.

use criterion::{Criterion, criterion_group, criterion_main};
use quadrille::domain::{Domain, DomainParams};
use quadrille::geometry::params::RelaxParams;
use quadrille::geometry::{PatternParams, develop};
use quadrille::mesh::isomorphism::canonical_mesh;
use quadrille::mesh::{InitialMesh, base_json};
use quadrille::surface::{SurfaceParams, build};
use std::path::Path;

const DOMAIN: &str = r#"
[[loop]]
kind = "polyline"
points_m = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]]
[[loop]]
kind = "circle"
center_m = [0.0, 0.0]
radius_m = 22.245
"#;

fn geometry(criterion: &mut Criterion) {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let surface = build(&SurfaceParams::GreatCourt {}, here).expect("a surface");
    let params: DomainParams = toml::from_str(DOMAIN).expect("a domain");
    let domain = Domain::resolve(&params, &surface, here).expect("a domain");
    let base =
        std::fs::read_to_string(here.join("tests/data/grammar/bases/great_court.json")).expect("a file");
    let initial = InitialMesh::from_base(&base_json::read(&base).expect("a base mesh")).expect("a mesh");
    let mesh = canonical_mesh(&initial.mesh);

    // Placing and densifying alone is developing without sweeps; relaxing is the rest.
    let mut group = criterion.benchmark_group("develop");
    group.sample_size(10);
    for (name, panels, sweeps) in [
        ("2 000 panels, 100 area sweeps", 2_000, 100),
        ("22 000 panels, no sweep", 22_000, 0),
        ("22 000 panels, 100 area sweeps", 22_000, 100),
    ] {
        let relax = RelaxParams { sweeps, ..RelaxParams::default() };
        let params = PatternParams { panels, max_faces: 30_000, relax, ..PatternParams::default() };
        group.bench_function(name, |b| b.iter(|| develop(&mesh, &domain, surface.as_ref(), &params)));
    }
    group.finish();
}

criterion_group!(benches, geometry);
criterion_main!(benches);
