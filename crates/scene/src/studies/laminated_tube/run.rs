//! The tube without loads and under pressure, beside one without growth.

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use piola_uniformity::UniformityError;
use serde_json::{Value, json};

use super::pressure::{HeldTube, Refusal};
use super::{LayeredTube, Layers};
use crate::run::Outcome;
use crate::studies::StressAt;
use crate::studies::observer::{Observer, outcome};
use crate::studies::stresses::through;

/// Parts of each layer between particles whose stress is computed.
const PARTS: u32 = 24;

/// A tube in one state.
///
/// # Example
/// See [`LayeredTube`].
#[derive(Debug, Clone, PartialEq)]
pub struct TubeState {
    /// Pressure inside, Pa.
    pub pressure: f64,
    /// r of the faces, m.
    pub radii: [f64; 2],
    /// λ.
    pub axial_stretch: f64,
    /// Resultant of the axial stress, N.
    pub axial_force: f64,
    /// ∫ `T_θθ` r dr, N: the moment per length that a cut along the tube sets free.
    pub moment: f64,
    /// Stresses layer by layer, from the inner face on.
    pub stresses: Vec<StressAt>,
}

/// The stresses of a tube of layers.
///
/// # Example
/// See [`LayeredTube`].
#[derive(Debug, Clone, Default)]
pub struct TubeStresses {
    /// Without loads: residual stress.
    pub at_rest: Option<TubeState>,
    /// Under the pressure.
    pub loaded: Option<TubeState>,
    /// A tube without growth under the pressure.
    pub homogeneous: Option<TubeState>,
    /// Stretch of the inner face over that without loads, and pressure, Pa.
    pub curve: Vec<(f64, f64)>,
    /// The same without growth.
    pub homogeneous_curve: Vec<(f64, f64)>,
}

impl LayeredTube {
    pub(in crate::studies) fn run(&self, observer: &mut Observer<'_>) -> (TubeStresses, Outcome) {
        let mut found = TubeStresses::default();
        let result = self.solve(&mut found, observer);
        (found, outcome(result))
    }

    fn solve(&self, found: &mut TubeStresses, observer: &mut Observer<'_>) -> Result<bool, UniformityError> {
        let held = HeldTube::at_rest(&self.layers, &self.law)?;
        found.at_rest = Some(self.state(&self.layers, &held, 0.0)?);
        if observer(0.2) == ControlFlow::Break(()) {
            return Ok(false);
        }
        found.loaded = Some(self.state(&self.layers, &held, self.pressure)?);
        found.curve = held.curve(self.stretch)?;
        if observer(0.6) == ControlFlow::Break(()) {
            return Ok(false);
        }
        let homogeneous = self.layers.homogeneous();
        let held = HeldTube::at_rest(&homogeneous, &self.law)?;
        found.homogeneous = Some(self.state(&homogeneous, &held, self.pressure)?);
        found.homogeneous_curve = held.curve(self.stretch)?;
        Ok(observer(1.0) == ControlFlow::Continue(()))
    }

    fn state(&self, layers: &Layers, held: &HeldTube<'_>, pressure: f64) -> Result<TubeState, UniformityError> {
        let stretch = held.stretch_at(pressure, self.stretch).map_err(|refusal| match refusal {
            Refusal::Beyond { most, .. } => {
                UniformityError::NotConverged { quantity: "pressure", error: pressure - most, allowed: 0.0 }
            }
            Refusal::Refused(error) => error,
        })?;
        let state = held.state(stretch)?;
        let loads = state.loads(&self.law, -pressure)?;
        let mut stresses = Vec::new();
        for [from, to] in layers.spans() {
            // At an interface the metric is that of the layer outside.
            for reference in through([from, to - 1e-9 * (to - from)], PARTS) {
                let stress = state.stress(&self.law, reference, -pressure)?.cauchy.0.components;
                stresses.push(StressAt::of(reference, state.place([reference, 0.0, 0.0])?[0], stress));
            }
        }
        let radius = |reference: f64| Ok::<_, UniformityError>(state.place([reference, 0.0, 0.0])?[0]);
        let [inner, outer] = layers.radii();
        Ok(TubeState {
            pressure,
            radii: [radius(inner)?, radius(outer)?],
            axial_stretch: held.axial_stretch,
            axial_force: TAU * loads.second_force,
            moment: loads.first_moment,
            stresses,
        })
    }
}

impl TubeState {
    /// The least and the largest hoop stress, Pa.
    #[must_use]
    pub fn hoop_stresses(&self) -> [f64; 2] {
        let hoop = || self.stresses.iter().map(|at| at.stress[1]);
        [hoop().fold(f64::INFINITY, f64::min), hoop().fold(f64::NEG_INFINITY, f64::max)]
    }

    fn results(&self) -> Value {
        let [least, largest] = self.hoop_stresses();
        json!({
            "pressure_Pa": self.pressure,
            "inner_radius_m": self.radii[0],
            "outer_radius_m": self.radii[1],
            "axial_stretch": self.axial_stretch,
            "axial_force_N": self.axial_force,
            "hoop_moment_N": self.moment,
            "least_hoop_stress_Pa": least,
            "largest_hoop_stress_Pa": largest,
        })
    }
}

impl TubeStresses {
    pub(in crate::studies) fn results(&self) -> Value {
        let state = |state: Option<&TubeState>| state.map(TubeState::results);
        let spread = |state: &TubeState| {
            let [least, largest] = state.hoop_stresses();
            largest - least
        };
        let ratio = self.loaded.as_ref().zip(self.homogeneous.as_ref());
        json!({
            "without_loads": state(self.at_rest.as_ref()),
            "under_pressure": state(self.loaded.as_ref()),
            "homogeneous_under_pressure": state(self.homogeneous.as_ref()),
            "range_of_hoop_stress_over_homogeneous": ratio.map(|(tube, other)| spread(tube) / spread(other)),
        })
    }
}
