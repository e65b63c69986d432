//! Spheres and discs that roll on a plane.
//!
//! ```text
//! v + ω×r = 0,   r = −R n  of a sphere,   r = −R (n − (n·a) a)/|n − (n·a) a|  of a disc with the axis a
//! ```
//! Three conditions on the velocities, linear in q̇. Some of the rates follow from the others: lengths before angles. The state holds the
//! coordinates and the rates that are free, so that nothing slips, at any tolerance.
//!
//! Conditions that follow from others at the start are left out. A run ends with an error where the motion violates one of them.

use nalgebra::Vector3;
use piola_lagrangian::anholonomic::{ByCoframe, Coframe, Nonholonomic};
use piola_lagrangian::{ConstraintError, LagrangianError};
use piola_numerics::{Dual, Real};

use super::{Constraint, ConstraintKind};
use crate::SimulationError;
use crate::forces::{AppliedForces, MechanismLagrangian, MechanismPotential};
use crate::joints::{JointTree, Mechanism};

/// The equations of a mechanism whose bodies roll.
pub(crate) type RollingMechanism<'m> =
    Nonholonomic<&'m JointTree, MechanismPotential<'m>, AppliedForces<'m>, ByCoframe<RollingFrame<'m>>>;

/// The rates that are free, and then the independent conditions.
#[derive(Debug, Clone)]
pub(crate) struct RollingFrame<'m> {
    system: &'m Mechanism,
    /// Coordinates whose rates are free.
    pub(crate) free: Vec<usize>,
    /// Conditions that do not follow from others, by their index.
    pub(crate) held: Vec<usize>,
}

/// Writes the conditions of all rolling bodies, row after row.
fn conditions<T: Real>(system: &Mechanism, q: &[T], write: &mut dyn FnMut(usize, usize, T)) {
    let mut first = 0;
    for constraint in &system.constraints {
        let ConstraintKind::Rolling { centre, radius, axis, normal } = &constraint.kind else { continue };
        for i in system.tree.coordinates_of(centre) {
            let seeded = |k: usize| if k == i { Dual::variable(q[k]) } else { Dual::constant(q[k]) };
            let (place, attitude) = system.tree.frame_of(centre, &seeded);
            let components = [attitude.w, attitude.x, attitude.y, attitude.z];
            let still = piola_kinematics::Attitude {
                w: attitude.w.value,
                x: attitude.x.value,
                y: attitude.y.value,
                z: attitude.z.value,
            };
            let spin = still.angular_velocity_in_space(components.map(|component| component.tangent));
            let n = Vector3::from(normal.map(T::lit));
            let towards = match axis {
                None => n,
                Some(axis) => {
                    let a = still.to_space(&Vector3::from(axis.map(T::lit)));
                    let along = n.x * a.x + n.y * a.y + n.z * a.z;
                    let down = Vector3::new(n.x - along * a.x, n.y - along * a.y, n.z - along * a.z);
                    let length = (down.x * down.x + down.y * down.y + down.z * down.z).sqrt();
                    down.map(|x| x / length)
                }
            };
            let r = towards.map(|x| T::lit(-radius) * x);
            let turning = [spin.y * r.z - spin.z * r.y, spin.z * r.x - spin.x * r.z, spin.x * r.y - spin.y * r.x];
            for k in 0..3 {
                write(first + k, i, place[k].tangent + turning[k]);
            }
        }
        first += 3;
    }
}

impl Coframe for RollingFrame<'_> {
    fn coframe<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
        let n = q.len();
        rows.fill(T::zero());
        for (row, coordinate) in self.free.iter().enumerate() {
            rows[row * n + coordinate] = T::one();
        }
        conditions(self.system, q, &mut |condition, coordinate, value| {
            if let Some(place) = self.held.iter().position(|held| *held == condition) {
                rows[(self.free.len() + place) * n + coordinate] = value;
            }
        });
    }
}

impl Mechanism {
    /// Whether a body rolls.
    #[must_use]
    pub fn rolls(&self) -> bool {
        self.constraints.iter().any(|constraint| matches!(constraint.kind, ConstraintKind::Rolling { .. }))
    }

    /// The rates that are free, at the start. Dependent rates that are zero count as not given.
    ///
    /// # Errors
    /// [`SimulationError::DiscFlat`], [`SimulationError::RateAgainstRolling`].
    pub(crate) fn rolling_start(&self) -> Result<Vec<f64>, SimulationError> {
        /// The largest relative difference between a rate that is given and the one that follows.
        const AGREED: f64 = 1e-6;
        self.discs_stand()?;
        let free = self.rolling_frame().free;
        let rates: Vec<f64> = free.iter().map(|i| self.velocity[*i]).collect();
        // A start without velocities is refused by the run, with its reason.
        if let Ok(follows) = self.rolling(self.lagrangian())?.velocities(&self.position, &rates, 0.0) {
            for (i, (&given, &follows)) in self.velocity.iter().zip(follows.as_slice()).enumerate() {
                let contradicts = AGREED * given.abs().max(follows.abs()) < (given - follows).abs();
                if !free.contains(&i) && 0.0 < given.abs() && contradicts {
                    let coordinate = self.coordinates[i].clone();
                    return Err(SimulationError::RateAgainstRolling { coordinate, given, follows });
                }
            }
        }
        Ok(rates)
    }

    /// Refuses discs whose lowest point is not unique at the start.
    fn discs_stand(&self) -> Result<(), SimulationError> {
        /// The least |n − (n·a) a|: below it rounding decides on the direction.
        const LEAST: f64 = 1e-6;
        for Constraint { name, kind } in &self.constraints {
            let ConstraintKind::Rolling { centre, axis: Some(axis), normal, .. } = kind else { continue };
            let (_, attitude) = self.tree.frame_of(centre, &|k| self.position[k]);
            let (a, n) = (attitude.to_space(&Vector3::from(*axis)), Vector3::from(*normal));
            if (n - a * n.dot(&a)).norm() < LEAST {
                return Err(SimulationError::DiscFlat { constraint: name.clone() });
            }
        }
        Ok(())
    }

    /// Checks the conditions that were left out at the start.
    ///
    /// # Errors
    /// [`ConstraintError::Singular`] where one is violated.
    pub(crate) fn check_left_out(
        &self,
        frame: &RollingFrame<'_>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) -> Result<(), LagrangianError> {
        /// The largest velocity of slip, over the largest term of all conditions.
        const SLIP: f64 = 1e-4;
        let mut slips = vec![0.0; 3 * self.constraints.len()];
        let mut scale = 0.0_f64;
        conditions(self, q, &mut |condition, coordinate, value: f64| {
            slips[condition] += value * v[coordinate];
            scale = scale.max((value * v[coordinate]).abs());
        });
        let slipping = |condition: &usize| !frame.held.contains(condition) && SLIP * scale < slips[*condition].abs();
        let Some(condition) = (0..slips.len()).find(slipping) else { return Ok(()) };
        let constraint = condition / 3;
        let name = Some(self.constraints[constraint].name.clone());
        Err(ConstraintError::Singular { constraint, name, time: t }.into())
    }

    /// The equations of the mechanism with bodies that roll, on the parts of a tree.
    pub(crate) fn rolling<'m>(
        &'m self,
        lagrangian: MechanismLagrangian<'m>,
    ) -> Result<RollingMechanism<'m>, SimulationError> {
        let frame = self.rolling_frame();
        let held: Vec<usize> = (frame.free.len()..self.tree.freedom()).collect();
        let rolling = lagrangian.in_coframe(frame).holding(&held);
        rolling.map_err(|_| SimulationError::WrongLength {
            quantity: "held rates",
            expected: held.len(),
            found: self.tree.freedom(),
        })
    }

    /// The free rates and the independent conditions at the start.
    pub(crate) fn rolling_frame(&self) -> RollingFrame<'_> {
        /// A pivot below this part of the largest entry is none.
        const SMALL: f64 = 1e-9;
        let n = self.tree.freedom();
        let count = 3 * self.constraints.len();
        let mut rows = vec![vec![0.0; n]; count];
        conditions(self, &self.position, &mut |condition, coordinate, value: f64| rows[condition][coordinate] = value);
        let scale = rows.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let (mut held, mut given): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
        // Lengths are eliminated before angles: a user knows the angles' rates.
        for angular in [false, true] {
            loop {
                let entries =
                    (0..count).filter(|row| !held.contains(row)).flat_map(|row| (0..n).map(move |i| (row, i)));
                let best = entries
                    .filter(|(_, i)| self.angular[*i] == angular && !given.contains(i))
                    .max_by(|a, b| rows[a.0][a.1].abs().total_cmp(&rows[b.0][b.1].abs()));
                let Some((row, column)) = best.filter(|(row, i)| SMALL * scale < rows[*row][*i].abs()) else { break };
                let pivot = rows[row].clone();
                for (other, entries) in rows.iter_mut().enumerate() {
                    let factor = entries[column] / pivot[column];
                    if other != row && !held.contains(&other) {
                        entries.iter_mut().zip(&pivot).for_each(|(entry, pivot)| *entry -= factor * pivot);
                    }
                }
                held.push(row);
                given.push(column);
            }
        }
        held.sort_unstable();
        let free = (0..n).filter(|i| !given.contains(i)).collect();
        RollingFrame { system: self, free, held }
    }
}
