//! Curvilinear coordinates: any system given by its map to Cartesian coordinates.
//!
//! ```text
//! x = x(q)      gᵢ = ∂x/∂qⁱ      g_ij = gᵢ·gⱼ      Γᵏᵢⱼ = gᵏ·∂²x/∂qⁱ∂qʲ
//! ∇ⱼvⁱ = ∂ⱼvⁱ + Γⁱₖⱼ vᵏ            (div T)ⁱ = ∂ⱼTⁱʲ + Γⁱₖⱼ Tᵏʲ + Γʲₖⱼ Tⁱᵏ
//! ```
//!
//! Basis, metric and Γ follow from the map by exact derivatives: [`LocalBasis`]. In orthogonal systems
//! components in the unit vectors eᵢ = gᵢ/hᵢ, hᵢ = √gᵢᵢ, are *physical*: [`PhysicalFrame`]. All divergences
//! contract the last index, (div T)ᵢ = ∂Tᵢⱼ/∂xⱼ.
//!
//! | components | operators | for |
//! |---|---|---|
//! | contravariant, Tⁱʲ | methods of [`LocalBasis`] | any system |
//! | physical | methods of [`Coordinates`] | orthogonal systems; explicit for the three below |
//!
//! | system | coordinates | x |
//! |---|---|---|
//! | [`Cartesian`] | x, y, z | (x, y, z) |
//! | [`Cylindrical`] | r, θ, z | (r cos θ, r sin θ, z) |
//! | [`Spherical`] | r, θ azimuth, φ colatitude | (r sin φ cos θ, r sin φ sin θ, r cos φ) |
//!
//! On an axis or at a pole the basis does not exist: [`FieldsError::SingularCoordinates`], never NaN.

mod basis;
mod cartesian;
mod cylindrical;
mod frame;
mod spherical;

pub use basis::LocalBasis;
pub use cartesian::Cartesian;
pub use cylindrical::Cylindrical;
pub use frame::PhysicalFrame;
pub use spherical::Spherical;

use nalgebra::{Matrix3, Vector3};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Mask, Real};

use super::field::{Field, ValueOf, check_point, finite, value_and_partials};
use super::residual::{Residual, VectorResidual};
use super::value::TensorValue;
use crate::FieldsError;
use crate::error::check_finite;
use piola_tensor::internal::rows::Rows;

/// A system of coordinates, given by its map to Cartesian coordinates.
///
/// The operators act on fields of the coordinates q with physical components and need an orthogonal system;
/// for others see [`LocalBasis`].
///
/// # Errors
/// All methods that return a `Result` refuse, with [`FieldsError::NotFinite`], coordinates, times and results
/// that are not finite; with [`FieldsError::SingularCoordinates`] points without a basis; with
/// [`FieldsError::NotOrthogonal`] a system that is not orthogonal where physical components are asked for.
///
/// # Example
/// Parabolic cylindrical coordinates: both scale factors are √(u² + v²).
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::Coordinates;
/// use piola_numerics::Real;
/// struct Parabolic;
/// impl Coordinates for Parabolic {
///     fn place<T: Real>(&self, q: &Vector3<T>) -> Vector3<T> {
///         Vector3::new(T::lit(0.5) * (q[0] * q[0] - q[1] * q[1]), q[0] * q[1], q[2])
///     }
/// }
/// let frame = Parabolic.physical_frame(&Vector3::new(3.0, 4.0, 0.0))?;
/// assert_eq!(frame.scale_factors, [5.0, 5.0, 1.0]);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// Physical components of the divergence: W(23.56) cylindrical, W(25.10) spherical.
pub trait Coordinates {
    /// x(q), m.
    fn place<T: Real>(&self, coordinates: &Vector3<T>) -> Vector3<T>;

    /// Refuses coordinates outside the range of the system; all are accepted unless this says otherwise.
    ///
    /// # Errors
    /// Whatever the system does not accept.
    #[inline]
    fn check_domain<T: Real>(&self, coordinates: &Vector3<T>) -> Result<(), FieldsError> {
        let _ = coordinates;
        Ok(())
    }

    /// Basis, metric and Christoffel symbols at a point.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn local_basis<T: Real>(&self, coordinates: &Vector3<T>) -> Result<LocalBasis<T>, FieldsError> {
        LocalBasis::of(self, coordinates)
    }

    /// Unit vectors, scale factors and curvatures of an orthogonal system at a point.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn physical_frame<T: Real>(&self, coordinates: &Vector3<T>) -> Result<PhysicalFrame<T>, FieldsError> {
        self.local_basis(coordinates)?.physical_frame()
    }

    /// hᵢ = |∂x/∂qⁱ| of an orthogonal system, m or m/rad.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn scale_factors<T: Real>(&self, coordinates: &Vector3<T>) -> Result<[T; 3], FieldsError> {
        Ok(self.physical_frame(coordinates)?.scale_factors)
    }

    /// The terms of (div T)ᵢ, from the physical components Tᵢⱼ at q and their partial derivatives ∂Tᵢⱼ/∂qᵏ,
    /// `[k][i][j]`: what [`divergence`](Self::divergence) sums.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn divergence_terms<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        tensor: &Rows<T>,
        partials: &[Rows<T>; 3],
    ) -> Result<[Residual<T>; 3], FieldsError> {
        Ok(self.physical_frame(coordinates)?.divergence_terms(tensor, partials))
    }

    /// (grad v)ᵢⱼ = ∂vᵢ/∂xⱼ in physical components, from those of v at q and their partial derivatives
    /// ∂vᵢ/∂qᵏ, `[k][i]`.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn gradient_from_partials<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        vector: &[T; 3],
        partials: &[[T; 3]; 3],
    ) -> Result<Rows<T>, FieldsError> {
        Ok(self.physical_frame(coordinates)?.gradient(vector, partials))
    }

    /// div T of a field of tensors, contracting the last index, in physical components, `[T]/m`.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | T(q, t) | `tensor`, physical components | any |
    /// | q, t | `coordinates`, `t` | m or rad, s |
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn divergence<F: Field<Value: TensorValue>, T: Real>(
        &self,
        tensor: &F,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<Vector3<T>, FieldsError> {
        let divergence = VectorResidual::from(divergence_of(self, tensor, coordinates, t)?).value;
        finite::<Vector3<f64>, T>("divergence", divergence)
    }

    /// grad v of a field of vectors in physical components, (grad v)ᵢⱼ = ∂vᵢ/∂xⱼ, `[v]/m`: L where v is the
    /// velocity.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn vector_gradient<F: Field<Value = Vector3<f64>>, T: Real>(
        &self,
        vector: &F,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<Matrix3<T>, FieldsError> {
        let gradient = gradient_of(self, vector, coordinates, t)?.1;
        check_finite("gradient", gradient.as_flattened())?;
        Ok(from_rows(gradient))
    }

    /// div v of a field of vectors in physical components, `[v]/m`.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn vector_divergence<F: Field<Value = Vector3<f64>>, T: Real>(
        &self,
        vector: &F,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<T, FieldsError> {
        let gradient = gradient_of(self, vector, coordinates, t)?.1;
        let divergence = piola_tensor::internal::rows::trace(gradient);
        check_finite("divergence", &[divergence])?;
        Ok(divergence)
    }

    /// grad f of a field of scalars in physical components, (1/hᵢ) ∂f/∂qⁱ, `[f]/m`.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn scalar_gradient<F: Field<Value = f64>, T: Real>(
        &self,
        scalar: &F,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<Vector3<T>, FieldsError> {
        check_point(coordinates, t)?;
        let partials = value_and_partials(scalar, coordinates, t).1;
        let h = self.scale_factors(coordinates)?;
        finite::<Vector3<f64>, T>("gradient", Vector3::from_fn(|i, _| partials[i] / h[i]))
    }

    /// Δf = div grad f of a field of scalars, `[f]/m²`, in any system, orthogonal or not.
    ///
    /// # Errors
    /// See [the trait](Coordinates#errors).
    fn laplacian<F: Field<Value = f64>, T: Real>(
        &self,
        scalar: &F,
        coordinates: &Vector3<T>,
        t: T,
    ) -> Result<T, FieldsError> {
        use piola_numerics::Gradient;
        check_point(coordinates, t)?;
        let basis = self.local_basis(coordinates)?;
        let twice = super::motion::kernels::twice_variables(coordinates);
        let value = scalar.at(&twice, Gradient::constant(Gradient::constant(t)));
        let laplacian = basis.laplacian(&value.value.partials, &value.partials.map(|row| row.partials));
        check_finite("Laplacian", &[laplacian])?;
        Ok(laplacian)
    }
}

impl<C: Coordinates> Coordinates for &C {
    #[inline]
    fn place<T: Real>(&self, coordinates: &Vector3<T>) -> Vector3<T> {
        (**self).place(coordinates)
    }
    #[inline]
    fn check_domain<T: Real>(&self, coordinates: &Vector3<T>) -> Result<(), FieldsError> {
        (**self).check_domain(coordinates)
    }
    #[inline]
    fn scale_factors<T: Real>(&self, coordinates: &Vector3<T>) -> Result<[T; 3], FieldsError> {
        (**self).scale_factors(coordinates)
    }
    #[inline]
    fn divergence_terms<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        tensor: &Rows<T>,
        partials: &[Rows<T>; 3],
    ) -> Result<[Residual<T>; 3], FieldsError> {
        (**self).divergence_terms(coordinates, tensor, partials)
    }
    #[inline]
    fn gradient_from_partials<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        vector: &[T; 3],
        partials: &[[T; 3]; 3],
    ) -> Result<Rows<T>, FieldsError> {
        (**self).gradient_from_partials(coordinates, vector, partials)
    }
}

/// The terms of div T of a field.
pub(crate) fn divergence_of<C: Coordinates + ?Sized, F: Field<Value: TensorValue>, T: Real>(
    system: &C,
    tensor: &F,
    coordinates: &Vector3<T>,
    t: T,
) -> Result<[Residual<T>; 3], FieldsError> {
    check_point(coordinates, t)?;
    let (value, partials) = value_and_partials(tensor, coordinates, t);
    let rows = |value: &ValueOf<F, T>| F::Value::rows(value);
    let [a, b, c] = &partials;
    system.divergence_terms(coordinates, &rows(&value), &[rows(a), rows(b), rows(c)])
}

/// (v, grad v) of a field.
pub(crate) fn gradient_of<C: Coordinates + ?Sized, F: Field<Value = Vector3<f64>>, T: Real>(
    system: &C,
    vector: &F,
    coordinates: &Vector3<T>,
    t: T,
) -> Result<(Vector3<T>, Rows<T>), FieldsError> {
    check_point(coordinates, t)?;
    let (value, partials) = value_and_partials(vector, coordinates, t);
    let gradient = system.gradient_from_partials(coordinates, &value.into(), &partials.map(Into::into))?;
    Ok((value, gradient))
}

/// Refuses, as a point without a basis, coordinates of which a length is not positive in some lane.
#[inline]
pub(crate) fn check_radius<T: Real>(coordinates: &Vector3<T>, length: T) -> Result<(), FieldsError> {
    check_finite("coordinates", coordinates.as_slice())?;
    if T::zero().less_than(length).all() {
        return Ok(());
    }
    Err(singular(coordinates, length, |lane| 0.0 < length.primal(lane)))
}

/// The error of the first lane that is not regular.
#[cold]
pub(crate) fn singular<T: Real>(
    coordinates: &Vector3<T>,
    volume_element: T,
    regular: impl Fn(usize) -> bool,
) -> FieldsError {
    let lane = (0..T::LANES).find(|&lane| !regular(lane)).unwrap_or(0);
    FieldsError::SingularCoordinates {
        coordinates: coordinates.map(|q| q.primal(lane)).into(),
        volume_element: volume_element.primal(lane),
    }
}
