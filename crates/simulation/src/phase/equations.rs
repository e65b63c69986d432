//! Hamilton's equations of an expression, with all derivatives of a point in one pass.
//!
//! ```text
//! any H:                         q̇ = ∂H/∂p        ṗ = −∂H/∂q        Ẇ = ∂H/∂t
//! H = T(p) + V(q):               q̇ = ∂T/∂p        ṗ = −∂V/∂q        each half by itself
//! H = ½ p·W p + w·p + V(q):      q̈ = −W ∂V/∂q                       q̇ = W p + w
//! ```

use nalgebra::{DMatrix, DVector};
use piola_expression::{ExpressionSlopes, Halves};
use piola_hamiltonian::{HamiltonianError, hessian};
use piola_integrators::internal::magnitudes_of_blocks;
use piola_integrators::{Field, SecondOrder, Separable};

use super::{PhaseExpression, PhaseSystem};
use crate::expression::Variable;

/// Hamilton's equations of any H, with ∫ ∂H/∂t dt after them where H depends on time.
pub(crate) struct PhaseField {
    slopes: ExpressionSlopes,
    freedom: usize,
    driven: bool,
}

impl PhaseField {
    pub(crate) fn of(system: &PhaseSystem) -> Self {
        let hamiltonian = &system.hamiltonian.0;
        Self {
            slopes: ExpressionSlopes::of(hamiltonian),
            freedom: system.freedom(),
            driven: hamiltonian.depends_on_time(),
        }
    }

    /// The field without ∫ ∂H/∂t dt.
    pub(super) fn of_motion(system: &PhaseSystem) -> Self {
        Self { driven: false, ..Self::of(system) }
    }

    /// H and ½ |p·∂H/∂p|.
    pub(crate) fn energies(&mut self, q: &[f64], p: &[f64], t: f64) -> (f64, f64) {
        let mut twice = 0.0;
        let value = self.slopes.differentiate(reader(q, p, t), |variable, slope| {
            if let Variable::Conjugate(i) = variable {
                twice += p[i] * slope;
            }
        });
        (value, 0.5 * twice.abs())
    }
}

fn reader<'r>(q: &'r [f64], p: &'r [f64], t: f64) -> impl Fn(Variable) -> f64 + 'r {
    move |variable| match variable {
        Variable::Coordinate(i) => q[i],
        Variable::Conjugate(i) => p[i],
        Variable::Time => t,
    }
}

/// Refuses derivatives that are not numbers.
fn finite(quantity: &'static str, values: &[f64]) -> Result<(), HamiltonianError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(HamiltonianError::NotFinite { quantity, index, value: values[index] }),
        None => Ok(()),
    }
}

impl Field for PhaseField {
    type Error = HamiltonianError;
    fn dimension(&self) -> usize {
        2 * self.freedom + usize::from(self.driven)
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), HamiltonianError> {
        let n = self.freedom;
        let (q, p) = y[..2 * n].split_at(n);
        rate.fill(0.0);
        let (velocity, rest) = rate.split_at_mut(n);
        let (force, power) = rest.split_at_mut(n);
        self.slopes.differentiate(reader(q, p, t), |variable, slope| match variable {
            Variable::Coordinate(i) => force[i] -= slope,
            Variable::Conjugate(i) => velocity[i] += slope,
            Variable::Time => power.iter_mut().for_each(|power| *power += slope),
        });
        if rate.iter().all(|rate| rate.is_finite()) {
            return Ok(());
        }
        finite("q", q)?;
        finite("p", p)?;
        // ∂H/∂q stands before ∂H/∂p in dH, and is −ṗ.
        let (velocity, rest) = rate.split_at(n);
        let (force, power) = rest.split_at(n);
        let differential: Vec<f64> = force.iter().map(|f| -f).chain(velocity.iter().copied()).collect();
        finite("dH", &differential)?;
        finite("∂H/∂t", power)
    }
    /// The work does not act back on the motion, whose steps serve for it.
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        let dimension = 2 * self.freedom;
        magnitudes_of_blocks(&y[..dimension], &mut magnitudes[..dimension]);
        magnitudes[dimension..].fill(f64::MAX);
    }
}

/// H = T(p) + V(q) as a pair for explicit symplectic methods: only the half that is asked for is evaluated.
pub(crate) struct Split {
    kinetic: Option<ExpressionSlopes>,
    potential: Option<ExpressionSlopes>,
    freedom: usize,
}

impl Split {
    /// Nothing where H is no such sum.
    pub(crate) fn of(system: &PhaseSystem) -> Option<Self> {
        let Halves { of_coordinates, of_conjugates } = system.hamiltonian.0.halves()?;
        let slopes = |half: &Option<_>| half.as_ref().map(ExpressionSlopes::of);
        let (kinetic, potential) = (slopes(&of_conjugates), slopes(&of_coordinates));
        Some(Self { kinetic, potential, freedom: system.freedom() })
    }
}

impl Separable for Split {
    type Error = HamiltonianError;
    fn freedom(&self) -> usize {
        self.freedom
    }
    fn velocity(&mut self, t: f64, momentum: &[f64], velocity: &mut [f64]) -> Result<(), HamiltonianError> {
        velocity.fill(0.0);
        if let Some(kinetic) = &mut self.kinetic {
            kinetic.differentiate(reader(&[], momentum, t), |variable, slope| {
                if let Variable::Conjugate(i) = variable {
                    velocity[i] += slope;
                }
            });
        }
        finite("∂H/∂p", velocity)
    }
    fn force(&mut self, t: f64, position: &[f64], force: &mut [f64]) -> Result<(), HamiltonianError> {
        force.fill(0.0);
        if let Some(potential) = &mut self.potential {
            potential.differentiate(reader(position, &[], t), |variable, slope| {
                if let Variable::Coordinate(i) = variable {
                    force[i] -= slope;
                }
            });
        }
        finite("ṗ", force)
    }
}

/// H = ½ p·W p + w·p + V(q) as equations of second order.
pub(crate) struct Newtonian {
    split: Split,
    /// W = ∂²T/∂p².
    by_momenta: DMatrix<f64>,
    /// W⁻¹, the inertia.
    inertia: DMatrix<f64>,
    /// w.
    drift: DVector<f64>,
    force: DVector<f64>,
}

impl Newtonian {
    /// Nothing where H is no such sum, or W has no inverse to some eight digits.
    pub(crate) fn of(system: &PhaseSystem) -> Option<Self> {
        /// Largest condition number of W: momenta are recorded by W⁻¹.
        const CONDITION: f64 = 1e8;
        let n = system.freedom();
        let kinetic = system.hamiltonian.0.halves()?.of_conjugates?;
        kinetic.degree_in_conjugates().filter(|degree| *degree == 2)?;
        let zero = vec![0.0; n];
        let second = hessian(&PhaseExpression(kinetic), &zero, &zero, 0.0).ok()?;
        let by_momenta = second.view((n, n), (n, n)).into_owned();
        let inertia = by_momenta.clone().try_inverse()?;
        (by_momenta.norm() * inertia.norm() < CONDITION).then_some(())?;
        let mut split = Split::of(system)?;
        let mut drift = DVector::zeros(n);
        split.velocity(0.0, &zero, drift.as_mut_slice()).ok()?;
        Some(Self { split, by_momenta, inertia, drift, force: DVector::zeros(n) })
    }

    /// q̇ = W p + w.
    pub(crate) fn velocities(&self, momenta: &[f64]) -> Vec<f64> {
        (&self.by_momenta * DVector::from_column_slice(momenta) + &self.drift).as_slice().to_vec()
    }

    /// Writes p = W⁻¹ (q̇ − w).
    pub(crate) fn momenta_into(&self, velocities: &[f64], momenta: &mut [f64]) {
        for (i, momentum) in momenta.iter_mut().enumerate() {
            let terms = self.inertia.row(i).into_iter().zip(velocities).zip(&self.drift);
            *momentum = terms.map(|((m, v), w)| m * (v - w)).sum();
        }
    }
}

impl SecondOrder for Newtonian {
    type Error = HamiltonianError;
    const VELOCITY_DEPENDENT: bool = false;
    fn freedom(&self) -> usize {
        self.split.freedom
    }
    fn acceleration(
        &mut self,
        t: f64,
        q: &[f64],
        _v: &[f64],
        acceleration: &mut [f64],
    ) -> Result<(), HamiltonianError> {
        self.split.force(t, q, self.force.as_mut_slice())?;
        for (i, acceleration) in acceleration.iter_mut().enumerate() {
            *acceleration = self.by_momenta.row(i).into_iter().zip(&self.force).map(|(w, f)| w * f).sum();
        }
        Ok(())
    }
}
