//! `quadrille` finds good topologies for structured surface structures: gridshells, shells and cable nets.
//!
//! A design is a short string over a small grammar. The pipeline runs one way; every stage is a plain
//! function on plain data:
//!
//! ```text
//! config → string → topology → geometry → structure → objectives → selection → files
//! ```
//!
//! # A string is a mesh
//!
//! ```
//! use quadrille::{InitialMesh, Rules, decode, samples};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let initial = InitialMesh::from_base(&samples::grid(3, 3))?;
//! let mesh = decode(&initial, &"D".parse()?, Rules::Plain).mesh;
//! assert_eq!(mesh.face_count(), 6); // a strip less: three faces
//! for first in mesh.face_darts() {
//!     let corners: Vec<_> = mesh.along(first).map(|dart| mesh.origin(dart)).collect();
//!     assert_eq!(corners.len(), 4);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! # A string by a config, its metrics by name
//!
//! ```
//! use quadrille::{Effort, ResolvedConfig, Study, objectives};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let text = r#"
//!     domain.loop = [{ kind = "polyline", points_m = [[0, 0], [8, 0], [8, 6], [0, 6]] }]
//!     surface = { kind = "height", expression = "0.3 * x - 0.0375 * x^2" }
//!     topology.initial = { grid = [2, 2] }
//!     pattern.panels = 40
//!     structure = {}
//! "#;
//! let config = ResolvedConfig::parse(text, "vault.toml".as_ref(), &[])?;
//! let study = Study::of(&config)?;
//! let design = study.evaluate_topology(study.topology(&"ATTA".parse()?), Effort::Everything);
//! let mass = objectives::named(&design.metrics, "mass").ok_or("no mass")?;
//! assert!(mass > 1000.0, "{mass} kg");
//! # Ok(())
//! # }
//! ```
//!
//! # A frame under combinations of loads
//!
//! ```
//! use quadrille::structure::model::{LoadCase, Material, Member, MemberKind, NodalLoad, Support};
//! use quadrille::structure::section::Section;
//! use quadrille::{FrameAnalysis, FrameModel, FrameParts, Order, structure};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // A cantilever of 2 m along x, pushed down and sideways at its tip.
//! let push = |load| LoadCase { nodal: vec![NodalLoad { node: 1, load }], ..LoadCase::default() };
//! let model = FrameModel::new(FrameParts {
//!     nodes: vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
//!     members: vec![Member { start: 0, end: 1, up: [0.0, 0.0, 1.0], section: 0, kind: MemberKind::RIGID }],
//!     sections: vec![Section::round(0.1)?],
//!     material: Material { youngs_modulus: 210e9, shear_modulus: 81e9, density: 7850.0, strength: 355e6, thermal_expansion: 1.2e-5 },
//!     shear_deformation: false,
//!     supports: vec![Support::fixed(0, [true; 6])],
//!     load_cases: vec![push([0.0, 0.0, -1e3, 0.0, 0.0, 0.0]), push([0.0, 1e3, 0.0, 0.0, 0.0, 0.0])],
//! })?;
//! let analysis = FrameAnalysis { order: Order::First, buckling_modes: 0 };
//! let found = structure::combined(&model, &[(0, 1.35), (1, 1.5)], &analysis)?;
//! let [_, v, w, ..] = found.displacements[1];
//! let stiffness = 3.0 * 210e9 * model.sections()[0].iy / 8.0; // 3 EI / L³
//! assert!((v - 1.5e3 / stiffness).abs() < 1e-9 && (w + 1.35e3 / stiffness).abs() < 1e-9);
//! # Ok(())
//! # }
//! ```
//!
//! # NSGA-II on anything
//!
//! ```
//! use quadrille::evolve::{Fitness, Violation, evolve};
//! use quadrille::random::{Rng, below, chance, stream, unit};
//!
//! // ZDT1 (Zitzler, Deb, Thiele 2000): the front is f₂ = 1 − √f₁, where all variables but the first are 0.
//! let evaluate = |x: &Vec<f64>| {
//!     let g = 1.0 + 9.0 * x[1..].iter().sum::<f64>() / (x.len() - 1) as f64;
//!     Fitness::new(Violation::NONE, vec![x[0], g * (1.0 - (x[0] / g).sqrt())])
//! };
//! let breed = |a: &Vec<f64>, b: &Vec<f64>, rng: &mut Rng| {
//!     let mut child: Vec<f64> = a.iter().zip(b).map(|(a, b)| if chance(rng, 0.5) { *a } else { *b }).collect();
//!     let k = below(rng, child.len());
//!     child[k] = (child[k] + 0.3 * (unit(rng) - 0.5)).clamp(0.0, 1.0);
//!     child
//! };
//! let mut rng = stream(7, 0, 0);
//! let start = (0..40).map(|_| (0..6).map(|_| unit(&mut rng)).collect()).collect();
//! let found = evolve(start, (150, 7), breed, evaluate);
//! for (_, fitness) in found.front() {
//!     let f = &fitness.objectives;
//!     assert!(f[1] - (1.0 - f[0].sqrt()) < 0.05, "{f:?}");
//! }
//! ```
//!
//! `docs/library.md` goes on from here.
//!
//! Method: Oval, Mesnil, Van Mele, Baverel, Block, *A vector encoding for topology finding of structured
//! quad-based patterns for surface structures*. See `docs/ARCHITECTURE.md` for the modules and what flows.

pub mod config;
pub mod domain;
pub mod evolve;
pub mod expression;
pub mod files;
pub mod geometry;
pub mod grammar;
pub mod io;
pub mod json;
pub mod mesh;
pub mod objectives;
pub mod output;
pub mod random;
pub mod search;
mod simd;
pub mod skeleton;
pub mod structure;
pub mod study;
pub mod surface;

pub use config::{Config, ConfigError, ResolvedConfig};
pub use evolve::{Fitness, Population, Violation};
pub use geometry::Pattern;
pub use grammar::{Decoded, Rules, Tokens, decode};
pub use mesh::{BaseMesh, CanonicalMesh, Code, InitialMesh, QuadMesh, samples};
pub use search::{Evaluation, Identity, Problem};
pub use structure::{FrameAnalysis, FrameModel, FrameParts, FrameResult, Order};
pub use study::{Design, Effort, Failure, Study, StudyError};
