//! Material isomorphisms, and the freedom of K.
//!
//! ```text
//! K(X, Y) = K(Y) H K(X)⁻¹,  H ∈ 𝒢        G(F, Y) = G(F K(X, Y), X)        W(27.5–27.6)
//! ```

use nalgebra::{Matrix3, Vector3};
use piola_fields::Field;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_tensor::Symmetric;

use crate::UniformityError;
use crate::error::{check_finite, check_metric};
use crate::group::NominalGroup;
use crate::map::UniformityMap;

/// K(Y) H K(X)⁻¹, a material isomorphism from X to Y for each H in the symmetry group, W(27.6).
///
/// # Errors
/// What the map refuses; [`UniformityError::NotFinite`].
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_uniformity::{ConstantMap, isomorphism};
/// let map = ConstantMap(Matrix3::identity() * 2.0);
/// let (x, y) = (Vector3::zeros(), Vector3::x());
/// assert_eq!(isomorphism::of_element(&map, &x, &y, &Matrix3::identity())?, Matrix3::identity());
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
pub fn of_element(
    map: &impl UniformityMap,
    from: &Vector3<f64>,
    to: &Vector3<f64>,
    element: &Matrix3<f64>,
) -> Result<Matrix3<f64>, UniformityError> {
    check_finite("H", element.as_slice())?;
    Ok(map.value(to)? * element * inverse(&map.value(from)?))
}

/// How far a linear map from X to Y is from a material isomorphism: the [defect](NominalGroup::defect) of K(Y)⁻¹ A K(X), W(27.6).
///
/// # Errors
/// What the map refuses; [`UniformityError::NotFinite`].
///
/// # Example
/// An isotropic solid in a homogeneous reference: rotations are isomorphisms, stretches are not.
/// ```
/// use nalgebra::{Matrix3, Rotation3, Vector3};
/// use piola_uniformity::{ConstantMap, NominalGroup, isomorphism};
/// let map = ConstantMap(Matrix3::identity());
/// let (x, y) = (Vector3::zeros(), Vector3::x());
/// let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.5).into_inner();
/// assert!(isomorphism::defect(&map, &NominalGroup::Isotropic, &x, &y, &turn)? < 1e-15);
/// assert!(isomorphism::defect(&map, &NominalGroup::Isotropic, &x, &y, &(turn * 2.0))? > 1.0);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
pub fn defect(
    map: &impl UniformityMap,
    group: &NominalGroup,
    from: &Vector3<f64>,
    to: &Vector3<f64>,
    candidate: &Matrix3<f64>,
) -> Result<f64, UniformityError> {
    check_finite("isomorphism", candidate.as_slice())?;
    Ok(group.defect(&(inverse(&map.value(to)?) * candidate * map.value(from)?)))
}

/// How far two maps are from describing the same body at X: the [defect](NominalGroup::defect) of K⁻¹K̄, W(26.5–26.9).
///
/// # Errors
/// What the maps refuse.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_uniformity::{ConstantMap, NominalGroup, isomorphism};
/// let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
/// let (first, second) = (ConstantMap(Matrix3::identity()), ConstantMap(quarter_turn));
/// let x = Vector3::zeros();
/// let tetragonal = NominalGroup::generated(&[quarter_turn], 4)?;
/// assert_eq!(isomorphism::freedom_defect(&first, &second, &tetragonal, &x)?, 0.0);
/// assert_eq!(isomorphism::freedom_defect(&first, &second, &NominalGroup::trivial(), &x)?, 2.0);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
pub fn freedom_defect(
    map: &impl UniformityMap,
    other: &impl UniformityMap,
    group: &NominalGroup,
    place: &Vector3<f64>,
) -> Result<f64, UniformityError> {
    Ok(group.defect(&(inverse(&map.value(place)?) * other.value(place)?)))
}

/// Aᵀ M(Y) A − M(X): zero where A is an isometry of the characteristic metric, which isomorphisms of isotropic solids are, W(29.9).
///
/// # Errors
/// [`UniformityError::NotFinite`], [`TensorError::NotPositiveDefinite`](piola_tensor::TensorError::NotPositiveDefinite).
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_uniformity::{CharacteristicMetric, ConstantMap, isomorphism};
/// let metric = CharacteristicMetric(ConstantMap(Matrix3::identity()));
/// let (x, y) = (Vector3::zeros(), Vector3::x());
/// let residual = isomorphism::isometry_residual(&metric, &x, &y, &(Matrix3::identity() * 2.0))?;
/// assert_eq!(residual.components, [3.0, 3.0, 3.0, 0.0, 0.0, 0.0]);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
pub fn isometry_residual(
    metric: &impl Field<Value = Symmetric>,
    from: &Vector3<f64>,
    to: &Vector3<f64>,
    candidate: &Matrix3<f64>,
) -> Result<Symmetric, UniformityError> {
    check_finite("isometry", candidate.as_slice())?;
    let (before, after) = (metric.at(from, 0.0), metric.at(to, 0.0));
    check_metric(&before)?;
    check_metric(&after)?;
    let difference = candidate.transpose() * after.matrix() * candidate - before.matrix();
    Ok(Symmetric::symmetric_part(rows_of(&difference)))
}

fn inverse(map: &Matrix3<f64>) -> Matrix3<f64> {
    from_rows(inverse_and_determinant(rows_of(map)).0)
}
