//! A mesh small enough for a page: positions and results as 16-bit steps, panels as variable-length differences, all in base64.
//!
//! A design of 2,000 panels takes about 45 kB instead of 700 kB as JSON numbers. `assets/report/mesh.js` reads it.

use super::ReportError;
use super::data::Mesh;
use serde::Serialize;
use std::collections::BTreeMap;

/// Stands for "no value" among 16-bit steps.
pub(super) const NO_VALUE: u16 = u16::MAX;

/// What the page holds of a mesh. Members are not stored: they are the panels' edges, sorted as `[smaller, larger]`.
#[derive(Serialize)]
pub(super) struct Packed {
    vertices: usize,
    panels: usize,
    /// Smallest coordinate and step, m, per axis: `coordinate = low + step · integer`.
    low: [f64; 3],
    step: [f64; 3],
    /// x of all vertices, then y, then z: unsigned 16-bit little-endian.
    positions: String,
    /// Per panel: number of corners, then each corner less the same corner of the panel before, zigzag, LEB128.
    corners: String,
    /// Vertices to mark: vertex, and kind (0 fewer members than regular, 1 more, 2 pole).
    singular: Vec<[u32; 2]>,
    curvature: Option<Field>,
    skewness: Option<Field>,
    utilisation: Option<Field>,
}

/// Values as steps from 0 to `max`: `value = max · integer / 65534`; 65535 is "none".
#[derive(Serialize)]
struct Field {
    max: f64,
    /// 98 of 100 values are below it: where a colour scale may end without losing the rest in one tint.
    high: f64,
    values: String,
}

/// Packs a mesh, or tells what is wrong with it.
pub(super) fn pack(id: &str, mesh: &Mesh) -> Result<Packed, ReportError> {
    let broken = |what: String| ReportError::Mesh { id: id.to_owned(), what };
    let count = mesh.positions.len();
    if let Some(i) = mesh.positions.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
        return Err(broken(format!("vertex {i} has a coordinate that is no finite number")));
    }
    let in_range = |v: &u32| usize::try_from(*v).is_ok_and(|v| v < count);
    for (i, panel) in mesh.panels.iter().enumerate() {
        if !(3..=4).contains(&panel.len()) || !panel.iter().all(in_range) {
            return Err(broken(format!("panel {i} is {panel:?}, of {count} vertices")));
        }
    }
    if let Some(singular) = mesh.singular.iter().find(|singular| !in_range(&singular.vertex)) {
        return Err(broken(format!("singular vertex {} of {count}", singular.vertex)));
    }
    let per_panel = |name: &str, values: &[Option<f64>]| match values.len() {
        0 => Ok(None),
        n if n == mesh.panels.len() => Ok(Some(field(values.iter().copied()))),
        n => Err(broken(format!("{n} values of {name} for {} panels", mesh.panels.len()))),
    };
    let (low, step, positions) = pack_positions(&mesh.positions);
    Ok(Packed {
        vertices: count,
        panels: mesh.panels.len(),
        low,
        step,
        positions,
        corners: pack_corners(&mesh.panels),
        singular: mesh.singular.iter().map(|s| [s.vertex, s.mark as u32]).collect(),
        curvature: per_panel("curvature", &mesh.curvature)?,
        skewness: per_panel("skewness", &mesh.skewness)?,
        utilisation: member_field(mesh).map_err(broken)?,
    })
}

fn pack_positions(positions: &[[f64; 3]]) -> ([f64; 3], [f64; 3], String) {
    let mut low = [0.0; 3];
    let mut step = [0.0; 3];
    let mut bytes = Vec::with_capacity(positions.len() * 6);
    for axis in 0..3 {
        let values = || positions.iter().map(|p| p[axis]);
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(f64::NEG_INFINITY, f64::max);
        if least <= most {
            low[axis] = least;
            step[axis] = (most - least) / f64::from(u16::MAX);
        }
        for value in values() {
            bytes.extend(to_step(value - low[axis], most - least, u16::MAX).to_le_bytes());
        }
    }
    (low, step, base64(&bytes))
}

/// `value` of `0..=range` as an integer of `0..=steps`.
fn to_step(value: f64, range: f64, steps: u16) -> u16 {
    if range <= 0.0 {
        return 0;
    }
    // Within 0..=65535 by the clamp, so that the cast is exact.
    (value / range * f64::from(steps)).round().clamp(0.0, f64::from(steps)) as u16
}

fn pack_corners(panels: &[Vec<u32>]) -> String {
    let mut bytes = Vec::new();
    let mut before = [0_i64; 4];
    for panel in panels {
        put_varint(&mut bytes, panel.len() as u64);
        for (corner, previous) in panel.iter().zip(&mut before) {
            let difference = i64::from(*corner) - *previous;
            put_varint(&mut bytes, ((difference << 1) ^ (difference >> 63)) as u64);
            *previous = i64::from(*corner);
        }
    }
    base64(&bytes)
}

fn put_varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push((value & 0x7f) as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

fn field(values: impl Iterator<Item = Option<f64>> + Clone) -> Field {
    let known = |v: Option<f64>| v.filter(|v| v.is_finite());
    let mut sorted: Vec<f64> = values.clone().filter_map(known).map(|v| v.max(0.0)).collect();
    sorted.sort_by(f64::total_cmp);
    let max = sorted.last().copied().unwrap_or(0.0);
    let high = sorted.get(sorted.len() * 98 / 100).copied().unwrap_or(0.0);
    let bytes: Vec<u8> = values
        .flat_map(|v| known(v).map_or(NO_VALUE, |v| to_step(v, max, NO_VALUE - 1)).to_le_bytes())
        .collect();
    Field { max, high, values: base64(&bytes) }
}

/// Utilisation in the order in which the page finds the members: the panels' edges, sorted.
fn member_field(mesh: &Mesh) -> Result<Option<Field>, String> {
    if mesh.utilisation.is_empty() {
        return Ok(None);
    }
    if mesh.utilisation.len() != mesh.edges.len() {
        return Err(format!(
            "{} values of utilisation for {} members",
            mesh.utilisation.len(),
            mesh.edges.len()
        ));
    }
    let mut by_edge: BTreeMap<[u32; 2], Option<f64>> = panel_edges(&mesh.panels).map(|e| (e, None)).collect();
    for (&[a, b], &value) in mesh.edges.iter().zip(&mesh.utilisation) {
        let slot = by_edge.get_mut(&[a.min(b), a.max(b)]);
        *slot.ok_or_else(|| format!("member {a}–{b} is no edge of a panel"))? = value;
    }
    Ok(Some(field(by_edge.values().copied())))
}

fn panel_edges(panels: &[Vec<u32>]) -> impl Iterator<Item = [u32; 2]> {
    panels
        .iter()
        .flat_map(|panel| panel.iter().zip(panel.iter().cycle().skip(1)).map(|(&a, &b)| [a.min(b), a.max(b)]))
}

/// RFC 4648 §4, with padding.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let group = chunk.iter().fold(0_u32, |g, &b| g << 8 | u32::from(b)) << (8 * (3 - chunk.len()));
        for i in 0..4 {
            let digit = DIGITS[(group >> (18 - 6 * i)) as usize & 63];
            text.push(if i <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_matches_the_vectors_of_rfc_4648() {
        let pairs = [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in pairs {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn varints_are_leb128() {
        let mut bytes = Vec::new();
        put_varint(&mut bytes, 300);
        put_varint(&mut bytes, 5);
        assert_eq!(bytes, [0xac, 0x02, 5]);
    }

    fn square() -> Mesh {
        Mesh {
            positions: vec![[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 1.0, 1.0], [0.0, 1.0, 1.0]],
            panels: vec![vec![0, 1, 2, 3]],
            edges: vec![[0, 1], [1, 2], [2, 3], [3, 0]],
            utilisation: vec![Some(0.1), Some(0.2), Some(0.4), None],
            ..Mesh::default()
        }
    }

    #[test]
    fn members_follow_their_sorted_edges() {
        let packed = pack("a", &square()).unwrap().utilisation.unwrap();
        assert_eq!(packed.max, 0.4);
        // Sorted: 0–1, 0–3, 1–2, 2–3.
        let steps = [16384_u16, NO_VALUE, 32767, 65534];
        let bytes: Vec<u8> = steps.iter().flat_map(|s| s.to_le_bytes()).collect();
        assert_eq!(packed.values, base64(&bytes));
    }

    #[test]
    fn a_flat_mesh_has_no_step_upwards() {
        let packed = pack("a", &square()).unwrap();
        assert_eq!((packed.low, packed.step[2]), ([0.0, 0.0, 1.0], 0.0));
    }

    #[test]
    fn broken_meshes_are_named() {
        let broken = |change: fn(&mut Mesh)| {
            let mut mesh = square();
            change(&mut mesh);
            pack("c0ffee", &mesh).err().unwrap().to_string()
        };
        assert!(broken(|m| m.positions[2][1] = f64::NAN).contains("design c0ffee: vertex 2"));
        assert!(broken(|m| m.panels[0][3] = 4).contains("panel 0"));
        assert!(broken(|m| m.curvature = vec![None; 3]).contains("3 values of curvature for 1 panels"));
        assert!(broken(|m| m.edges[3] = [0, 2]).contains("member 0–2"));
        assert!(broken(|m| m.edges.truncate(3)).contains("4 values of utilisation for 3 members"));
    }
}
