//! `topology.initial` of the config: skeleton, grid, file or written out, fitted to the domain.

use super::params::{InitialMesh as Given, TopologyParams};
use super::{SkeletonError, initial_mesh};
use crate::domain::Domain;
use crate::io::text::decode;
use crate::io::{Input, Inputs, LengthUnit, MEET, ReadError, compas, obj};
use crate::json;
use crate::mesh::load::{MAX_CORNERS, MAX_FACES};
use crate::mesh::{BaseMesh, BaseMeshError, InitialMesh, base_json};
use std::collections::{BTreeMap, BTreeSet};

/// Why there is no initial mesh.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum InitialError {
    /// The skeleton fails.
    #[error("topology.initial: {0}")]
    Skeleton(#[from] SkeletonError),
    /// The file cannot be read.
    #[error("topology.initial.file: {0}")]
    File(#[from] ReadError),
    /// The mesh is no valid coarse mesh.
    #[error("topology.initial: {0}")]
    Mesh(#[from] BaseMeshError),
    /// More corners than meshes can have, found before anything is made of them.
    #[error(
        "topology.initial: the domain has {corners} corners, at most {MAX_CORNERS} are supported; of a boundary of many points that is \
         a curve, domain.loop.corners = \"auto\" takes those only where it turns"
    )]
    TooManyCorners {
        /// Corners of the domain.
        corners: usize,
    },
    /// A grid needs four corners and no hole.
    #[error(
        "topology.initial: a grid needs a domain with four corners and no hole, this one has {corners} corners and {holes} holes"
    )]
    GridDomain {
        /// Corners of the domain.
        corners: usize,
        /// Holes of the domain.
        holes: usize,
    },
    /// A grid too small or too large.
    #[error(
        "topology.initial: grid = [{m}, {n}]: each number must lie between 1 and 1000, their product be at most {MAX_FACES}"
    )]
    GridSize {
        /// Faces one way.
        m: usize,
        /// Faces the other way.
        n: usize,
    },
    /// A number that does not fit.
    #[error("topology.initial: {what}")]
    Inline {
        /// What is wrong.
        what: String,
    },
    /// The mesh has other loops than the domain.
    #[error("topology.initial: the mesh has {mesh} boundary loops, the domain has {domain}")]
    LoopCount {
        /// Boundary loops of the mesh.
        mesh: usize,
        /// Loops of the domain.
        domain: usize,
    },
    /// No loop of the mesh lies along a loop of the domain.
    #[error("topology.initial: no boundary loop of the mesh lies along loop {loop_number} of the domain")]
    LoopMissing {
        /// The loop of the domain.
        loop_number: usize,
    },
    /// A corner of the domain has no vertex of the mesh.
    #[error(
        "topology.initial: corner {corner} of the domain, at ({x}, {y}), has no boundary vertex of the mesh within {tolerance:.2e} m: the \
         nearest is {distance:.6} m away"
    )]
    CornerMissing {
        /// The corner.
        corner: usize,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
        /// How far was looked, m.
        tolerance: f64,
        /// How far away the nearest boundary vertex of that loop is, m.
        distance: f64,
    },
    /// A mesh that faces y.
    #[error(
        "{error}; most of the mesh faces y, as in files with y up: files are read with z up, so export it with z up"
    )]
    YUp {
        /// Why it does not fit.
        error: Box<InitialError>,
    },
    /// The mesh gives another number of corners than the domain has.
    #[error("topology.initial: the file lists {found} corners, the domain has {wanted}")]
    CornerCount {
        /// Corners listed.
        found: usize,
        /// Corners of the domain.
        wanted: usize,
    },
}

impl InitialError {
    /// The key of the config that says what is wrong.
    pub fn key(&self, params: &TopologyParams) -> String {
        match (self, &params.initial) {
            (Self::YUp { error }, _) => error.key(params),
            (Self::Mesh(BaseMeshError::MarkerNotAnEdge { .. }), _) => "topology.marker".to_owned(),
            (Self::Mesh(error), Given::Inline { .. }) => match error.face() {
                Some(face) => format!("topology.initial.faces[{face}]"),
                None => "topology.initial".to_owned(),
            },
            (_, Given::File { .. }) => "topology.initial.file".to_owned(),
            _ => "topology.initial".to_owned(),
        }
    }
}

/// The initial mesh of a config on its domain, valid and with its corners marked: boundary loop `k` of the mesh is loop `k` of the
/// domain. The file that it names is among `inputs`.
///
/// # Errors
/// See [`InitialError`].
pub fn initial(params: &TopologyParams, domain: &Domain, inputs: &Inputs) -> Result<BaseMesh, InitialError> {
    let corners = domain.corner_count();
    if corners > MAX_CORNERS {
        return Err(InitialError::TooManyCorners { corners });
    }
    let mut base = match &params.initial {
        Given::Word(_) => initial_mesh(domain)?,
        Given::Grid { grid } => grid_mesh(*grid, domain)?,
        Given::File { file, unit } => fit(read(inputs.get(file)?, *unit)?, domain)?,
        Given::Inline { vertices, faces, poles } => fit(inline(vertices, faces, poles)?, domain)?,
    };
    if let Some(marker) = params.marker {
        base.marker = Some([index(marker[0])?, index(marker[1])?]);
    }
    InitialMesh::from_base(&base)?;
    Ok(base)
}

fn index(number: usize) -> Result<u32, InitialError> {
    u32::try_from(number)
        .map_err(|_| InitialError::Inline { what: format!("{number} is not a vertex number") })
}

fn inline(
    vertices: &[[f64; 3]],
    faces: &[Vec<usize>],
    poles: &BTreeMap<String, usize>,
) -> Result<BaseMesh, InitialError> {
    let face = |f: &Vec<usize>| f.iter().map(|&v| index(v)).collect();
    let pole = |(key, &v): (&String, &usize)| match key.parse() {
        Ok(face) => Ok((face, index(v)?)),
        Err(_) => Err(InitialError::Inline { what: format!("poles: {key:?} is not a face number") }),
    };
    Ok(BaseMesh {
        vertices: vertices.to_vec(),
        faces: faces.iter().map(face).collect::<Result<_, _>>()?,
        poles: poles.iter().map(pole).collect::<Result<_, _>>()?,
        ..BaseMesh::default()
    })
}

/// A valid mesh from a file whose coordinates have the given unit: OBJ by its extension, otherwise JSON, as a base mesh
/// (`vertices`) or by COMPAS (`vertex`).
///
/// # Errors
/// A file that is no mesh, or whose mesh is not valid, with line or key.
pub fn read(input: Input<'_>, unit: LengthUnit) -> Result<BaseMesh, ReadError> {
    let Input { file, bytes } = input;
    let content = |reason: String| ReadError::Content { file: file.to_owned(), reason };
    if file.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")) {
        let obj = obj::read(input, unit)?;
        let base = BaseMesh { vertices: obj.vertices, faces: obj.faces, ..BaseMesh::default() };
        InitialMesh::from_base(&base).map_err(|error| {
            let at_face = error.face().and_then(|face| obj.face_lines.get(face));
            let line = at_face.or_else(|| error.vertex().and_then(|vertex| obj.vertex_lines.get(vertex)));
            let where_poles_go = match error {
                BaseMeshError::TriangleWithoutPole { .. } => {
                    "; an OBJ file has no place for them: give the mesh as base mesh JSON, or by vertices, faces and poles in \
                     [topology.initial]"
                }
                _ => "",
            };
            let reason = format!("{error}{where_poles_go} (vertices and faces counted from 0)");
            match line {
                Some(&line) => ReadError::Line { file: file.to_owned(), line, reason },
                None => content(reason),
            }
        })?;
        return Ok(base);
    }
    let text =
        decode(bytes).map_err(|(line, reason)| ReadError::Line { file: file.to_owned(), line, reason })?;
    let value: serde_json::Value = json::read(&text).map_err(|e| content(e.to_string()))?;
    let (mut base, counted) = match value.get("vertices") {
        None => (compas::from_value(&value).map_err(content)?, " (counted from 0 in the order of the keys)"),
        Some(_) => (base_json::read(&text).map_err(|e| content(e.to_string()))?, ""),
    };
    InitialMesh::from_base(&base).map_err(|error| match error {
        BaseMeshError::TriangleWithoutPole { .. } if !counted.is_empty() => {
            content(format!("{error}, which a COMPAS mesh has as its attribute `face_pole`{counted}"))
        }
        error => content(format!("{error}{counted}")),
    })?;
    base.vertices.iter_mut().for_each(|position| *position = position.map(|c| unit.metres(c)));
    Ok(base)
}

/// An m × n grid between the four corners: m faces along the side from corner 0 to corner 1.
fn grid_mesh([m, n]: [usize; 2], domain: &Domain) -> Result<BaseMesh, InitialError> {
    let (corners, holes) = (domain.corner_count(), domain.loops.len() - 1);
    if corners != 4 || holes != 0 {
        return Err(InitialError::GridDomain { corners, holes });
    }
    if !(1..=1000).contains(&m) || !(1..=1000).contains(&n) || m * n > MAX_FACES {
        return Err(InitialError::GridSize { m, n });
    }
    let outer = &domain.loops[0];
    let c = outer.corners();
    let side = |k: usize, share: f64| {
        let length = (c[(k + 1) % 4] - c[k]).rem_euclid(outer.length());
        outer.point(c[k] + share * length)
    };
    // Transfinite interpolation (Coons) between the four sides.
    let point = |i: usize, j: usize| {
        let (u, v) = (i as f64 / m as f64, j as f64 / n as f64);
        let (south, north, west, east) = (side(0, u), side(2, 1.0 - u), side(3, 1.0 - v), side(1, v));
        let corner: [[f64; 3]; 4] = std::array::from_fn(|k| outer.point(c[k]));
        let mut p: [f64; 3] = std::array::from_fn(|k| {
            let ruled = (1.0 - v) * south[k] + v * north[k] + (1.0 - u) * west[k] + u * east[k];
            let bilinear = (1.0 - v) * ((1.0 - u) * corner[0][k] + u * corner[1][k])
                + v * ((1.0 - u) * corner[3][k] + u * corner[2][k]);
            ruled - bilinear
        });
        if let (true, Some(z)) = ((1..m).contains(&i) && (1..n).contains(&j), domain.height(p[0], p[1])) {
            p[2] = z;
        }
        p
    };
    let vertices = (0..=n).flat_map(|j| (0..=m).map(move |i| (i, j))).map(|(i, j)| point(i, j)).collect();
    let at = |i: usize, j: usize| (j * (m + 1) + i) as u32;
    let faces = (0..n)
        .flat_map(|j| (0..m).map(move |i| (i, j)))
        .map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect();
    let corners = vec![vec![at(0, 0)], vec![at(m, 0)], vec![at(m, n)], vec![at(0, n)]];
    Ok(BaseMesh { vertices, faces, corners, ..BaseMesh::default() })
}

/// Fits a mesh from outside to the domain: turns it counter-clockwise, orders its loops as the domain's, marks its corners.
fn fit(base: BaseMesh, domain: &Domain) -> Result<BaseMesh, InitialError> {
    let is_upright = faces_y(&base);
    fit_in_plan(base, domain).map_err(|error| match is_upright {
        true => InitialError::YUp { error: Box::new(error) },
        false => error,
    })
}

/// Whether the faces of a mesh have more area seen along y than from above.
fn faces_y(base: &BaseMesh) -> bool {
    let seen = |[i, j]: [usize; 2]| {
        let p = |v: &u32| base.vertices.get(*v as usize).map_or([0.0; 2], |p| [p[i], p[j]]);
        let area = |f: &Vec<u32>| {
            let points: Vec<_> = f.iter().map(p).collect();
            let n = points.len();
            let cross =
                |k: usize| points[k][0] * points[(k + 1) % n][1] - points[k][1] * points[(k + 1) % n][0];
            (0..n).map(cross).sum::<f64>().abs()
        };
        base.faces.iter().map(area).sum::<f64>()
    };
    seen([0, 2]) > seen([0, 1])
}

fn fit_in_plan(mut base: BaseMesh, domain: &Domain) -> Result<BaseMesh, InitialError> {
    if let Some(given) = Some(base.corners.len()).filter(|&n| n > 0 && n != domain.corner_count()) {
        return Err(InitialError::CornerCount { found: given, wanted: domain.corner_count() });
    }
    InitialMesh::from_base(&base)?;
    turn(&mut base);
    let loops = match_loops(&base, domain)?;
    if base.corners.is_empty() {
        base.corners = marks(&base, &loops, domain)?;
    }
    order_holes(&mut base, &loops);
    Ok(base)
}

/// Faces seen from below are turned over, all of them.
fn turn(base: &mut BaseMesh) {
    let p = |v: u32| base.vertices[v as usize];
    let area = |f: &Vec<u32>| {
        (1..f.len() - 1)
            .map(|i| {
                let (a, b, c) = (p(f[0]), p(f[i]), p(f[i + 1]));
                (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
            })
            .sum::<f64>()
    };
    if base.faces.iter().map(area).sum::<f64>() < 0.0 {
        for face in &mut base.faces {
            face[1..].reverse();
        }
    }
}

/// The boundary loops of a valid mesh, each as its vertices.
fn boundary_loops(base: &BaseMesh) -> Vec<Vec<u32>> {
    let darts = |f: &Vec<u32>| (0..f.len()).map(|k| (f[k], f[(k + 1) % f.len()])).collect::<Vec<_>>();
    let all: BTreeSet<(u32, u32)> = base.faces.iter().flat_map(darts).collect();
    let mut after: BTreeMap<u32, u32> =
        all.iter().copied().filter(|&(a, b)| !all.contains(&(b, a))).collect();
    let mut loops = Vec::new();
    while let Some((start, mut v)) = after.pop_first() {
        let mut vertices = vec![start];
        while let Some(next) = after.remove(&v) {
            vertices.push(v);
            v = next;
        }
        loops.push(vertices);
    }
    loops
}

/// For each loop of the domain, the loop of the mesh whose vertices are nearest to it on average.
fn match_loops(base: &BaseMesh, domain: &Domain) -> Result<Vec<Vec<u32>>, InitialError> {
    let loops = boundary_loops(base);
    if loops.len() != domain.loops.len() {
        return Err(InitialError::LoopCount { mesh: loops.len(), domain: domain.loops.len() });
    }
    let distance = |vertices: &[u32], k: usize| {
        let sum: f64 = vertices
            .iter()
            .map(|&v| {
                let p = base.vertices[v as usize];
                let q = domain.loops[k].closest_point(p);
                (p[0] - q[0]).hypot(p[1] - q[1])
            })
            .sum();
        sum / vertices.len() as f64
    };
    let nearest: Vec<usize> = loops
        .iter()
        .map(|l| {
            (0..domain.loops.len()).min_by(|&i, &j| distance(l, i).total_cmp(&distance(l, j))).unwrap_or(0)
        })
        .collect();
    (0..domain.loops.len())
        .map(|loop_number| {
            let found = nearest.iter().position(|&k| k == loop_number);
            found.map(|i| loops[i].clone()).ok_or(InitialError::LoopMissing { loop_number })
        })
        .collect()
}

/// Renumbers so that the holes' smallest vertex numbers come in the order of the domain's holes, which is how loops are
/// labelled: the numbers that holes have are dealt out anew, hole by hole.
fn order_holes(base: &mut BaseMesh, loops: &[Vec<u32>]) {
    let smallest = |l: &Vec<u32>| l.iter().copied().min();
    if loops[1..].is_sorted_by_key(smallest) {
        return;
    }
    let mut of_holes: Vec<u32> = Vec::new();
    for hole in &loops[1..] {
        let mut vertices: Vec<u32> = hole.iter().copied().filter(|v| !of_holes.contains(v)).collect();
        vertices.sort_unstable();
        of_holes.append(&mut vertices);
    }
    let mut numbers = of_holes.clone();
    numbers.sort_unstable();
    let renamed: BTreeMap<u32, u32> = of_holes.into_iter().zip(numbers).collect();
    let rename = |v: &mut u32| *v = renamed.get(v).copied().unwrap_or(*v);
    let old = base.vertices.clone();
    for (&from, &to) in &renamed {
        base.vertices[to as usize] = old[from as usize];
    }
    base.faces.iter_mut().flatten().for_each(rename);
    base.poles.values_mut().for_each(rename);
    base.corners.iter_mut().flatten().for_each(rename);
    base.marker.iter_mut().flatten().for_each(rename);
}

/// The boundary vertices at the corners of the domain, within [`MEET`] of its size; without corners, the vertex nearest to its mark.
fn marks(base: &BaseMesh, loops: &[Vec<u32>], domain: &Domain) -> Result<Vec<Vec<u32>>, InitialError> {
    let tolerance = MEET * domain.size();
    let away = |v: u32, at: [f64; 3]| {
        let p = base.vertices[v as usize];
        (p[0] - at[0]).hypot(p[1] - at[1])
    };
    if let Some(s) = domain.mark() {
        let at = domain.loops[0].point(s);
        let nearest = loops[0].iter().copied().min_by(|&a, &b| away(a, at).total_cmp(&away(b, at)));
        return Ok(vec![nearest.into_iter().collect()]);
    }
    (0..domain.corner_count())
        .filter_map(|corner| Some((corner, domain.corner(corner)?)))
        .map(|(corner, (loop_number, s))| {
            let at = domain.loops[loop_number].point(s);
            let nearest =
                loops[loop_number].iter().copied().min_by(|&a, &b| away(a, at).total_cmp(&away(b, at)));
            let distance = nearest.map_or(f64::INFINITY, |v| away(v, at));
            match nearest.filter(|_| distance <= tolerance) {
                Some(v) => Ok(vec![v]),
                None => Err(InitialError::CornerMissing { corner, x: at[0], y: at[1], tolerance, distance }),
            }
        })
        .collect()
}
