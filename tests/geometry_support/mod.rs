//! The Great Court, as several tests of the geometry need it.

use quadrille::domain::{Domain, DomainParams};
use quadrille::mesh::{InitialMesh, base_json};
use quadrille::surface::{Surface, SurfaceParams, build};
use std::path::Path;
use std::sync::Arc;

/// Its initial mesh, its domain and its roof.
pub fn great_court() -> (InitialMesh, Domain, Arc<dyn Surface>) {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let base =
        std::fs::read_to_string(here.join("tests/data/grammar/bases/great_court.json")).expect("a file");
    let base = base_json::read(&base).expect("a base mesh");
    let surface = build(&SurfaceParams::GreatCourt {}, here).expect("a surface");
    let params: DomainParams = toml::from_str(
        r#"
[[loop]]
kind = "polyline"
points_m = [[-36.625, -51.125], [36.625, -51.125], [36.625, 46.025], [-36.625, 46.025]]
[[loop]]
kind = "circle"
center_m = [0.0, 0.0]
radius_m = 22.245
"#,
    )
    .expect("a domain");
    let domain = Domain::resolve(&params, &surface, here).expect("a domain");
    (InitialMesh::from_base(&base).expect("a mesh"), domain, surface)
}
