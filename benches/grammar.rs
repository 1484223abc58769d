//! Speed of the grammar on the Great Court's mesh, fixed seeds. Goals (issue 3): at least 20,000 decodes of 40 tokens
//! a second on one core, 5,000 with the placed + reduced code; a distance up to 3 in at most 50 ms.
#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use quadrille::grammar::random::{Shares, aware, structured, uniform};
use quadrille::grammar::{Rules, Tokens, decode};
use quadrille::mesh::{Equivalence, InitialMesh, QuadMesh, base_json, canonical_mesh, deletions, distance};
use quadrille::random::stream;
use std::hint::black_box;

fn great_court() -> InitialMesh {
    let text = include_str!("../tests/data/grammar/bases/great_court.json");
    InitialMesh::from_base(&base_json::read(text).unwrap()).unwrap()
}

fn strings(kind: &str, count: u32) -> Vec<Tokens> {
    let initial = great_court();
    let shares = Shares::default();
    (0..count)
        .map(|i| {
            let rng = &mut stream(40, 0, i);
            match kind {
                "uniform" => uniform(rng, 40..=40),
                "structured" => structured(rng, 40..=40, &shares),
                _ => aware(rng, 40..=40, &shares, &initial, Rules::Plain),
            }
        })
        .collect()
}

fn decoding(c: &mut Criterion) {
    let initial = great_court();
    let mut group = c.benchmark_group("decode 40 tokens");
    for kind in ["uniform", "structured", "aware"] {
        let strings = strings(kind, 500);
        group.throughput(Throughput::Elements(strings.len() as u64));
        group.bench_function(kind, |b| {
            b.iter(|| {
                for string in &strings {
                    black_box(decode(&initial, string, Rules::Plain));
                }
            });
        });
        group.bench_function(format!("{kind}, placed + reduced code"), |b| {
            b.iter(|| {
                for string in &strings {
                    let mesh = decode(&initial, string, Rules::Plain).mesh;
                    black_box(Equivalence::default().code(&mesh));
                }
            });
        });
    }
    group.finish();
}

fn identity(c: &mut Criterion) {
    let initial = great_court();
    let meshes: Vec<QuadMesh> =
        strings("aware", 60).iter().map(|string| decode(&initial, string, Rules::Domain).mesh).collect();
    c.bench_function("canonical mesh", |b| {
        b.iter(|| meshes.iter().map(|mesh| canonical_mesh(mesh).vertex_count).sum::<usize>());
    });
    let mut group = c.benchmark_group("distance");
    group.sample_size(10);
    for max in [2, 3] {
        group.throughput(Throughput::Elements(meshes.len() as u64 - 1));
        group.bench_function(format!("up to {max}"), |b| {
            b.iter(|| {
                for pair in meshes.windows(2) {
                    black_box(distance(&pair[0], &pair[1], Equivalence::default(), max));
                }
            });
        });
    }
    group.throughput(Throughput::Elements(meshes.len() as u64));
    for depth in [1, 2] {
        group.bench_function(format!("codes of all deletions to depth {depth}"), |b| {
            b.iter(|| {
                meshes.iter().map(|mesh| deletions(mesh, depth, Equivalence::default()).len()).sum::<usize>()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, decoding, identity);
criterion_main!(benches);
