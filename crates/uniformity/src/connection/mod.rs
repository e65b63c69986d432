//! Affine connections on a body: covariant derivative, torsion, curvature, change of coordinates.
//!
//! ```text
//! ∇_B u^C = ∂_B u^C + Γ^C_AB u^A                                                  W(27.9)   the last lower index differentiates
//! Y^C_AB  = Γ^C_AB − Γ^C_BA                                                       W(27.13)  torsion
//! R^C_ABD = ∂_D Γ^C_AB − ∂_B Γ^C_AD + Γ^E_AB Γ^C_ED − Γ^E_AD Γ^C_EB               W(27.14)  curvature
//! Γ̄^c_ab  = ∂q^c/∂X^C (∂X^A/∂q^a ∂X^B/∂q^b Γ^C_AB + ∂²X^C/∂q^a∂q^b)               W(27.18)  other coordinates
//! ```
//!
//! R is minus the common `R^C_{A,BD}`; with `Ric_AB = R^C_ABC` spheres have positive curvature.
//!
//! | connection | type |
//! |---|---|
//! | of a uniform body with a symmetry algebra | [`MaterialConnection`] |
//! | of a metric | [`LeviCivita`] |
//! | the same in other coordinates | [`ConnectionIn`] |
//! | your own | implement [`AffineConnection`] |

mod curvature;
mod in_coordinates;
mod levi_civita;
mod material;
mod torsion;

pub use curvature::ConnectionCurvature;
pub use in_coordinates::ConnectionIn;
pub use levi_civita::LeviCivita;
pub use material::{MaterialConnection, MaterialityResidual};
pub use torsion::Torsion;

use nalgebra::{Matrix3, Vector3};
use piola_fields::Field;
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Gradient, Real};

use crate::UniformityError;
use crate::error::check_finite;
use crate::indices::{Fourth, Third, fourth, second, sum, third, variables};

/// An affine connection, given by its coefficients `Γ^C_AB` in the coordinates of the reference configuration.
///
/// # Errors
/// The methods that return a `Result` refuse places and results that are not finite, [`UniformityError::NotFinite`], and what
/// [`check_domain`](Self::check_domain) refuses.
///
/// # Example
/// Γ¹₁₂ = X₂ and all others zero: a covariant derivative, the torsion and the curvature by hand.
/// ```
/// use nalgebra::Vector3;
/// use piola_numerics::Real;
/// use piola_uniformity::{AffineConnection, ConnectionCoefficients};
/// struct Mine;
/// impl AffineConnection for Mine {
///     fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T> {
///         let mut components = [[[T::zero(); 3]; 3]; 3];
///         components[0][0][1] = place.y;
///         ConnectionCoefficients { components }
///     }
/// }
/// let place = Vector3::new(0.0, 2.0, 0.0);
/// assert_eq!(Mine.torsion(&place)?.components[0][0][1], 2.0); // Γ¹₁₂ − Γ¹₂₁
/// let curvature = Mine.curvature(&place)?;
/// assert_eq!(curvature.components[0][0][1][1], 0.0); // antisymmetric in the last two
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
///
/// # Source
/// W(27.8–27.14).
pub trait AffineConnection {
    /// `Γ^C_AB` at a place, unchecked.
    fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T>;

    /// Refuses places at which the connection is not defined.
    ///
    /// # Errors
    /// Whatever the connection does not accept.
    #[inline]
    fn check_domain<T: Real>(&self, place: &Vector3<T>) -> Result<(), UniformityError> {
        let _ = place;
        Ok(())
    }

    /// `Γ^C_AB`, 1/m.
    ///
    /// # Errors
    /// See [the trait](AffineConnection#errors).
    fn coefficients<T: Real>(&self, place: &Vector3<T>) -> Result<ConnectionCoefficients<T>, UniformityError> {
        check(self, place)?;
        let coefficients = self.at(place);
        check_finite("connection", coefficients.components.as_flattened().as_flattened())?;
        Ok(coefficients)
    }

    /// `Y^C_AB`, 1/m, W(27.13).
    ///
    /// # Errors
    /// See [the trait](AffineConnection#errors).
    fn torsion<T: Real>(&self, place: &Vector3<T>) -> Result<Torsion<T>, UniformityError> {
        Ok(self.coefficients(place)?.torsion())
    }

    /// `R^C_ABD`, 1/m², W(27.14), by exact derivatives of Γ.
    ///
    /// # Errors
    /// See [the trait](AffineConnection#errors).
    fn curvature<T: Real>(&self, place: &Vector3<T>) -> Result<ConnectionCurvature<T>, UniformityError> {
        check(self, place)?;
        let curvature = curvature_of(&self.at(&variables(place)).components);
        for components in &curvature.components {
            check_finite("curvature", components.as_flattened().as_flattened())?;
        }
        Ok(curvature)
    }

    /// ∇_B u^C of a field of vectors, `[(C, B)]`, W(27.9).
    ///
    /// # Errors
    /// See [the trait](AffineConnection#errors).
    fn covariant_derivative<T: Real>(
        &self,
        field: &impl Field<Value = Vector3<f64>>,
        place: &Vector3<T>,
    ) -> Result<Matrix3<T>, UniformityError> {
        let coefficients = self.coefficients(place)?;
        let u = field.at(&variables(place), Gradient::constant(T::zero()));
        let gradient = from_rows([0, 1, 2].map(|c: usize| u[c].partials));
        let derivative = coefficients.covariant_derivative(&u.map(|u| u.value), &gradient);
        check_finite("covariant derivative", derivative.as_slice())?;
        Ok(derivative)
    }
}

impl<C: AffineConnection + ?Sized> AffineConnection for &C {
    #[inline]
    fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T> {
        (**self).at(place)
    }
    #[inline]
    fn check_domain<T: Real>(&self, place: &Vector3<T>) -> Result<(), UniformityError> {
        (**self).check_domain(place)
    }
}

/// `Γ^C_AB` at a point, 1/m.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_uniformity::ConnectionCoefficients;
/// let mut components = [[[0.0; 3]; 3]; 3];
/// components[0][1][2] = 3.0; // Γ¹₂₃
/// let gamma = ConnectionCoefficients { components };
/// let derivative = gamma.covariant_derivative(&Vector3::new(0.0, 2.0, 0.0), &Matrix3::zeros());
/// assert_eq!(derivative[(0, 2)], 6.0); // ∇₃u¹ = Γ¹₂₃ u²
/// ```
#[doc(alias = "Christoffel symbols")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConnectionCoefficients<T = f64> {
    /// `[C][A][B]`: C is the upper index, B the direction of differentiation.
    pub components: [[[T; 3]; 3]; 3],
}

impl<T: Real> ConnectionCoefficients<T> {
    /// `Y^C_AB = Γ^C_AB − Γ^C_BA`.
    #[inline]
    #[must_use]
    pub fn torsion(&self) -> Torsion<T> {
        let gamma = &self.components;
        let scale = third(|c, a, b| gamma[c][a][b].abs() + gamma[c][b][a].abs());
        Torsion {
            components: third(|c, a, b| gamma[c][a][b] - gamma[c][b][a]),
            scale: crate::indices::largest(scale.as_flattened().as_flattened().iter().copied()),
        }
    }

    /// ∇_B u^C, `[(C, B)]`, from the components of u and ∂_B u^C.
    #[inline]
    #[must_use]
    pub fn covariant_derivative(&self, vector: &Vector3<T>, gradient: &Matrix3<T>) -> Matrix3<T> {
        let gamma = &self.components;
        from_rows(second(|c, b| gradient[(c, b)] + sum(|a| gamma[c][a][b] * vector[a])))
    }

    /// `du^C/ds = −Γ^C_AB u^A v^B` of a vector carried in parallel along a curve with velocity v, W(27.12).
    #[inline]
    #[must_use]
    pub fn parallel_rate(&self, vector: &Vector3<T>, velocity: &Vector3<T>) -> Vector3<T> {
        let gamma = &self.components;
        Vector3::from([0, 1, 2].map(|c: usize| -sum(|a| vector[a] * sum(|b| gamma[c][a][b] * velocity[b]))))
    }
}

/// `R^C_ABD` of coefficients with their derivatives.
#[inline]
fn curvature_of<T: Real>(gamma: &Third<Gradient<T, 3>>) -> ConnectionCurvature<T> {
    let value = |c: usize, a: usize, b: usize| gamma[c][a][b].value;
    let partial = |c: usize, a: usize, b: usize, d: usize| gamma[c][a][b].partials[d];
    let mut scale = T::zero();
    let components: Fourth<T> = fourth(|c, a, b, d| {
        let (first, last) = (partial(c, a, b, d), partial(c, a, d, b));
        let product = |e: usize| (value(e, a, b) * value(c, e, d), value(e, a, d) * value(c, e, b));
        let products = [product(0), product(1), product(2)];
        let size = sum(|e| products[e].0.abs() + products[e].1.abs());
        scale = scale.max(first.abs() + last.abs() + size);
        (first - last) + sum(|e| products[e].0 - products[e].1)
    });
    ConnectionCurvature { components, scale }
}

#[inline]
fn check<T: Real>(connection: &(impl AffineConnection + ?Sized), place: &Vector3<T>) -> Result<(), UniformityError> {
    check_finite("X", place.as_slice())?;
    connection.check_domain(place)
}
