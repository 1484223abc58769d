//! Maps of a mesh onto itself that do to loops and corners what a symmetry of the domain does.

use super::canonical::CanonicalMesh;
use super::isomorphism::Symmetry;
use super::quad_mesh::{Left, QuadMesh};

/// What a map has to keep: faces, and which edges are on which loop, and the carriers of the corners.
pub struct Shape {
    /// The distinct vertices of each face, counter-clockwise; those of a pseudo-quad begin with its pole.
    faces: Vec<Vec<u32>>,
    /// The darts that have a face on their left, `(u, v, face, place of u in it)`, sorted.
    darts: Vec<(u32, u32, u32, u32)>,
    /// The outside darts `(u, v, what is on their left)`, sorted.
    walls: Vec<(u32, u32, Left)>,
    /// The corners that count at each vertex, ascending.
    corners: Vec<Vec<u32>>,
}

impl Shape {
    /// Of a mesh; of its corners only the first `corner_count` count.
    pub fn of(mesh: &QuadMesh, corner_count: usize) -> Self {
        let faces = mesh.face_darts().into_iter();
        let faces = faces.map(|first| mesh.along(first).map(|d| mesh.origin(d).0).collect()).collect();
        let outside = mesh.darts().filter(|&d| mesh.is_outside(d));
        let walls = outside.map(|d| (mesh.origin(d).0, mesh.end(d).0, mesh.left(d)));
        let marks = mesh.marks().iter().filter(|mark| (mark.corner as usize) < corner_count);
        let marks = marks.map(|mark| (mark.corner, mark.vertex.0));
        Self::new(mesh.vertex_count(), faces, walls, marks)
    }

    /// Of a canonical mesh, with all its corners.
    pub fn of_canonical(mesh: &CanonicalMesh) -> Self {
        let distinct = |face: &[u32; 4]| face[usize::from(face[0] == face[1])..].to_vec();
        let marks = mesh.corners.iter().zip(0..);
        let marks = marks.flat_map(|(carriers, k)| carriers.iter().map(move |&v| (k, v)));
        Self::new(mesh.vertex_count, mesh.faces.iter().map(distinct).collect(), around(&mesh.loops), marks)
    }

    /// Of a dense mesh, its loops in either direction; its first `corner_count` vertices are corners of the same number.
    pub fn of_panels<'a>(
        vertex_count: usize,
        panels: impl Iterator<Item = &'a [u32]>,
        loops: &[Vec<u32>],
        corner_count: usize,
    ) -> Self {
        let marks = (0..corner_count as u32).map(|v| (v, v));
        Self::new(vertex_count, panels.map(<[u32]>::to_vec).collect(), around(loops), marks)
    }

    fn new(
        vertex_count: usize,
        faces: Vec<Vec<u32>>,
        walls: impl Iterator<Item = (u32, u32, Left)>,
        marks: impl Iterator<Item = (u32, u32)>,
    ) -> Self {
        let mut darts = Vec::with_capacity(4 * faces.len());
        for (face, f) in faces.iter().zip(0..) {
            let n = face.len();
            darts.extend((0..n).map(|i| (face[i], face[(i + 1) % n], f, i as u32)));
        }
        darts.sort_unstable();
        let mut corners = vec![Vec::new(); vertex_count];
        for (corner, vertex) in marks {
            corners[vertex as usize].push(corner);
        }
        corners.iter_mut().for_each(|numbers: &mut Vec<u32>| numbers.sort_unstable());
        let mut shape = Self { faces, darts, walls: Vec::new(), corners };
        // A face lies on the right of an outside dart.
        let turned = |(u, v, left)| if shape.dart(u, v).is_some() { (v, u, left) } else { (u, v, left) };
        let mut walls: Vec<_> = walls.map(turned).collect();
        walls.sort_unstable();
        shape.walls = walls;
        shape
    }

    /// The map of the vertices that does to loops and corners what `symmetry` does to those of the domain. At most one on a mesh with
    /// a corner that one vertex carries; the first found on others. `None` too on a mesh without boundary.
    pub fn find(&self, symmetry: &Symmetry) -> Option<Vec<u32>> {
        self.all(symmetry).next()
    }

    /// All such maps.
    pub fn all<'a>(&'a self, symmetry: &'a Symmetry) -> impl Iterator<Item = Vec<u32>> + 'a {
        // From the vertex with the most corners there are the fewest ways to begin.
        let root = self.walls.iter().max_by_key(|(u, ..)| self.corners[*u as usize].len()).copied();
        root.into_iter()
            .flat_map(move |root| self.walls.iter().filter_map(move |&at| self.extend(symmetry, root, at)))
    }

    /// The map that takes the outside dart `root` to the outside dart `image`.
    fn extend(
        &self,
        symmetry: &Symmetry,
        root: (u32, u32, Left),
        (iu, iv, image_left): (u32, u32, Left),
    ) -> Option<Vec<u32>> {
        let (u, v, left) = root;
        let [to_u, to_v] = if symmetry.reversed { [iv, iu] } else { [iu, iv] };
        if symmetry.left(left) != image_left || !self.corners_fit(symmetry, u, to_u) {
            return None;
        }
        let mut map = vec![u32::MAX; self.corners.len()];
        (map[u as usize], map[v as usize]) = (to_u, to_v);
        let mut reached = vec![false; self.faces.len()];
        let mut pending = vec![(v, u)];
        while let Some((a, b)) = pending.pop() {
            let Some((f, i)) = self.dart(a, b) else { continue };
            if std::mem::replace(&mut reached[f], true) {
                continue;
            }
            let (to_a, to_b) = (map[a as usize], map[b as usize]);
            let (g, j) = if symmetry.reversed { self.dart(to_b, to_a)? } else { self.dart(to_a, to_b)? };
            let (face, image) = (&self.faces[f], &self.faces[g]);
            let n = face.len();
            if image.len() != n {
                return None;
            }
            for k in 0..n {
                let from = (i + k) % n;
                let to = if symmetry.reversed { (j + 1 + n - k) % n } else { (j + k) % n };
                // The pole of a triangle comes first.
                if n == 3 && (from == 0) != (to == 0) {
                    return None;
                }
                let slot = &mut map[face[from] as usize];
                if *slot != u32::MAX && *slot != image[to] {
                    return None;
                }
                *slot = image[to];
                pending.push((face[(from + 1) % n], face[from]));
            }
        }
        self.is_kept(symmetry, &map).then_some(map)
    }

    fn dart(&self, u: u32, v: u32) -> Option<(usize, usize)> {
        let at = self.darts.partition_point(|&(a, b, ..)| (a, b) < (u, v));
        let &(a, b, face, place) = self.darts.get(at)?;
        (a == u && b == v).then_some((face as usize, place as usize))
    }

    fn corners_fit(&self, symmetry: &Symmetry, v: u32, image: u32) -> bool {
        let mut wanted: Vec<u32> = self.corners[v as usize].iter().map(|&k| symmetry.corner(k)).collect();
        wanted.sort_unstable();
        wanted == self.corners[image as usize]
    }

    /// Whether a map of vertices is one-to-one and keeps corners and loops.
    fn is_kept(&self, symmetry: &Symmetry, map: &[u32]) -> bool {
        let mut taken = vec![false; map.len()];
        let is_new =
            |&v: &u32| taken.get_mut(v as usize).is_some_and(|taken| !std::mem::replace(taken, true));
        map.iter().all(is_new)
            && map.iter().zip(0..).all(|(&image, v)| self.corners_fit(symmetry, v, image))
            && self.walls.iter().all(|&(u, v, left)| {
                let (a, b) = (map[u as usize], map[v as usize]);
                let image = if symmetry.reversed { (b, a) } else { (a, b) };
                self.walls.binary_search(&(image.0, image.1, symmetry.left(left))).is_ok()
            })
    }
}

/// The edges of loops, by label.
fn around(loops: &[Vec<u32>]) -> impl Iterator<Item = (u32, u32, Left)> + '_ {
    loops.iter().zip(0..).flat_map(|(vertices, label)| {
        let next = vertices.iter().cycle().skip(1);
        vertices.iter().zip(next).map(move |(&u, &v)| (u, v, Left::outside(label)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{BaseMesh, InitialMesh};

    /// Two squares side by side, `0 1 2` below and `3 4 5` above.
    fn domino() -> QuadMesh {
        let base = BaseMesh {
            vertices: (0..6).map(|i| [f64::from(i % 3), f64::from(i / 3), 0.0]).collect(),
            faces: vec![vec![0, 1, 4, 3], vec![1, 2, 5, 4]],
            corners: vec![vec![0], vec![2], vec![5], vec![3]],
            ..BaseMesh::default()
        };
        InitialMesh::from_base(&base).unwrap().mesh
    }

    #[test]
    fn mirrors_and_turns_of_a_domino() {
        let shape = Shape::of(&domino(), 4);
        let find = |corners: [u32; 4], reversed| {
            shape.find(&Symmetry { loops: vec![0], corners: corners.to_vec(), reversed })
        };
        assert_eq!(find([1, 0, 3, 2], true), Some(vec![2, 1, 0, 5, 4, 3]));
        assert_eq!(find([3, 2, 1, 0], true), Some(vec![3, 4, 5, 0, 1, 2]));
        assert_eq!(find([2, 3, 0, 1], false), Some(vec![5, 4, 3, 2, 1, 0]));
        assert_eq!(find([1, 2, 3, 0], false), None, "a quarter turn");
        assert_eq!(find([1, 0, 3, 2], false), None, "no turn exchanges these corners");
    }

    #[test]
    fn a_canonical_mesh_has_the_same() {
        let mesh = crate::mesh::canonical_mesh(&domino());
        let shape = Shape::of_canonical(&mesh);
        let mirror = Symmetry { loops: vec![0], corners: vec![1, 0, 3, 2], reversed: true };
        let map = shape.find(&mirror).unwrap();
        for k in 0..4 {
            let image = mirror.corner(k);
            assert_eq!(map[mesh.corners[k as usize][0] as usize], mesh.corners[image as usize][0]);
        }
    }
}
