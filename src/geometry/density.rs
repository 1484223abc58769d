//! How many rows each strip has (docs/reference/geometry.md §2.2).

use super::coarse::Coarse;
use super::dense::panel_count;

/// Steps of the bisection: enough for the last bit.
const STEPS: usize = 64;
/// Lengths that differ by less than this share of themselves are equal but for rounding.
const TIE: f64 = 1e-9;
/// Times that the rows of sides are looked at.
const ROUNDS: usize = 4;

/// How fine a pattern is to be.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Fineness {
    /// As near as possible to a number of panels.
    Panels(f64),
    /// Rows of a given width τ, in the unit of the lengths.
    Width(f64),
}

/// What rows are bound to beside their lengths.
#[derive(Clone, PartialEq, Debug)]
pub struct Bounds {
    /// Most rows of each strip.
    pub most: Vec<u32>,
    /// Fewest rows of each strip; these win over `most`.
    pub least: Vec<u32>,
    /// What ends on each side of the boundary.
    pub sides: Vec<SideRows>,
}

/// The rows that a side of the boundary needs, and the strips that end on it, as often as they do.
#[derive(Clone, PartialEq, Debug)]
pub struct SideRows {
    /// Fewest rows altogether.
    pub need: u32,
    /// The strips.
    pub strips: Vec<u32>,
}

/// Rows of all strips of the given lengths.
///
/// n(s) = min(most, max(1, ⌊L(s)/τ + ½⌋)), but at least `least`; τ by bisection where a number of panels is asked for. A side that is
/// short of rows gets one more of each strip on it that has the longest rows, among those below their most; then τ anew.
pub fn choose(coarse: &Coarse<'_>, lengths: &[f64], fineness: Fineness, bounds: &Bounds) -> Vec<u32> {
    let lengths = tied(lengths);
    let mut least = bounds.least.clone();
    let mut rows = at_fineness(coarse, &lengths, fineness, &bounds.most, &least);
    for _ in 0..ROUNDS {
        if !fill_sides(&lengths, bounds, &mut rows, &mut least) {
            break;
        }
        rows = at_fineness(coarse, &lengths, fineness, &bounds.most, &least);
    }
    rows
}

/// Lengths equal but for rounding made equal: sorted, each takes the value of its predecessor where it is within [`TIE`].
fn tied(lengths: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    order.sort_by(|&i, &j| lengths[i].total_cmp(&lengths[j]));
    let mut tied = lengths.to_vec();
    for pair in order.windows(2) {
        if tied[pair[1]] - tied[pair[0]] <= TIE * tied[pair[1]] {
            tied[pair[1]] = tied[pair[0]];
        }
    }
    tied
}

fn at_fineness(
    coarse: &Coarse<'_>,
    lengths: &[f64],
    fineness: Fineness,
    most: &[u32],
    least: &[u32],
) -> Vec<u32> {
    let rows = |width: f64| -> Vec<u32> {
        let of = |s: usize| (((lengths[s] / width + 0.5).floor() as u32).max(1)).min(most[s]).max(least[s]);
        (0..lengths.len()).map(of).collect()
    };
    let panels = match fineness {
        Fineness::Width(width) => return rows(width),
        Fineness::Panels(panels) => panels,
    };
    let count = |width: f64| panel_count(coarse, &rows(width)) as f64;
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let (mut fine, mut rough) = (shortest / (panels + 1.0), 3.0 * longest);
    for _ in 0..STEPS {
        let middle = (fine * rough).sqrt();
        if count(middle) >= panels {
            fine = middle;
        } else {
            rough = middle;
        }
    }
    // Of two as near the denser one.
    let off = |width: f64| (count(width) - panels).abs();
    rows(if off(rough) < off(fine) { rough } else { fine })
}

/// Gives sides their rows as far as strips may have more; whether any got one. All sides are looked at before any strip gets one, and
/// strips with equal rows get one together, so that no numbering decides.
fn fill_sides(lengths: &[f64], bounds: &Bounds, rows: &mut [u32], least: &mut [u32]) -> bool {
    let mut changed = false;
    loop {
        let mut chosen = vec![false; rows.len()];
        for side in &bounds.sides {
            let there: u32 = side.strips.iter().map(|&s| rows[s as usize]).sum();
            if there < side.need {
                let width = |s: u32| lengths[s as usize] / f64::from(rows[s as usize]);
                let free =
                    || side.strips.iter().copied().filter(|&s| rows[s as usize] < bounds.most[s as usize]);
                let widest = free().map(width).fold(0.0, f64::max);
                free().filter(|&s| width(s) >= widest * (1.0 - TIE)).for_each(|s| chosen[s as usize] = true);
            }
        }
        if !chosen.contains(&true) {
            return changed;
        }
        for s in (0..rows.len()).filter(|&s| chosen[s]) {
            rows[s] += 1;
            least[s] = least[s].max(rows[s]);
        }
        changed = true;
    }
}
