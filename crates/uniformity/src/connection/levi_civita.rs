//! The connection of a metric.

use nalgebra::Vector3;
use piola_fields::Field;
use piola_numerics::linear::matrix3::inverse_and_determinant;
use piola_numerics::{Gradient, Real};
use piola_tensor::{Rows, Symmetric};

use super::{AffineConnection, ConnectionCoefficients};
use crate::UniformityError;
use crate::indices::{sum, third, variables};

/// The connection of a field of metrics that is free of torsion: Christoffel's symbols, W(29.18).
///
/// ```text
/// Γ^C_AB = ½ M^CE (∂_A M_EB + ∂_B M_EA − ∂_E M_AB)
/// ```
///
/// # Errors
/// [`TensorError::NotPositiveDefinite`](piola_tensor::TensorError::NotPositiveDefinite) where M is not positive definite.
///
/// # Example
/// The plane in polar coordinates: M = diag(1, r², 1), Γ¹₂₂ = −r, Γ²₁₂ = 1/r, and no curvature.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::Symmetric;
/// use piola_fields::Field;
/// use piola_numerics::Real;
/// use piola_uniformity::{AffineConnection, LeviCivita};
/// struct Polar;
/// impl Field for Polar {
///     type Value = Symmetric;
///     fn at<T: Real>(&self, q: &Vector3<T>, _t: T) -> Symmetric<T> {
///         Symmetric::diagonal([T::one(), q.x * q.x, T::one()])
///     }
/// }
/// let gamma = LeviCivita(Polar).coefficients(&Vector3::new(2.0, 0.0, 0.0))?.components;
/// assert_eq!((gamma[0][1][1], gamma[1][0][1]), (-2.0, 0.5));
/// assert_eq!(LeviCivita(Polar).curvature(&Vector3::new(2.0, 0.0, 0.0))?.largest(), 0.0);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[doc(alias = "Christoffel symbols")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeviCivita<G>(
    /// M(X).
    pub G,
);

impl<G: Field<Value = Symmetric>> AffineConnection for LeviCivita<G> {
    fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T> {
        let metric = self.0.at(&variables(place), Gradient::constant(T::zero())).rows();
        let slope = |a: usize, b: usize, along: usize| metric[a][b].partials[along];
        let value: Rows<T> = metric.map(|row| row.map(|entry| entry.value));
        let inverse = inverse_and_determinant(value).0;
        let half = T::lit(0.5);
        let lower = third(|e, a, b| half * (slope(e, b, a) + slope(e, a, b) - slope(a, b, e)));
        ConnectionCoefficients { components: third(|c, a, b| sum(|e| inverse[c][e] * lower[e][a][b])) }
    }

    fn check_domain<T: Real>(&self, place: &Vector3<T>) -> Result<(), UniformityError> {
        crate::error::check_metric(&self.0.at(place, T::zero()))
    }
}
