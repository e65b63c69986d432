//! Projection onto the constraints, of positions and of velocities.
//!
//! ```text
//! δq = −M⁻¹Gᵀ (G M⁻¹ Gᵀ)⁻¹ φ      until φ = 0 to rounding        the nearest position, in the inertia metric
//! δq̇ = −M⁻¹Gᵀ (G M⁻¹ Gᵀ)⁻¹ (G q̇ + ∂φ/∂t)                          the nearest velocity
//! ```

use piola_kinematics::Holonomic;

use super::workspace::Workspace;
use super::{Constrained, Constraints};
use crate::check::check_length;
use crate::{ConstraintError, LagrangianError};
use crate::{Forces, Potential};

/// A state that satisfies the constraints, and how well.
///
/// # Example
/// See [`Constrained::integrate`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Assembly {
    /// The coordinates q.
    pub coordinates: Vec<f64>,
    /// The velocities q̇.
    pub velocities: Vec<f64>,
    /// The largest |φᵢ|, relative to Σ |∂φᵢ/∂q| max(|q|, 1), or to a thousandth of the largest of these.
    pub residual: f64,
    /// The largest |φ̇ᵢ|, relative in the same way to Σ |∂φᵢ/∂q| max |q̇|.
    pub rate_residual: f64,
    /// The iterations made.
    pub iterations: usize,
}

/// How well a projection ended.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Closeness {
    pub(super) residual: f64,
    pub(super) rate_residual: f64,
    pub(super) iterations: usize,
}

/// The relative residuals beyond which constraints count as violated: far above rounding.
const SATISFIED: f64 = 1e-12;
const MOST_ITERATIONS: usize = 60;

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// A state near a guess that satisfies φ = 0 and G q̇ + ∂φ/∂t = 0 to rounding.
    ///
    /// Positions are found by Gauss and Newton's method in the inertia metric, with shorter steps where it would
    /// lead away; velocities by one linear projection. Redundant constraints do no harm.
    ///
    /// # Errors
    /// As [`check`](Self::check) and [`acceleration`](Self::acceleration);
    /// [`ConstraintError::Inconsistent`], where a constraint contradicts others on which its gradient
    /// depends; [`ConstraintError::NotAssembled`] where no such position is found near the guess.
    ///
    /// # Accuracy
    /// Residuals of a few ulp: they are returned.
    pub fn assemble(&self, q: &[f64], v: &[f64], t: f64) -> Result<Assembly, LagrangianError> {
        self.check(q, v, t)?;
        let (mut coordinates, mut velocities) = (q.to_vec(), v.to_vec());
        let close = self.project_into(&mut Workspace::default(), &mut coordinates, &mut velocities, t)?;
        let Closeness { residual, rate_residual, iterations } = close;
        Ok(Assembly { coordinates, velocities, residual, rate_residual, iterations })
    }

    /// Projects a state, and leaves M (at the position given), φ̇, γ and G in `work`, the gradients at scale.
    pub(super) fn project_into(
        &self,
        work: &mut Workspace,
        q: &mut [f64],
        v: &mut [f64],
        t: f64,
    ) -> Result<Closeness, LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        let (residual, iterations) = self.project_position(work, q, v, t)?;
        let rate_residual = self.project_velocity(work, q, v, t)?;
        Ok(Closeness { residual, rate_residual, iterations })
    }

    /// The largest residual of a position, relative, and which it is.
    pub(super) fn violation(work: &Workspace, q: &[f64]) -> (usize, f64) {
        let unit = q.iter().fold(1.0, |m: f64, q| m.max(q.abs()));
        worst(&work.gradients.residuals, &work.gradients.rows, unit, q.len())
    }

    fn project_position(
        &self,
        work: &mut Workspace,
        q: &mut [f64],
        v: &[f64],
        t: f64,
    ) -> Result<(f64, usize), LagrangianError> {
        let n = q.len();
        let mut weights = core::mem::take(&mut work.multipliers);
        let mut trial = core::mem::take(&mut work.acceleration);
        let mut before = f64::INFINITY;
        let mut outcome = None;
        for iteration in 0..MOST_ITERATIONS {
            // The metric need not be that of the last iteration: it says only what is near.
            if iteration == 0 || SATISFIED.sqrt() < before {
                self.form(work, q, v, t)?;
                self.factor(work, false)?;
            } else {
                self.differentiate(work, q, v, t);
                work.independence.scale(&work.gradients.rows, self.constraints.count());
            }
            let (_, violation) = Self::violation(work, q);
            let small = violation <= SATISFIED;
            if violation <= 0.5 * f64::EPSILON || small && 0.25 * before <= violation {
                outcome = Some((violation, iteration));
                break;
            }
            before = violation;
            weights.clear();
            weights.extend_from_slice(&work.gradients.residuals);
            work.independence.factor_corrections()?;
            work.independence.weigh(&mut weights)?;
            Self::gather(work, &weights, n);
            work.independence.solve_metric(&mut work.along)?;
            if small {
                q.iter_mut().zip(&work.along).for_each(|(q, step)| *q -= step);
                continue;
            }
            // Shorter until the residuals, in units of what they cost, get smaller.
            let cost = |residuals: &[f64], work: &Workspace| -> f64 {
                let each = residuals.iter().zip(&work.independence.sizes);
                each.map(|(r, s)| if 0.0 < *s { (r / s).powi(2) } else { 0.0 }).sum()
            };
            let start = cost(&work.gradients.residuals, work);
            let mut share = 1.0;
            let lower = (0..30).any(|_| {
                trial.clear();
                trial.extend(q.iter().zip(&work.along).map(|(q, step)| q - share * step));
                self.constraints.residuals(&trial, t, &mut weights);
                share *= 0.5;
                cost(&weights, work) < start
            });
            if !lower {
                break;
            }
            q.copy_from_slice(&trial);
        }
        (work.multipliers, work.acceleration) = (weights, trial);
        match outcome {
            Some(closeness) => Ok(closeness),
            None => Err(self.explain_assembly(work, q, v, t)),
        }
    }

    /// The residuals of a state, relative as those of an [`Assembly`].
    pub(super) fn relative_residuals(&self, work: &mut Workspace, q: &[f64], v: &[f64], t: f64) -> (f64, f64) {
        self.differentiate(work, q, v, t);
        let (_, residual) = Self::violation(work, q);
        let fastest = v.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let (_, rate) = worst(&work.gradients.rates, &work.gradients.rows, fastest, q.len());
        (residual, rate)
    }

    /// The constraint that contradicts others, or else that which is farthest from being satisfied.
    #[cold]
    fn explain_assembly(&self, work: &mut Workspace, q: &[f64], v: &[f64], t: f64) -> LagrangianError {
        if let Err(error) = self.form(work, q, v, t).and_then(|()| self.factor(work, false)) {
            return error;
        }
        if let Some(error) = self.contradiction(work, |work| &work.gradients.residuals) {
            return error;
        }
        let (constraint, _) = Self::violation(work, q);
        let residual = work.gradients.residuals[constraint];
        LagrangianError::Constraint(ConstraintError::NotAssembled {
            constraint,
            name: self.name_of(constraint),
            residual,
        })
    }

    /// A constraint whose gradient is a combination of others but whose residual is not.
    fn contradiction(&self, work: &mut Workspace, of: impl Fn(&Workspace) -> &[f64]) -> Option<LagrangianError> {
        work.independence.choose(self.least_share.max(1e-5));
        work.independence.combine();
        let residuals = of(work);
        let left = |place: usize| {
            let combination = work.independence.combination(place);
            let made_up: f64 = combination.iter().zip(residuals).map(|(c, r)| c * r).sum();
            let constraint = work.independence.order[place];
            let residual = residuals[constraint] - made_up;
            let scale = residuals.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
            (1e-3 * scale < residual.abs()).then_some((constraint, residual, combination))
        };
        let (constraint, residual, combination) =
            (work.independence.rank..work.independence.order.len()).find_map(left)?;
        let name = self.name_of(constraint);
        Some(LagrangianError::Constraint(ConstraintError::Inconsistent { constraint, name, residual, combination }))
    }

    fn project_velocity(&self, work: &mut Workspace, q: &[f64], v: &mut [f64], t: f64) -> Result<f64, LagrangianError> {
        let n = q.len();
        let mut weights = core::mem::take(&mut work.multipliers);
        let mut fastest = 0.0_f64;
        let mut before = f64::INFINITY;
        let (mut constraint, mut violation) = (0, 0.0);
        for iteration in 0..8 {
            self.differentiate(work, q, v, t);
            fastest = v.iter().fold(fastest, |m, v| m.max(v.abs()));
            (constraint, violation) = worst(&work.gradients.rates, &work.gradients.rows, fastest, n);
            if violation <= f64::EPSILON || 0 < iteration && 0.25 * before <= violation {
                break;
            }
            before = violation;
            if iteration == 0 {
                work.independence.factor_corrections()?;
            }
            weights.clear();
            weights.extend_from_slice(&work.gradients.rates);
            work.independence.weigh(&mut weights)?;
            Self::gather(work, &weights, n);
            work.independence.solve_metric(&mut work.along)?;
            v.iter_mut().zip(&work.along).for_each(|(v, step)| *v -= step);
        }
        work.multipliers = weights;
        if violation <= SATISFIED {
            return Ok(violation);
        }
        let found = self.contradiction(work, |work| &work.gradients.rates);
        let residual = work.gradients.rates[constraint];
        let name = self.name_of(constraint);
        Err(found.unwrap_or(LagrangianError::Constraint(ConstraintError::NotAssembled { constraint, name, residual })))
    }
}

/// The constraint of the largest residual, relative to Σ |∂φᵢ/∂q| `unit`, or to a thousandth of the largest of these:
/// where a gradient nearly vanishes its own terms do not tell what rounding is. Infinite where nothing moves.
fn worst(residuals: &[f64], rows: &[f64], unit: f64, n: usize) -> (usize, f64) {
    let scale = |i: usize| rows[i * n..(i + 1) * n].iter().map(|g| g.abs()).sum::<f64>() * unit;
    let least = 1e-3 * (0..residuals.len()).map(scale).fold(0.0, f64::max);
    let mut worst = (0, 0.0);
    for (i, residual) in residuals.iter().map(|r| r.abs()).enumerate() {
        let violation = if residual <= 0.0 { 0.0 } else { residual / scale(i).max(least) };
        // NaN is the worst.
        if worst.1 < violation || violation.is_nan() {
            worst = (i, violation);
        }
    }
    worst
}
