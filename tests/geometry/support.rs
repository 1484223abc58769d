//! The Great Court, as several tests and benches of the geometry need it.

use quadrille::config::ResolvedConfig;
use quadrille::study::Study;
use std::path::Path;

/// Its initial mesh, whole, its domain and its roof, as the shipped config has them.
pub fn great_court() -> Study {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/great_court.toml");
    let config = ResolvedConfig::open(&file, &["topology.symmetry=[]".to_owned()]).expect("a config");
    Study::of(&config).expect("a study")
}
