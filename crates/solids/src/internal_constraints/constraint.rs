//! Traits of constraints, and a constraint at a deformation.

use nalgebra::Matrix3;
use piola_continuum::strain::RightCauchyGreen;
use piola_continuum::{CauchyStress, Deformation, Symmetric};
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::{Rows, product, product_transposed, scaled};

use crate::SolidsError;

/// Largest skew share of N of a constraint that counts as independent of the observer.
const LARGEST_SKEW_SHARE: f64 = 1e-10;

/// A constraint μ(F) = 0.
///
/// Only [`value`](Self::value) must be given, as one function over any scalar; it must not depend on the observer:
/// μ(Q F) = μ(F).
///
/// # Example
/// A material whose faces across axis 3 keep their area.
/// ```
/// use piola_solids::internal_constraints::InternalConstraint;
/// use piola_continuum::{Deformation, DeformationGradient};
/// use piola_numerics::Real;
/// struct AreaOfPlane;
/// impl InternalConstraint for AreaOfPlane {
///     fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
///         let [x, y, z] = deformation.cofactor_rows().map(|row| row[2]); // n da of dA = e₃
///         x * x + y * y + z * z - T::one()
///     }
/// }
/// let stretched = DeformationGradient::diagonal([2.0, 0.5, 3.0])?;
/// // N = 2 λ a² (1 − n ⊗ n): a tension in the plane.
/// assert_eq!(AreaOfPlane.reaction(&stretched, 1.0).0.components[..3], [2.0, 2.0, 0.0]);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(21.13).
pub trait InternalConstraint {
    /// μ(F).
    #[must_use]
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T;

    /// ∂μ/∂F.
    #[must_use]
    fn gradient<T: Real>(&self, deformation: &impl Deformation<T>) -> Matrix3<T> {
        let varied = deformation.lifted(|i, j, x| Gradient::<T, 9>::variable(x, 3 * i + j));
        let slopes = self.value(&varied).partials;
        Matrix3::from_fn(|i, j| slopes[3 * i + j])
    }

    /// N = λ F (∂μ/∂F)ᵀ, Pa for λ in Pa.
    #[must_use]
    fn reaction<T: Real>(&self, deformation: &impl Deformation<T>, multiplier: T) -> CauchyStress<T> {
        let unit = product_transposed(deformation.gradient_rows(), rows_of(&self.gradient(deformation)));
        CauchyStress(Symmetric::symmetric_part(unit) * multiplier)
    }

    /// μ, ∂μ/∂F and the reaction of λ = 1 at a deformation.
    ///
    /// # Errors
    /// [`SolidsError::ConstraintDependsOnObserver`] when F (∂μ/∂F)ᵀ is not symmetric;
    /// [`SolidsError::NotFinite`].
    fn at(&self, deformation: &impl Deformation<f64>) -> Result<Restriction, SolidsError> {
        Restriction::of(self.value(deformation), self.gradient(deformation), deformation.gradient_rows())
    }
}

/// A constraint μ̂(C) = 0, which no observer can see differently.
///
/// # Example
/// ```
/// use piola_solids::internal_constraints::{InternalConstraint, MetricConstraint, OfMetric};
/// use piola_continuum::{DeformationGradient, strain::RightCauchyGreen};
/// use piola_numerics::Real;
/// /// Bell's constraint would be tr U = 3; this is tr C = 3.
/// struct Trace;
/// impl MetricConstraint for Trace {
///     fn value<T: Real>(&self, metric: &RightCauchyGreen<T>) -> T {
///         metric.0.trace() - T::lit(3.0)
///     }
/// }
/// let shear = DeformationGradient::simple_shear(1.0)?;
/// assert_eq!(OfMetric(Trace).reaction(&shear, 0.5).0.components[3], 1.0); // N = 2 λ B
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(21.16), W(21.19).
pub trait MetricConstraint {
    /// μ̂(C).
    #[must_use]
    fn value<T: Real>(&self, metric: &RightCauchyGreen<T>) -> T;

    /// ∂μ̂/∂C, symmetric.
    #[must_use]
    fn gradient<T: Real>(&self, metric: &RightCauchyGreen<T>) -> Symmetric<T> {
        let components = metric.0.components;
        let varied = core::array::from_fn(|k| Gradient::<T, 6>::variable(components[k], k));
        let slopes = self.value(&RightCauchyGreen(Symmetric { components: varied })).partials;
        // A shear stands for two entries of C.
        let half = T::lit(0.5);
        let [a, b, c, d, e, f] = slopes;
        Symmetric::new(a, b, c, d * half, e * half, f * half)
    }
}

/// A [`MetricConstraint`] as an [`InternalConstraint`]: N = 2 λ F (∂μ̂/∂C) Fᵀ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OfMetric<M>(
    /// μ̂.
    pub M,
);

impl<M: MetricConstraint> InternalConstraint for OfMetric<M> {
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.0.value(&RightCauchyGreen::of(deformation))
    }
    fn gradient<T: Real>(&self, deformation: &impl Deformation<T>) -> Matrix3<T> {
        let slope = self.0.gradient(&RightCauchyGreen::of(deformation));
        from_rows(scaled(product(deformation.gradient_rows(), slope.rows()), T::lit(2.0)))
    }
    fn reaction<T: Real>(&self, deformation: &impl Deformation<T>, multiplier: T) -> CauchyStress<T> {
        let slope = self.0.gradient(&RightCauchyGreen::of(deformation));
        CauchyStress(slope.congruence(deformation.gradient_rows()) * (T::lit(2.0) * multiplier))
    }
}

/// A constraint at a deformation: its value, its gradient and its reaction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restriction {
    /// μ.
    pub value: f64,
    /// ∂μ/∂F.
    pub gradient: Matrix3<f64>,
    /// F (∂μ/∂F)ᵀ, the reaction of λ = 1: μ̇ = tr(F (∂μ/∂F)ᵀ L).
    pub reaction: Symmetric,
}

impl Restriction {
    pub(super) fn of(value: f64, gradient: Matrix3<f64>, f: Rows<f64>) -> Result<Self, SolidsError> {
        let unit = product_transposed(f, rows_of(&gradient));
        let mut size = 0.0_f64;
        let mut skew = 0.0_f64;
        for (i, row) in unit.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                if !entry.is_finite() {
                    let parameter = "F (∂μ/∂F)ᵀ";
                    return Err(SolidsError::NotFinite { law: "constraint", parameter, value: *entry });
                }
                size = size.max(entry.abs());
                skew = skew.max(0.5 * (entry - unit[j][i]).abs());
            }
        }
        crate::error::check_finite("constraint", "μ", value)?;
        if LARGEST_SKEW_SHARE * size < skew {
            return Err(SolidsError::ConstraintDependsOnObserver { skew, size });
        }
        Ok(Self { value, gradient, reaction: Symmetric::symmetric_part(unit) })
    }
}
