//! The Great Court, as several tests and benches of the geometry need it.

use quadrille::config;
use quadrille::study::Study;
use std::path::Path;

/// Its initial mesh, its domain and its roof, as the shipped config has them.
pub fn great_court() -> Study {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/great_court.toml");
    let config = config::load(&file, &[]).expect("a config");
    Study::new(&config, config::folder_of(&file)).expect("a study")
}
