//! Uniformity maps K(X): how the crystal of a uniform body lies in its reference configuration.

use nalgebra::{Matrix3, Vector3};
use piola_fields::Motion;
use piola_numerics::linear::matrix3::{determinant, from_rows, inverse_and_determinant, rows_of};
use piola_numerics::{Gradient, Mask, Real};
use piola_tensor::Rows;

use crate::UniformityError;
use crate::error::check_finite;
use crate::indices::{primal, second, variables};

/// K(X) of a materially uniform body, W(26.2): the response at X is that of one crystal, G(F, X) = N(F K(X)).
///
/// The column a of K holds the crystal's basis vector a at X in components of the reference configuration, `K^A_a`. One formula over any
/// scalar, from which connections, torsion and curvature follow by exact derivatives. K is determined up to K(X) H(X)
/// with H in the symmetry group of N, W(26.5–26.9).
///
/// | symbol | here | shape | unit |
/// |---|---|---|---|
/// | X | `reference` | 3 | m |
/// | K | [`at`](Self::at), checked [`value`](Self::value) | 3×3 | – |
///
/// # Errors
/// `value` refuses what [`check_domain`](Self::check_domain) refuses, [`UniformityError::NotFinite`],
/// [`UniformityError::SingularMap`] and [`UniformityError::OrientationReversing`].
///
/// # Example
/// A lattice that turns about e₃ with X₁.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_numerics::Real;
/// use piola_uniformity::UniformityMap;
///
/// struct Turning;
/// impl UniformityMap for Turning {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let ((s, c), o) = (reference.x.sin_cos(), T::zero());
///         Matrix3::new(c, -s, o, s, c, o, o, o, T::one())
///     }
/// }
/// assert_eq!(Turning.value(&Vector3::<f64>::zeros())?, Matrix3::identity());
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[doc(alias("implant", "plastic deformation", "uniform reference", "crystal basis"))]
pub trait UniformityMap {
    /// K(X), unchecked.
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T>;

    /// Refuses places for which the map is not defined; everything is defined unless this says otherwise.
    ///
    /// # Errors
    /// Whatever the map does not accept.
    #[inline]
    fn check_domain<T: Real>(&self, reference: &Vector3<T>) -> Result<(), UniformityError> {
        let _ = reference;
        Ok(())
    }

    /// K(X), with 0 < det K.
    ///
    /// # Errors
    /// See [the trait](UniformityMap#errors).
    #[inline]
    fn value<T: Real>(&self, reference: &Vector3<T>) -> Result<Matrix3<T>, UniformityError> {
        check_place(self, reference)?;
        let value = self.at(reference);
        check_map(rows_of(&value), reference)?;
        Ok(value)
    }
}

impl<M: UniformityMap + ?Sized> UniformityMap for &M {
    #[inline]
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        (**self).at(reference)
    }
    #[inline]
    fn check_domain<T: Real>(&self, reference: &Vector3<T>) -> Result<(), UniformityError> {
        (**self).check_domain(reference)
    }
}

/// K given by its inverse: the rows of K⁻¹ are the crystal's dual basis, as dislocations are usually stated.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_numerics::Real;
/// use piola_uniformity::{InverseMap, UniformityMap};
/// /// Screws of density ½ along X₃: the third row of K⁻¹ is (−¼ X₂, ¼ X₁, 1).
/// struct Screws;
/// impl UniformityMap for Screws {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let mut dual = Matrix3::identity();
///         dual[(2, 0)] = T::lit(-0.25) * reference.y;
///         dual[(2, 1)] = T::lit(0.25) * reference.x;
///         dual
///     }
/// }
/// let k = InverseMap(Screws).value(&Vector3::new(0.0, 4.0, 0.0))?;
/// assert_eq!(k[(2, 0)], 1.0);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InverseMap<M>(
    /// K⁻¹(X).
    pub M,
);

impl<M: UniformityMap> UniformityMap for InverseMap<M> {
    #[inline]
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        from_rows(inverse_and_determinant(rows_of(&self.0.at(reference))).0)
    }
    fn check_domain<T: Real>(&self, reference: &Vector3<T>) -> Result<(), UniformityError> {
        self.0.check_domain(reference)?;
        check_map(rows_of(&self.0.at(reference)), reference)
    }
}

/// K = (∂x/∂X)⁻¹ of a motion at t = 0: the body is locally homogeneous, W(26.10), and the motion takes it to its homogeneous
/// configuration.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::Motion;
/// use piola_numerics::Real;
/// use piola_uniformity::{HomogeneousIn, UniformityMap};
/// struct Twice;
/// impl Motion for Twice {
///     fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
///         reference * T::lit(2.0)
///     }
/// }
/// assert_eq!(HomogeneousIn(Twice).value(&Vector3::<f64>::zeros())?, Matrix3::identity() * 0.5);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HomogeneousIn<M>(
    /// x(X, 0), the homogeneous configuration.
    pub M,
);

impl<M: Motion> UniformityMap for HomogeneousIn<M> {
    #[inline]
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let x = self.0.place(&variables(reference), Gradient::constant(T::zero()));
        from_rows(inverse_and_determinant([x[0].partials, x[1].partials, x[2].partials]).0)
    }
    fn check_domain<T: Real>(&self, reference: &Vector3<T>) -> Result<(), UniformityError> {
        Ok(self.0.check_domain(reference, T::zero())?)
    }
}

/// The same K everywhere: a homogeneous body.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_uniformity::{ConstantMap, UniformityMap};
/// let map = ConstantMap(Matrix3::identity() * 2.0);
/// assert_eq!(map.at(&Vector3::<f64>::zeros())[(1, 1)], 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantMap(
    /// K.
    pub Matrix3<f64>,
);

impl UniformityMap for ConstantMap {
    #[inline]
    fn at<T: Real>(&self, _reference: &Vector3<T>) -> Matrix3<T> {
        self.0.map(T::lit)
    }
}

/// K, its partial derivatives and its inverse at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalMap<T> {
    /// `[A][a]`.
    pub(crate) value: Rows<T>,
    /// `∂_B K^A_a`, `[B][A][a]`.
    pub(crate) partials: [Rows<T>; 3],
    /// `[a][A]`.
    pub(crate) inverse: Rows<T>,
}

impl<T: Real> LocalMap<T> {
    #[inline]
    pub(crate) fn of(map: &(impl UniformityMap + ?Sized), reference: &Vector3<T>) -> Self {
        let k = map.at(&variables(reference));
        let value = second(|i, j| k[(i, j)].value);
        Self {
            value,
            partials: [0, 1, 2].map(|b: usize| second(|i, j| k[(i, j)].partials[b])),
            inverse: inverse_and_determinant(value).0,
        }
    }
}

/// Refuses a place that is not finite or at which the map is not defined.
#[inline]
pub(crate) fn check_place<T: Real>(
    map: &(impl UniformityMap + ?Sized),
    reference: &Vector3<T>,
) -> Result<(), UniformityError> {
    check_finite("X", reference.as_slice())?;
    map.check_domain(reference)
}

/// Refuses K that is not finite, singular to rounding or reverses the orientation in any lane.
pub(crate) fn check_map<T: Real>(k: Rows<T>, reference: &Vector3<T>) -> Result<(), UniformityError> {
    check_finite("K", k.as_flattened())?;
    let length = |row: [T; 3]| row[0].abs().max(row[1].abs()).max(row[2].abs());
    let (determinant, scale) = (determinant(k), length(k[0]) * length(k[1]) * length(k[2]));
    let threshold = T::lit(8.0 * f64::EPSILON) * scale;
    if threshold.less_than(determinant).all() {
        return Ok(());
    }
    let is_good = |lane: usize| threshold.primal(lane) < determinant.primal(lane);
    let lane = (0..T::LANES).find(|&lane| !is_good(lane)).unwrap_or(0);
    let (determinant, place) = (determinant.primal(lane), primal(reference, lane));
    if determinant < -threshold.primal(lane) {
        return Err(UniformityError::OrientationReversing { determinant, place });
    }
    Err(UniformityError::SingularMap { determinant, scale: scale.primal(lane), place })
}
