//! Forks to their exact places: equally far from all boundaries that they touch.

use super::graph::{Fork, Graph, plan};
use super::triangulation::{Site, distance};
use crate::domain::Domain;

/// Moves every fork to the point that is equally far from its boundaries, and its boundary points with it. A fork of more than
/// three boundaries that have no such point goes where the squares of the differences are least.
pub(super) fn forks(graph: &mut Graph, domain: &Domain) {
    for fork in graph.forks.iter_mut().flatten() {
        if let Some(refined) = refine(fork, domain) {
            *fork = refined;
        }
    }
}

/// Newton on |x − p_k(x)| = ρ, where p_k is the closest point on the k-th boundary; corners stay. `None` if it leads away.
fn refine(fork: &Fork, domain: &Domain) -> Option<Fork> {
    let start = fork.position;
    let radius = distance(start, plan(domain, fork.ring[0].site));
    let mut refined = fork.clone();
    for _ in 0..60 {
        for slot in refined.ring.iter_mut().filter(|s| s.site.corner.is_none()) {
            slot.site = follow(domain, slot.site, refined.position);
        }
        let step = newton_step(&refined, domain)?;
        let length = step[0].hypot(step[1]);
        let scale = if length > 0.2 * radius { 0.2 * radius / length } else { 1.0 };
        refined.position = [0, 1].map(|k| refined.position[k] + scale * step[k]);
        if distance(refined.position, start) > 0.5 * radius {
            return None;
        }
        if length < 1e-14 * radius {
            break;
        }
    }
    in_order(fork, &refined, domain).then_some(refined)
}

fn follow(domain: &Domain, site: Site, to: [f64; 2]) -> Site {
    Site { s: domain.loops[site.loop_number].closest_near(to, site.s), ..site }
}

/// The least-squares solution of g_k · δ − ρ = −d_k with the distances d_k and their gradients g_k.
fn newton_step(fork: &Fork, domain: &Domain) -> Option<[f64; 2]> {
    let mut normal = [[0.0; 3]; 3];
    let mut right = [0.0; 3];
    for slot in &fork.ring {
        let p = plan(domain, slot.site);
        let d = distance(fork.position, p);
        if d <= 0.0 {
            return None;
        }
        let row = [(fork.position[0] - p[0]) / d, (fork.position[1] - p[1]) / d, -1.0];
        for i in 0..3 {
            for j in 0..3 {
                normal[i][j] += row[i] * row[j];
            }
            right[i] -= row[i] * d;
        }
    }
    let determinant = determinant(&normal);
    if determinant.abs() < 1e-12 {
        return None;
    }
    let solve = |column: usize| {
        let mut m = normal;
        for (row, &value) in m.iter_mut().zip(&right) {
            row[column] = value;
        }
        self::determinant(&m) / determinant
    };
    Some([solve(0), solve(1)])
}

fn determinant(m: &[[f64; 3]; 3]) -> f64 {
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
}

/// Whether no boundary point has moved by more than half the way to another of the fork on the same loop.
fn in_order(before: &Fork, after: &Fork, domain: &Domain) -> bool {
    let gap = |a: Site, b: Site| {
        let length = domain.loops[a.loop_number].length();
        let way = (a.s - b.s).abs();
        way.min(length - way)
    };
    before.ring.iter().zip(&after.ring).enumerate().all(|(i, (old, new))| {
        let others = before
            .ring
            .iter()
            .enumerate()
            .filter(|&(k, o)| k != i && o.site.loop_number == old.site.loop_number);
        let nearest = others.map(|(_, o)| gap(old.site, o.site)).fold(f64::INFINITY, f64::min);
        gap(old.site, new.site) < 0.5 * nearest
    })
}
