//! What the `[structure]` table must satisfy beyond its types.

use super::params::{
    ElementsPerMember, FactorParams, HeightParams, LoadParams, SectionParams, StiffnessParams,
    StructureParams, SupportParams,
};
use super::section::Section;

/// Key paths, relative to `[structure]`, with what is wrong.
type Problems = Vec<(String, String)>;

impl StructureParams {
    /// Everything that is wrong with the values: `(key path below [structure], message)`, in the order of the
    /// documentation. Empty = fine.
    pub fn validate(&self) -> Vec<(String, String)> {
        let mut problems = Problems::new();
        if !matches!(self.order, 1 | 2) {
            problems.push(("order".into(), format!("{} must be 1 or 2", self.order)));
        }
        let tolerance = self.second_order_tolerance;
        if !(1e-12..=1e-2).contains(&tolerance) {
            problems
                .push(("second_order_tolerance".into(), format!("{tolerance} must be from 1e-12 to 1e-2")));
        }
        if let ElementsPerMember::Number(n) = self.elements_per_member
            && !(1..=100).contains(&n)
        {
            problems.push(("elements_per_member".into(), format!("{n} must be from 1 to 100, or \"auto\"")));
        }
        self.check_material(&mut problems);
        self.check_joints(&mut problems);
        self.check_height_and_section(&mut problems);
        for (i, zone) in self.utilisation.exclude.iter().enumerate() {
            let key = format!("utilisation.exclude[{i}]");
            at_least_zero(&mut problems, &format!("{key}.radius_m"), zone.radius_m);
            if !zone.corners {
                problems
                    .push((format!("{key}.corners"), "false excludes nothing; leave the zone out".into()));
            }
        }
        for (i, support) in self.supports.iter().enumerate() {
            check_support(&mut problems, i, support);
        }
        self.check_loads(&mut problems);
        self.check_requirements(&mut problems);
        problems
    }

    fn check_material(&self, problems: &mut Problems) {
        let m = &self.material;
        positive(problems, "material.youngs_modulus_pa", m.youngs_modulus_pa);
        if !(m.poisson > -1.0 && m.poisson <= 0.5) {
            let message = format!("{} must be greater than -1 and at most 0.5", m.poisson);
            problems.push(("material.poisson".into(), message));
        }
        at_least_zero(problems, "material.density_kg_m3", m.density_kg_m3);
        positive(problems, "material.yield_pa", m.yield_pa);
        positive(problems, "material.gamma_m0", m.gamma_m0);
        if !m.thermal_expansion_per_k.is_finite() {
            let message = format!("{} is not a finite number", m.thermal_expansion_per_k);
            problems.push(("material.thermal_expansion_per_k".into(), message));
        }
    }

    fn check_joints(&self, problems: &mut Problems) {
        if let Some((key, message)) = self.joints.problem() {
            problems.push((format!("joints.{key}"), message));
        }
        let turns = self.joints.joint(1).torsion;
        if turns.is_hinge() {
            let message = "released at both ends of a member it lets the member turn freely about itself: \
                           give gj_per_l or nm_per_rad greater than 0, or leave it rigid";
            problems.push(("joints.torsion".into(), message.into()));
        }
    }

    fn check_height_and_section(&self, problems: &mut Problems) {
        let before = problems.len();
        let (key, least) = match self.height {
            HeightParams::Fixed { fixed_m } => {
                positive(problems, "height.fixed_m", fixed_m);
                ("height.fixed_m", fixed_m)
            }
            HeightParams::Sized { min_m, max_m, step_m } => {
                positive(problems, "height.min_m", min_m);
                positive(problems, "height.max_m", max_m);
                positive(problems, "height.step_m", step_m);
                if max_m <= min_m {
                    let message = format!("{max_m} must be greater than min_m = {min_m}");
                    problems.push(("height.max_m".into(), message));
                }
                ("height.min_m", min_m)
            }
        };
        if let Some((key, value)) = self.section.not_positive() {
            positive(problems, &format!("section.{key}"), value);
        }
        match self.section {
            SectionParams::Box { width_m, thickness_m } => {
                wall(problems, "section.width_m", width_m, thickness_m);
                wall(problems, key, least, thickness_m);
            }
            SectionParams::Tube { thickness_m } => wall(problems, key, least, thickness_m),
            SectionParams::Properties { .. } if matches!(self.height, HeightParams::Sized { .. }) => {
                let message = "a section of given properties cannot be sized: give fixed_m";
                problems.push(("height".into(), message.into()));
            }
            SectionParams::Round {} | SectionParams::Properties { .. } => {}
        }
        // What the checks above have no words for: properties that overflow or vanish.
        if problems.len() == before
            && let Err(error) = Section::of_params(&self.section, least).and_then(|s| s.check())
        {
            problems.push(("section".into(), error.to_string()));
        }
    }

    fn check_loads(&self, problems: &mut Problems) {
        for (name, load) in &self.loads {
            if let Some((key, value)) = load.numbers().into_iter().find(|(_, value)| !value.is_finite()) {
                problems.push((format!("loads.{name}.{key}"), format!("{value} is not a finite number")));
            }
            if let Some(Err(error)) = load.factor().map(FactorParams::read) {
                problems.push((format!("loads.{name}.factor"), error.to_string()));
            }
            if let LoadParams::Point { points_m, .. } = load
                && points_m.is_empty()
            {
                problems.push((format!("loads.{name}.points_m"), "name at least one point".into()));
            }
        }
        if self.combinations.is_empty() {
            problems.push(("combinations".into(), "at least one combination is needed".into()));
        }
        for (name, cases) in &self.combinations {
            for (case, factor) in cases {
                let key = format!("combinations.{name}.{case}");
                if !self.loads.contains_key(case) {
                    problems
                        .push((key, format!("there is no load case {case:?}; {}", known(self.loads.keys()))));
                } else if !factor.is_finite() {
                    problems.push((key, format!("{factor} is not a finite number")));
                }
            }
        }
    }

    fn check_requirements(&self, problems: &mut Problems) {
        for (i, requirement) in self.requirements.iter().enumerate() {
            let key = |name: &str| format!("requirement[{i}].{name}");
            match (&requirement.combination, requirement.analysed()) {
                (Some(combination), Some(_)) if !self.combinations.contains_key(combination) => {
                    let message = format!(
                        "there is no combination {combination:?}; {}",
                        known(self.combinations.keys())
                    );
                    problems.push((key("combination"), message));
                }
                (Some(combination), None) => {
                    let message = format!(
                        "{combination:?}, but {} is no matter of loads; leave it out",
                        requirement.quantity
                    );
                    problems.push((key("combination"), message));
                }
                (None, Some(quantity)) if quantity.needs_combination() => {
                    let message = format!("{quantity} needs one; {}", known(self.combinations.keys()));
                    problems.push((key("combination"), message));
                }
                _ => {}
            }
            match (requirement.max, requirement.min) {
                (Some(max), None) => at_least_zero(problems, &key("max"), max),
                (None, Some(min)) => positive(problems, &key("min"), min),
                (Some(_), Some(_)) => problems.push((key("min"), "give either max or min, not both".into())),
                (None, None) => problems.push((key("max"), "give max or min".into())),
            }
        }
    }
}

fn known<'a>(names: impl Iterator<Item = &'a String>) -> String {
    let names: Vec<&str> = names.map(String::as_str).collect();
    if names.is_empty() { "none is defined".into() } else { format!("known: {}", names.join(", ")) }
}

fn positive(problems: &mut Problems, key: &str, value: f64) {
    if !(value > 0.0 && value.is_finite()) {
        problems.push((key.into(), format!("{value} must be greater than 0")));
    }
}

fn at_least_zero(problems: &mut Problems, key: &str, value: f64) {
    if !(value >= 0.0 && value.is_finite()) {
        problems.push((key.into(), format!("{value} must be 0 or more")));
    }
}

fn wall(problems: &mut Problems, key: &str, value: f64, thickness: f64) {
    if value > 0.0 && thickness > 0.0 && value <= 2.0 * thickness {
        let message = format!("{value} must be greater than twice the wall thickness, {thickness}");
        problems.push((key.into(), message));
    }
}

fn check_support(problems: &mut Problems, i: usize, support: &SupportParams) {
    let key = |name: &str| format!("support[{i}].{name}");
    match support.nodes().as_slice() {
        [_] => {}
        [] => {
            let message = "give at = \"boundary\", \"corners\" or \"all\", or loop = k, nodes_near_m, sides_near_m or inside_near_m";
            problems.push((key("at"), message.into()));
        }
        [(first, _), (second, _), ..] => {
            problems.push((key(second), format!("give either {first} or {second}, not both")));
        }
    }
    if support.fixed.is_empty() && support.stiffness.is_none() {
        let message = "name at least one of ux, uy, uz, rx, ry, rz, or give a stiffness";
        problems.push((key("fixed"), message.into()));
    }
    for (name, value) in StiffnessParams::KEYS.iter().zip(support.stiffness.unwrap_or_default().values()) {
        at_least_zero(problems, &key(&format!("stiffness.{name}")), value);
    }
}
