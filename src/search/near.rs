//! The first population where it is looked for near the initial mesh (docs/reference/search.md §2.3).

use std::collections::{BTreeSet, VecDeque};

use super::problem::{Identity, Problem, Steps};
use super::server::Server;
use crate::grammar::Tokens;
use crate::mesh::canonical::Code;

/// Goes through the neighbourhood of the initial mesh in a fixed order: one natural step; two; then one strip along any
/// short simple polyedge. Strings come as they are asked for, so that none is made that no budget reaches.
#[derive(Clone, Debug)]
pub(crate) struct Near {
    /// Where steps are still to be taken from.
    sources: VecDeque<Source>,
    /// Strings made and not yet handed out.
    made: VecDeque<(Tokens, Identity)>,
    /// Topologies from which a second step is or will be taken.
    stepped: BTreeSet<Code>,
}

#[derive(Clone, Debug)]
struct Source {
    expressed: Tokens,
    steps: Steps,
    /// Whether a second step follows.
    first: bool,
}

impl Near {
    /// Before the first step from the initial mesh, which the empty string stands for.
    pub(crate) fn new() -> Self {
        let source = |steps, first| Source { expressed: Tokens::default(), steps, first };
        Self {
            sources: [source(Steps::Natural, true), source(Steps::Simple, false)].into(),
            made: VecDeque::new(),
            stepped: BTreeSet::new(),
        }
    }

    /// The next string and what it means; those that topology alone rules out are left out, but steps from them are taken.
    pub(crate) fn next<P: Problem>(
        &mut self,
        problem: &P,
        server: &dyn Server,
    ) -> Option<(Tokens, Identity)> {
        loop {
            if let Some(made) = self.made.pop_front() {
                return Some(made);
            }
            let source = self.sources.pop_front()?;
            let strings = problem.steps(source.steps, &source.expressed);
            let identities = server.identify(&strings);
            // A string that cannot be read is no step.
            let named = strings.into_iter().zip(identities).filter_map(|(s, i)| i.ok().map(|i| (s, i)));
            let mut further = Vec::new();
            for (tokens, identity) in named {
                if source.first && self.stepped.insert(identity.code) {
                    let expressed = identity.expressed.clone();
                    further.push(Source { expressed, steps: Steps::Natural, first: false });
                }
                if identity.rejected.is_none() {
                    self.made.push_back((tokens, identity));
                }
            }
            // Before the simple polyedges.
            further.into_iter().rev().for_each(|source| self.sources.push_front(source));
        }
    }
}
