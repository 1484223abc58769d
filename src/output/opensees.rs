//! A Tcl deck for OpenSees of a design under one combination (docs/reference/files.md §7).
//!
//! Every line is one plain command, without variables or arithmetic, so that scripts in other languages of OpenSees can read it line by
//! line. Node n here is node n + 1 there, member m element m + 1. N, m, kg; z up.

use super::handed::Handed;
use super::number::push_shortest;
use nalgebra::Vector3;
use std::fmt::Write;

/// A section that is rigid in shear, for an element that is not: so many times its area.
const RIGID: f64 = 1e6;

/// A design under one of its combinations. `file` is what the files are called that the deck writes.
///
/// First order is linear. Second order takes `PDelta`, which moves the ends of a member alone: what the bending between them adds, as
/// quadrille's cubic geometric stiffness has it, comes with members split into elements.
pub fn opensees(design: &Handed<'_>, combination: (&str, &[(usize, f64)]), file: &str) -> Vec<u8> {
    let (name, factors) = combination;
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let id = design.id;
    let mut deck = Deck(format!(
        "# design {id}, combination {name}: quadrille {}\n# N, m, kg; z up; node n is {id}_nodes.csv's n - 1, element m \
         {id}_members.csv's m - 1\n",
        env!("CARGO_PKG_VERSION")
    ));
    deck.line("wipe", &[]);
    deck.line("model BasicBuilder -ndm 3 -ndf 6", &[]);
    for (n, position) in design.model.nodes().iter().enumerate() {
        deck.line(&format!("node {}", n + 1), position);
    }
    for node in design.model.supported() {
        let fixed = design.model.fixed()[node.0 as usize].map(|held| f64::from(u8::from(held)));
        deck.line(&format!("fix {}", node.0 + 1), &fixed);
    }
    deck.members(design);
    deck.loads(design, factors);
    let algorithm = if design.order == 2 { "Newton" } else { "Linear" };
    let nodes = design.model.nodes().len();
    for line in [
        "constraints Plain".to_owned(),
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
        format!(
            "recorder Element -file {file}_forces.out -precision 16 -eleRange 1 {} localForce",
            design.model.members().len()
        ),
        "analyze 1".into(),
    ] {
        deck.line(&line, &[]);
    }
    deck.0.into_bytes()
}

struct Deck(String);

impl Deck {
    /// A command with numbers behind it.
    fn line(&mut self, command: &str, numbers: &[f64]) {
        self.0.push_str(command);
        for &number in numbers {
            self.0.push(' ');
            push_shortest(&mut self.0, number);
        }
        self.0.push('\n');
    }

    /// Elements, each with the transformation of its own axes: the vector in its x–z plane is the section's height.
    fn members(&mut self, design: &Handed<'_>) {
        let model = design.model;
        let transformation = if design.order == 2 { "PDelta" } else { "Linear" };
        let (e, g) = (model.material().youngs_modulus, model.material().shear_modulus);
        for (m, (member, axes)) in model.members().iter().zip(model.axes()).enumerate() {
            let tag = m + 1;
            let section = &model.sections()[member.section as usize];
            self.line(&format!("geomTransf {transformation} {tag}"), axes.z.as_slice());
            let ends = format!("{tag} {} {}", member.start + 1, member.end + 1);
            let [a, j, iy, iz] = [section.area, section.j, section.iy, section.iz];
            if model.shear_deformation() {
                let shear = [section.asy, section.asz].map(|area| if area > 0.0 { area } else { RIGID * a });
                self.line(
                    &format!("element ElasticTimoshenkoBeam {ends}"),
                    &[e, g, a, j, iy, iz, shear[0], shear[1]],
                );
            } else {
                self.line(&format!("element elasticBeamColumn {ends}"), &[a, e, g, j, iy, iz]);
            }
            // The transformation is the last word of the element's line.
            self.0.pop();
            let _ = writeln!(self.0, " {tag}");
        }
    }

    /// One pattern; loads of members in their own axes, self weight among them.
    fn loads(&mut self, design: &Handed<'_>, factors: &[(usize, f64)]) {
        let model = design.model;
        let loads = design.combined(factors);
        self.line("timeSeries Linear 1", &[]);
        self.line("pattern Plain 1 1 {", &[]);
        for load in &loads.nodal {
            self.line(&format!("load {}", load.node + 1), &load.load);
        }
        let mut on_members = vec![Vector3::zeros(); model.members().len()];
        for load in &loads.uniform {
            on_members[load.member as usize] = Vector3::from(load.force_per_length);
        }
        for (m, (member, axes)) in model.members().iter().zip(model.axes()).enumerate() {
            let area = model.sections()[member.section as usize].area;
            let load = on_members[m] - Vector3::z() * (loads.gravity * model.material().density * area);
            if load != Vector3::zeros() {
                let local = [load.dot(&axes.y), load.dot(&axes.z), load.dot(&axes.x)];
                self.line(&format!("eleLoad -ele {} -type -beamUniform", m + 1), &local);
            }
        }
        self.line("}", &[]);
    }
}
