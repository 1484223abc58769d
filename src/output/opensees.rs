//! A Tcl deck for OpenSees of a design under one combination (docs/reference/files.md §7).
//!
//! Every line is one plain command, without variables or arithmetic, so that scripts in other languages of OpenSees can read it line by
//! line. Node n here is node n + 1 there, member m element m + 1. N, m, kg; z up.

use super::handed::Handed;
use super::number::push_shortest;
use crate::structure::model::{EndJoint, Frame3, Joint, LoadCase, MemberKind, Settlement};
use nalgebra::Vector3;

/// A section that is rigid in shear, for an element that is not: so many times its area.
const RIGID: f64 = 1e6;

/// A joint that is rigid about one axis and gives way about another: so many times the member's own stiffness. Stiffer ones cost OpenSees
/// more digits than they win.
const STIFF: f64 = 1e7;

/// A design under one of its combinations. `file` is what the files are called that the deck writes.
///
/// First order is linear. Second order takes `PDelta`, which moves the ends of a member alone: what the bending between them adds, as
/// quadrille's cubic geometric stiffness has it, comes with members split into elements.
pub fn opensees(design: &Handed<'_>, combination: (&str, &[(usize, f64)]), file: &str) -> Vec<u8> {
    let (name, factors) = combination;
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let id = design.id;
    let model = design.model;
    let mut deck = Deck {
        text: format!(
            "# design {id}, combination {name}: quadrille {}\n# N, m, kg; z up; node n is {id}_nodes.csv's n - 1, element m \
             {id}_members.csv's m - 1\n",
            env!("CARGO_PKG_VERSION")
        ),
        nodes: model.nodes().len(),
        elements: model.members().len(),
        materials: 0,
    };
    let loads = design.combined(factors);
    if !loads.temperature.is_empty() {
        deck.line("# temperature acts as forces at members' ends: of a warmed member N is less by E A alpha dT than its element's", &[]);
    }
    deck.line("wipe", &[]);
    deck.line("model BasicBuilder -ndm 3 -ndf 6", &[]);
    for (n, position) in model.nodes().iter().enumerate() {
        deck.line(&format!("node {}", n + 1), position);
    }
    deck.supports(design, &loads.settlements);
    deck.members(design);
    deck.loads(design, &loads);
    // Prescribed displacements need more than the plain handler.
    let constraints = if loads.settlements.is_empty() { "Plain" } else { "Transformation" };
    let algorithm = if design.order == 2 { "Newton" } else { "Linear" };
    let (nodes, elements) = (model.nodes().len(), model.members().len());
    for line in [
        format!("constraints {constraints}"),
        "numberer RCM".into(),
        "system UmfPack".into(),
        "test NormDispIncr 1e-12 50".into(),
        format!("algorithm {algorithm}"),
        "integrator LoadControl 1".into(),
        "analysis Static".into(),
        format!(
            "recorder Node -file {file}_displacements.out -precision 16 -nodeRange 1 {nodes} -dof 1 2 3 4 5 6 disp"
        ),
        format!(
            "recorder Node -file {file}_reactions.out -precision 16 -nodeRange 1 {nodes} -dof 1 2 3 4 5 6 reaction"
        ),
        format!("recorder Element -file {file}_forces.out -precision 16 -eleRange 1 {elements} localForce"),
        "analyze 1".into(),
    ] {
        deck.line(&line, &[]);
    }
    deck.text.into_bytes()
}

/// What is written, and the numbers of what OpenSees needs beside nodes and members.
struct Deck {
    text: String,
    nodes: usize,
    elements: usize,
    materials: usize,
}

impl Deck {
    /// A command with numbers behind it.
    fn line(&mut self, command: &str, numbers: &[f64]) {
        self.text.push_str(command);
        for &number in numbers {
            self.text.push(' ');
            push_shortest(&mut self.text, number);
        }
        self.text.push('\n');
    }

    /// Held directions, but those that `moved` moves; nodes that join nothing but trusses have no rotation.
    fn supports(&mut self, design: &Handed<'_>, moved: &[Settlement]) {
        let model = design.model;
        for (n, fixed) in model.fixed().iter().enumerate() {
            let node = n as u32;
            let turns = model.unturned().binary_search(&node).is_err();
            let moves = |d: usize| moved.iter().any(|s| s.node == node && s.displacement[d] != 0.0);
            let held: [bool; 6] = std::array::from_fn(|d| fixed[d] && !moves(d) || (d > 2 && !turns));
            if held.contains(&true) {
                self.line(&format!("fix {}", n + 1), &held.map(|held| f64::from(u8::from(held))));
            }
            let springs = design.springs(node);
            if springs != [0.0; 6] {
                let ground = self.node(model.nodes()[n]);
                self.line(&format!("fix {ground}"), &[1.0; 6]);
                self.springs([ground, n + 1], (1..).zip(springs), None);
            }
        }
    }

    /// One more node.
    fn node(&mut self, position: [f64; 3]) -> usize {
        self.nodes += 1;
        self.line(&format!("node {}", self.nodes), &position);
        self.nodes
    }

    /// One more material, of a spring or bar.
    fn material(&mut self, stiffness: f64) -> usize {
        self.materials += 1;
        self.line(&format!("uniaxialMaterial Elastic {}", self.materials), &[stiffness]);
        self.materials
    }

    /// An element without length between two nodes at one place: a spring for each direction (1 … 6) that has a stiffness, in the axes of
    /// a member or else the global ones.
    fn springs(
        &mut self,
        ends: [usize; 2],
        springs: impl Iterator<Item = (usize, f64)>,
        axes: Option<&Frame3>,
    ) {
        let springs: Vec<(usize, f64)> = springs.filter(|(_, stiffness)| *stiffness > 0.0).collect();
        if springs.is_empty() {
            return;
        }
        let materials: Vec<usize> = springs.iter().map(|(_, stiffness)| self.material(*stiffness)).collect();
        let words = |numbers: &mut dyn Iterator<Item = usize>| {
            numbers.map(|number| number.to_string()).collect::<Vec<_>>().join(" ")
        };
        self.elements += 1;
        let command = format!(
            "element zeroLength {} {} {} -mat {} -dir {}",
            self.elements,
            ends[0],
            ends[1],
            words(&mut materials.into_iter()),
            words(&mut springs.iter().map(|(direction, _)| *direction))
        );
        match axes {
            None => self.line(&command, &[]),
            Some(Frame3 { x, y, .. }) => {
                self.line(&format!("{command} -orient"), &[x.x, x.y, x.z, y.x, y.y, y.z]);
            }
        }
    }

    /// Elements, each with the transformation of its own axes: the vector in its x–z plane is the section's height.
    fn members(&mut self, design: &Handed<'_>) {
        let model = design.model;
        let transformation = if design.order == 2 { "PDelta" } else { "Linear" };
        let (e, g) = (model.material().youngs_modulus, model.material().shear_modulus);
        for (m, (member, axes)) in model.members().iter().zip(model.axes()).enumerate() {
            let tag = m + 1;
            let section = &model.sections()[member.section as usize];
            let [a, j, iy, iz] = [section.area, section.j, section.iy, section.iz];
            let mut ends = [member.start, member.end].map(|node| node as usize + 1);
            if member.kind == MemberKind::Truss {
                let material = self.material(e);
                let kind = if design.order == 2 { "corotTruss" } else { "Truss" };
                self.line(&format!("element {kind} {tag} {} {}", ends[0], ends[1]), &[a, material as f64]);
                continue;
            }
            for (end, joint) in ends.iter_mut().zip(member.kind.joints().into_iter().flatten()) {
                *end = self.joint(*end, joint, design, m);
            }
            self.line(&format!("geomTransf {transformation} {tag}"), axes.z.as_slice());
            let [start, end] = ends;
            if model.shear_deformation() {
                let shear = [section.asy, section.asz].map(|area| if area > 0.0 { area } else { RIGID * a });
                self.line(
                    &format!("element ElasticTimoshenkoBeam {tag} {start} {end}"),
                    &[e, g, a, j, iy, iz, shear[0], shear[1], tag as f64],
                );
            } else {
                let numbers = [a, e, g, j, iy, iz, tag as f64];
                self.line(&format!("element elasticBeamColumn {tag} {start} {end}"), &numbers);
            }
        }
    }

    /// A node of the member's own, which moves with its node and turns as far as the joint lets it.
    fn joint(&mut self, end: usize, joint: &EndJoint, design: &Handed<'_>, member: usize) -> usize {
        if joint.about().into_iter().all(Joint::is_rigid) {
            return end;
        }
        let own = self.node(design.model.nodes()[end - 1]);
        self.line(&format!("equalDOF {end} {own} 1 2 3"), &[]);
        let beside = design.stiffness(member);
        let springs =
            joint.about().into_iter().zip(beside).map(|(joint, beside)| {
                if joint.is_rigid() { STIFF * beside } else { joint.stiffness(beside) }
            });
        self.springs([end, own], (4..).zip(springs), Some(&design.model.axes()[member]));
        own
    }

    /// One pattern; loads of members in their own axes, self weight among them.
    fn loads(&mut self, design: &Handed<'_>, loads: &LoadCase) {
        let model = design.model;
        self.line("timeSeries Linear 1", &[]);
        self.line("pattern Plain 1 1 {", &[]);
        for load in &loads.nodal {
            self.line(&format!("load {}", load.node + 1), &load.load);
        }
        let on_members = design.on_members(loads).into_iter().enumerate();
        for (m, load) in on_members.filter(|(_, load)| *load != Vector3::zeros()) {
            let axes = &model.axes()[m];
            if model.members()[m].kind == MemberKind::Truss {
                let half = load * (0.5 * axes.length);
                self.at_ends(design, m, [half, half]);
            } else {
                let local = [load.dot(&axes.y), load.dot(&axes.z), load.dot(&axes.x)];
                self.line(&format!("eleLoad -ele {} -type -beamUniform", m + 1), &local);
            }
        }
        for warmed in &loads.temperature {
            let m = warmed.member as usize;
            let section = &model.sections()[model.members()[m].section as usize];
            let material = model.material();
            let push = material.youngs_modulus * section.area * material.thermal_expansion * warmed.kelvin;
            let along = model.axes()[m].x * push;
            self.at_ends(design, m, [-along, along]);
        }
        for moved in &loads.settlements {
            for (d, &displacement) in moved.displacement.iter().enumerate().filter(|(_, u)| **u != 0.0) {
                self.line(&format!("sp {} {}", moved.node + 1, d + 1), &[displacement]);
            }
        }
        self.line("}", &[]);
    }

    /// Forces on the two nodes of a member.
    fn at_ends(&mut self, design: &Handed<'_>, member: usize, forces: [Vector3<f64>; 2]) {
        let member = &design.model.members()[member];
        for (node, force) in [member.start, member.end].into_iter().zip(forces) {
            self.line(&format!("load {}", node + 1), &[force.x, force.y, force.z, 0.0, 0.0, 0.0]);
        }
    }
}
