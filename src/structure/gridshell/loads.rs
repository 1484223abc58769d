//! The loads of a config on a pattern.

use super::AnalysisError;
use super::panels::{PanelShape, Panels};
use super::supports::{FoundNode, nearest};
use crate::geometry::pattern::Pattern;
use crate::structure::model::{LoadCase, NodalLoad, TemperatureLoad};
use crate::structure::params::{FactorParams, LoadParams};
use nalgebra::Vector3;

/// The load case of one of the config's, for a frame of so many members; adds the nodes that forces at points have found.
pub fn load_case(
    name: &str,
    load: &LoadParams,
    pattern: &Pattern,
    panels: &Panels,
    members: u32,
    found: &mut Vec<FoundNode>,
) -> Result<LoadCase, AnalysisError> {
    let nodal = |nodal: Vec<NodalLoad>| LoadCase { nodal, ..LoadCase::default() };
    let down = |areas: &[f64], pressure: f64| -> LoadCase {
        let loaded = areas.iter().enumerate().filter(|(_, area)| **area != 0.0);
        nodal(loaded.map(|(n, area)| force(n as u32, Vector3::new(0.0, 0.0, -area * pressure))).collect())
    };
    let by_panel = |factor: Option<&FactorParams>, of: &dyn Fn(&PanelShape) -> Vector3<f64>| {
        on_panels(name, pattern, factor, of).map(nodal)
    };
    Ok(match load {
        LoadParams::Gravity { g_m_s2 } => LoadCase { gravity: *g_m_s2, ..LoadCase::default() },
        LoadParams::Area { down_pa, factor: None } => down(panels.true_shares(), *down_pa),
        LoadParams::Projected { down_pa, factor: None } => down(panels.plan_shares(), *down_pa),
        LoadParams::Area { down_pa, factor } => {
            by_panel(factor.as_ref(), &|panel| Vector3::new(0.0, 0.0, -down_pa * panel.area))?
        }
        LoadParams::Projected { down_pa, factor } => {
            by_panel(factor.as_ref(), &|panel| Vector3::new(0.0, 0.0, -down_pa * panel.plan()))?
        }
        LoadParams::Pressure { pressure_pa, factor } => {
            by_panel(factor.as_ref(), &|panel| panel.vector_area * -pressure_pa)?
        }
        LoadParams::Temperature { kelvin } => LoadCase {
            temperature: (0..members).map(|member| TemperatureLoad { member, kelvin: *kelvin }).collect(),
            ..LoadCase::default()
        },
        LoadParams::Point { points_m, force_n } => {
            let mut loads = Vec::new();
            for (k, &point) in points_m.iter().enumerate() {
                let near = nearest(pattern, &format!("loads.{name}.points_m[{k}]"), point, |_| true);
                let share = Vector3::from(*force_n) / near.len() as f64;
                loads.extend(near.iter().map(|found| force(found.node, share)));
                found.extend(near);
            }
            nodal(loads)
        }
    })
}

fn force(node: u32, force: Vector3<f64>) -> NodalLoad {
    NodalLoad { node, load: [force.x, force.y, force.z, 0.0, 0.0, 0.0] }
}

/// The force on each panel × its factor, shared by its corners as its area is.
fn on_panels(
    name: &str,
    pattern: &Pattern,
    factor: Option<&FactorParams>,
    of: &dyn Fn(&PanelShape) -> Vector3<f64>,
) -> Result<Vec<NodalLoad>, AnalysisError> {
    let wrong = |message: String| AnalysisError::Params { key: format!("loads.{name}.factor"), message };
    let factor = factor.map(FactorParams::read).transpose().map_err(|error| wrong(error.to_string()))?;
    let mut forces = vec![Vector3::zeros(); pattern.positions.len()];
    for panel in &pattern.panels {
        let shape = PanelShape::new(pattern, panel.corners());
        if !(shape.area > 0.0) {
            continue;
        }
        let mut load = of(&shape);
        if let Some(factor) = &factor {
            let size = shape.vector_area.norm();
            let normal = if size > 0.0 { shape.vector_area / size } else { Vector3::zeros() };
            let times = factor.at(shape.middle.into(), normal.into());
            if !times.is_finite() {
                let [x, y, z]: [f64; 3] = shape.middle.into();
                return Err(wrong(format!(
                    "`{}` is {times} on the panel at ({x:.3}, {y:.3}, {z:.3})",
                    factor.text()
                )));
            }
            load *= times;
        }
        for (&corner, share) in panel.corners().iter().zip(shape.shares) {
            forces[corner as usize] += load * (share / shape.area);
        }
    }
    let loaded = forces.into_iter().enumerate().filter(|(_, f)| *f != Vector3::zeros());
    Ok(loaded.map(|(n, f)| force(n as u32, f)).collect())
}
