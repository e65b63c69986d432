//! Follows the motions.

use piola_dynamics::DynamicsError;
use piola_dynamics::hamiltonian::{PhaseFunction as _, PhasePoint, PoincareSection, lyapunov_exponents};
use piola_integrators::Tolerance;
use serde_json::{Value, json};

use super::{Abscissa, HenonHeiles, Potential};
use crate::run::Outcome;
use crate::studies::run::Observer;

/// Time between two crossings, at most, on the mean.
pub(super) const LONGEST_TURN: f64 = 20.0;
/// Time after which variations are made orthogonal.
const INTERVAL: f64 = 5.0;

/// A motion in a section.
#[derive(Debug, Clone)]
pub struct Motion {
    /// `(y, p_y)` of its crossings, the start first.
    pub crossings: Vec<[f64; 2]>,
    /// The largest Lyapunov exponent.
    pub exponent: f64,
    /// The largest |H − E|.
    pub energy_error: f64,
}

/// The motions of one energy.
#[derive(Debug, Clone)]
pub struct Section {
    /// E.
    pub energy: f64,
    /// The motions.
    pub motions: Vec<Motion>,
}

/// What was found.
#[derive(Debug, Clone, Default)]
pub struct Sections {
    /// A section for each energy.
    pub sections: Vec<Section>,
    /// Time over which the exponents are taken.
    pub duration: f64,
    /// Crossings asked of each motion.
    pub asked: u32,
}

impl HenonHeiles {
    pub(in crate::studies) fn run(&self, observer: &mut Observer<'_>) -> (Sections, Outcome) {
        let mut found = Sections { sections: Vec::new(), duration: self.duration, asked: self.crossings };
        let outcome = match self.follow(&mut found, observer) {
            Ok(true) => Outcome::Completed,
            Ok(false) => Outcome::Interrupted,
            Err(error) => Outcome::Failed(error.to_string()),
        };
        (found, outcome)
    }

    fn follow(&self, found: &mut Sections, observer: &mut Observer<'_>) -> Result<bool, DynamicsError> {
        let tolerance = Tolerance::relative(self.tolerance)
            .map_err(|error| DynamicsError::Run { time: 0.0, source: Box::new(error.with_field_error()) })?;
        let whole = self.energies.len() as f64 * f64::from(self.orbits);
        let mut done = 0.0;
        for &energy in &self.energies {
            found.sections.push(Section { energy, motions: Vec::new() });
            for [y, momentum] in starts(energy, self.orbits) {
                let motion = self.motion(energy, [y, momentum], tolerance)?;
                if let Some(section) = found.sections.last_mut() {
                    section.motions.push(motion);
                }
                done += 1.0;
                if observer(done / whole).is_break() {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    fn motion(&self, energy: f64, [y, momentum]: [f64; 2], tolerance: Tolerance) -> Result<Motion, DynamicsError> {
        let across = square_across(energy, y, momentum).max(0.0).sqrt();
        let start = PhasePoint::new(&[0.0, y], &[across, momentum], 0.0)?;
        let section = PoincareSection::new(&Potential, &Abscissa, tolerance);
        let mut points = Vec::with_capacity(self.crossings as usize);
        let most = self.crossings as usize;
        section.follow_into(&start, LONGEST_TURN * f64::from(self.crossings), most, &mut points)?;
        let crossings = points.iter().map(|point| [point.q()[1], point.p()[1]]);
        let error = |point: &PhasePoint| (Potential.value(point.q(), point.p(), 0.0) - energy).abs();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is at least one")]
        let intervals = (self.duration / INTERVAL).ceil().max(1.0) as usize;
        let interval = self.duration / intervals as f64;
        let exponents = lyapunov_exponents(&Potential, &start, 1, interval, intervals, tolerance)?;
        Ok(Motion {
            crossings: core::iter::once([y, momentum]).chain(crossings).collect(),
            exponent: exponents.exponents.first().copied().unwrap_or(f64::NAN),
            energy_error: points.iter().chain([&exponents.end]).map(error).fold(0.0, f64::max),
        })
    }
}

/// `p_x²` where x = 0.
pub(super) fn square_across(energy: f64, y: f64, momentum: f64) -> f64 {
    2.0 * energy - momentum * momentum - y * y + 2.0 / 3.0 * y * y * y
}

/// The interval of y around 0 that an energy allows where x = 0 and `p_y = 0`.
pub(super) fn allowed(energy: f64) -> [f64; 2] {
    [-1.0, 1.0].map(|end| {
        let (mut inside, mut outside) = (0.0, end);
        for _ in 0..200 {
            let middle = 0.5 * (inside + outside);
            *(if 0.0 <= square_across(energy, middle, 0.0) { &mut inside } else { &mut outside }) = middle;
        }
        inside
    })
}

/// Places `(y, p_y)` from which motions start: two of three on the axis `p_y = 0`, the others on y = 0.
fn starts(energy: f64, count: u32) -> Vec<[f64; 2]> {
    let [low, high] = allowed(energy);
    let upright = count / 3;
    let level = count - upright;
    let share = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let on_axis = (0..level).map(|i| [low + share(i, level) * (high - low), 0.0]);
    let beside = (0..upright).map(|i| [0.0, share(i, upright) * (2.0 * energy).sqrt()]);
    on_axis.chain(beside).collect()
}

impl Sections {
    pub(in crate::studies) fn results(&self) -> Value {
        let motions = || self.sections.iter().flat_map(|section| &section.motions);
        let sections: Vec<Value> = self
            .sections
            .iter()
            .map(|section| {
                let exponents = || section.motions.iter().map(|motion| motion.exponent);
                json!({
                    "energy": section.energy,
                    "motions": section.motions.len(),
                    "largest_exponent": exponents().fold(f64::NEG_INFINITY, f64::max),
                    "chaotic_motions": exponents().filter(|exponent| self.threshold() < *exponent).count(),
                })
            })
            .collect();
        json!({
            "motions": motions().count(),
            "crossings": motions().map(|motion| motion.crossings.len()).sum::<usize>(),
            "motions_with_fewer_crossings_than_asked": motions().filter(|motion| self.fewer(motion)).count(),
            "largest_error_of_energy": motions().map(|motion| motion.energy_error).fold(0.0, f64::max),
            "threshold_of_chaos": self.threshold(),
            "sections": sections,
        })
    }

    /// Whether a motion ran out of time before the crossings asked of it, its start not among them.
    #[must_use]
    pub fn fewer(&self, motion: &Motion) -> bool {
        motion.crossings.len() <= self.asked as usize
    }

    /// Exponents above this are not those of a regular motion at a finite time, whose variations grow as the time does.
    #[must_use]
    pub fn threshold(&self) -> f64 {
        2.0 * self.duration.max(core::f64::consts::E).ln() / self.duration
    }
}
