//! Surfaces, domains, skeletons, densities and patterns.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod code;
mod compas;
mod density;
mod domain_area;
mod domain_corners;
mod domain_loops;
mod domains;
mod exact;
mod obj_random;
mod pattern_limits;
mod pattern_optimise;
mod skeleton_domains;
mod skeleton_initial;
mod skeleton_limits;
mod support;
mod surface_kinds;
mod surface_skin;
mod symmetry;
