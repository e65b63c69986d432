//! Basis, metric and Christoffel symbols of any system of coordinates at a point.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::linear::matrix3::{determinant, dot, inverse_and_determinant};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Gradient, Mask, Real};
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::{Rows, product, product_transposed, transpose, transposed_product};

use super::{Coordinates, PhysicalFrame, singular};
use crate::FieldsError;
use crate::error::check_finite;
use crate::motion::kernels::twice_variables;

/// The local basis gᵢ = ∂x/∂qⁱ of a system of coordinates and how it changes.
///
/// Its methods take contravariant components, v = vⁱ gᵢ and T = Tⁱʲ gᵢ⊗gⱼ, of any system, orthogonal or not.
///
/// # Example
/// Cylindrical coordinates at r = 2: g₂₂ = r², Γ¹₂₂ = −r, Γ²₁₂ = 1/r.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Coordinates, Cylindrical};
/// let basis = Cylindrical.local_basis(&Vector3::new(2.0, 0.0, 0.0))?;
/// assert_eq!(basis.metric().components[1], 4.0);
/// assert_eq!(basis.christoffel[0][1][1], -2.0);
/// assert_eq!(basis.christoffel[1][0][1], 0.5);
/// assert_eq!(basis.volume_element(), 2.0);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalBasis<T = f64> {
    /// gᵢ = ∂x/∂qⁱ in Cartesian components, one a row.
    pub basis: Rows<T>,
    /// gⁱ with gⁱ·gⱼ = δⁱⱼ in Cartesian components, one a row.
    pub dual: Rows<T>,
    /// Γᵏᵢⱼ = gᵏ·∂gᵢ/∂qʲ, symmetric in i and j, as `[k][i][j]`.
    pub christoffel: [Rows<T>; 3],
    /// ∂gᵢ/∂qᵏ in Cartesian components, as `[i][k]`.
    pub(super) change: [Rows<T>; 3],
    pub(super) determinant: T,
}

impl<T: Real> LocalBasis<T> {
    pub(super) fn of<C: Coordinates + ?Sized>(system: &C, coordinates: &Vector3<T>) -> Result<Self, FieldsError> {
        check_finite("coordinates", coordinates.as_slice())?;
        system.check_domain(coordinates)?;
        let x: Vector3<Gradient<Gradient<T, 3>, 3>> = system.place(&twice_variables(coordinates));
        // [component][i] and [component][i][k]
        let jacobian: Rows<T> = [0, 1, 2].map(|c: usize| x[c].value.partials);
        let second: [Rows<T>; 3] = [0, 1, 2].map(|c: usize| x[c].partials.map(|row| row.partials));
        check_finite("basis", jacobian.as_flattened())?;
        let basis = transpose(jacobian);
        let length = |g: [T; 3]| g[0].abs().max(g[1].abs()).max(g[2].abs());
        let box_volume = length(basis[0]) * length(basis[1]) * length(basis[2]);
        let volume = determinant(basis);
        let limit = T::lit(32.0 * unit_in_last_place::<T>()) * box_volume;
        if !limit.less_than(volume.abs()).all() {
            return Err(singular(coordinates, volume, |lane| limit.primal(lane) < volume.primal(lane).abs()));
        }
        // Jacobian (∂x/∂q) has the inverse ∂q/∂x, whose rows are the dual basis.
        let (dual, determinant) = inverse_and_determinant(jacobian);
        let change =
            [0, 1, 2].map(|i: usize| [0, 1, 2].map(|k: usize| [second[0][i][k], second[1][i][k], second[2][i][k]]));
        let christoffel = dual.map(|dual| change.map(|row| row.map(|change| dot(dual, change))));
        check_finite("Christoffel symbol", christoffel.as_flattened().as_flattened())?;
        Ok(Self { basis, dual, christoffel, change, determinant })
    }

    /// `g_ij` = gᵢ·gⱼ.
    #[inline]
    #[must_use]
    pub fn metric(&self) -> Symmetric<T> {
        Symmetric::upper_triangle(product_transposed(self.basis, self.basis))
    }

    /// gⁱʲ = gⁱ·gʲ, the inverse of the metric.
    #[inline]
    #[must_use]
    pub fn inverse_metric(&self) -> Symmetric<T> {
        Symmetric::upper_triangle(product_transposed(self.dual, self.dual))
    }

    /// √det g = |det ∂x/∂q|: the volume of the element dq¹ dq² dq³.
    #[inline]
    #[must_use]
    pub fn volume_element(&self) -> T {
        self.determinant.abs()
    }

    /// Whether (g₁, g₂, g₃) is a right-handed basis: +1, or −1 when it is left-handed, as the spherical one in the
    /// order r, azimuth, colatitude.
    #[inline]
    #[must_use]
    pub fn orientation(&self) -> T {
        T::one().copysign(self.determinant)
    }

    /// Cartesian components of v = vⁱ gᵢ.
    #[inline]
    #[must_use]
    pub fn vector_to_cartesian(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::from(piola_tensor::internal::rows::apply(transpose(self.basis), (*v).into()))
    }

    /// Contravariant components vⁱ = gⁱ·v of a vector with given Cartesian ones.
    #[inline]
    #[must_use]
    pub fn vector_from_cartesian(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::from(piola_tensor::internal::rows::apply(self.dual, (*v).into()))
    }

    /// Cartesian components of T = Tⁱʲ gᵢ⊗gⱼ.
    #[inline]
    #[must_use]
    pub fn tensor_to_cartesian(&self, tensor: &Rows<T>) -> Rows<T> {
        product(transposed_product(self.basis, *tensor), self.basis)
    }

    /// Contravariant components Tⁱʲ = gⁱ·T gʲ of a tensor with given Cartesian ones.
    #[inline]
    #[must_use]
    pub fn tensor_from_cartesian(&self, tensor: &Rows<T>) -> Rows<T> {
        product_transposed(product(self.dual, *tensor), self.dual)
    }

    /// ∇ⱼvⁱ = ∂ⱼvⁱ + Γⁱₖⱼ vᵏ, at row i and column j, from vⁱ and ∂vⁱ/∂qᵏ, `[k][i]`.
    #[inline]
    #[must_use]
    pub fn vector_gradient(&self, v: &Vector3<T>, partials: &[Vector3<T>; 3]) -> Matrix3<T> {
        let gamma = &self.christoffel;
        Matrix3::from_fn(|i, j| partials[j][i] + gamma[i][0][j] * v[0] + gamma[i][1][j] * v[1] + gamma[i][2][j] * v[2])
    }

    /// div v = ∂ᵢvⁱ + Γⁱₖᵢ vᵏ.
    #[inline]
    #[must_use]
    pub fn vector_divergence(&self, v: &Vector3<T>, partials: &[Vector3<T>; 3]) -> T {
        let trace = |k: usize| self.christoffel[0][k][0] + self.christoffel[1][k][1] + self.christoffel[2][k][2];
        (partials[0][0] + partials[1][1] + partials[2][2]) + (trace(0) * v[0] + trace(1) * v[1] + trace(2) * v[2])
    }

    /// (div T)ⁱ = ∂ⱼTⁱʲ + Γⁱₖⱼ Tᵏʲ + Γʲₖⱼ Tⁱᵏ, contravariant, from Tⁱʲ and ∂Tⁱʲ/∂qᵏ, `[k][i][j]`.
    #[inline]
    #[must_use]
    pub fn tensor_divergence(&self, tensor: &Rows<T>, partials: &[Rows<T>; 3]) -> Vector3<T> {
        let gamma = &self.christoffel;
        let trace = |k: usize| gamma[0][k][0] + gamma[1][k][1] + gamma[2][k][2];
        Vector3::from_fn(|i, _| {
            let mut sum = T::zero();
            for j in 0..3 {
                sum += partials[j][i][j] + trace(j) * tensor[i][j];
                for k in 0..3 {
                    sum += gamma[i][k][j] * tensor[k][j];
                }
            }
            sum
        })
    }

    /// Δf = gⁱʲ (∂ᵢ∂ⱼf − Γᵏᵢⱼ ∂ₖf).
    #[inline]
    #[must_use]
    pub fn laplacian(&self, partials: &[T; 3], second_partials: &Rows<T>) -> T {
        let inverse = product_transposed(self.dual, self.dual);
        let mut sum = T::zero();
        for i in 0..3 {
            for j in 0..3 {
                let along = |k: usize| self.christoffel[k][i][j] * partials[k];
                sum += inverse[i][j] * (second_partials[i][j] - (along(0) + along(1) + along(2)));
            }
        }
        sum
    }

    /// Unit vectors, scale factors and curvatures, where the basis is orthogonal.
    ///
    /// # Errors
    /// [`FieldsError::NotOrthogonal`] when, in any lane, gᵢ·gⱼ is more than 64 ulp of |gᵢ| |gⱼ|.
    pub fn physical_frame(&self) -> Result<PhysicalFrame<T>, FieldsError> {
        PhysicalFrame::of(self)
    }
}
