//! Symmetries of designs: those that the config asks for, and those that a design has.

use super::{Study, StudyError};
use crate::domain::params::Pinched;
use crate::domain::{self, Domain, DomainError};
use crate::geometry::images::{self, Image};
use crate::geometry::limits::Limits;
use crate::geometry::{self, Rejection};
use crate::mesh::fold::Mirror;
use crate::mesh::{CanonicalMesh, Symmetries};

/// The reflections of a config, as they act on meshes.
pub fn mirrors(domain: &Domain, kinds: &[domain::Symmetry]) -> Result<Vec<Mirror>, StudyError> {
    let mut mirrors: Vec<Mirror> = Vec::new();
    for &kind in kinds {
        let name = kind.name();
        if mirrors.iter().any(|mirror| mirror.name == name) {
            return Err(StudyError::MirrorTwice { symmetry: name });
        }
        let symmetry = domain.symmetry(kind).map_err(|error| match error {
            DomainError::NotSymmetric { symmetry, reason } => StudyError::NoMirror { symmetry, reason },
            other => other.into(),
        })?;
        let [sx, sy] = kind.signs();
        let [cx, cy, _] = domain.image([0.0; 3], kind);
        mirrors.push(Mirror { name, symmetry, plan: [[sx, 0.0, cx], [0.0, sy, cy]] });
    }
    Ok(mirrors)
}

impl Study {
    /// The reflections that every pattern is to have.
    pub fn mirrors(&self) -> &[domain::Symmetry] {
        &self.mirrors
    }

    /// The reflections and rotations of the domain that map a design onto itself.
    pub fn symmetries_of(&self, topology: &CanonicalMesh) -> Symmetries {
        images::symmetries(&Image::all(topology, &self.domain))
    }

    /// Why topology alone rules a design out, with `limits` also what would break them in every pattern.
    pub(super) fn rejection(&self, topology: &CanonicalMesh, limits: Option<&Limits>) -> Option<Rejection> {
        let asked = (!self.mirrors.is_empty()).then(|| Image::all(topology, &self.domain));
        let unsymmetric = asked.and_then(|images| {
            images::rejection(topology, &images, &self.mirrors, self.pinched == Pinched::Allow)
        });
        unsymmetric.or_else(|| geometry::topological_rejection(topology, &self.domain, self.pinched, limits))
    }
}
