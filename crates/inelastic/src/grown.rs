//! Growth and thermal expansion: F = Fₑ G with a stress-free G.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, DeformationGradient, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::{Rows, product, product_transposed};

use crate::InelasticError;
use crate::error::{check_bound, check_finite};

/// An elastic law behind a given stress-free deformation: growth, swelling or thermal expansion.
///
/// ```text
/// F = Fₑ G        W(F) = det G Wₑ(F G⁻¹)        P = det G Pₑ G⁻ᵀ
/// ```
/// It is a [`Hyperelastic`] law: batches, specimens and checks take it. W is zero where F = G.
///
/// # Accuracy
/// That of the elastic law × the condition number of G.
///
/// # Example
/// A body heated by 100 K without being able to expand is under pressure; free to expand, it has no stress.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{Grown, ThermalExpansion};
/// use piola_solids::{Hyperelastic, NeoHookeanCiarlet};
/// let expansion = ThermalExpansion { coefficient: 1e-3, reference_temperature: 300.0 };
/// let hot = Grown::heated(NeoHookeanCiarlet::with_constants(1.0, 2.0)?, &expansion, 400.0)?;
/// let free = DeformationGradient::dilatation(0.1_f64.exp())?; // e^(α ΔT)
/// assert!(hot.cauchy(&free).0.components[0].abs() < 1e-15_f64);
/// assert!(hot.cauchy(&DeformationGradient::<f64>::identity()).0.components[0] < -0.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// E. K. Rodriguez and others, J. Biomech. 27 (1994) 455–467; R. Stojanović, S. Djurić and L. Vujošević, Arch. Mech.
/// Stos. 16 (1964) 103–108.
#[doc(alias("growth", "thermal expansion", "eigenstrain", "swelling"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Grown<L> {
    law: L,
    growth: Rows<f64>,
    #[cfg_attr(feature = "serde", serde(skip))]
    inverse: Rows<f64>,
    #[cfg_attr(feature = "serde", serde(skip))]
    volume: f64,
}

/// Isotropic thermal expansion G = e^(α (θ − θ₀)) 1.
///
/// # Example
/// ```
/// use piola_inelastic::ThermalExpansion;
/// let steel = ThermalExpansion { coefficient: 1.2e-5, reference_temperature: 293.15 };
/// assert!((steel.stretch(393.15) - 1.001_2).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ThermalExpansion {
    /// α, 1/K.
    pub coefficient: f64,
    /// θ₀, K.
    pub reference_temperature: f64,
}

impl ThermalExpansion {
    /// e^(α (θ − θ₀)) of the temperature θ, K.
    #[must_use]
    pub fn stretch(&self, temperature: f64) -> f64 {
        (self.coefficient * (temperature - self.reference_temperature)).exp()
    }
}

impl<L> Grown<L> {
    /// Of the elastic law and G.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`] unless 0 < det G.
    pub fn new(law: L, growth: &Matrix3<f64>) -> Result<Self, InelasticError> {
        check_finite("G", growth.as_slice())?;
        let growth = rows_of(growth);
        let (inverse, volume) = inverse_and_determinant(growth);
        check_bound("growth", "det G", volume, "0 < det G", 0.0 < volume)?;
        Ok(Self { law, growth, inverse, volume })
    }

    /// Grown by ϑ in all directions.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn isotropic(law: L, stretch: f64) -> Result<Self, InelasticError> {
        check_bound("growth", "ϑ", stretch, "0 < ϑ", 0.0 < stretch)?;
        Self::new(law, &Matrix3::from_diagonal_element(stretch))
    }

    /// Grown by ϑ along a direction alone: G = 1 + (ϑ − 1) a ⊗ a.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn along(law: L, stretch: f64, fibre: piola_solids::Fibre) -> Result<Self, InelasticError> {
        check_bound("growth", "ϑ", stretch, "0 < ϑ", 0.0 < stretch)?;
        Self::new(law, &(Matrix3::identity() + fibre.structure().matrix() * (stretch - 1.0)))
    }

    /// At a temperature, K.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn heated(law: L, expansion: &ThermalExpansion, temperature: f64) -> Result<Self, InelasticError> {
        Self::isotropic(law, expansion.stretch(temperature))
    }

    /// The elastic law.
    #[must_use]
    pub const fn law(&self) -> &L {
        &self.law
    }

    /// G.
    #[must_use]
    pub fn growth(&self) -> Matrix3<f64> {
        from_rows(self.growth)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inverse<T: Real>(&self) -> Rows<T> {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.inverse;
        let l = T::lit;
        [[l(a), l(b), l(c)], [l(d), l(e), l(f)], [l(g), l(h), l(i)]]
    }

    /// Fₑ = F G⁻¹.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn elastic<T: Real>(&self, deformation: &impl Deformation<T>) -> DeformationGradient<T> {
        DeformationGradient::trusted(product(deformation.gradient_rows(), self.inverse()))
    }
}

impl<L: Hyperelastic> Hyperelastic for Grown<L> {
    const REFUSED_IS_NOT_FINITE: bool = L::REFUSED_IS_NOT_FINITE;
    const KNOWS_DEFORMATIONS: bool = L::KNOWS_DEFORMATIONS;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        T::lit(self.volume) * self.law.energy(&self.elastic(deformation))
    }

    fn reference_energy(&self) -> f64 {
        self.volume * self.law.reference_energy()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        self.law.check(&self.elastic(deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        let stress = self.law.first_piola(&self.elastic(deformation));
        FirstPiola(from_rows(product_transposed(rows_of(&stress.0), self.inverse())) * T::lit(self.volume))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_and_first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> (T, FirstPiola<T>) {
        (self.energy(deformation), self.first_piola(deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        self.first_piola_and_tangent(deformation).1
    }

    /// `A_iAjB = det G A^e_iCjD H_AC H_BD`, H = G⁻¹.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        let (inverse, volume) = (self.inverse::<T>(), T::lit(self.volume));
        let (stress, tangent) = self.law.first_piola_and_tangent(&self.elastic(deformation));
        let stress = FirstPiola(from_rows(product_transposed(rows_of(&stress.0), inverse)) * volume);
        let entries = &tangent.0.components;
        let half = |row: usize, j: usize, b: usize| {
            let [x, y, z] = [entries[row][3 * j], entries[row][3 * j + 1], entries[row][3 * j + 2]];
            x * inverse[b][0] + y * inverse[b][1] + z * inverse[b][2]
        };
        let mut whole = [[T::zero(); 9]; 9];
        for (row, entries) in whole.iter_mut().enumerate() {
            let (i, h) = (3 * (row / 3), inverse[row % 3]);
            for (column, entry) in entries.iter_mut().enumerate() {
                let (j, b) = (column / 3, column % 3);
                *entry = volume * (h[0] * half(i, j, b) + h[1] * half(i + 1, j, b) + h[2] * half(i + 2, j, b));
            }
        }
        (stress, FirstPiolaTangent(FourthOrder { components: whole }))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
        let (stress, tangent) = self.first_piola_and_tangent(deformation);
        (self.energy(deformation), stress, tangent)
    }
}
