//! Physical components in orthogonal coordinates.

use nalgebra::Vector3;
use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, apply, product, product_transposed, transpose, transposed_product};

use super::LocalBasis;
use crate::FieldsError;
use crate::residual::Residual;

/// The unit vectors eᵢ of orthogonal coordinates at a point, with what derivatives of components need.
///
/// ```text
/// eᵢ = gᵢ/hᵢ       hᵢ = |gᵢ|       κⱼₖ = (∂hⱼ/∂qᵏ)/(hⱼ hₖ),  k ≠ j
/// ∂eⱼ/∂sⱼ = − Σₖ κⱼₖ eₖ        ∂eₖ/∂sⱼ = κⱼₖ eⱼ        ∂/∂sⱼ = (1/hⱼ) ∂/∂qʲ
/// ```
///
/// κⱼₖ is the curvature of the coordinate line j towards −eₖ, 1/m: for circles about an axis, 1/r.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Coordinates, Cylindrical};
/// let frame = Cylindrical.physical_frame(&Vector3::new(4.0, 0.0, 0.0))?;
/// assert_eq!(frame.scale_factors, [1.0, 4.0, 1.0]);
/// assert_eq!(frame.curvatures[1][0], 0.25);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PhysicalFrame<T = f64> {
    /// eᵢ in Cartesian components, one a row.
    pub directions: Rows<T>,
    /// hᵢ, m or m/rad.
    pub scale_factors: [T; 3],
    /// κⱼₖ, 1/m, as `[j][k]`; zero for j = k.
    pub curvatures: Rows<T>,
}

impl<T: Real> PhysicalFrame<T> {
    pub(super) fn of(local: &LocalBasis<T>) -> Result<Self, FieldsError> {
        let g = local.basis;
        let scale_factors = g.map(|g| dot(g, g).sqrt());
        for (row, column) in [(0, 1), (1, 2), (0, 2)] {
            let product = dot(g[row], g[column]);
            let limit = T::lit(64.0 * unit_in_last_place::<T>()) * scale_factors[row] * scale_factors[column];
            if !product.abs().at_most(limit).all() {
                let lane = (0..T::LANES).find(|&l| limit.primal(l) < product.primal(l).abs()).unwrap_or(0);
                let lengths = scale_factors[row].primal(lane) * scale_factors[column].primal(lane);
                return Err(FieldsError::NotOrthogonal { row, column, cosine: product.primal(lane) / lengths });
            }
        }
        let directions = [0, 1, 2].map(|i: usize| g[i].map(|c| c / scale_factors[i]));
        // ∂hⱼ/∂qᵏ = eⱼ·∂gⱼ/∂qᵏ
        let curvature = |j: usize, k: usize| {
            if j == k {
                return T::zero();
            }
            dot(directions[j], local.change[j][k]) / (scale_factors[j] * scale_factors[k])
        };
        let curvatures = [0, 1, 2].map(|j: usize| [0, 1, 2].map(|k: usize| curvature(j, k)));
        Ok(Self { directions, scale_factors, curvatures })
    }

    /// Cartesian components of v = vᵢ eᵢ.
    #[inline]
    #[must_use]
    pub fn vector_to_cartesian(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::from(apply(transpose(self.directions), (*v).into()))
    }

    /// Physical components vᵢ = eᵢ·v of a vector with given Cartesian ones.
    #[inline]
    #[must_use]
    pub fn vector_from_cartesian(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::from(apply(self.directions, (*v).into()))
    }

    /// Cartesian components of T = Tᵢⱼ eᵢ⊗eⱼ.
    #[inline]
    #[must_use]
    pub fn tensor_to_cartesian(&self, tensor: &Rows<T>) -> Rows<T> {
        product(transposed_product(self.directions, *tensor), self.directions)
    }

    /// Physical components Tᵢⱼ = eᵢ·T eⱼ of a tensor with given Cartesian ones.
    #[inline]
    #[must_use]
    pub fn tensor_from_cartesian(&self, tensor: &Rows<T>) -> Rows<T> {
        product_transposed(product(self.directions, *tensor), self.directions)
    }

    /// (grad v)ᵢⱼ: ∂vᵢ/∂sⱼ − κⱼᵢ vⱼ for i ≠ j, ∂vⱼ/∂sⱼ + Σₖ κⱼₖ vₖ on the diagonal.
    #[inline]
    #[must_use]
    pub fn gradient(&self, vector: &[T; 3], partials: &[[T; 3]; 3]) -> Rows<T> {
        let (h, kappa) = (&self.scale_factors, &self.curvatures);
        let mut gradient = [[T::zero(); 3]; 3];
        for j in 0..3 {
            for i in 0..3 {
                let turning = if i == j { dot(kappa[j], *vector) } else { -(kappa[j][i] * vector[j]) };
                gradient[i][j] = partials[j][i] / h[j] + turning;
            }
        }
        gradient
    }

    /// The terms of (div T)ᵢ = Σⱼ ∂Tᵢⱼ/∂sⱼ + Σₖ κᵢₖ Tₖᵢ − Σⱼ κⱼᵢ Tⱼⱼ + Σⱼₖ κⱼₖ Tᵢₖ.
    #[inline]
    #[must_use]
    pub fn divergence_terms(&self, tensor: &Rows<T>, partials: &[Rows<T>; 3]) -> [Residual<T>; 3] {
        let (h, kappa) = (&self.scale_factors, &self.curvatures);
        [0, 1, 2].map(|i: usize| {
            let mut sum = Residual::zero();
            for j in 0..3 {
                sum = sum.plus(partials[j][i][j] / h[j]);
                sum = sum.plus(kappa[i][j] * tensor[j][i]).plus(-(kappa[j][i] * tensor[j][j]));
                for k in 0..3 {
                    sum = sum.plus(kappa[j][k] * tensor[i][k]);
                }
            }
            sum
        })
    }
}
