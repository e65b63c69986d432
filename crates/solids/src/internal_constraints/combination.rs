//! Several constraints at once.

use piola_continuum::rates::VelocityGradient;
use piola_continuum::{CauchyStress, Symmetric};

use super::orthogonal::{Orthogonal, dot, orthogonalise};
use super::{Restriction, StressCondition};
use crate::SolidsError;

/// Differences beyond this share of what is compared are contradictions.
const LARGEST_RESIDUAL: f64 = 1e-9;

/// Constraints at one deformation, independent of one another.
///
/// ```text
/// N = Σ λₖ Nₖ,  Nₖ = F (∂μₖ/∂F)ᵀ        μ̇ₖ = Nₖ : D = 0
/// ```
///
/// # Example
/// A cord in two directions that are the same.
/// ```
/// use piola_solids::SolidsError;
/// use piola_solids::internal_constraints::{Combination, Inextensibility, InternalConstraint};
/// use piola_solids::Fibre;
/// use piola_continuum::DeformationGradient;
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// let cord = |direction| Fibre::new(direction).map(Inextensibility::along);
/// let (one, other) = (cord([0.0, 1.0, 0.0])?.at(&shear)?, cord([0.0, -2.0, 0.0])?.at(&shear)?);
/// let refused = Combination::new([one, other]);
/// assert!(matches!(refused, Err(SolidsError::RedundantConstraint { index: 1, rank: 1, .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(21.18).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Combination<const N: usize> {
    restrictions: [Restriction; N],
    /// An orthonormal basis of the reactions, shears × √2.
    basis: [[f64; 6]; N],
}

/// The components in an orthonormal basis of symmetric tensors.
fn coordinates(tensor: &Symmetric) -> [f64; 6] {
    let [a, b, c, d, e, f] = tensor.components;
    let root = core::f64::consts::SQRT_2;
    [a, b, c, d * root, e * root, f * root]
}

fn reactions<const N: usize>(restrictions: &[Restriction; N]) -> [[f64; 6]; N] {
    core::array::from_fn(|k| coordinates(&restrictions[k].reaction))
}

impl<const N: usize> Combination<N> {
    /// Of constraints at the same deformation.
    ///
    /// Those that say the same are told from those that contradict one another by their values: a motion that keeps the
    /// others and changes μₖ at the rate −μₖ must exist.
    ///
    /// # Errors
    /// [`SolidsError::RedundantConstraint`] for a reaction that is, but for 10⁻¹⁰ of itself, a sum of others or zero;
    /// [`SolidsError::InconsistentConstraints`] if its value differs from the same sum of the others' values.
    pub fn new(restrictions: [Restriction; N]) -> Result<Self, SolidsError> {
        let orthogonal = orthogonalise(&reactions(&restrictions));
        if orthogonal.rank == N {
            return Ok(Self { restrictions, basis: orthogonal.basis });
        }
        // The first dependent one, as the one given last of those that make it up.
        let Orthogonal { rank, share, order, .. } = orthogonal;
        for (place, &index) in order.iter().enumerate().skip(rank) {
            let (expected, scale) = Self::implied(&orthogonal, &restrictions, place);
            let residual = restrictions[index].value - expected;
            if LARGEST_RESIDUAL * scale < residual.abs() {
                return Err(SolidsError::InconsistentConstraints { index, residual });
            }
        }
        let index = order[rank..].iter().copied().max().unwrap_or(N);
        Err(SolidsError::RedundantConstraint { index, rank, count: N, share })
    }

    /// The value of a dependent constraint that follows from the independent ones, and the size to compare it with.
    fn implied(orthogonal: &Orthogonal<6, N>, restrictions: &[Restriction; N], place: usize) -> (f64, f64) {
        let mut column = [0.0; N];
        for (entry, row) in column.iter_mut().zip(&orthogonal.triangle) {
            *entry = row[place];
        }
        let shares = orthogonal.back_substituted(column);
        let own = &restrictions[orthogonal.order[place]];
        let mut scale = coordinates(&own.reaction).iter().fold(own.value.abs(), |scale, x| scale.max(x.abs()));
        let mut sum = 0.0;
        for (share, &index) in shares.iter().zip(&orthogonal.order).take(orthogonal.rank) {
            let part = share * restrictions[index].value;
            scale = scale.max(part.abs());
            sum += part;
        }
        (sum, scale)
    }

    /// Number of independent constraints; never an error.
    #[must_use]
    pub fn rank(restrictions: &[Restriction; N]) -> usize {
        orthogonalise(&reactions(restrictions)).rank
    }

    /// The constraints.
    #[must_use]
    pub const fn restrictions(&self) -> &[Restriction; N] {
        &self.restrictions
    }

    /// Refuses a deformation that the material cannot have.
    ///
    /// # Errors
    /// [`SolidsError::ConstraintViolated`] with the first μₖ whose modulus is above `tolerance`.
    pub fn check_satisfied(&self, tolerance: f64) -> Result<(), SolidsError> {
        for (index, restriction) in self.restrictions.iter().enumerate() {
            let value = restriction.value;
            if value.is_nan() || tolerance < value.abs() {
                return Err(SolidsError::ConstraintViolated { index, value, tolerance });
            }
        }
        Ok(())
    }

    /// N = Σ λₖ Nₖ, Pa.
    #[must_use]
    pub fn reaction(&self, multipliers: [f64; N]) -> CauchyStress {
        let mut sum = Symmetric::zero();
        for (restriction, multiplier) in self.restrictions.iter().zip(multipliers) {
            sum += restriction.reaction * multiplier;
        }
        CauchyStress(sum)
    }

    /// T = N + what the law gives, Pa.
    #[must_use]
    pub fn stress(&self, extra: &CauchyStress, multipliers: [f64; N]) -> CauchyStress {
        CauchyStress(self.reaction(multipliers).0 + extra.0)
    }

    /// μ̇ₖ = tr(Nₖ L), 1/s: zero for motions that the material can have.
    #[must_use]
    pub fn rates(&self, velocity_gradient: &VelocityGradient) -> [f64; N] {
        let stretching = Symmetric::symmetric_part(velocity_gradient.rows());
        self.restrictions.map(|restriction| restriction.reaction.double_contraction(&stretching))
    }

    /// The stretching nearest to D that the material can have: D without its parts along the Nₖ.
    #[must_use]
    pub fn admissible(&self, stretching: &Symmetric) -> Symmetric {
        let mut rest = coordinates(stretching);
        for q in &self.basis {
            let along = dot(q, &rest);
            for (entry, q) in rest.iter_mut().zip(q) {
                *entry -= along * q;
            }
        }
        let root = core::f64::consts::FRAC_1_SQRT_2;
        let [a, b, c, d, e, f] = rest;
        Symmetric::new(a, b, c, d * root, e * root, f * root)
    }

    /// The multipliers with which T = Σ λₖ Nₖ + `extra` satisfies the conditions, as least squares if there are more
    /// conditions than multipliers.
    ///
    /// # Errors
    /// [`SolidsError::UndeterminedMultiplier`] if the conditions do not see a reaction, or see it as a sum of others;
    /// [`SolidsError::ImpossibleCondition`] if no multipliers satisfy a condition to 10⁻⁹ of its terms.
    ///
    /// # Accuracy
    /// A few ulp of the largest term × the condition number of the conditions.
    pub fn multipliers<const M: usize>(
        &self,
        extra: &CauchyStress,
        conditions: &[StressCondition; M],
    ) -> Result<[f64; N], SolidsError> {
        let columns: [[f64; M]; N] = core::array::from_fn(|k| {
            core::array::from_fn(|m| conditions[m].functional().double_contraction(&self.restrictions[k].reaction))
        });
        let right: [f64; M] = core::array::from_fn(|m| {
            let condition = &conditions[m];
            condition.value() - condition.functional().double_contraction(&extra.0)
        });
        let orthogonal = orthogonalise(&columns);
        if orthogonal.rank < N {
            let (rank, index) = (orthogonal.rank, orthogonal.order[orthogonal.rank]);
            return Err(SolidsError::UndeterminedMultiplier { index, rank, count: N });
        }
        let mut rest = right;
        let mut coordinates = [0.0; N];
        for (coordinate, q) in coordinates.iter_mut().zip(&orthogonal.basis) {
            *coordinate = dot(q, &rest);
            for (entry, q) in rest.iter_mut().zip(q) {
                *entry -= *coordinate * q;
            }
        }
        let solution = orthogonal.back_substituted(coordinates);
        let mut multipliers = [0.0; N];
        for (&index, value) in orthogonal.order.iter().zip(solution) {
            multipliers[index] = value;
        }
        let stress = self.stress(extra, multipliers).0;
        for (index, condition) in conditions.iter().enumerate() {
            let functional = condition.functional();
            let residual = functional.double_contraction(&stress) - condition.value();
            let size = functional.norm();
            let mut scale = condition.value().abs().max(size * extra.0.norm());
            for (restriction, multiplier) in self.restrictions.iter().zip(multipliers) {
                scale = scale.max(size * multiplier.abs() * restriction.reaction.norm());
            }
            if residual.is_nan() || LARGEST_RESIDUAL * scale < residual.abs() {
                return Err(SolidsError::ImpossibleCondition { index, residual });
            }
        }
        Ok(multipliers)
    }
}
