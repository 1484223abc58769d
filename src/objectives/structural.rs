//! Numbers of the frame analysis (docs/reference/structure.md §6.2).

use super::Metric;

/// Steel mass of the members.
pub const MASS: Metric = Metric {
    name: "mass",
    column: "mass_kg",
    unit: "kg",
    about: "mass of the members",
    structural: true,
    value: |design| design.response.map(|r| r.mass_kg),
};

/// F of the paper.
pub const DEFLECTION: Metric = Metric {
    name: "deflection",
    column: "deflection_m",
    unit: "m",
    about: "F: largest resultant displacement of a node, the worst over the combinations required of it (or `sls`)",
    structural: true,
    value: |design| design.response.map(|r| r.deflection_m),
};

/// U of the paper, outside the excluded zones.
pub const UTILISATION: Metric = Metric {
    name: "utilisation",
    column: "utilisation",
    unit: "",
    about: "U: largest elastic utilisation outside the excluded zones, the worst over the combinations required of it (or `uls`)",
    structural: true,
    value: |design| design.response.map(|r| r.utilisation),
};

/// 1/B of the paper; 0 where nothing buckles.
pub const BUCKLING: Metric = Metric {
    name: "buckling",
    column: "buckling",
    unit: "",
    about: "1/B: inverse of the first positive buckling factor, the worst over the combinations required of it (or `uls`); 0 where there is none",
    structural: true,
    value: |design| design.response.map(|r| 1.0 / r.buckling_factor),
};

/// Height of the section.
pub const HEIGHT: Metric = Metric {
    name: "height",
    column: "height_m",
    unit: "m",
    about: "height of the section: fixed, or the least that meets all requirements",
    structural: true,
    value: |design| design.response.map(|r| r.height_m),
};

/// B of the paper.
pub const BUCKLING_FACTOR: Metric = Metric {
    name: "buckling_factor",
    column: "buckling_factor",
    unit: "",
    about: "B: first positive buckling factor, the least over the combinations required of it (or `uls`); none where nothing buckles",
    structural: true,
    value: |design| design.response.map(|r| r.buckling_factor),
};

/// Utilisation with torsion and shear.
pub const UTILISATION_VON_MISES: Metric = Metric {
    name: "utilisation_von_mises",
    column: "utilisation_von_mises",
    unit: "",
    about: "largest von Mises utilisation, with torsion and shear, outside the excluded zones",
    structural: true,
    value: |design| design.response.map(|r| r.utilisation_von_mises),
};

/// The paper's utilisation.
pub const UTILISATION_ALL: Metric = Metric {
    name: "utilisation_all",
    column: "utilisation_all",
    unit: "",
    about: "largest elastic utilisation of all members, those at the corners included",
    structural: true,
    value: |design| design.response.map(|r| r.utilisation_all),
};

/// Vertical part of the deflection.
pub const DEFLECTION_VERTICAL: Metric = Metric {
    name: "deflection_vertical",
    column: "deflection_vertical_m",
    unit: "m",
    about: "largest vertical displacement of a node, the worst over the combinations required of it (or `sls`)",
    structural: true,
    value: |design| design.response.map(|r| r.deflection_vertical_m),
};

/// Mass over the true area of all panels.
pub const MASS_PER_AREA: Metric = Metric {
    name: "mass_per_area",
    column: "mass_per_area_kg_m2",
    unit: "kg/m²",
    about: "mass of the members over the true area of all panels",
    structural: true,
    value: |design| {
        let area = design.fabrication.panel_area_mean * design.fabrication.panels as f64;
        design.response.map(|r| r.mass_kg / area)
    },
};

/// Largest pull on a support.
pub const UPLIFT: Metric = Metric {
    name: "uplift",
    column: "uplift_kn",
    unit: "kN",
    about: "largest downward pull that a support must give",
    structural: true,
    value: |design| design.response.map(|r| r.uplift_kn),
};

/// Largest horizontal movement of a support.
pub const SUPPORT_SLIDE: Metric = Metric {
    name: "support_slide",
    column: "support_slide_m",
    unit: "m",
    about: "largest horizontal movement of a supported node",
    structural: true,
    value: |design| design.response.map(|r| r.support_slide_m),
};
