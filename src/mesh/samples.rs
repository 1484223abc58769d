//! Small initial meshes to try things on.

use super::base::BaseMesh;

/// A plan grid of m × n unit squares, its four corners marked counter-clockwise from the origin, m and n at least 1. Vertices and
/// faces row by row; the marker lies on the first edge.
pub fn grid(m: u32, n: u32) -> BaseMesh {
    let (m, n) = (m.max(1), n.max(1));
    let at = |i: u32, j: u32| j * (m + 1) + i;
    let rows = |m: u32, n: u32| (0..n).flat_map(move |j| (0..m).map(move |i| (i, j)));
    BaseMesh {
        vertices: rows(m + 1, n + 1).map(|(i, j)| [f64::from(i), f64::from(j), 0.0]).collect(),
        faces: rows(m, n)
            .map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
            .collect(),
        corners: vec![vec![at(0, 0)], vec![at(m, 0)], vec![at(m, n)], vec![at(0, n)]],
        ..BaseMesh::default()
    }
}

/// A ring of `around` faces by `across`, radii 1 and 2, without corners: a court. `around` at least 3, `across` at least 1.
pub fn ring(around: u32, across: u32) -> BaseMesh {
    let (around, across) = (around.max(3), across.max(1));
    let at = |i: u32, j: u32| j * around + i % around;
    let vertex = |i: u32, j: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(around);
        let radius = 1.0 + f64::from(j) / f64::from(across);
        [radius * libm::cos(angle), radius * libm::sin(angle), 0.0]
    };
    let rows = |n: u32| (0..n).flat_map(move |j| (0..around).map(move |i| (i, j)));
    BaseMesh {
        vertices: rows(across + 1).map(|(i, j)| vertex(i, j)).collect(),
        faces: rows(across)
            .map(|(i, j)| vec![at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)])
            .collect(),
        ..BaseMesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::InitialMesh;

    #[test]
    fn samples_are_valid_meshes_of_their_topology() {
        for (m, n) in [(1, 1), (3, 2)] {
            let mesh = InitialMesh::from_base(&grid(m, n)).unwrap().mesh;
            let found = (mesh.face_count(), mesh.loop_count(), mesh.euler_characteristic());
            assert_eq!(found, ((m * n) as usize, 1, 1));
        }
        let mesh = InitialMesh::from_base(&ring(6, 2)).unwrap().mesh;
        assert_eq!((mesh.face_count(), mesh.loop_count(), mesh.euler_characteristic()), (12, 2, 0));
    }
}
