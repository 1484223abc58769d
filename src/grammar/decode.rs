//! Decoding: a string read to its end (docs/reference/grammar.md §2).

use crate::mesh::{DartId, InitialMesh, QuadMesh};

use super::rules::Rules;
use super::tokens::{Token, Tokens};
use super::walker::{Effect, Walker};

/// What a string means.
#[derive(Clone, Debug)]
pub struct Decoded {
    /// The mesh at the end.
    pub mesh: QuadMesh,
    /// The marker at the end.
    pub marker: DartId,
    /// One record a token.
    pub trace: Vec<Effect>,
    /// The string without what had no effect on the mesh; it decodes to the same mesh with nothing skipped.
    pub expressed: Tokens,
}

/// Reads a string from an initial mesh. Total: every string gives a valid mesh.
pub fn decode(initial: &InitialMesh, tokens: &Tokens, rules: Rules) -> Decoded {
    let mut walker = Walker::new(initial, rules);
    let trace: Vec<Effect> = tokens.iter().map(|&token| walker.apply(token)).collect();
    let expressed = express(tokens, &trace);
    let (mesh, marker) = walker.into_parts();
    Decoded { mesh, marker, trace, expressed }
}

/// The given string without skipped `D`, without both `A` of a skipped pair, without an `A` never closed, and
/// without everything after the last applied rule.
pub fn express(tokens: &Tokens, trace: &[Effect]) -> Tokens {
    let applied = trace.iter().rposition(Effect::is_applied).map_or(0, |last| last + 1);
    let mut kept: Vec<bool> = vec![true; applied];
    let mut opened = None;
    for (i, effect) in trace[..applied].iter().enumerate() {
        match effect {
            Effect::Collecting => {
                opened = Some(i);
                kept[i] = false;
            }
            Effect::Added(_) => {
                opened.take().into_iter().for_each(|first: usize| kept[first] = true);
            }
            Effect::Skipped(_) => kept[i] = false,
            Effect::Turned | Effect::Pivoted | Effect::Deleted(_) => {}
        }
    }
    tokens.iter().zip(kept).filter(|&(_, kept)| kept).map(|(&token, _): (&Token, bool)| token).collect()
}
