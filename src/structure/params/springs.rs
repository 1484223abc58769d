//! Springs of supports.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Springs of a support along and about the axes x, y and z (up); 0 is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StiffnessParams {
    /// Along x, in N/m.
    #[schemars(extend("minimum" = 0))]
    pub ux_n_per_m: f64,
    /// Along y, in N/m.
    #[schemars(extend("minimum" = 0))]
    pub uy_n_per_m: f64,
    /// Along z, in N/m.
    #[schemars(extend("minimum" = 0))]
    pub uz_n_per_m: f64,
    /// About x, in Nm/rad.
    #[schemars(extend("minimum" = 0))]
    pub rx_nm_per_rad: f64,
    /// About y, in Nm/rad.
    #[schemars(extend("minimum" = 0))]
    pub ry_nm_per_rad: f64,
    /// About z, in Nm/rad.
    #[schemars(extend("minimum" = 0))]
    pub rz_nm_per_rad: f64,
}

impl StiffnessParams {
    /// Of ux, uy, uz (N/m), rx, ry, rz (Nm/rad).
    pub fn values(&self) -> [f64; 6] {
        [
            self.ux_n_per_m,
            self.uy_n_per_m,
            self.uz_n_per_m,
            self.rx_nm_per_rad,
            self.ry_nm_per_rad,
            self.rz_nm_per_rad,
        ]
    }

    /// The keys, in the same order.
    pub const KEYS: [&'static str; 6] =
        ["ux_n_per_m", "uy_n_per_m", "uz_n_per_m", "rx_nm_per_rad", "ry_nm_per_rad", "rz_nm_per_rad"];
}
