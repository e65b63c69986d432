//! The pressure of a tube of layers over the stretch of its inner face.

use piola_uniformity::UniformityError;
use piola_uniformity::laminated::{LaminatedTube, SheetState};

use super::Layers;
use crate::RubberLaw;

/// Intervals of the range of stretches that are searched one by one.
const INTERVALS: u32 = 96;

/// A tube whose axial stretch is held.
#[derive(Debug)]
pub struct HeldTube<'a> {
    tube: LaminatedTube<&'a Layers>,
    law: &'a RubberLaw,
    /// r of the inner face without pressure, m.
    pub(super) radius: f64,
    /// λ.
    pub(super) axial_stretch: f64,
}

/// Why no state carries a pressure.
#[derive(Debug)]
pub enum PressureRefusal {
    /// It is beyond the largest one.
    Beyond {
        /// The largest, Pa.
        most: f64,
        /// Its stretch.
        stretch: f64,
        /// Whether the range ends there.
        is_end: bool,
    },
    /// A state is refused.
    Refused(UniformityError),
}

impl From<UniformityError> for PressureRefusal {
    fn from(error: UniformityError) -> Self {
        Self::Refused(error)
    }
}

impl<'a> HeldTube<'a> {
    /// The tube without loads.
    ///
    /// # Errors
    /// It has no state without loads.
    pub fn at_rest(layers: &'a Layers, law: &'a RubberLaw) -> Result<Self, UniformityError> {
        let tube = LaminatedTube::new(layers, layers.radii())?;
        let rest = tube.at_rest(law)?.state;
        let [radius, _, axial_stretch] = rest.place([layers.radii()[0], 0.0, 1.0])?;
        Ok(Self { tube, law, radius, axial_stretch })
    }

    /// At a stretch of the inner face.
    pub(super) fn state(&self, stretch: f64) -> Result<SheetState<&&'a Layers>, UniformityError> {
        self.tube.inflated(stretch * self.radius, [[1.0, 0.0], [0.0, self.axial_stretch]])
    }

    /// The pressure at a stretch, Pa.
    pub(super) fn pressure(&self, stretch: f64) -> Result<f64, UniformityError> {
        Ok(self.state(stretch)?.loads(self.law, 0.0)?.normal_stress_difference)
    }

    /// The pressure over stretches from 1 to the largest one.
    pub(super) fn curve(&self, largest: f64) -> Result<Vec<(f64, f64)>, UniformityError> {
        (0..=INTERVALS)
            .map(|i| {
                let stretch = 1.0 + (largest - 1.0) * f64::from(i) / f64::from(INTERVALS);
                Ok((stretch, self.pressure(stretch)?))
            })
            .collect()
    }

    /// The first stretch at which a pressure, Pa, is carried, up to the largest stretch.
    ///
    /// # Errors
    /// [`PressureRefusal`].
    pub fn stretch_at(&self, pressure: f64, largest: f64) -> Result<f64, PressureRefusal> {
        if pressure <= 0.0 {
            return Ok(1.0);
        }
        let curve = self.curve(largest)?;
        let Some(pair) = curve.windows(2).find(|pair| pressure <= pair[1].1) else {
            let highest = (0..curve.len()).max_by(|a, b| curve[*a].1.total_cmp(&curve[*b].1)).unwrap_or(0);
            let is_end = highest + 1 == curve.len();
            let around = (curve[highest.saturating_sub(1)].0, curve[(highest + 1).min(curve.len() - 1)].0);
            let (stretch, most) = if is_end { curve[highest] } else { self.highest(around)? };
            // Between two points of the search the curve may reach it all the same.
            if most < pressure {
                return Err(PressureRefusal::Beyond { most, stretch, is_end });
            }
            return Ok(self.bisected(pressure, (curve[highest.saturating_sub(1)].0, stretch))?);
        };
        Ok(self.bisected(pressure, (pair[0].0, pair[1].0))?)
    }

    /// A stretch between two others of which the second carries the pressure.
    fn bisected(&self, pressure: f64, (mut low, mut high): (f64, f64)) -> Result<f64, UniformityError> {
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if self.pressure(middle)? < pressure {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(high)
    }

    /// The stretch of the largest pressure, and that pressure: the golden section of an interval with one maximum.
    fn highest(&self, (mut low, mut high): (f64, f64)) -> Result<(f64, f64), UniformityError> {
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        for _ in 0..40 {
            let [left, right] = [high - golden * (high - low), low + golden * (high - low)];
            if self.pressure(left)? < self.pressure(right)? {
                low = left;
            } else {
                high = right;
            }
        }
        let stretch = f64::midpoint(low, high);
        Ok((stretch, self.pressure(stretch)?))
    }
}
