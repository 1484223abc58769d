//! Counts: of the dense pattern, and of the coarse mesh it comes from.

use super::Metric;

/// Panels.
pub const FACES: Metric = Metric {
    name: "faces",
    column: "faces",
    unit: "",
    about: "panels, triangles included",
    structural: false,
    value: |design| Some(design.fabrication.panels as f64),
};

/// Triangles.
pub const TRIANGLES: Metric = Metric {
    name: "triangles",
    column: "triangles",
    unit: "",
    about: "triangular panels (at poles)",
    structural: false,
    value: |design| Some(design.fabrication.triangles as f64),
};

/// Nodes.
pub const NODES: Metric = Metric {
    name: "nodes",
    column: "nodes",
    unit: "",
    about: "nodes",
    structural: false,
    value: |design| Some(design.fabrication.nodes as f64),
};

/// Members.
pub const MEMBERS: Metric = Metric {
    name: "members",
    column: "members",
    unit: "",
    about: "members",
    structural: false,
    value: |design| Some(design.fabrication.members as f64),
};

/// Largest valence.
pub const VALENCE_MAX: Metric = Metric {
    name: "valence_max",
    column: "valence_max",
    unit: "",
    about: "most members at a node",
    structural: false,
    value: |design| Some(design.fabrication.valence_max as f64),
};

/// Strips.
pub const STRIPS: Metric = Metric {
    name: "strips",
    column: "strips",
    unit: "",
    about: "strips of the reduced coarse mesh",
    structural: false,
    value: |design| Some(design.fabrication.strips as f64),
};

/// Singular vertices.
pub const SINGULARITIES: Metric = Metric {
    name: "singularities",
    column: "singularities",
    unit: "",
    about: "singular vertices: inner, on the boundary, and poles",
    structural: false,
    value: |design| Some(design.fabrication.singularities.total() as f64),
};

/// Inner singular vertices.
pub const SINGULARITIES_INNER: Metric = Metric {
    name: "singularities_inner",
    column: "singularities_inner",
    unit: "",
    about: "inner vertices of a valence other than 4",
    structural: false,
    value: |design| Some(design.fabrication.singularities.inner as f64),
};

/// Boundary singular vertices.
pub const SINGULARITIES_BOUNDARY: Metric = Metric {
    name: "singularities_boundary",
    column: "singularities_boundary",
    unit: "",
    about: "boundary vertices of a valence other than 3",
    structural: false,
    value: |design| Some(design.fabrication.singularities.boundary as f64),
};

/// Poles.
pub const POLES: Metric = Metric {
    name: "poles",
    column: "poles",
    unit: "",
    about: "poles",
    structural: false,
    value: |design| Some(design.fabrication.singularities.poles as f64),
};
