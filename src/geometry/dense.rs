//! From the coarse mesh and the densities of its strips to the dense mesh: topology only (docs/reference/geometry.md §2.3).

use super::coarse::Coarse;
use super::pattern::Panel;

/// The dense mesh without positions. A coarse vertex keeps its number; the vertices inside coarse edges follow, edge
/// by edge, then those inside coarse faces, face by face.
#[derive(Clone)]
pub struct Dense {
    /// Number of vertices.
    pub vertex_count: usize,
    /// Panels, counter-clockwise, coarse face by coarse face.
    pub panels: Vec<Panel>,
    /// For each panel, its coarse face.
    pub coarse_face: Vec<u32>,
    /// For each coarse edge, its vertices from end to end.
    pub edge_paths: Vec<Vec<u32>>,
    /// For each coarse face, the first of the vertices inside it.
    pub face_inner: Vec<u32>,
    /// Boundary loops, counter-clockwise seen from above.
    pub loops: Vec<Vec<u32>>,
}

/// The vertices of one coarse face `[a, b, c, d]`, in n parts from a to b and m from a to d.
pub struct Grid {
    /// Parts from a to b.
    pub n: usize,
    /// Parts from a to d.
    pub m: usize,
    /// Row 0 from a to b (all the pole if a = b), and row m from d to c.
    rows: [Vec<u32>; 2],
    /// Column 0 from a to d, and column n from b to c.
    columns: [Vec<u32>; 2],
    inner: u32,
}

impl Grid {
    /// The vertex in column `i`, 0 to n, of row `j`, 0 to m.
    pub fn at(&self, i: usize, j: usize) -> u32 {
        match (i, j) {
            (_, 0) => self.rows[0][i],
            (_, j) if j == self.m => self.rows[1][i],
            (0, j) => self.columns[0][j],
            (i, j) if i == self.n => self.columns[1][j],
            (i, j) => self.inner + ((j - 1) * (self.n - 1) + i - 1) as u32,
        }
    }
}

/// How many panels the densities give; `usize::MAX` if there are more than that.
pub fn panel_count(coarse: &Coarse<'_>, density: &[u32]) -> usize {
    let of_face =
        |&[s, t]: &[u32; 2]| (density[s as usize] as usize).saturating_mul(density[t as usize] as usize);
    coarse.mesh.face_strips.iter().map(of_face).fold(0, usize::saturating_add)
}

/// Divides every strip `s` into `density[s]` parts.
pub fn densify(coarse: &Coarse<'_>, density: &[u32]) -> Dense {
    let mesh = coarse.mesh;
    let mut next = mesh.vertex_count as u32;
    let mut fresh = |n: u32| {
        let start = next;
        next += n;
        start..next
    };
    let edge_paths: Vec<Vec<u32>> = coarse
        .edges
        .iter()
        .zip(&coarse.edge_strip)
        .map(|(&[u, v], &s)| {
            let inner = fresh(density[s as usize] - 1);
            std::iter::once(u).chain(inner).chain(std::iter::once(v)).collect()
        })
        .collect();
    let mut face_inner = Vec::with_capacity(mesh.faces.len());
    let mut panels = Vec::with_capacity(panel_count(coarse, density));
    let mut coarse_face = Vec::with_capacity(panels.capacity());
    for (f, &[s, t]) in mesh.face_strips.iter().enumerate() {
        let (n, m) = (density[s as usize] as usize, density[t as usize] as usize);
        face_inner.push(fresh(((n - 1) * (m - 1)) as u32).start);
        let grid = grid(coarse, &edge_paths, face_inner[f], f);
        let at = |i, j| grid.at(i, j);
        for j in 0..m {
            for i in 0..n {
                let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                panels.push(if corners[0] == corners[1] {
                    Panel::triangle([corners[0], corners[2], corners[3]])
                } else {
                    Panel::quad(corners)
                });
                coarse_face.push(f as u32);
            }
        }
    }
    let loops = coarse
        .loops
        .iter()
        .map(|vertices| {
            let n = vertices.len();
            (0..n)
                .flat_map(|i| {
                    let mut stretch = path(coarse, &edge_paths, vertices[i], vertices[(i + 1) % n]);
                    stretch.pop();
                    stretch
                })
                .collect()
        })
        .collect();
    Dense { vertex_count: next as usize, panels, coarse_face, edge_paths, face_inner, loops }
}

/// The vertices of a coarse edge from `u` to `v`.
fn path(coarse: &Coarse<'_>, edge_paths: &[Vec<u32>], u: u32, v: u32) -> Vec<u32> {
    let e = coarse.edge(u, v);
    let mut vertices = edge_paths[e].clone();
    if coarse.edges[e][0] != u {
        vertices.reverse();
    }
    vertices
}

fn grid(coarse: &Coarse<'_>, edge_paths: &[Vec<u32>], inner: u32, face: usize) -> Grid {
    let [a, b, c, d] = coarse.mesh.faces[face];
    let path = |u, v| path(coarse, edge_paths, u, v);
    let last = path(d, c);
    let n = last.len() - 1;
    let rows = [if a == b { vec![a; n + 1] } else { path(a, b) }, last];
    let columns = [path(a, d), path(b, c)];
    Grid { n, m: columns[0].len() - 1, rows, columns, inner }
}

impl Dense {
    /// The vertices of a coarse face.
    pub fn grid(&self, coarse: &Coarse<'_>, face: usize) -> Grid {
        grid(coarse, &self.edge_paths, self.face_inner[face], face)
    }
}

/// The edges of a mesh and the panels on their two sides.
pub struct Edges {
    /// Every edge once, `[smaller, larger]`, sorted.
    pub list: Vec<[u32; 2]>,
    /// For each edge, the panels on the left of `smaller → larger` and of `larger → smaller`; [`NO_PANEL`] outside.
    pub panels: Vec<[u32; 2]>,
}

/// No panel on this side of an edge.
pub const NO_PANEL: u32 = u32::MAX;

impl Edges {
    /// Collects the edges of `panels` over `vertex_count` vertices, in linear time.
    pub fn of(vertex_count: usize, panels: &[Panel]) -> Self {
        let mut start = vec![0usize; vertex_count + 1];
        let darts = || {
            panels.iter().enumerate().flat_map(|(p, panel)| {
                let c = panel.corners();
                (0..c.len()).map(move |i| (c[i], c[(i + 1) % c.len()], p as u32))
            })
        };
        for (u, v, _) in darts() {
            start[u.min(v) as usize + 1] += 1;
        }
        for i in 0..vertex_count {
            start[i + 1] += start[i];
        }
        let mut fill = start.clone();
        let mut sorted = vec![(0u32, false, 0u32); start[vertex_count]];
        for (u, v, p) in darts() {
            let slot = &mut fill[u.min(v) as usize];
            sorted[*slot] = (u.max(v), u > v, p);
            *slot += 1;
        }
        let mut edges = Self { list: Vec::new(), panels: Vec::new() };
        for u in 0..vertex_count {
            let bucket = &mut sorted[start[u]..start[u + 1]];
            bucket.sort_unstable();
            for &(v, backward, p) in bucket.iter() {
                if edges.list.last() != Some(&[u as u32, v]) {
                    edges.list.push([u as u32, v]);
                    edges.panels.push([NO_PANEL; 2]);
                }
                if let Some(sides) = edges.panels.last_mut() {
                    sides[usize::from(backward)] = p;
                }
            }
        }
        edges
    }

    /// The number of the edge between two vertices, if there is one.
    pub fn find(&self, u: u32, v: u32) -> Option<usize> {
        self.list.binary_search(&[u.min(v), u.max(v)]).ok()
    }
}
