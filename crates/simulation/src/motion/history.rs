//! The record of a run: positions and coordinates at instants, invariants at ends of steps.

use serde::{Deserialize, Serialize};

/// Positions, coordinates and invariants over time.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct History {
    /// Names of the bodies or parts.
    pub names: Vec<String>,
    /// Instants, s.
    pub times: Vec<f64>,
    /// Positions, m: for each instant one a body.
    pub positions: Vec<Vec<[f64; 3]>>,
    /// Velocities, m/s, in the same order; empty for a mechanism, which has `coordinates`.
    pub velocities: Vec<Vec<[f64; 3]>>,
    /// Names of the coordinates of a mechanism; names of coordinates and then of momenta under a Hamiltonian.
    pub coordinate_names: Vec<String>,
    /// Coordinates and then their rates or momenta, for each instant; empty of bodies that move freely.
    pub coordinates: Vec<Vec<f64>>,
    /// Names of the forces of a mechanism that take energy or give it.
    pub work_names: Vec<String>,
    /// Their works since the start, J, for each instant; empty without such forces.
    pub works: Vec<Vec<f64>>,
    /// Names of the parts of the energy: kinetic energy and weight of every part, what every force stores.
    pub energy_names: Vec<String>,
    /// These energies, J, for each instant; empty unless they are asked for.
    pub energies: Vec<Vec<f64>>,
    /// Names of the forces of constraints, each with its unit: tensions, forces of loops, drives.
    pub condition_names: Vec<String>,
    /// These forces for each instant; empty unless reactions are asked for.
    pub conditions: Vec<Vec<f64>>,
    /// Forces and moments on the parts, for each instant and part; empty unless reactions are asked for.
    pub reactions: Vec<Vec<PartReaction>>,
    /// Singular positions of the constraints that the motion went through, the first 64: s and the constraint that depends on
    /// others there. Motions of several kinds meet there, and the recorded one goes on along the smooth branch.
    pub singular_positions: Vec<(f64, String)>,
    /// Invariants. With an adaptive method they stand at the end of the step that an instant falls into, where the state is
    /// best known.
    pub invariants: Vec<Invariants>,
}

/// What holds a part of a mechanism beside gravity: m ẍ − m g, by its joint, by forces and by constraints together.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartReaction {
    /// Force, N, in space.
    pub force: [f64; 3],
    /// Moment about the centre of mass, N m, in space; zero of a particle.
    pub moment: [f64; 3],
}

/// A vector with the magnitude that its changes are compared with.
pub type Scaled = ([f64; 3], f64);

/// The invariants of the motion at one time.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Invariants {
    /// Time, s.
    pub time: f64,
    /// Kinetic and potential energy, J.
    pub energy: f64,
    /// The work that forces, dampers and drives have brought in since the start, J: `energy` − `work` is what is conserved.
    pub work: f64,
    /// A scale of energy besides the first energy: the kinetic energy in a mechanism, whose potential has an arbitrary zero, and
    /// ½ |p·∂H/∂p| under a Hamiltonian; 0 otherwise.
    pub energy_scale: f64,
    /// Energy with the post-Newtonian part, J, when that is on.
    pub post_newtonian_energy: Option<f64>,
    /// Σ m v, kg m/s, and Σ m |v|, where momentum is conserved.
    pub momentum: Option<Scaled>,
    /// Σ m r × v, kg m²/s, and Σ m |r × v|, where it is conserved.
    pub angular_momentum: Option<Scaled>,
}

/// How far one invariant went from its first value.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Drift {
    /// The largest |change| over the whole run, relative.
    pub max_relative: f64,
    /// The |change| at the end, relative.
    pub last_relative: f64,
}

/// The drifts; `None` for what is not conserved.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Drifts {
    /// |E − W − E₀| relative to |E₀|, W being the work of its forces. In a mechanism it is relative to the largest of |E₀| and
    /// the kinetic energy, under a Hamiltonian to the largest of |E₀| and ½ |p·∂H/∂p|.
    pub energy: Option<Drift>,
    /// Drift of the energy with its post-Newtonian part, likewise.
    pub post_newtonian_energy: Option<Drift>,
    /// |P − P₀| relative to Σ m |v|.
    pub momentum: Option<Drift>,
    /// |H − H₀| relative to Σ m |r × v|.
    pub angular_momentum: Option<Drift>,
}

impl History {
    /// Leaves so many recorded instants and invariants.
    pub(super) fn truncate(&mut self, [recorded, invariants]: [usize; 2]) {
        self.times.truncate(recorded);
        self.positions.truncate(recorded);
        self.velocities.truncate(recorded);
        for rows in [&mut self.coordinates, &mut self.works, &mut self.energies, &mut self.conditions] {
            rows.truncate(recorded);
        }
        self.reactions.truncate(recorded);
        self.invariants.truncate(invariants);
    }

    /// The drifts of the recorded invariants.
    #[must_use]
    pub fn drifts(&self) -> Drifts {
        let series = self.drift_series();
        let of = |pick: fn(&DriftAt) -> Option<f64>| {
            let values: Vec<f64> = series.iter().filter_map(pick).collect();
            let last = *values.last()?;
            // A drift that is not a number is the largest of all.
            let largest = values.iter().copied().reduce(|a, b| if a.is_nan() || b < a { a } else { b })?;
            Some(Drift { max_relative: largest, last_relative: last })
        };
        Drifts {
            energy: of(|drift| Some(drift.energy)),
            post_newtonian_energy: of(|drift| drift.post_newtonian_energy),
            momentum: of(|drift| drift.momentum),
            angular_momentum: of(|drift| drift.angular_momentum),
        }
    }

    /// Relative changes since the first record, one for each record.
    #[must_use]
    pub fn drift_series(&self) -> Vec<DriftAt> {
        let Some(first) = self.invariants.first() else { return Vec::new() };
        let energy_scale = self.invariants.iter().map(|record| record.energy_scale).fold(first.energy.abs(), f64::max);
        let relative = |change: f64, scale: f64| if 0.0 < scale { change / scale } else { change };
        let vector = |pick: fn(&Invariants) -> Option<Scaled>, record: &Invariants| {
            let ((now, scale), (start, _)) = (pick(record)?, pick(first)?);
            let square: f64 = now.iter().zip(start).map(|(a, b)| (a - b) * (a - b)).sum();
            Some(relative(square.sqrt(), scale))
        };
        self.invariants
            .iter()
            .map(|record| DriftAt {
                time: record.time,
                energy: relative((record.energy - record.work - first.energy).abs(), energy_scale),
                post_newtonian_energy: record
                    .post_newtonian_energy
                    .zip(first.post_newtonian_energy)
                    .map(|(now, start)| relative((now - start).abs(), start.abs())),
                momentum: vector(|record| record.momentum, record),
                angular_momentum: vector(|record| record.angular_momentum, record),
            })
            .collect()
    }
}

/// Relative changes of the invariants at one time, scaled as in [`Drifts`]; `None` for what is not conserved.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct DriftAt {
    /// Time, s.
    pub time: f64,
    /// Of the energy.
    pub energy: f64,
    /// Of the energy with its post-Newtonian part.
    pub post_newtonian_energy: Option<f64>,
    /// Of the momentum.
    pub momentum: Option<f64>,
    /// Of the angular momentum.
    pub angular_momentum: Option<f64>,
}
