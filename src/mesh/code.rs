//! Canonical codes (docs/reference/grammar.md §7): two meshes have the same code exactly when they are isomorphic.
//!
//! The darts are numbered from a root in a fixed traversal (from every dart, in number order, `next` before `twin`)
//! and the map is written down as one entry a dart: number of `next`, number of `twin`, colour. The smallest list
//! over the roots is the code. Colours and roots are those of the reference cases, so that codes can be compared.

use sha2::{Digest, Sha256};

use super::canonical::Code;
use super::ids::DartId;
use super::quad_mesh::QuadMesh;

/// One entry of a code: number of `next`, number of `twin`, rank of the colour.
type Entry = [u32; 3];

/// The smallest code of a mesh, written down.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Numbering {
    /// The darts in the order of discovery.
    pub order: Vec<DartId>,
    entries: Vec<Entry>,
    colours: Vec<u128>,
}

/// The code of a mesh. `placed`: labels of loops and corner marks count.
pub fn code(mesh: &QuadMesh, placed: bool) -> Code {
    number(mesh, placed).code()
}

/// The code with the given dart as its only root: equal exactly when mesh and dart are the same.
pub fn rooted_code(mesh: &QuadMesh, root: DartId, placed: bool) -> Code {
    let (ranks, colours) = Colours::of(mesh, placed).ranked();
    smallest(mesh, &[root], ranks, colours).code()
}

/// The numbering that gives the smallest code. Roots are the darts of the rarest colour (ties: the largest one).
pub fn number(mesh: &QuadMesh, placed: bool) -> Numbering {
    let (ranks, colours) = Colours::of(mesh, placed).ranked();
    let mut counts = vec![0usize; colours.len()];
    ranks.iter().for_each(|&rank| counts[rank as usize] += 1);
    let rarest = (0..counts.len()).rev().min_by_key(|&rank| counts[rank]).unwrap_or(0);
    let roots: Vec<DartId> = mesh.darts().filter(|d| ranks[d.index()] as usize == rarest).collect();
    smallest(mesh, &roots, ranks, colours)
}

impl Numbering {
    /// The code as it is compared: one (next, twin, colour) a dart.
    fn written(&self) -> impl Iterator<Item = (u32, u32, u128)> + '_ {
        self.entries.iter().map(|&[next, twin, rank]| (next, twin, self.colours[rank as usize]))
    }

    /// Lexicographic order of codes: which of several meshes has the smaller one.
    pub fn is_smaller_than(&self, other: &Self) -> bool {
        self.written().lt(other.written())
    }

    /// SHA-256 of all numbers of the code joined by commas.
    pub fn code(&self) -> Code {
        let mut text: Vec<u8> = Vec::with_capacity(self.entries.len() * 12);
        for (next, twin, colour) in self.written() {
            push_number(&mut text, u128::from(next));
            push_number(&mut text, u128::from(twin));
            push_number(&mut text, colour);
        }
        text.pop();
        let digest = Sha256::digest(&text);
        Code(digest.iter().take(16).fold(0, |code, &byte| code << 8 | u128::from(byte)))
    }
}

/// Appends a number in decimal, and a comma.
fn push_number(text: &mut Vec<u8>, mut number: u128) {
    let start = text.len();
    loop {
        text.push(b'0' + (number % 10) as u8);
        number /= 10;
        if number == 0 {
            break;
        }
    }
    text[start..].reverse();
    text.push(b',');
}

/// The colour of every dart, in the numbers of the reference cases.
struct Colours(Vec<u128>);

impl Colours {
    /// 0 inside, 1 inside and leaving the pole corner of its pseudo-quad, 2 outside (placed: 2 + loop label);
    /// placed: + 1000 × the sum of 2^k over the corner numbers k that mark its origin.
    fn of(mesh: &QuadMesh, placed: bool) -> Self {
        let mut marks = vec![0u128; if placed { mesh.vertex_count() } else { 0 }];
        if placed {
            for mark in mesh.marks() {
                marks[mark.vertex.index()] |= 1 << mark.corner;
            }
        }
        let colour = |d: DartId| {
            let dart = mesh.dart(d);
            let side = match (dart.left.as_loop(), dart.left.as_seam()) {
                (Some(label), _) if placed => 2 + u128::from(label),
                (Some(_), _) => 2,
                // Seams are told from all loops.
                (None, Some(fold)) => 2 + u128::from(mesh.loop_count) + u128::from(fold),
                (None, None) => u128::from(dart.pole),
            };
            side + if placed { 1000 * marks[dart.origin.index()] } else { 0 }
        };
        Self(mesh.darts().map(colour).collect())
    }

    /// The rank of each dart's colour, and the colours in ascending order: comparing ranks is comparing colours.
    fn ranked(self) -> (Vec<u32>, Vec<u128>) {
        let mut colours: Vec<u128> = Vec::with_capacity(16);
        let mut ranks: Vec<u32> = Vec::with_capacity(self.0.len());
        for &colour in &self.0 {
            let found = colours.iter().position(|&known| known == colour);
            ranks.push(found.unwrap_or(colours.len()) as u32);
            if found.is_none() {
                colours.push(colour);
            }
        }
        let mut sorted = colours.clone();
        sorted.sort_unstable();
        let rank_of: Vec<u32> =
            colours.iter().map(|colour| sorted.partition_point(|known| known < colour) as u32).collect();
        ranks.iter_mut().for_each(|rank| *rank = rank_of[*rank as usize]);
        (ranks, sorted)
    }
}

const UNSEEN: u32 = u32::MAX;

/// The smallest code over some roots. A root is given up at the first entry that is larger than the best so far.
fn smallest(mesh: &QuadMesh, roots: &[DartId], ranks: Vec<u32>, colours: Vec<u128>) -> Numbering {
    let count = mesh.darts.len();
    let mut best: Vec<Entry> = Vec::with_capacity(count);
    let mut best_order: Vec<DartId> = Vec::new();
    let mut order: Vec<DartId> = Vec::with_capacity(count);
    let mut number = vec![UNSEEN; count];
    for &root in roots {
        order.iter().for_each(|d| number[d.index()] = UNSEEN);
        order.clear();
        order.push(root);
        number[root.index()] = 0;
        // Ahead: every entry so far equals the best code's, so the first that differs decides.
        let mut ahead = !best.is_empty();
        let mut lost = false;
        let mut i = 0;
        while let Some(&d) = order.get(i) {
            let dart = mesh.dart(d);
            let mut numbered = |e: DartId| {
                let slot = &mut number[e.index()];
                if *slot == UNSEEN {
                    *slot = order.len() as u32;
                    order.push(e);
                }
                *slot
            };
            let entry = [numbered(dart.next), numbered(dart.twin), ranks[d.index()]];
            if ahead {
                match entry.cmp(&best[i]) {
                    std::cmp::Ordering::Less => {
                        ahead = false;
                        best.truncate(i);
                        best.push(entry);
                    }
                    std::cmp::Ordering::Equal => {}
                    std::cmp::Ordering::Greater => {
                        lost = true;
                        break;
                    }
                }
            } else {
                best.push(entry);
            }
            i += 1;
        }
        if !lost && !ahead {
            best_order.clone_from(&order);
        }
    }
    Numbering { order: best_order, entries: best, colours }
}
