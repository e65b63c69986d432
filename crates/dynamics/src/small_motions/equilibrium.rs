//! Statics: where the forces balance.

use nalgebra::{DMatrix, DVector, SVD, Vector3};
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};

use super::linearisation::Sweep;
use super::{Linearisation, Stability};
use crate::DynamicsError;
use crate::lagrangian::{Forces, Lagrangian, Potential};

/// Newton steps after which the search is given up.
const NEWTON_ITERATIONS: usize = 100;
/// How often one of them is halved.
const HALVINGS: usize = 40;

/// A place where the system stays at rest, with what shows that it is one.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// q.
    pub coordinates: DVector<f64>,
    /// The largest force left, by units of mass, over the forces that balance: a few ulp.
    pub residual: f64,
    /// Largest over smallest singular value of ∂f/∂q, by units of mass: that of the squares of the frequencies.
    /// The coordinates are known to a few ulp times it.
    pub condition: f64,
    /// Newton steps made.
    pub iterations: usize,
    /// The equations of motion about it.
    pub linearisation: Linearisation,
    /// What becomes of a small disturbance.
    pub stability: Stability,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Finds coordinates at which the system stays at rest: f(q, 0, t) = 0.
    ///
    /// Newton's iteration with exact derivatives from `guess`, each step halved until the forces get smaller.
    /// It finds stable and unstable equilibria alike; which one, is a matter of the guess. With a placement
    /// that depends on time it is an equilibrium of the moment t, and a lasting one if the time does not show
    /// in the forces: the bead at rest on a hoop that turns steadily.
    ///
    /// # Errors
    /// [`DynamicsError::SingularStiffness`] when the equilibrium is not isolated, or no force answers a
    /// displacement that the search needs; it names the direction. [`DynamicsError::NoEquilibrium`] when the
    /// forces do not get smaller any more. [`DynamicsError::NonFinite`] and what [`check`](Self::check) finds
    /// wrong at the guess.
    ///
    /// # Accuracy
    /// See [`Equilibrium::residual`] and [`Equilibrium::condition`].
    ///
    /// # Example
    /// A pendulum, blown at by a horizontal force of its own weight, hangs at 45°.
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_dynamics::lagrangian::{Holonomic, Lagrangian, Placement};
    /// use piola_dynamics::small_motions::Stability;
    /// use piola_numerics::Real;
    /// struct Pendulum;
    /// impl Holonomic for Pendulum {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = q[0].sin_cos();
    ///         bodies.particle(3.0, Vector3::new(s, T::zero(), -c));
    ///     }
    /// }
    /// let blown = Lagrangian::of(Pendulum).with_uniform_gravity([10.0, 0.0, -10.0]);
    /// let found = blown.equilibrium(&[0.0], 0.0)?;
    /// assert!((found.coordinates[0] - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    /// assert_eq!(found.stability, Stability::Stable);
    /// # Ok::<(), piola_dynamics::DynamicsError>(())
    /// ```
    ///
    /// # Source
    /// W(6.3) at rest.
    pub fn equilibrium(&self, guess: &[f64], t: f64) -> Result<Equilibrium, DynamicsError> {
        let n = guess.len();
        let rest = vec![0.0; n];
        self.check(guess, &rest, t)?;
        let mut q = DVector::from_column_slice(guess);
        let mut forces = self.forces_at(&q, t)?;
        let (mut previous, mut iterations) = (f64::INFINITY, 0);
        loop {
            let units = forces.units();
            let force = forces.force.component_div(&units);
            let stiffness = DMatrix::from_fn(n, n, |i, j| forces.stiffness[(i, j)] / (units[i] * units[j]));
            let decomposition = Decomposition::of(stiffness)?;
            let (mut step, along) = decomposition.solve(&force);
            // The size of displacements is that of the coordinates, or of what has been travelled.
            let extent = (0..n).fold(0.0_f64, |extent, i| {
                let travelled = (q[i] - guess[i]).abs();
                extent.max(units[i] * q[i].abs().max(travelled)).max(step[i].abs())
            });
            let balance = self.weight(q.as_slice(), t).max(decomposition.largest() * extent);
            let residual = if balance <= 0.0 { force.amax() } else { force.amax() / balance };
            let correction = if extent <= 0.0 { 0.0 } else { step.amax() / extent };
            let noise = (1e3 * f64::EPSILON * decomposition.condition()).min(1e-6);
            let stagnates = correction <= noise && previous <= 2.0 * correction;
            let fine = 4.0 * f64::EPSILON;
            let balanced = residual <= fine * (n as f64 + 1.0);
            if (correction <= fine && balanced) || (stagnates && residual <= 1e3 * fine) || force.amax() <= 0.0 {
                if let Some(direction) = decomposition.null_direction(&units) {
                    return Err(DynamicsError::SingularStiffness { ratio: decomposition.ratio(), direction });
                }
                let condition = decomposition.condition();
                return self.balanced(q, t, [residual, condition], iterations);
            }
            if NEWTON_ITERATIONS <= iterations {
                return Err(DynamicsError::NoEquilibrium { iterations, residual });
            }
            let stuck = if along < 0.5 * force.norm() { decomposition.null_direction(&units) } else { None };
            if let Some(direction) = stuck {
                return Err(DynamicsError::SingularStiffness { ratio: decomposition.ratio(), direction });
            }
            iterations += 1;
            step.component_div_assign(&units);
            let size = |forces: &Balance| forces.force.component_div(&units).norm();
            let (mut fraction, before) = (1.0, size(&forces));
            let mut halvings = 0;
            loop {
                let moved = &q + &step * fraction;
                let reached = self.forces_at(&moved, t);
                let smaller = reached.as_ref().is_ok_and(|reached| size(reached) < (1.0 - 1e-4 * fraction) * before);
                // Near the solution the forces are rounding and need not get smaller.
                if smaller || (correction <= noise && reached.is_ok()) {
                    (q, forces) = (moved, reached?);
                    break;
                }
                if HALVINGS <= halvings {
                    return Err(match decomposition.null_direction(&units) {
                        Some(direction) => DynamicsError::SingularStiffness { ratio: decomposition.ratio(), direction },
                        None => DynamicsError::NoEquilibrium { iterations, residual },
                    });
                }
                fraction *= 0.5;
                halvings += 1;
            }
            previous = correction;
        }
    }

    fn balanced(
        &self,
        coordinates: DVector<f64>,
        t: f64,
        [residual, condition]: [f64; 2],
        iterations: usize,
    ) -> Result<Equilibrium, DynamicsError> {
        let zero = DVector::zeros(coordinates.len());
        let linearisation = self.linearise_at(coordinates.as_slice(), zero.as_slice(), t, zero.clone())?;
        let stability = linearisation.stability()?;
        Ok(Equilibrium { coordinates, residual, condition, iterations, linearisation, stability })
    }

    /// The forces on the system at rest with their derivatives.
    fn forces_at(&self, q: &DVector<f64>, t: f64) -> Result<Balance, DynamicsError> {
        let n = q.len();
        let rest = DVector::zeros(n);
        let mut sweep = Sweep::new(q.as_slice(), rest.as_slice(), t);
        let mut stiffness = DMatrix::zeros(n, n);
        for j in 0..n {
            sweep.along(self, j, &rest, stiffness.column_mut(j).as_mut_slice())?;
        }
        let force = DVector::from_fn(n, |i, _| sweep.forcing[i].value);
        let inertia = DVector::from_fn(n, |i, _| sweep.mass_matrix[i + i * n].value);
        Ok(Balance { force, stiffness, inertia })
    }

    /// A bound for what uniform gravity does to any coordinate: |Q_Δ| ≤ √g_ΔΔ · √(Σm) |γ|.
    fn weight(&self, q: &[f64], t: f64) -> f64 {
        let mut mass = Mass(0.0);
        self.system().place(q, t, &mut mass);
        mass.0.sqrt() * Vector3::from(self.gravity()).norm()
    }
}

/// Forces at rest, ∂(−f)/∂q, and the diagonal of the mass matrix.
struct Balance {
    force: DVector<f64>,
    stiffness: DMatrix<f64>,
    inertia: DVector<f64>,
}

impl Balance {
    /// √M_ii, or one where a coordinate has no inertia: statics needs none.
    fn units(&self) -> DVector<f64> {
        self.inertia.map(|m| if 0.0 < m { m.sqrt() } else { 1.0 })
    }
}

/// The singular values of the stiffness.
struct Decomposition {
    svd: SVD<f64, nalgebra::Dyn, nalgebra::Dyn>,
    order: usize,
}

impl Decomposition {
    fn of(stiffness: DMatrix<f64>) -> Result<Self, DynamicsError> {
        let order = stiffness.nrows();
        let svd = SVD::try_new(stiffness, true, true, f64::EPSILON, 100 * order.max(1));
        Ok(Self { svd: svd.ok_or(DynamicsError::NoEigenvalues { rows: order })?, order })
    }

    fn largest(&self) -> f64 {
        self.svd.singular_values.iter().fold(0.0, |m, &x| m.max(x))
    }

    fn smallest(&self) -> f64 {
        self.svd.singular_values.iter().fold(f64::INFINITY, |m, &x| m.min(x))
    }

    /// Smallest over largest singular value; zero for the zero matrix.
    fn ratio(&self) -> f64 {
        let largest = self.largest();
        if 0.0 < largest { self.smallest() / largest } else { 0.0 }
    }

    fn condition(&self) -> f64 {
        if self.order == 0 { 1.0 } else { self.ratio().recip() }
    }

    fn threshold(&self) -> f64 {
        16.0 * self.order as f64 * f64::EPSILON * self.largest()
    }

    /// The shortest x with K x = b but for the directions without stiffness, and the length of the part of b
    /// that it answers.
    fn solve(&self, b: &DVector<f64>) -> (DVector<f64>, f64) {
        let mut x = DVector::zeros(self.order);
        let mut answered = 0.0;
        if let (Some(u), Some(v)) = (&self.svd.u, &self.svd.v_t) {
            for (k, &value) in self.svd.singular_values.iter().enumerate() {
                if self.threshold() < value {
                    let part = u.column(k).dot(b);
                    answered += part * part;
                    x += v.row(k).transpose() * (part / value);
                }
            }
        }
        (x, answered.sqrt())
    }

    /// A displacement that no force answers, of size one, in the coordinates' own units.
    fn null_direction(&self, units: &DVector<f64>) -> Option<Vec<f64>> {
        if self.order == 0 || self.threshold() < self.smallest() {
            return None;
        }
        let direction = self.svd.v_t.as_ref()?.row(self.order - 1).transpose().component_div(units);
        let size = direction.amax();
        let sign = direction.iter().find(|x| (1.0 - 1e-6) * size <= x.abs()).map_or(1.0, |x| x.signum());
        Some(direction.iter().map(|x| sign * x / size).collect())
    }
}

/// The mass placed.
struct Mass(f64);

impl Placement<f64> for Mass {
    fn particle(&mut self, mass: f64, _position: Vector3<f64>) {
        self.0 += mass;
    }
    fn body(&mut self, body: &RigidBody, _centre: Vector3<f64>, _attitude: Attitude<f64>) {
        self.0 += body.mass();
    }
}
