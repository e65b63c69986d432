//! The tube without loads and under pressure, beside one without growth.

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use piola_uniformity::UniformityError;

use super::pressure::{HeldTube, PressureRefusal};
use super::{LayeredTube, Layers};
use crate::StressAt;
use crate::observer::{Observer, outcome};
use crate::stresses::through;
use piola_simulation::Outcome;

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
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (TubeStresses, Outcome) {
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
            PressureRefusal::Beyond { most, .. } => {
                UniformityError::NotConverged { quantity: "pressure", error: pressure - most, allowed: 0.0 }
            }
            PressureRefusal::Refused(error) => error,
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
}
