//! Symmetries of boundary and surface (docs/reference/geometry.md §0.5).

use super::params::Symmetry as Kind;
use super::{Domain, DomainError};
use crate::mesh::Symmetry;

/// Points and heights may differ by this share of the domain's size.
const TOLERANCE: f64 = 1e-6;

impl Kind {
    /// Its name in the config.
    pub fn name(self) -> &'static str {
        match self {
            Self::MirrorX => "mirror-x",
            Self::MirrorY => "mirror-y",
            Self::Rotate180 => "rotate-180",
        }
    }

    /// Signs of x and y about the middle.
    pub fn signs(self) -> [f64; 2] {
        match self {
            Self::MirrorX => [-1.0, 1.0],
            Self::MirrorY => [1.0, -1.0],
            Self::Rotate180 => [-1.0, -1.0],
        }
    }
}

impl Domain {
    /// How each symmetry of the config carries loops and corners into each other. All of the group that they generate is given,
    /// without the identity: two mirrors make the half turn too.
    ///
    /// # Errors
    /// A symmetry that boundary or surface do not have, and what has no image.
    pub fn symmetries(&self, wanted: &[Kind]) -> Result<Vec<(Kind, Symmetry)>, DomainError> {
        let has = |kind| wanted.contains(&kind);
        let pairs = Kind::ALL.into_iter().filter(|&k| has(k)).count();
        Kind::ALL
            .into_iter()
            .filter(|&kind| has(kind) || pairs >= 2)
            .map(|kind| Ok((kind, self.symmetry(kind)?)))
            .collect()
    }

    /// How one symmetry, about the middle of the bounding box, carries loops and corners into each other.
    ///
    /// # Errors
    /// What has no image.
    pub fn symmetry(&self, kind: Kind) -> Result<Symmetry, DomainError> {
        let fault = |reason: String| DomainError::NotSymmetric { symmetry: kind.name(), reason };
        let tolerance = TOLERANCE * self.size();
        let loops = (0..self.loops.len())
            .map(|i| self.image_of_loop(i, kind, tolerance).map_err(fault))
            .collect::<Result<Vec<u32>, _>>()?;
        let corners = (0..self.corner_count())
            .map(|c| self.image_of_corner(c, kind, tolerance).map_err(fault))
            .collect::<Result<Vec<u32>, _>>()?;
        if let Some(s) = self.mark() {
            let p = self.loops[0].point(s);
            if distance(p, self.image(p, kind)) > tolerance {
                let mark = "the mark of a domain without corners, mark_m, by default its point of largest x";
                return Err(fault(format!("{mark}, does not stay")));
            }
        }
        self.check_heights(kind, tolerance).map_err(fault)?;
        Ok(Symmetry { loops, corners, reversed: kind != Kind::Rotate180 })
    }

    /// The symmetries that boundary and surface have, and the mark where there is no corner.
    pub fn own_symmetries(&self) -> &[(Kind, Symmetry)] {
        self.own_symmetries.get_or_init(|| {
            Kind::ALL.into_iter().filter_map(|kind| Some((kind, self.symmetry(kind).ok()?))).collect()
        })
    }

    /// The image of a point under a symmetry about the middle of the bounding box, m.
    pub fn image(&self, [x, y, z]: [f64; 3], kind: Kind) -> [f64; 3] {
        let [low, high] = self.bounds();
        let [sx, sy] = kind.signs();
        // A coordinate that is kept keeps every bit.
        let across = |sign: f64, x: f64, k: usize| if sign > 0.0 { x } else { (low[k] + high[k]) - x };
        [across(sx, x, 0), across(sy, y, 1), z]
    }

    fn image_of_loop(&self, loop_number: usize, kind: Kind, tolerance: f64) -> Result<u32, String> {
        let boundary = &self.loops[loop_number];
        let images: Vec<_> = boundary
            .sample(self.size() / 200.0)
            .iter()
            .map(|&s| self.image(boundary.point(s), kind))
            .collect();
        let on =
            |k: &usize| images.iter().all(|&p| distance(p, self.loops[*k].closest_point(p)) <= tolerance);
        match (0..self.loops.len()).find(on) {
            Some(k) => Ok(k as u32),
            None => Err(format!("loop {loop_number} has no image")),
        }
    }

    fn image_of_corner(&self, corner: usize, kind: Kind, tolerance: f64) -> Result<u32, String> {
        let place = |c: usize| self.corner(c).map(|(l, s)| self.loops[l].point(s));
        let image = place(corner).map(|p| self.image(p, kind));
        let same =
            |c: &usize| matches!((image, place(*c)), (Some(p), Some(q)) if distance(p, q) <= tolerance);
        match (0..self.corner_count()).find(same) {
            Some(c) => Ok(c as u32),
            None => Err(format!("corner {corner} has no image")),
        }
    }

    /// Compares heights of the surface on a grid with those of the images.
    fn check_heights(&self, kind: Kind, tolerance: f64) -> Result<(), String> {
        const GRID: usize = 40;
        let [low, high] = self.bounds();
        let at = |k: usize, i: usize| low[k] + (high[k] - low[k]) * (i as f64 + 0.37) / GRID as f64;
        for (i, j) in (0..GRID).flat_map(|i| (0..GRID).map(move |j| (i, j))) {
            let (x, y) = (at(0, i), at(1, j));
            let [u, v, _] = self.image([x, y, 0.0], kind);
            if let (Some(z), Some(w)) = (self.height(x, y), self.height(u, v))
                && (z - w).abs() > tolerance
            {
                return Err(format!(
                    "the surface is {z:.6} m high at ({x:.3}, {y:.3}) and {w:.6} m at its image"
                ));
            }
        }
        Ok(())
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
}
