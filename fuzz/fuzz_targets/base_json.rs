//! Any text as a base mesh file: an error, or a mesh that is refused with a reason or sound.
#![no_main]

use libfuzzer_sys::fuzz_target;
use quadrille::mesh::{InitialMesh, base_json, validate};

fuzz_target!(|data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let Ok(base) = base_json::read(text) else { return };
    if let Ok(initial) = InitialMesh::from_base(&base) {
        validate::check(&initial.mesh).unwrap();
        validate::check_invariants(&initial.mesh).unwrap();
    }
});
