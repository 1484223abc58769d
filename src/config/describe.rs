//! What a config means, in words, and what its author may not have thought of.

use super::Config;
use crate::domain::params::{CornerRule, Corners, LengthUnit, LoopParams};
use crate::geometry::params::{Density, MetricLimitParams, PatternParams};
use crate::objectives;
use crate::search::params::{SearchParams, Seeds};
use crate::skeleton::params::InitialMesh;
use crate::structure::model::Direction;
use crate::structure::params::{
    FactorParams, HeightParams, LoadParams, Quantity, RequirementParams, SectionParams, StructureParams,
    SupportNodes, SupportParams, SupportPlace,
};
use crate::surface::params::SurfaceParams;

/// The config in sentences, one for each decision it makes.
pub fn describe(config: &Config) -> Vec<String> {
    let mut lines = Vec::new();
    for (k, boundary_loop) in config.domain.loops.iter().enumerate() {
        let role = if k == 0 { "outer boundary".to_owned() } else { format!("hole {k}") };
        lines.push(format!("{role}: {}", describe_loop(boundary_loop)));
    }
    lines.push(format!("surface: {}", describe_surface(&config.surface)));
    lines.push(format!("initial mesh: {}", describe_initial(&config.topology.initial)));
    lines.extend(describe_pattern(&config.pattern));
    match &config.structure {
        Some(structure) => lines.extend(describe_structure(structure)),
        None => lines.push("structure: not analysed (there is no [structure])".into()),
    }
    lines.extend(config.pattern.metric_limits.iter().map(describe_limit));
    let Config { objectives, .. } = config;
    for (what, names) in [("minimised", &objectives.minimise), ("maximised", &objectives.maximise)] {
        lines.extend((!names.is_empty()).then(|| format!("{what}: {}", names.join(", "))));
    }
    lines.extend(describe_search(config));
    lines
}

/// Things that are allowed but seldom meant.
pub fn warnings(config: &Config) -> Vec<String> {
    let mut warnings = Vec::new();
    let objectives: Vec<&str> = config.objectives.names().map(String::as_str).collect();
    if let Some(structure) = &config.structure {
        pinned_objectives(structure, &objectives, &mut warnings);
        if structure.requirements.is_empty() {
            warnings.push(
                "no [[structure.requirement]]: nothing limits deflection, utilisation or buckling".into(),
            );
        }
    }
    if objectives.len() > 4 {
        warnings.push(many_objectives(config));
    }
    if objectives.len() == 1 {
        warnings.push("one objective: the front will hold one design".into());
    }
    if config.run.seed.is_none() {
        warnings.push(
            "no run.seed: each run draws one (and records it), so results differ from run to run".into(),
        );
    }
    warnings
}

/// What becomes of a front that holds most designs.
fn many_objectives(config: &Config) -> String {
    let (count, search) = (config.objectives.count(), &config.search);
    let survivors = match search.survival.by_hypervolume(count) {
        true => "which of them survive is decided by what they add to the hypervolume",
        false => {
            "which of them survive is decided by crowding alone, which does not tell good from bad (search.survival = \
             \"auto\" takes the hypervolume)"
        }
    };
    format!("{count} objectives: with more than 4 most designs are non-dominated; {survivors}")
}

/// A sized height is the least that meets all requirements: one of them is met exactly.
fn pinned_objectives(structure: &StructureParams, objectives: &[&str], warnings: &mut Vec<String>) {
    if !matches!(structure.height, HeightParams::Sized { .. }) {
        return;
    }
    for requirement in &structure.requirements {
        let name = match requirement.analysed() {
            Some(Quantity::BucklingFactor | Quantity::Buckling) => "buckling",
            Some(Quantity::Deflection) => "deflection",
            Some(Quantity::Utilisation) => "utilisation",
            _ => continue,
        };
        if objectives.contains(&name) {
            warnings.push(format!(
                "objective \"{name}\": the height is sized to the requirements, so the governing one sits at its limit \
                 in nearly every design and says little; minimise \"mass\" instead"
            ));
        }
    }
}

fn describe_loop(boundary_loop: &LoopParams) -> String {
    match boundary_loop {
        LoopParams::Polyline { points_m, corners, corner_angle_deg } => {
            format!("polyline of {} points, {}", points_m.len(), describe_corners(corners, *corner_angle_deg))
        }
        LoopParams::Circle { center_m, radius_m } => {
            format!("circle of radius {radius_m} m about {center_m:?}")
        }
        LoopParams::Ellipse { center_m, semi_axes_m: [a, b], .. } => {
            format!("ellipse with semi-axes {a} m and {b} m about {center_m:?}")
        }
        LoopParams::Obj { file, unit, polyline, corners, corner_angle_deg } => {
            let corners = describe_corners(corners, *corner_angle_deg);
            format!("polyline {polyline} of {}{}, {corners}", file.display(), describe_unit(*unit))
        }
    }
}

/// What is said of a file whose coordinates are not in metres.
fn describe_unit(unit: LengthUnit) -> &'static str {
    match unit {
        LengthUnit::M => "",
        LengthUnit::Cm => " (in centimetres)",
        LengthUnit::Mm => " (in millimetres)",
        LengthUnit::Ft => " (in feet)",
        LengthUnit::In => " (in inches)",
    }
}

fn describe_corners(corners: &Corners, angle: f64) -> String {
    match corners {
        Corners::Rule(CornerRule::All) => "each a corner".into(),
        Corners::Rule(CornerRule::Auto) => {
            format!("corners where it turns by more than {angle}° within a tenth of the target length")
        }
        Corners::Indices(indices) => format!("corners at points {indices:?}"),
    }
}

fn describe_surface(surface: &SurfaceParams) -> String {
    match surface {
        SurfaceParams::GreatCourt {} => "the Great Court roof (Williams 2001)".into(),
        SurfaceParams::Plane { z_m } => format!("the plane z = {z_m} m"),
        SurfaceParams::Height { expression, .. } => format!("z = {expression}"),
        SurfaceParams::Paraboloid { rise_m, half_spans_m: [a, b], .. } => {
            format!("a paraboloid that falls by {rise_m} m over {a} m and {b} m")
        }
        SurfaceParams::Hypar { rise_m, half_spans_m: [a, b], .. } => {
            format!("a hyperbolic paraboloid, {rise_m} m high at ({a} m, {b} m)")
        }
        SurfaceParams::Sphere { radius_m, .. } => {
            format!("the upper part of a sphere of radius {radius_m} m")
        }
        SurfaceParams::Cylinder { radius_m, .. } => {
            format!("the upper part of a cylinder of radius {radius_m} m")
        }
        SurfaceParams::Mesh { file, unit } => format!("the mesh {}{}", file.display(), describe_unit(*unit)),
        SurfaceParams::Free {} => "none; the relaxation finds the form".into(),
    }
}

fn describe_initial(initial: &InitialMesh) -> String {
    match initial {
        InitialMesh::Word(_) => "decomposition of the domain along its medial axis".into(),
        InitialMesh::File { file, unit } => format!("from {}{}", file.display(), describe_unit(*unit)),
        InitialMesh::Grid { grid: [m, n] } => format!("a grid of {m} × {n} faces"),
        InitialMesh::Inline { vertices, faces, .. } => {
            format!("{} vertices and {} faces written in the config", vertices.len(), faces.len())
        }
    }
}

fn describe_pattern(pattern: &PatternParams) -> Vec<String> {
    let density = match (pattern.density, pattern.target_length_m) {
        (Density::TargetLength, Some(length)) => format!("edges of about {length} m"),
        _ => format!("as near to {} panels as each topology can come", pattern.panels),
    };
    let limits = &pattern.limits;
    let mut parts = Vec::new();
    parts.push(match limits.min_edge_m {
        Some(length) => format!("members of at least {length} m"),
        None => "members of at least a quarter of the target length".into(),
    });
    parts.push(format!("at most {} × the target length", limits.max_edge_factor));
    parts.push(format!("panel angles of at least {}°", limits.min_angle_deg));
    parts.push(format!("at most {} members at a node", limits.max_valence));
    if limits.min_valence > 2 {
        parts.push(format!("at least {} members at an inner node", limits.min_valence));
    }
    if let Some(area) = limits.max_panel_area_m2 {
        parts.push(format!("panels of at most {area} m²"));
    }
    vec![
        format!("density: {density}, never more than {} panels", pattern.max_faces),
        format!("limits (constraints): {}", parts.join(", ")),
    ]
}

fn describe_structure(structure: &StructureParams) -> Vec<String> {
    let order = if structure.order == 1 { "first" } else { "second" };
    let height = match structure.height {
        HeightParams::Fixed { fixed_m } => format!("{} mm high", millimetres(fixed_m)),
        HeightParams::Sized { min_m, max_m, .. } => {
            format!("as high as the requirements need, {} to {} mm", millimetres(min_m), millimetres(max_m))
        }
    };
    let section = match structure.section {
        SectionParams::Box { width_m, thickness_m } => {
            format!("box {} mm wide, wall {} mm", millimetres(width_m), millimetres(thickness_m))
        }
        SectionParams::Round {} => "solid round bar".into(),
        SectionParams::Tube { thickness_m } => format!("round tube, wall {} mm", millimetres(thickness_m)),
        SectionParams::Properties { area_m2, iy_m4, .. } => {
            format!("section of given properties, A {} cm², Iy {} cm⁴", 1e4 * area_m2, 1e8 * iy_m4)
        }
    };
    let mut lines = vec![format!("structure: rigid frame, {order} order; {section}, {height}")];
    lines.extend(structure.supports.iter().map(describe_support));
    lines.extend(structure.loads.iter().map(|(name, load)| format!("load {name}: {}", describe_load(load))));
    for (name, factors) in &structure.combinations {
        let sum: Vec<String> = factors.iter().map(|(case, factor)| format!("{factor} {case}")).collect();
        lines.push(format!("combination {name}: {}", sum.join(" + ")));
    }
    lines.extend(structure.requirements.iter().map(describe_requirement));
    lines
}

/// A length as an engineer writes it.
fn millimetres(metres: f64) -> f64 {
    (metres * 1e6).round() / 1e3
}

fn describe_support(support: &SupportParams) -> String {
    let near = |points: &[[f64; 2]]| {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("({x} m, {y} m)")).collect();
        points.join(", ")
    };
    let places = support.nodes().into_iter().map(|(_, nodes)| match nodes {
        SupportNodes::Place(SupportPlace::Boundary) => "all boundary nodes".into(),
        SupportNodes::Place(SupportPlace::Corners) => "corners of the outer boundary".into(),
        SupportNodes::Place(SupportPlace::All) => "all nodes".into(),
        SupportNodes::Loop(k) => format!("nodes of boundary loop {k}"),
        SupportNodes::NodesNear(points) => format!("boundary nodes closest to {}", near(points)),
        SupportNodes::SidesNear(points) => format!("nodes of the sides closest to {}", near(points)),
        SupportNodes::InsideNear(points) => format!("nodes inside closest to {}", near(points)),
    });
    let place = places.collect::<Vec<String>>().join(" and ");
    let (_, springs) = support.holds();
    let springs = Direction::ALL.into_iter().zip(springs).filter(|(_, stiffness)| *stiffness > 0.0);
    let springs: Vec<String> = springs
        .map(|(direction, stiffness)| {
            let unit = if direction < Direction::Rx { "kN/m" } else { "kNm/rad" };
            format!("{} by {} {unit}", name_of(direction), stiffness / 1e3)
        })
        .collect();
    let fixed: Vec<&str> = support.fixed.iter().map(|direction| name_of(*direction)).collect();
    let words = [("fixed in", fixed.join(", ")), ("held in", springs.join(", "))];
    let words = words.into_iter().filter(|(_, list)| !list.is_empty());
    let words: Vec<String> = words.map(|(verb, list)| format!("{verb} {list}")).collect();
    format!("support: {place} {}", words.join(", "))
}

fn name_of(direction: Direction) -> &'static str {
    match direction {
        Direction::Ux => "x",
        Direction::Uy => "y",
        Direction::Uz => "z",
        Direction::Rx => "rotation about x",
        Direction::Ry => "rotation about y",
        Direction::Rz => "rotation about z",
    }
}

fn describe_load(load: &LoadParams) -> String {
    let times = match load.factor() {
        None => String::new(),
        Some(FactorParams::Text(text)) => format!(", times {text}"),
        Some(FactorParams::Table(table)) => format!(", times {}", table.expression),
    };
    match load {
        LoadParams::Gravity { g_m_s2 } => format!("self weight of the members, g = {g_m_s2} m/s²"),
        LoadParams::Area { down_pa, .. } => {
            format!("{} kN/m² downwards on the panels{times}", down_pa / 1000.0)
        }
        LoadParams::Projected { down_pa, .. } => {
            format!("{} kN/m² downwards on their plan projection{times}", down_pa / 1000.0)
        }
        LoadParams::Pressure { pressure_pa, .. } => {
            format!("{} kN/m² against the normals of the panels{times}", pressure_pa / 1000.0)
        }
        LoadParams::Temperature { kelvin } => format!("all members {kelvin:+} K"),
        LoadParams::Point { points_m, force_n: [x, y, z] } => {
            let points: Vec<String> = points_m.iter().map(|[x, y]| format!("({x} m, {y} m)")).collect();
            format!("({}, {}, {}) kN near {}", x / 1e3, y / 1e3, z / 1e3, points.join(", "))
        }
    }
}

fn describe_requirement(requirement: &RequirementParams) -> String {
    let quantity = match requirement.analysed() {
        Some(Quantity::DeflectionVertical) => "vertical deflection".to_owned(),
        Some(Quantity::UtilisationAll) => "utilisation of all members".to_owned(),
        Some(Quantity::UtilisationVonMises) => "von Mises utilisation".to_owned(),
        Some(Quantity::BucklingFactor) => "first buckling factor".to_owned(),
        _ => in_words(&requirement.quantity.to_string()),
    };
    let limit = limit(&requirement.quantity.to_string(), requirement.max, requirement.min);
    let combination = match (&requirement.combination, requirement.analysed()) {
        (Some(name), _) => format!(" under {name}"),
        (None, Some(_)) => " under every combination that it is told of".into(),
        (None, None) => String::new(),
    };
    format!("required: {quantity} {limit}{combination}")
}

fn describe_limit(limited: &MetricLimitParams) -> String {
    let MetricLimitParams { quantity, max, min } = limited;
    format!("pattern required: {} {}", in_words(quantity), limit(quantity, *max, *min))
}

/// The name of a metric as people say it.
fn in_words(name: &str) -> String {
    objectives::called(name).map_or(name, |metric| metric.name).replace('_', " ")
}

/// An upper or lower limit with the unit of the metric.
fn limit(metric: &str, max: Option<f64>, min: Option<f64>) -> String {
    let unit = match objectives::called(metric).map_or("", |metric| metric.unit) {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    match (max, min) {
        (Some(max), _) => format!("≤ {max}{unit}"),
        (None, min) => format!("≥ {}{unit}", min.unwrap_or(0.0)),
    }
}

fn describe_search(config: &Config) -> Vec<String> {
    let search = &config.search;
    let later = (search.population as u64).saturating_mul(search.islands as u64);
    let most = later.saturating_mul(u64::from(search.generations)).saturating_add(search.first() as u64);
    let mut stops = vec![format!("{} generations", search.generations)];
    stops.extend(search.evaluations.map(|n| format!("{n} structural evaluations")));
    stops.extend(search.minutes.map(|minutes| format!("{minutes} minutes")));
    stops.extend(
        search
            .stall_generations
            .map(|n| format!("{n} generations without a better front, once there is one")),
    );
    let seed = config.run.seed.map_or("drawn at random".to_owned(), |seed| seed.to_string());
    vec![
        format!(
            "search: population {}, at most {most} designs analysed, ends after {}; strings of {} to {} tokens; seed {seed}",
            search.population,
            stops.join(" or "),
            search.tokens.min,
            search.tokens.max
        ),
        format!("evaluated first: {}", seeds(&search.seeds)),
        kept(search),
        match search.survival.by_hypervolume(config.objectives.count()) {
            true => "of the last front that survives, what adds most to the hypervolume stays",
            false => "of the last front that survives, what is least crowded stays",
        }
        .to_owned(),
    ]
}

/// What strings may not do.
fn kept(search: &SearchParams) -> String {
    let frozen = &search.frozen;
    let count =
        |n: usize, what: &str| (n > 0).then(|| format!("{n} {what}{}", if n == 1 { "" } else { "s" }));
    let named = [count(frozen.strips.len(), "strip"), count(frozen.regions_m.len(), "region")];
    let named: Vec<String> = named.into_iter().flatten().collect();
    let frozen = if named.is_empty() { "nothing".to_owned() } else { named.join(" and ") };
    let poles = if search.poles { "may end in poles" } else { "may not end in poles" };
    format!("frozen of the initial mesh: {frozen}; strips {poles}")
}

fn seeds(seeds: &Seeds) -> String {
    let initial = "the initial mesh".to_owned();
    let named = match seeds {
        Seeds::Strings(strings) => strings.iter().map(|string| format!("\"{string}\"")).collect(),
        Seeds::Folder(folder) => vec![format!("the front of {}", folder.display())],
    };
    [vec![initial], named].concat().join(", ")
}
