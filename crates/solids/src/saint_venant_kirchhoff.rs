//! The solid of St. Venant and Kirchhoff.

use piola_continuum::internal::strain as kernels;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent};
use piola_continuum::{Deformation, FirstPiola, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::internal::Lanewise;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::MajorSymmetric;
use piola_tensor::internal::rows::{Rows, product, scaled};

use super::{Hyperelastic, packed};
use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// The solid of St. Venant and Kirchhoff: Hooke's law between E and S.
    ///
    /// ```text
    /// W = ½ λ (tr E)² + μ E : E        S = λ tr E 1 + 2 μ E        ∂S/∂E = λ 1 ⊗ 1 + 2 μ
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | λ | `first_lame_parameter` | Pa | 0 < 3 λ + 2 μ |
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    ///
    /// For large rotations at small strain. In compression it loses ellipticity: a bar of λ = 0 under axial
    /// compression yields where the stretch is √⅓, and W stays finite as J → 0.
    ///
    /// # Accuracy
    /// S and P relative 1e-13 down to ∇u = 1e-16, from E; tangents 4 ulp of their norm.
    ///
    /// # Example
    /// ```
    /// use piola_solids::{Hyperelastic, SaintVenantKirchhoff};
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
        first_lame_parameter as "lambda":
            "0 < 3 λ + 2 μ" => 0.0 < 3.0 * first_lame_parameter + 2.0 * shear_modulus,
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
    }
}

impl SaintVenantKirchhoff {
    /// λ tr E 1 + 2 μ E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress<T: Real>(&self, displacement: Rows<T>) -> Symmetric<T> {
        let strain = kernels::green(displacement);
        Symmetric::identity() * (T::lit(self.first_lame_parameter) * strain.trace())
            + strain * T::lit(2.0 * self.shear_modulus)
    }

    /// `δ_ij S_AB + λ F_iA F_jB + μ (F_iB F_jA + B_ij δ_AB)`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tangent<T: Real>(&self, stress: &Symmetric<T>, f: Rows<T>) -> [[T; 9]; 9] {
        let mu = T::lit(self.shear_modulus);
        let (s, b) = (stress.rows(), (kernels::left_cauchy_green(f) * mu).rows());
        let (l, m) = (scaled(f, T::lit(self.first_lame_parameter)), scaled(f, mu));
        let mut entries = [[T::zero(); 9]; 9];
        // Written out: in a loop the compiler would decide at run time which terms an entry has.
        macro_rules! row {
            ($r:literal: $($c:literal)+) => { $(
                let (i, p, j, q) = ($r / 3, $r % 3, $c / 3, $c % 3);
                let mut entry = l[i][p] * f[j][q] + m[i][q] * f[j][p];
                if i == j {
                    entry += s[p][q];
                }
                if p == q {
                    entry += b[i][j];
                }
                entries[$r][$c] = entry;
                entries[$c][$r] = entry;
            )+ };
        }
        rows_of_upper_triangle!(row);
        entries
    }
}

/// P and ∂P/∂F of F and ∇u.
struct Both(SaintVenantKirchhoff);

impl Lanewise<18, 54> for Both {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 54] {
        let [f, h] = packed::gradients(inputs);
        let stress = self.0.stress(h);
        packed::of_both(product(f, stress.rows()), &self.0.tangent(&stress, f))
    }
}

impl Hyperelastic for SaintVenantKirchhoff {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = kernels::green(deformation.displacement_rows());
        let trace = strain.trace();
        T::lit(0.5 * self.first_lame_parameter) * (trace * trace)
            + T::lit(self.shear_modulus) * strain.double_contraction(&strain)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola(from_rows(product(deformation.gradient_rows(), self.stress(deformation.displacement_rows()).rows())))
    }

    /// W = ½ S : E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_and_first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> (T, FirstPiola<T>) {
        let h = deformation.displacement_rows();
        let stress = self.stress(h);
        let energy = T::lit(0.5) * stress.double_contraction(&kernels::green(h));
        (energy, FirstPiola(from_rows(product(deformation.gradient_rows(), stress.rows()))))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
        let (stress, tangent) = self.first_piola_and_tangent(deformation);
        (self.energy(deformation), stress, tangent)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(self.stress(deformation.displacement_rows()))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        self.first_piola_and_tangent(deformation).1
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        packed::both(self.first_piola_and_upper_triangle(deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_and_upper_triangle<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        T::lanewise(&Both(*self), packed::of_deformation(deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn material_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> MaterialTangent<T> {
        MaterialTangent(MajorSymmetric::isotropic(T::lit(self.first_lame_parameter), T::lit(self.shear_modulus)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (SecondPiola<T>, MaterialTangent<T>) {
        (self.second_piola(deformation), self.material_tangent(deformation))
    }
}
