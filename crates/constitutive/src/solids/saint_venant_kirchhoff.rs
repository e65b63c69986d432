//! The solid of St. Venant and Kirchhoff.

use piola_continuum::strain::kernels;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::tensor::rows::product;
use piola_continuum::tensor::{FourthOrder, MajorSymmetric};
use piola_continuum::{Deformation, FirstPiola, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::Hyperelastic;
use super::parameters::parameters;

parameters! {
    /// The solid of St. Venant and Kirchhoff: Hooke's law between E and S.
    ///
    /// ```text
    /// W = ½ λ (tr E)² + μ E : E        S = λ tr E 1 + 2 μ E        ∂S/∂E = λ 1 ⊗ 1 + 2 μ
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | λ | `lambda` | Pa | 0 < 3 λ + 2 μ |
    /// | μ | `mu` | Pa | 0 < μ |
    ///
    /// For large rotations at small strain. In compression it loses ellipticity: a bar of λ = 0 under axial
    /// compression yields where the stretch is √⅓, and W stays finite as J → 0.
    ///
    /// # Accuracy
    /// S and P relative 1e-13 down to ∇u = 1e-16, from E; tangents 4 ulp of their norm.
    ///
    /// # Example
    /// ```
    /// use piola_constitutive::solids::{Hyperelastic, SaintVenantKirchhoff};
    /// use piola_continuum::DeformationGradient;
    /// let solid = SaintVenantKirchhoff::new(1.0, 2.0)?;
    /// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?; // E₁₁ = 3/2
    /// assert_eq!(solid.second_piola(&bar).0.components[0], 7.5); // (λ + 2 μ) E₁₁
    /// assert_eq!(solid.first_piola(&bar).0[(0, 0)], 15.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// B(4.67–4.69).
    pub struct SaintVenantKirchhoff("St. Venant–Kirchhoff") {
        /// λ, Pa.
        lambda: "0 < 3 λ + 2 μ" => 0.0 < 3.0 * lambda + 2.0 * mu,
        /// μ, Pa.
        mu: "0 < μ" => 0.0 < mu,
    }
}

impl SaintVenantKirchhoff {
    /// λ tr E 1 + 2 μ E.
    #[inline(always)]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        let strain = kernels::green(deformation.displacement_rows());
        Symmetric::identity() * (T::lit(self.lambda) * strain.trace()) + strain * T::lit(2.0 * self.mu)
    }

    /// `δ_ij S_AB + λ F_iA F_jB + μ (F_iB F_jA + B_ij δ_AB)`.
    #[expect(clippy::needless_range_loop, reason = "row and column are pairs of indices of four tensors")]
    #[inline(always)]
    fn tangent<T: Real>(&self, stress: &Symmetric<T>, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        let f = deformation.gradient_rows();
        let (s, b) = (stress.rows(), kernels::left_cauchy_green(f).rows());
        let (lambda, mu) = (T::lit(self.lambda), T::lit(self.mu));
        let mut components = [[T::zero(); 9]; 9];
        for row in 0..9 {
            for column in row..9 {
                let (i, p, j, q) = (row / 3, row % 3, column / 3, column % 3);
                let mut entry = lambda * (f[i][p] * f[j][q]) + mu * (f[i][q] * f[j][p]);
                if i == j {
                    entry += s[p][q];
                }
                if p == q {
                    entry += mu * b[i][j];
                }
                components[row][column] = entry;
                components[column][row] = entry;
            }
        }
        FirstPiolaTangent(FourthOrder { components })
    }
}

impl Hyperelastic for SaintVenantKirchhoff {
    #[inline(always)]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = kernels::green(deformation.displacement_rows());
        let trace = strain.trace();
        T::lit(0.5 * self.lambda) * (trace * trace) + T::lit(self.mu) * strain.double_contraction(&strain)
    }

    #[inline(always)]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola(from_rows(product(deformation.gradient_rows(), self.stress(deformation).rows())))
    }

    #[inline(always)]
    fn second_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(self.stress(deformation))
    }

    #[inline(always)]
    fn first_piola_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        self.tangent(&self.stress(deformation), deformation)
    }

    #[inline(always)]
    fn first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        let stress = self.stress(deformation);
        let first = FirstPiola(from_rows(product(deformation.gradient_rows(), stress.rows())));
        (first, self.tangent(&stress, deformation))
    }

    #[inline(always)]
    fn material_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> MaterialTangent<T> {
        MaterialTangent(MajorSymmetric::isotropic(T::lit(self.lambda), T::lit(self.mu)))
    }
}
