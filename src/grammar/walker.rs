//! The marker and the mesh it walks on: one token at a time (docs/reference/grammar.md §2–§4).

use crate::mesh::contract::contract;
use crate::mesh::subdivide::subdivide;
use crate::mesh::unzip::{self, Course, End, unzip};
use crate::mesh::validate::Invalid;
use crate::mesh::{DartId, InitialMesh, QuadMesh, StripId, VertexId, strips, validate};

use super::rules::{self, Rules, Skip};
use super::tokens::Token;

/// What a token did: one record of the trace.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Effect {
    /// The marker went along its edge and turned left.
    Turned,
    /// The marker rotated clockwise about its position.
    Pivoted,
    /// Started collecting a polyedge.
    Collecting,
    /// A strip was added along the polyedge.
    Added(Added),
    /// A strip was deleted.
    Deleted(Deleted),
    /// Nothing happened to the mesh.
    Skipped(Skip),
}

impl Effect {
    /// True if the mesh changed.
    pub fn is_applied(&self) -> bool {
        matches!(self, Self::Added(_) | Self::Deleted(_))
    }
}

/// A strip addition.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Added {
    /// Label of the new strip.
    pub strip: StripId,
    /// Number of its edges in the new mesh.
    pub edges: usize,
    /// Number of new faces.
    pub faces: usize,
    /// How the strip runs.
    pub course: Course,
}

impl Added {
    /// How it ends: `["closed"]`, or what its start and its end are.
    pub fn ends(&self) -> Vec<&'static str> {
        let name = |end: End| if end == End::Pole { "pole" } else { "boundary" };
        match self.course {
            Course::Closed => vec!["closed"],
            Course::Open(ends) => ends.map(name).to_vec(),
        }
    }
}

/// A strip deletion.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Deleted {
    /// Label of the strip that is gone.
    pub strip: StripId,
    /// Strips subdivided before, to keep the boundaries, and into how many, by label.
    pub refined: Vec<(StripId, usize)>,
}

/// The marker on its mesh, and the polyedge while it is collecting.
///
/// Cheap to clone: a coarse mesh is a few kilobytes, so a search can look ahead on a copy.
#[derive(Clone, Debug)]
pub struct Walker {
    mesh: QuadMesh,
    marker: DartId,
    polyedge: Option<Polyedge>,
    rules: Rules,
    /// Whether strips may end in poles.
    poles: bool,
    /// Where rules are tried; taken over only when they hold.
    draft: QuadMesh,
}

#[derive(Clone, Debug)]
struct Polyedge {
    opened_with: Token,
    darts: Vec<DartId>,
}

impl Walker {
    /// A marker at its start.
    pub fn new(initial: &InitialMesh, rules: Rules) -> Self {
        Self {
            mesh: initial.mesh.clone(),
            marker: initial.marker,
            polyedge: None,
            rules,
            poles: initial.poles,
            draft: QuadMesh::default(),
        }
    }

    /// The mesh as it is now; always valid.
    pub fn mesh(&self) -> &QuadMesh {
        &self.mesh
    }

    /// The marker: a dart of [`Self::mesh`].
    pub fn marker(&self) -> DartId {
        self.marker
    }

    /// The marker's position.
    pub fn position(&self) -> VertexId {
        self.mesh.origin(self.marker)
    }

    /// The polyedge as darts of [`Self::mesh`] that meet, ending at the position; `None` when not collecting.
    pub fn polyedge(&self) -> Option<&[DartId]> {
        self.polyedge.as_ref().map(|polyedge| polyedge.darts.as_slice())
    }

    /// The mesh and the marker.
    pub fn into_parts(self) -> (QuadMesh, DartId) {
        (self.mesh, self.marker)
    }

    /// Applies one token. Total: what cannot be done is skipped, and the effect says why.
    pub fn apply(&mut self, token: Token) -> Effect {
        match token {
            Token::Turn => self.turn(),
            Token::Pivot => {
                self.marker = self.mesh.clockwise(self.marker);
                Effect::Pivoted
            }
            Token::Delete => match self.delete() {
                Ok(deleted) => Effect::Deleted(deleted),
                Err(skip) => Effect::Skipped(skip),
            },
            Token::Add | Token::AddPole | Token::AddClosed if self.polyedge.is_none() => {
                self.polyedge = Some(Polyedge { opened_with: token, darts: Vec::new() });
                Effect::Collecting
            }
            Token::Add | Token::AddPole | Token::AddClosed => {
                let outcome = self.draft_addition(token);
                self.polyedge = None;
                match outcome {
                    Ok(added) => {
                        std::mem::swap(&mut self.mesh, &mut self.draft);
                        Effect::Added(added)
                    }
                    Err(skip) => Effect::Skipped(skip),
                }
            }
        }
    }

    /// What the closing `A…` would do now, without doing it; `None` when not collecting.
    pub fn preview_addition(&mut self, closing: Token) -> Option<Result<Added, Skip>> {
        self.polyedge.is_some().then(|| self.draft_addition(closing))
    }

    fn turn(&mut self) -> Effect {
        if let Some(polyedge) = &mut self.polyedge {
            polyedge.darts.push(self.marker);
        }
        self.marker = self.mesh.next(self.marker);
        Effect::Turned
    }

    /// Strip addition (§3) on the draft. Every dart keeps its identity, so the marker needs no care.
    fn draft_addition(&mut self, closing: Token) -> Result<Added, Skip> {
        let (opening, path) = match &self.polyedge {
            Some(polyedge) => (polyedge.opened_with, polyedge.darts.as_slice()),
            None => (closing, [].as_slice()),
        };
        let course = course(&self.mesh, path, [opening, closing]);
        if !self.poles && matches!(course, Course::Open(ends) if ends.contains(&End::Pole)) {
            return Err(Skip::NoPoles);
        }
        unzip::applicable(&self.mesh, path, course)?;
        self.draft.copy_from(&self.mesh);
        let strip = unzip(&mut self.draft, path, course);
        validate::check_simple(&self.draft)?;
        rules::keep_frozen(&self.mesh, &self.draft)?;
        self.rules.allow(&self.mesh, &self.draft)?;
        Ok(Added {
            strip,
            edges: strips::edge_count(&self.draft, strip),
            faces: self.draft.face_count() - self.mesh.face_count(),
            course,
        })
    }

    /// Strip deletion (§4).
    fn delete(&mut self) -> Result<Deleted, Skip> {
        let strip = self.mesh.strip(self.marker);
        if self.mesh.around(self.marker).all(|d| self.mesh.strip(d) == strip) {
            return Err(Skip::PositionInsideStrip);
        }
        let refined = refinements(&self.mesh, strip)?;
        let is_refined = |label: StripId| refined.iter().any(|&(other, _)| other == label);
        if self.mesh.darts().any(|d| self.mesh.dart(d).frozen && is_refined(self.mesh.strip(d))) {
            return Err(Skip::Frozen);
        }
        let mut polyedge = self.polyedge.as_ref().map(|polyedge| polyedge.darts.clone());
        let old = if refined.is_empty() {
            &self.mesh
        } else {
            self.draft.copy_from(&self.mesh);
            for &(label, n) in &refined {
                let parts = subdivide(&mut self.draft, label, n);
                if let Some(darts) = &mut polyedge {
                    *darts = darts.iter().flat_map(|&d| parts.of(d)).collect();
                }
            }
            &self.draft
        };
        let contraction = contract(old, strip)?;
        rules::keep_seams(&self.mesh, &contraction.mesh)?;
        rules::keep_frozen(&self.mesh, &contraction.mesh)?;
        let marker = old
            .around(self.marker)
            .skip(1)
            .filter(|&d| old.strip(d) != strip)
            .find_map(|d| contraction.dart(old, d))
            .ok_or(Skip::MarkerLost)?;
        self.rules.allow(&self.mesh, &contraction.mesh)?;
        if let (Some(polyedge), Some(darts)) = (&mut self.polyedge, polyedge) {
            polyedge.darts = darts.into_iter().filter_map(|d| contraction.dart(old, d)).collect();
        }
        self.marker = marker;
        self.mesh = contraction.mesh;
        Ok(Deleted { strip, refined })
    }
}

/// How a strip runs by the tokens around its path. Closed if either carries `°`; but on a part of a symmetric mesh, where the path does not
/// come back to its start, `°` says of the end of a seam that the strip ends on the seam.
fn course(mesh: &QuadMesh, path: &[DartId], tokens: [Token; 2]) -> Course {
    let comes_back =
        matches!((path.first(), path.last()), (Some(&a), Some(&b)) if mesh.origin(a) == mesh.end(b));
    if tokens.contains(&Token::AddClosed) && (comes_back || !mesh.is_folded()) {
        return Course::Closed;
    }
    Course::Open(tokens.map(|token| match token {
        Token::AddPole => End::Pole,
        Token::AddClosed => End::OnSeam,
        _ => End::Regular,
    }))
}

/// Which strips must be subdivided, and into how many, before `strip` goes, so that every boundary loop keeps at
/// least 3 edges (§4.2), images counted. By label.
fn refinements(mesh: &QuadMesh, strip: StripId) -> Result<Vec<(StripId, usize)>, Invalid> {
    let mut refined: Vec<(StripId, usize)> = Vec::new();
    for (darts, label) in mesh.walls().iter().zip(0..) {
        let mut rest = darts.iter().map(|&d| mesh.strip(d)).filter(|&label| label != strip);
        let wanted = match (mesh.images_in_loop(label), rest.next(), rest.next(), rest.next()) {
            (0, ..) => Vec::new(),
            (_, None, ..) => return Err(Invalid::ShortLoop),
            (1, Some(only), None, _) => vec![(only, 3)],
            (1, Some(a), Some(b), None) => vec![(a, 2), (b, 2)],
            (2, Some(only), None, _) => vec![(only, 2)],
            _ => Vec::new(),
        };
        for (label, n) in wanted {
            match refined.iter_mut().find(|(known, _)| *known == label) {
                Some((_, most)) => *most = n.max(*most),
                None => refined.push((label, n)),
            }
        }
    }
    refined.sort_unstable();
    Ok(refined)
}
