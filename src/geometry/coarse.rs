//! The canonical mesh with the adjacency that geometry asks for.

use crate::mesh::CanonicalMesh;

/// Where a coarse vertex lies on the boundary.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct OnLoop {
    /// The loop's label.
    pub label: usize,
    /// Position in the counter-clockwise order of [`Coarse::loops`].
    pub position: usize,
}

/// A canonical mesh with its edges numbered strip by strip and its loops turned counter-clockwise.
pub struct Coarse<'a> {
    /// The mesh itself.
    pub mesh: &'a CanonicalMesh,
    /// Every edge once, strip by strip, in the strip's order.
    pub edges: Vec<[u32; 2]>,
    /// For each edge, its strip.
    pub edge_strip: Vec<u32>,
    /// For each edge, how many faces it has: 1 on the boundary, 2 inside.
    pub edge_faces: Vec<u8>,
    /// For each vertex, how many faces it has.
    pub vertex_faces: Vec<u32>,
    /// For each vertex, how many edges it has.
    pub valence: Vec<u32>,
    /// Boundary loops, all counter-clockwise seen from above.
    pub loops: Vec<Vec<u32>>,
    /// For each vertex, its place on the boundary.
    pub on_loop: Vec<Option<OnLoop>>,
    /// `(smaller vertex, larger vertex, edge)`, sorted, to look edges up.
    sorted: Vec<(u32, u32, u32)>,
}

impl<'a> Coarse<'a> {
    /// Collects the adjacency of a canonical mesh.
    pub fn of(mesh: &'a CanonicalMesh) -> Self {
        let mut edges = Vec::new();
        let mut edge_strip = Vec::new();
        for (s, strip) in mesh.strips.iter().enumerate() {
            edges.extend_from_slice(&strip.edges);
            edge_strip.resize(edges.len(), s as u32);
        }
        let mut sorted: Vec<(u32, u32, u32)> =
            edges.iter().enumerate().map(|(e, &[u, v])| (u.min(v), u.max(v), e as u32)).collect();
        sorted.sort_unstable();

        let mut valence = vec![0; mesh.vertex_count];
        for &[u, v] in &edges {
            valence[u as usize] += 1;
            valence[v as usize] += 1;
        }
        let loops: Vec<Vec<u32>> = mesh
            .loops
            .iter()
            .enumerate()
            .map(|(k, vertices)| match k {
                0 => vertices.iter().rev().copied().collect(),
                _ => vertices.clone(),
            })
            .collect();
        let mut on_loop = vec![None; mesh.vertex_count];
        for (label, vertices) in loops.iter().enumerate() {
            for (position, &v) in vertices.iter().enumerate() {
                on_loop[v as usize] = Some(OnLoop { label, position });
            }
        }
        let mut coarse = Self {
            mesh,
            edge_faces: vec![0; edges.len()],
            vertex_faces: vec![0; mesh.vertex_count],
            edges,
            edge_strip,
            valence,
            loops,
            on_loop,
            sorted,
        };
        for face in &mesh.faces {
            for v in corners_of(face) {
                coarse.vertex_faces[v as usize] += 1;
            }
            for [u, v] in sides_of(face) {
                let e = coarse.edge(u, v);
                coarse.edge_faces[e] += 1;
            }
        }
        coarse
    }

    /// The number of the edge between two vertices.
    ///
    /// # Panics
    /// If the two are not adjacent, which the contract of [`CanonicalMesh`] rules out for the sides of a face.
    pub fn edge(&self, u: u32, v: u32) -> usize {
        let key = (u.min(v), u.max(v));
        let at = self.sorted.partition_point(|&(a, b, _)| (a, b) < key);
        let (a, b, e) = self.sorted[at];
        assert!((a, b) == key, "vertices {u} and {v} share no edge of a strip");
        e as usize
    }
}

/// The distinct vertices of a coarse face: four, or three for a pseudo-quad (the pole first).
pub fn corners_of(face: &[u32; 4]) -> impl Iterator<Item = u32> + Clone + '_ {
    let skip = usize::from(face[0] == face[1]);
    face[skip..].iter().copied()
}

/// The real sides of a coarse face, counter-clockwise.
pub fn sides_of(face: &[u32; 4]) -> impl Iterator<Item = [u32; 2]> + '_ {
    (0..4).map(|i| [face[i], face[(i + 1) % 4]]).filter(|[u, v]| u != v)
}
