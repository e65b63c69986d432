//! Motions x = x(X, t) and what follows from them by exact derivatives.
//!
//! ```text
//! u = x − X        v = ∂x/∂t        a = ∂²x/∂t²        F = ∂x/∂X = 1 + ∇u        L = Ḟ F⁻¹ = grad v
//! ```
//!
//! A [`Motion`] states x(X, t) once over any scalar; its methods differentiate it, each only as far as it is
//! asked: a velocity costs one pass over dual numbers and no deformation gradient. All act at a particle X and
//! return what is there at the time t, in Cartesian components.
//!
//! | you have | use |
//! |---|---|
//! | a formula x(X, t) | implement [`Motion`] |
//! | a formula u(X, t), with small strains | implement [`Motion::displacement`] too |
//! | x = F(t) X + c(t) | [`Homogeneous`] |
//! | x = R(t) X + c(t) | [`Rigid`] |
//! | samples of places | [`SampledMotion`](crate::SampledMotion) |

mod affine;
pub(crate) mod kernels;

pub use affine::{Affine, AffineHistory, Homogeneous, Rigid, RigidHistory};

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{determinant, from_rows, inverse_and_determinant};

use crate::FieldsError;
use crate::error::check_finite;
use piola_continuum::internal::check_jacobian;
use piola_continuum::{DeformationGradient, DisplacementGradient};
use piola_tensor::internal::rows::product;

/// A motion x = x(X, t) of a body, W(14.1): the place at time t of the particle whose place in the reference
/// configuration is X.
///
/// One formula over any scalar, from which everything else follows by exact derivatives. It may be asked for
/// any X and t that [`check_domain`](Self::check_domain) accepts.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | X, x, u | `reference`, [`place`](Self::place), [`displacement`](Self::displacement) | m |
/// | t | `t` | s |
/// | v, a | [`velocity`](Self::velocity), [`acceleration`](Self::acceleration) | m/s, m/s² |
/// | F, ∇u | [`deformation_gradient`](Self::deformation_gradient), [`displacement_gradient`](Self::displacement_gradient) | – |
/// | Ḟ, F̈ | [`deformation_rate`](Self::deformation_rate), [`deformation_second_rate`](Self::deformation_second_rate) | 1/s, 1/s² |
/// | L | [`velocity_gradient`](Self::velocity_gradient) | 1/s |
///
/// # Errors
/// The methods that return a `Result` refuse: what `check_domain` refuses; with
/// [`FieldsError::NotFinite`] a place, time or result that is not finite; with
/// [`ContinuumError::NonPositiveJacobian`](piola_continuum::ContinuumError::NonPositiveJacobian) a place where 0 < det F is violated, when F is asked for or divided
/// by.
///
/// # Accuracy
/// A few ulp times the condition number of the formula: derivatives are exact.
///
/// # Example
/// Simple shear at the rate 2 per second.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::Motion;
/// use piola_numerics::Real;
///
/// struct Shear {
///     rate: f64,
/// }
/// impl Motion for Shear {
///     fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
///         let [x, y, z] = (*reference).into();
///         Vector3::new(x + T::lit(self.rate) * t * y, y, z)
///     }
/// }
///
/// let shear = Shear { rate: 2.0 };
/// let particle = Vector3::new(0.0, 3.0, 0.0);
/// assert_eq!(shear.velocity(&particle, 1.0)?.x, 6.0);
/// assert_eq!(shear.deformation_gradient(&particle, 1.0)?.matrix()[(0, 1)], 2.0);
/// assert_eq!(shear.velocity_gradient(&particle, 1.0)?[(0, 1)], 2.0);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// W(14.1–14.7), W(14.18), W(14.21).
pub trait Motion {
    /// x(X, t), m.
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T>;

    /// u(X, t) = x(X, t) − X, m, B(4.13).
    ///
    /// A motion that knows its displacement states it here, and x = X + u in [`place`](Self::place): then ∇u is
    /// exact however small the strain. Unless it does, u is the difference.
    ///
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_fields::Motion;
    /// use piola_numerics::Real;
    /// struct Breath;
    /// impl Motion for Breath {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
    ///         reference + self.displacement(reference, t)
    ///     }
    ///     fn displacement<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
    ///         reference * (T::lit(1e-20) * t)
    ///     }
    /// }
    /// let strain = Breath.displacement_gradient(&Vector3::new(1.0, 1.0, 1.0), 1.0)?;
    /// assert_eq!(strain.matrix()[(0, 0)], 1e-20); // F is 1 to the last bit
    /// # Ok::<(), piola_fields::FieldsError>(())
    /// ```
    #[inline]
    fn displacement<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        self.place(reference, t) - reference
    }

    /// Refuses particles and times for which the motion is not defined; everything is defined unless this says
    /// otherwise.
    ///
    /// # Errors
    /// Whatever the motion does not accept.
    #[inline]
    fn check_domain<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<(), FieldsError> {
        let _ = (reference, t);
        Ok(())
    }

    /// x(X, t), m, checked: the way to ask for one place; [`place`](Self::place) is the bare formula.
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn position<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<Vector3<T>, FieldsError> {
        check_event(self, reference, t)?;
        finite("place", self.place(reference, t))
    }

    /// v = ∂x/∂t at fixed X, m/s, W(14.18).
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn velocity<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<Vector3<T>, FieldsError> {
        check_event(self, reference, t)?;
        finite("velocity", kernels::velocity(self, reference, t))
    }

    /// a = ∂²x/∂t² at fixed X, m/s², W(14.18).
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn acceleration<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<Vector3<T>, FieldsError> {
        check_event(self, reference, t)?;
        finite("acceleration", kernels::acceleration(self, reference, t))
    }

    /// F = ∂x/∂X, W(14.7), with 0 < det F, W(14.8).
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn deformation_gradient<T: Real>(
        &self,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<DeformationGradient<T>, FieldsError> {
        check_event(self, reference, t)?;
        Ok(DeformationGradient::new(from_rows(kernels::gradient(self, reference, t)))?)
    }

    /// ∇u = ∂u/∂X = F − 1, B(4.28), from the displacement: without cancellation where the motion states it.
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn displacement_gradient<T: Real>(
        &self,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<DisplacementGradient<T>, FieldsError> {
        check_event(self, reference, t)?;
        Ok(DisplacementGradient::new(from_rows(kernels::displacement_gradient(self, reference, t)))?)
    }

    /// Ḟ = ∂F/∂t at fixed X, 1/s.
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn deformation_rate<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<Matrix3<T>, FieldsError> {
        check_event(self, reference, t)?;
        let rate = kernels::gradient_and_rate(self, reference, t).1;
        check_finite("rate of F", rate.as_flattened())?;
        Ok(from_rows(rate))
    }

    /// F̈ = ∂²F/∂t² at fixed X, 1/s².
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn deformation_second_rate<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<Matrix3<T>, FieldsError> {
        check_event(self, reference, t)?;
        let second_rate = kernels::gradient_second_rate(self, reference, t);
        check_finite("second rate of F", second_rate.as_flattened())?;
        Ok(from_rows(second_rate))
    }

    /// L = Ḟ F⁻¹, the velocity gradient ∂v/∂x at the place of the particle, 1/s, W(14.21).
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn velocity_gradient<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<Matrix3<T>, FieldsError> {
        check_event(self, reference, t)?;
        let (gradient, rate) = kernels::gradient_and_rate(self, reference, t);
        check_finite("F", gradient.as_flattened())?;
        check_jacobian(determinant(gradient))?;
        let velocity_gradient = product(rate, inverse_and_determinant(gradient).0);
        check_finite("L", velocity_gradient.as_flattened())?;
        Ok(from_rows(velocity_gradient))
    }

    /// `∂²xᵢ/∂X_A∂X_B`, the gradient of F, 1/m: for each i the symmetric matrix of A and B.
    ///
    /// # Errors
    /// See [the trait](Motion#errors).
    #[inline]
    fn second_gradient<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<[Matrix3<T>; 3], FieldsError> {
        check_event(self, reference, t)?;
        let second = kernels::second_gradient(self, reference, t);
        check_finite("gradient of F", second.as_flattened().as_flattened())?;
        Ok(second.map(from_rows))
    }
}

impl<M: Motion> Motion for &M {
    #[inline]
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        (**self).place(reference, t)
    }
    #[inline]
    fn displacement<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        (**self).displacement(reference, t)
    }
    #[inline]
    fn check_domain<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<(), FieldsError> {
        (**self).check_domain(reference, t)
    }
}

/// Refuses a particle or a time that is not finite or for which the motion is not defined.
#[inline]
pub(crate) fn check_event<T: Real>(
    motion: &(impl Motion + ?Sized),
    reference: &Vector3<T>,
    t: T,
) -> Result<(), FieldsError> {
    check_finite("X", reference.as_slice())?;
    check_finite("t", &[t])?;
    motion.check_domain(reference, t)
}

/// The vector, if it is finite.
#[inline]
fn finite<T: Real>(quantity: &'static str, vector: Vector3<T>) -> Result<Vector3<T>, FieldsError> {
    check_finite(quantity, vector.as_slice())?;
    Ok(vector)
}
