//! NSGA-II (Deb et al. 2002). Knows nothing of meshes: numbers in, indices out.
