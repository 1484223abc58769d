//! Polylines in pieces: CAD programs export a curve as pieces that meet end to end, each with vertices of its own.

use std::collections::BTreeMap;

/// Ends nearer to each other than this share of the size meet: exporters round to millimetres (docs/reference/files.md §4).
pub const MEET: f64 = 1e-4;

/// A polyline, and where it comes from.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// Its vertices; a closed one ends in its first, or at the place of it.
    pub vertices: Vec<u32>,
    /// The line of its first piece.
    pub line: usize,
    /// The widest gap between pieces that were joined.
    pub gap: f64,
}

impl Chain {
    fn ends(&self) -> [u32; 2] {
        [self.vertices[0], self.vertices[self.vertices.len() - 1]]
    }
}

/// Joins pieces that meet where no third one does: first those that have a vertex or a place in common, then open ends within
/// [`MEET`] of the size. The result is in the order of the first pieces.
pub(super) fn join(pieces: Vec<Chain>, vertices: &[[f64; 3]]) -> Vec<Chain> {
    let mut first: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    // −0 is 0.
    let bits = |v: u32| vertices[v as usize].map(|x| (x + 0.0).to_bits());
    let mut place = BTreeMap::new();
    for v in pieces.iter().flat_map(Chain::ends) {
        place.insert(v, *first.entry(bits(v)).or_insert(v));
    }
    let joined = link(pieces, &|v| place[&v], vertices);
    let near = near_ends(&joined, vertices);
    link(joined, &|v| near.get(&v).copied().unwrap_or(v), vertices)
}

/// Open ends that have exactly one other within reach: the end, and the one that stands for both.
fn near_ends(chains: &[Chain], vertices: &[[f64; 3]]) -> BTreeMap<u32, u32> {
    let at = |v: u32| vertices[v as usize];
    let used = || chains.iter().flat_map(|chain| &chain.vertices).map(|&v| at(v));
    let [low, high] = [f64::min, f64::max]
        .map(|pick| used().reduce(|a, b| std::array::from_fn(|k| pick(a[k], b[k]))).unwrap_or_default());
    let reach = MEET * distance(low, high);
    let open = chains.iter().filter(|chain| at(chain.ends()[0]) != at(chain.ends()[1]));
    let mut ends: Vec<u32> = open.flat_map(Chain::ends).collect();
    // Swept by x.
    ends.sort_by(|&a, &b| at(a)[0].total_cmp(&at(b)[0]).then(a.cmp(&b)));
    let mut partners: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (i, &a) in ends.iter().enumerate() {
        for &b in ends[i + 1..].iter().take_while(|&&b| at(b)[0] - at(a)[0] <= reach) {
            if distance(at(a), at(b)) <= reach {
                partners.entry(a).or_default().push(b);
                partners.entry(b).or_default().push(a);
            }
        }
    }
    let only = |v: u32| partners.get(&v).filter(|p| p.len() == 1).map(|p| p[0]);
    partners.keys().filter_map(|&v| only(v).filter(|&w| only(w) == Some(v)).map(|w| (v, v.min(w)))).collect()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
}

/// Joins chains at the nodes that their ends belong to.
fn link(pieces: Vec<Chain>, node: &dyn Fn(u32) -> u32, vertices: &[[f64; 3]]) -> Vec<Chain> {
    let mut links =
        Links { node, vertices, meeting: BTreeMap::new(), used: vec![false; pieces.len()], pieces };
    for (i, piece) in links.pieces.iter().enumerate() {
        let [first, last] = piece.ends().map(node);
        if first != last {
            links.meeting.entry(first).or_default().push(i);
            links.meeting.entry(last).or_default().push(i);
        }
    }
    let mut chains = Vec::new();
    for i in 0..links.pieces.len() {
        if std::mem::replace(&mut links.used[i], true) {
            continue;
        }
        let mut chain = links.pieces[i].clone();
        links.extend(&mut chain);
        chain.vertices.reverse();
        links.extend(&mut chain);
        chain.vertices.reverse();
        chains.push(chain);
    }
    chains
}

struct Links<'a> {
    node: &'a dyn Fn(u32) -> u32,
    vertices: &'a [[f64; 3]],
    pieces: Vec<Chain>,
    /// The pieces that end at each node.
    meeting: BTreeMap<u32, Vec<usize>>,
    used: Vec<bool>,
}

impl Links<'_> {
    /// Goes on at the end of the chain as long as exactly one other unused piece starts or ends there.
    fn extend(&mut self, chain: &mut Chain) {
        loop {
            let [first, last] = chain.ends();
            let (start, here) = ((self.node)(first), (self.node)(last));
            let Some(meeting) = self.meeting.get(&here).filter(|m| m.len() == 2 && start != here) else {
                return;
            };
            let Some(&next) = meeting.iter().find(|&&i| !self.used[i]) else { return };
            self.used[next] = true;
            let piece = &self.pieces[next];
            let mut more = piece.vertices.clone();
            if (self.node)(more[0]) != here {
                more.reverse();
            }
            let gap = distance(self.vertices[last as usize], self.vertices[more[0] as usize]);
            chain.gap = chain.gap.max(gap).max(piece.gap);
            chain.vertices.extend(&more[1..]);
        }
    }
}
