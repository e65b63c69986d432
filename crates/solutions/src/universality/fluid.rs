//! Elastic fluids.

use nalgebra::Vector3;
use piola_fields::Motion;
use piola_numerics::Gradient;
use piola_numerics::linear::matrix3::determinant;

use super::check;
use super::kernels::{gradient, variables};
use crate::SolutionsError;
use crate::error::check_finite;

/// How far a deformation is from being universal for elastic fluids, T = −π(ρ) 1: the largest |Grad det F| · size/det F over
/// the particles. Zero where det F is the same everywhere, as it must be.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | X | `particles` | m |
/// | | `size` of the body | m |
///
/// In motion without body force the acceleration must vanish, too: W(24.41).
///
/// # Errors
/// What the motion refuses; [`SolutionsError::OutOfBounds`] for no particle and unless 0 < size.
///
/// # Accuracy
/// Exact derivatives: a few ulp × the condition number of F.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::Motion;
/// use piola_numerics::Real;
/// use piola_solutions::universality::elastic_fluid;
/// /// det F = 1 + 2 k X.
/// struct Swelling(f64);
/// impl Motion for Swelling {
///     fn place<T: Real>(&self, x: &Vector3<T>, _t: T) -> Vector3<T> {
///         Vector3::new(x[0] + T::lit(self.0) * x[0] * x[0], x[1] + x[0] * x[0], x[2])
///     }
/// }
/// let particles = [Vector3::new(1.0, 0.0, 0.0)];
/// assert_eq!(elastic_fluid(&Swelling(0.0), &particles, 0.0, 1.0)?, 0.0); // sheared only
/// assert_eq!(elastic_fluid(&Swelling(0.5), &particles, 0.0, 1.0)?, 0.5); // 1/2
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W(24.38), W(24.41).
pub fn elastic_fluid(
    motion: &impl Motion,
    particles: &[Vector3<f64>],
    t: f64,
    size: f64,
) -> Result<f64, SolutionsError> {
    check(particles, size)?;
    let mut worst = 0.0_f64;
    for particle in particles {
        motion.deformation_gradient(particle, t)?;
        let jacobian: Gradient<f64, 3> = determinant(gradient(motion, &variables(particle), t));
        let change = Vector3::from(jacobian.partials).norm() * size / jacobian.value;
        check_finite("Grad det F", &[change])?;
        worst = worst.max(change);
    }
    Ok(worst)
}
