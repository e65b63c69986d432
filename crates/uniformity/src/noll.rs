//! Noll's equations of motion of a uniform body.
//!
//! ```text
//! H_k^iDC (∂²x^k/∂X^C∂X^D − F^k_B Γ^B_CD) + ρ_κ bⁱ = ρ_κ ẍⁱ        W(28.22)
//! H_k^iDC = det F (F⁻¹)^D_j G_k^ijC                                 W(28.23)
//! G_k^ijC = (∂N^ij/∂(FK)^k_a) K^C_a                                 W(28.17)
//! ```
//!
//! The bracket is the covariant derivative of F, W(28.24), in any material connection. The first term is Div P.

use nalgebra::Vector3;
use piola_continuum::DeformationGradient;
use piola_fields::{Field, Motion, Residual, VectorResidual};
use piola_numerics::linear::matrix3::{inverse_and_determinant, rows_of};
use piola_numerics::{Gradient, Real};
use piola_solids::Hyperelastic;
use piola_tensor::Rows;
use piola_tensor::internal::rows::product;

use crate::UniformityError;
use crate::body::MateriallyUniformBody;
use crate::connection::AffineConnection;
use crate::error::check_finite;
use crate::indices::{Fourth, Third, fourth, sum, third};
use crate::map::UniformityMap;

/// F, and the two terms of its covariant derivative.
type GradientWithTerms<T> = (Rows<T>, Third<(T, T)>);

/// The equations of motion of a uniform body with one of its material connections.
///
/// # Errors
/// What body, connection and motion refuse; [`UniformityError::NotFinite`].
///
/// # Accuracy
/// A few ulp of the sum of the moduli of the terms: derivatives are exact.
///
/// # Example
/// A bar whose growth varies along it, held straight: the stress varies, and Div P ≠ 0 though F is constant.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::Motion;
/// use piola_numerics::Real;
/// use piola_solids::NeoHookeanLogarithmic;
/// use piola_uniformity::{LieAlgebra, MaterialConnection, MateriallyUniformBody, NollEquations, UniformityMap};
/// #[derive(Clone, Copy)]
/// struct Grown;
/// impl UniformityMap for Grown {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         Matrix3::from_diagonal(&Vector3::new((T::one() + reference.x).recip(), T::one(), T::one()))
///     }
/// }
/// struct Rest;
/// impl Motion for Rest {
///     fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
///         *reference
///     }
/// }
/// let body = MateriallyUniformBody { law: NeoHookeanLogarithmic::with_constants(1.0, 0.0)?, map: Grown };
/// let connection = MaterialConnection::new(Grown, LieAlgebra::rotations());
/// let divergence = NollEquations { body: &body, connection: &connection }.divergence(&Rest, &Vector3::zeros(), 0.0)?;
/// // T₁₁ = μ (k² − 1)/k with k = 1/(1 + X): dT₁₁/dX = −2 μ at X = 0.
/// assert!((divergence.value.x + 2.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(28.17–28.24).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NollEquations<'a, L, M, C> {
    /// The body.
    pub body: &'a MateriallyUniformBody<L, M>,
    /// A material connection of the body.
    pub connection: &'a C,
}

impl<L: Hyperelastic, M: UniformityMap, C: AffineConnection> NollEquations<'_, L, M, C> {
    /// `∇_D F^k_C = ∂²x^k/∂X^C∂X^D − F^k_B Γ^B_CD`, 1/m, `[k][C][D]`, W(28.24).
    ///
    /// # Errors
    /// See [the type](NollEquations#errors).
    pub fn covariant_gradient<T: Real>(
        &self,
        motion: &impl Motion,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<[[[T; 3]; 3]; 3], UniformityError> {
        let terms = self.covariant_terms(motion, reference, t)?.1;
        Ok(third(|k, c, d| terms[k][c][d].0 - terms[k][c][d].1))
    }

    /// `H_k^iDC`, Pa, `[k][i][D][C]`, W(28.23).
    ///
    /// # Errors
    /// See [the type](NollEquations#errors).
    pub fn elasticity<T: Real>(
        &self,
        deformation: &DeformationGradient<T>,
        reference: &Vector3<T>,
    ) -> Result<[[[[T; 3]; 3]; 3]; 3], UniformityError> {
        self.body.crystal_deformation(deformation, reference)?;
        let elasticity = self.elasticity_of(rows_of(deformation.matrix()), reference);
        check_finite("H", elasticity.as_flattened().as_flattened().as_flattened())?;
        Ok(elasticity)
    }

    /// `H_k^iDC ∇_D F^k_C` = Div P, N/m³ of the reference configuration, with its scale.
    ///
    /// # Errors
    /// See [the type](NollEquations#errors).
    pub fn divergence<T: Real>(
        &self,
        motion: &impl Motion,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, UniformityError> {
        Ok(self.divergence_terms(motion, reference, t)?.into())
    }

    /// What W(28.22) leaves: Div P + `ρ_κ` b − `ρ_κ` ẍ, N/m³ of the reference configuration.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | ρ₀ | `crystal_density`; `ρ_κ` = ρ₀/det K | kg/m³ |
    /// | b(X, t) | `body_force`, per mass | m/s² |
    ///
    /// # Errors
    /// See [the type](NollEquations#errors).
    pub fn residual<T: Real>(
        &self,
        motion: &impl Motion,
        crystal_density: T,
        body_force: &impl Field<Value = Vector3<f64>>,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<VectorResidual<T>, UniformityError> {
        let terms = self.divergence_terms(motion, reference, t)?;
        let density = self.body.reference_density(crystal_density, reference)?;
        let (force, acceleration) = (body_force.at(reference, t), motion.acceleration(reference, t)?);
        let residual = [0, 1, 2].map(|i: usize| terms[i].plus(density * force[i]).plus(-(density * acceleration[i])));
        check_finite("residual", &residual.map(|component| component.value))?;
        Ok(residual.into())
    }

    fn divergence_terms<T: Real>(
        &self,
        motion: &impl Motion,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<[Residual<T>; 3], UniformityError> {
        let (gradient, covariant) = self.covariant_terms(motion, reference, t)?;
        let elasticity = self.elasticity(&DeformationGradient::from_rows(gradient)?, reference)?;
        Ok([0, 1, 2].map(|i: usize| {
            let mut component = Residual::zero();
            for (of_k, of_motion) in elasticity.iter().zip(&covariant) {
                for (d, row) in of_k[i].iter().enumerate() {
                    for (&h, terms) in row.iter().zip(of_motion) {
                        component = component.plus(h * terms[d].0).plus(-(h * terms[d].1));
                    }
                }
            }
            component
        }))
    }

    /// F, and the two terms of its covariant derivative.
    fn covariant_terms<T: Real>(
        &self,
        motion: &impl Motion,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<GradientWithTerms<T>, UniformityError> {
        let gradient = rows_of(motion.deformation_gradient(reference, t)?.matrix());
        let second = motion.second_gradient(reference, t)?;
        let gamma = self.connection.coefficients(reference)?.components;
        let terms = third(|k, c, d| (second[k][(c, d)], sum(|b| gradient[k][b] * gamma[b][c][d])));
        Ok((gradient, terms))
    }

    fn elasticity_of<T: Real>(&self, gradient: Rows<T>, reference: &Vector3<T>) -> Fourth<T> {
        let k = rows_of(&self.body.map.at(reference));
        let crystal = product(gradient, k);
        let varied: Rows<Gradient<T, 9>> =
            core::array::from_fn(|i| core::array::from_fn(|a| Gradient::variable(crystal[i][a], 3 * i + a)));
        let stress = self.body.law.cauchy(&DeformationGradient::trusted(varied)).0.rows();
        let (inverse, jacobian) = inverse_and_determinant(gradient);
        // G_k^ijC, then H_k^iDC.
        let g = |m: usize, i: usize, j: usize, c: usize| sum(|a| stress[i][j].partials[3 * m + a] * k[c][a]);
        let g = fourth(g);
        fourth(|m, i, d, c| jacobian * sum(|j| inverse[d][j] * g[m][i][j][c]))
    }
}
