//! The characteristic metric of an isotropic solid, and the geometry of metrics.
//!
//! ```text
//! M = K⁻ᵀ K⁻¹,   M⁻¹ = K Kᵀ        W(29.8)
//! ```
//!
//! M says what lengths the material has when it is free of stress; it does not depend on the choice of K. The body is locally homogeneous
//! where the curvature of M vanishes, W(29.20).

use nalgebra::{Matrix3, Vector3};
use piola_fields::Field;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{inverse_and_determinant, rows_of};
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::{product_transposed, transposed_product};

use crate::UniformityError;
use crate::connection::{AffineConnection, ConnectionCoefficients, ConnectionCurvature, LeviCivita};
use crate::error::{check_finite, check_metric};
use crate::map::UniformityMap;

/// M(X) = K⁻ᵀK⁻¹ of a uniform body, as a field of metrics, W(29.8).
///
/// # Example
/// A crystal swollen by two has M = ¼ 1: its natural lengths are halves of those of the reference.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::Field;
/// use piola_uniformity::{CharacteristicMetric, ConstantMap};
/// let metric = CharacteristicMetric(ConstantMap(Matrix3::identity() * 2.0));
/// assert_eq!(metric.at(&Vector3::<f64>::zeros(), 0.0).components, [0.25, 0.25, 0.25, 0.0, 0.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CharacteristicMetric<M>(
    /// K(X).
    pub M,
);

impl<M: UniformityMap> Field for CharacteristicMetric<M> {
    type Value = Symmetric;
    #[inline]
    fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
        let inverse = inverse_and_determinant(rows_of(&self.0.at(place))).0;
        Symmetric::upper_triangle(transposed_product(inverse, inverse))
    }
}

impl<M: UniformityMap> CharacteristicMetric<M> {
    /// M⁻¹ = K Kᵀ, without an inverse.
    ///
    /// # Errors
    /// What the map refuses.
    pub fn inverse_at<T: Real>(&self, place: &Vector3<T>) -> Result<Symmetric<T>, UniformityError> {
        let k = rows_of(&self.0.value(place)?);
        Ok(Symmetric::upper_triangle(product_transposed(k, k)))
    }
}

/// A metric at a point with all that follows from its derivatives.
///
/// # Example
/// The metric (1 + ¼|X|²)⁻² 1 of the unit sphere in four dimensions: Ric = 2 M and R = 6.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::Symmetric;
/// use piola_fields::Field;
/// use piola_numerics::Real;
/// use piola_uniformity::MetricGeometry;
/// struct Sphere;
/// impl Field for Sphere {
///     type Value = Symmetric;
///     fn at<T: Real>(&self, place: &Vector3<T>, _t: T) -> Symmetric<T> {
///         Symmetric::diagonal([(T::one() + T::lit(0.25) * place.dot(place)).powi(-2); 3])
///     }
/// }
/// let geometry = MetricGeometry::of(&Sphere, &Vector3::<f64>::zeros())?;
/// assert_eq!((geometry.scalar, geometry.ricci[(0, 0)]), (6.0, 2.0));
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetricGeometry<T = f64> {
    /// M.
    pub metric: Symmetric<T>,
    /// M⁻¹.
    pub inverse: Symmetric<T>,
    /// `Γ^C_AB`, W(29.18).
    pub christoffel: ConnectionCoefficients<T>,
    /// `R^C_ABD`, 1/m².
    pub riemann: ConnectionCurvature<T>,
    /// `Ric_AB = R^C_ABC`, 1/m², positive on spheres.
    pub ricci: Matrix3<T>,
    /// `R = M^AB Ric_AB`, 1/m².
    pub scalar: T,
}

impl<T: Real> MetricGeometry<T> {
    /// Of a field of metrics at a place; of a body by [`CharacteristicMetric`].
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`]; [`TensorError::NotPositiveDefinite`](piola_tensor::TensorError::NotPositiveDefinite).
    pub fn of(metric: &impl Field<Value = Symmetric>, place: &Vector3<T>) -> Result<Self, UniformityError> {
        check_finite("X", place.as_slice())?;
        let value = metric.at(place, T::zero());
        check_metric(&value)?;
        let inverse = Symmetric::symmetric_part(inverse_and_determinant(value.rows()).0);
        let connection = LeviCivita(metric);
        let (christoffel, riemann) = (connection.coefficients(place)?, connection.curvature(place)?);
        let scalar = riemann.scalar(&inverse);
        Ok(Self { metric: value, inverse, christoffel, riemann, ricci: riemann.ricci(), scalar })
    }
}
