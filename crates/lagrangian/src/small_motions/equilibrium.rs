//! Statics: where the forces balance.

use nalgebra::{DMatrix, DVector, SVD, Vector3};
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};

use super::linearisation::Sweep;
use super::{Linearisation, Stability};
#[cfg(feature = "serde")]
use crate::check::{check_finite, check_length};
use crate::{Forces, Lagrangian, Potential};
use crate::{LagrangianError, SmallMotionsError};

/// Newton steps after which the search is given up.
const NEWTON_ITERATIONS: usize = 100;
/// How often one of them is halved.
const HALVINGS: usize = 40;

/// A place where the system stays at rest, with what shows that it is one.
///
/// # Example
/// See [`Lagrangian::linearise`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct Equilibrium {
    /// q.
    #[cfg_attr(feature = "serde", serde(with = "crate::written::column"))]
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
    /// [`SmallMotionsError::SingularStiffness`] when the equilibrium is not isolated, or no force answers a
    /// displacement that the search needs; it names the direction. [`SmallMotionsError::NoEquilibrium`] when the
    /// forces do not get smaller any more. [`LagrangianError::NotFinite`] and what [`check`](Self::check) finds
    /// wrong at the guess.
    ///
    /// # Accuracy
    /// See [`Equilibrium::residual`] and [`Equilibrium::condition`].
    ///
    /// # Source
    /// W(6.3) at rest.
    pub fn equilibrium(&self, guess: &[f64], t: f64) -> Result<Equilibrium, LagrangianError> {
        let n = guess.len();
        let rest = vec![0.0; n];
        self.check(guess, &rest, t)?;
        let mut q = DVector::from_column_slice(guess);
        if n == 0 {
            return self.balanced(q, t, [0.0, 1.0], 0);
        }
        let mut forces = self.forces_at(&q, t)?;
        let (mut previous, mut largest_force, mut iterations) = (f64::INFINITY, 0.0_f64, 0);
        loop {
            let units = forces.units();
            let decomposition = Decomposition::of(&forces, &units)?;
            let force = forces.force.component_div(&units);
            let (mut step, answered) = decomposition.solve(&force);
            largest_force = largest_force.max(force.amax());
            let extent_of = |x: &dyn Fn(usize) -> f64| (0..n).fold(0.0_f64, |m, i| m.max((units[i] * x(i)).abs()));
            let guessed = extent_of(&|i| guess[i]);
            let extent = extent_of(&|i| q[i]).max(extent_of(&|i| q[i] - guess[i])).max(step.amax());
            let [weight, size] = self.weight_and_size(q.as_slice(), t);
            // Forces that small are rounding of those at the guess, or of those met on the way.
            let fine = 4.0 * (n as f64 + 1.0) * f64::EPSILON;
            let at_guess = weight.max(decomposition.largest() * guessed);
            let condition = decomposition.condition();
            let small = (1e3 * fine * at_guess).max(1e3 * fine * condition * largest_force);
            let residual = ratio_of(force.amax(), weight.max(decomposition.largest() * extent));
            let correction = ratio_of(step.amax(), extent);
            let noise = (1e3 * f64::EPSILON * condition).min(1e-6);
            let converged = (correction <= fine && residual <= fine)
                || (correction <= noise && previous <= 2.0 * correction && residual <= 1e3 * fine);
            let singular = decomposition.null_direction(&units);
            let refused = |direction| {
                LagrangianError::SmallMotions(SmallMotionsError::SingularStiffness {
                    ratio: decomposition.ratio(),
                    direction,
                })
            };
            if force.amax() <= 0.0 || (converged && force.amax() <= small) {
                return match singular {
                    Some(direction) => Err(refused(direction)),
                    None => self.balanced(q, t, [residual, condition], iterations),
                };
            }
            if answered < 0.5 * force.norm()
                && let Some(direction) = singular
            {
                return Err(refused(direction));
            }
            if NEWTON_ITERATIONS <= iterations {
                return Err(LagrangianError::SmallMotions(SmallMotionsError::NoEquilibrium { iterations, residual }));
            }
            iterations += 1;
            step.component_div_assign(&units);
            let Some(moved) = self.shortened_step(&q, &forces, &step, &units, correction <= noise, t) else {
                // Where q is near zero and positions are not, their rounding leaves a force.
                let rounding = decomposition.largest() * size;
                if singular.is_none() && force.amax() <= fine * rounding {
                    return self.balanced(q, t, [ratio_of(force.amax(), rounding), condition], iterations - 1);
                }
                return Err(singular.map_or(
                    LagrangianError::SmallMotions(SmallMotionsError::NoEquilibrium { iterations, residual }),
                    refused,
                ));
            };
            (q, forces) = moved;
            previous = correction;
        }
    }

    /// The step, halved until the forces get smaller; near the solution, where they are rounding, as it is.
    fn shortened_step(
        &self,
        q: &DVector<f64>,
        forces: &Balance,
        step: &DVector<f64>,
        units: &DVector<f64>,
        near: bool,
        t: f64,
    ) -> Option<(DVector<f64>, Balance)> {
        let size = |forces: &Balance| forces.force.component_div(units).norm();
        let (mut fraction, before) = (1.0, size(forces));
        for _ in 0..=HALVINGS {
            let moved = q + step * fraction;
            // Forces that do not exist there are as good as forces that grow.
            if let Ok(reached) = self.forces_at(&moved, t)
                && (near || size(&reached) < (1.0 - 1e-4 * fraction) * before)
            {
                return Some((moved, reached));
            }
            fraction *= 0.5;
        }
        None
    }

    fn balanced(
        &self,
        coordinates: DVector<f64>,
        t: f64,
        [residual, condition]: [f64; 2],
        iterations: usize,
    ) -> Result<Equilibrium, LagrangianError> {
        let zero = DVector::zeros(coordinates.len());
        let linearisation = self.linearise_at(coordinates.as_slice(), zero.as_slice(), t, zero.clone())?;
        let stability = linearisation.stability()?;
        Ok(Equilibrium { coordinates, residual, condition, iterations, linearisation, stability })
    }

    /// The forces on the system at rest with their derivatives.
    fn forces_at(&self, q: &DVector<f64>, t: f64) -> Result<Balance, LagrangianError> {
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

    /// A bound for what uniform gravity does to any coordinate, |Q_Δ| ≤ √g_ΔΔ · √(Σm) |γ|, and √(Σ m|x|²).
    fn weight_and_size(&self, q: &[f64], t: f64) -> [f64; 2] {
        let mut placed = Masses { total: 0.0, moment: 0.0 };
        self.system().place(q, t, &mut placed);
        [placed.total.sqrt() * Vector3::from(self.gravity()).norm(), placed.moment.sqrt()]
    }
}

/// a/b, and zero where nothing is.
fn ratio_of(a: f64, b: f64) -> f64 {
    if a <= 0.0 { 0.0 } else { a / b }
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
    fn of(forces: &Balance, units: &DVector<f64>) -> Result<Self, LagrangianError> {
        let order = units.len();
        let stiffness = DMatrix::from_fn(order, order, |i, j| forces.stiffness[(i, j)] / (units[i] * units[j]));
        let svd = SVD::try_new(stiffness, true, true, f64::EPSILON, 100 * order);
        Ok(Self {
            svd: svd.ok_or(LagrangianError::SmallMotions(SmallMotionsError::NoEigenvalues { rows: order }))?,
            order,
        })
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
        self.ratio().recip()
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
        if self.threshold() < self.smallest() {
            return None;
        }
        let direction = self.svd.v_t.as_ref()?.row(self.order - 1).transpose().component_div(units);
        let size = direction.amax();
        let sign = direction.iter().find(|x| (1.0 - 1e-6) * size <= x.abs()).map_or(1.0, |x| x.signum());
        Some(direction.iter().map(|x| sign * x / size).collect())
    }
}

/// Σ m and Σ m|x|² of what is placed.
struct Masses {
    total: f64,
    moment: f64,
}

impl Placement<f64> for Masses {
    fn particle(&mut self, mass: f64, position: Vector3<f64>) {
        self.total += mass;
        self.moment += mass * position.norm_squared();
    }
    fn body(&mut self, body: &RigidBody, centre: Vector3<f64>, _attitude: Attitude<f64>) {
        self.particle(body.mass(), centre);
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    #[serde(deserialize_with = "crate::written::column::deserialize")]
    coordinates: DVector<f64>,
    residual: f64,
    condition: f64,
    iterations: usize,
    linearisation: Linearisation,
    stability: Stability,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Equilibrium {
    type Error = LagrangianError;

    fn try_from(given: Unchecked) -> Result<Self, LagrangianError> {
        let Unchecked { coordinates, residual, condition, iterations, linearisation, stability } = given;
        check_length("coordinates", linearisation.coordinates(), coordinates.len())?;
        check_finite("coordinates", coordinates.as_slice())?;
        check_finite("residual and condition", &[residual, condition])?;
        Ok(Self { coordinates, residual, condition, iterations, linearisation, stability })
    }
}
