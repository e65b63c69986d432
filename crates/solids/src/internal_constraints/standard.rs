//! The constraints of the text.

use nalgebra::Matrix3;
use piola_continuum::internal::strain::right_cauchy_green_minus_one;
use piola_continuum::{CauchyStress, Deformation, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::internal::rows::{apply, product, scaled};

use super::{InternalConstraint, Restriction};
use crate::Fibre;
use crate::SolidsError;

/// Incompressibility, μ = det F − 1.
///
/// ```text
/// N = λ J 1 = −p 1
/// ```
///
/// # Example
/// ```
/// use piola_solids::internal_constraints::{Incompressibility, InternalConstraint};
/// use piola_continuum::DeformationGradient;
/// let squeezed = DeformationGradient::diagonal([0.5, 1.0, 1.0])?;
/// assert_eq!(Incompressibility.value(&squeezed), -0.5);
/// assert_eq!(Incompressibility.reaction(&squeezed, -3.0).0.components, [-1.5, -1.5, -1.5, 0.0, 0.0, 0.0]);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(21.20).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Incompressibility;

impl Incompressibility {
    /// p = −λ J, Pa.
    #[must_use]
    pub fn pressure<T: Real>(multiplier: T, deformation: &impl Deformation<T>) -> T {
        -(multiplier * deformation.jacobian())
    }
}

impl InternalConstraint for Incompressibility {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        deformation.volume_change()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient<T: Real>(&self, deformation: &impl Deformation<T>) -> Matrix3<T> {
        from_rows(deformation.cofactor_rows())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn reaction<T: Real>(&self, deformation: &impl Deformation<T>, multiplier: T) -> CauchyStress<T> {
        CauchyStress(Symmetric::identity() * (multiplier * deformation.jacobian()))
    }
}

/// Inextensibility along e, μ = |F e|² − 1.
///
/// ```text
/// N = 2 λ F e ⊗ F e = q F e ⊗ F e
/// ```
///
/// # Example
/// ```
/// use piola_solids::internal_constraints::{Inextensibility, InternalConstraint};
/// use piola_solids::Fibre;
/// use piola_continuum::DeformationGradient;
/// let cord = Inextensibility::along(Fibre::new([1.0, 0.0, 0.0])?);
/// let sheared = DeformationGradient::simple_shear(1.0)?; // e₁ ↦ e₁ + e₂
/// assert_eq!(cord.value(&sheared), 1.0);
/// assert_eq!(cord.reaction(&sheared, 0.5).0.components, [1.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(21.22).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Inextensibility {
    fibre: Fibre,
}

impl Inextensibility {
    /// Along fibres.
    #[must_use]
    pub const fn along(fibre: Fibre) -> Self {
        Self { fibre }
    }

    /// e.
    #[must_use]
    pub const fn fibre(&self) -> Fibre {
        self.fibre
    }

    /// q = 2 λ, the tension of N = q F e ⊗ F e, Pa.
    #[must_use]
    pub fn tension<T: Real>(multiplier: T) -> T {
        T::lit(2.0) * multiplier
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn image<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 3] {
        apply(deformation.gradient_rows(), self.fibre.direction().map(T::lit))
    }
}

impl InternalConstraint for Inextensibility {
    /// e · (C − 1) e.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let change = right_cauchy_green_minus_one(deformation.displacement_rows());
        let [x, y, z] = self.fibre.direction().map(T::lit);
        let [a, b, c] = change.apply([x, y, z]);
        x * a + y * b + z * c
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient<T: Real>(&self, deformation: &impl Deformation<T>) -> Matrix3<T> {
        let image = self.image(deformation);
        let e = self.fibre.direction().map(|x| T::lit(2.0 * x));
        Matrix3::from_fn(|i, j| image[i] * e[j])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn reaction<T: Real>(&self, deformation: &impl Deformation<T>, multiplier: T) -> CauchyStress<T> {
        CauchyStress(Symmetric::dyad(self.image(deformation)) * (T::lit(2.0) * multiplier))
    }
}

/// Rigidity, μ = Fᵀ F − 1: six constraints with a symmetric multiplier Λ.
///
/// ```text
/// N = 2 F Λ Fᵀ
/// ```
/// Any symmetric stress is a reaction.
///
/// # Example
/// ```
/// use piola_solids::internal_constraints::Rigidity;
/// use piola_continuum::{DeformationGradient, Symmetric};
/// let quarter_turn = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
/// assert_eq!(Rigidity.value(&quarter_turn), Symmetric::zero());
/// let reaction = Rigidity.reaction(&quarter_turn, &Symmetric::diagonal([0.5, 0.0, 0.0]));
/// assert_eq!(reaction.0, Symmetric::diagonal([0.0, 1.0, 0.0])); // turned with the body
/// assert_eq!(Rigidity.multiplier(&reaction, &quarter_turn), Symmetric::diagonal([0.5, 0.0, 0.0]));
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(21.25).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rigidity;

impl Rigidity {
    /// μ = C − 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn value<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        right_cauchy_green_minus_one(deformation.displacement_rows())
    }

    /// ∂(Λ : μ)/∂F = 2 F Λ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn gradient<T: Real>(&self, deformation: &impl Deformation<T>, multiplier: &Symmetric<T>) -> Matrix3<T> {
        from_rows(scaled(product(deformation.gradient_rows(), multiplier.rows()), T::lit(2.0)))
    }

    /// N = 2 F Λ Fᵀ, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn reaction<T: Real>(&self, deformation: &impl Deformation<T>, multiplier: &Symmetric<T>) -> CauchyStress<T> {
        CauchyStress(multiplier.congruence(deformation.gradient_rows()) * T::lit(2.0))
    }

    /// Λ = ½ F⁻¹ N F⁻ᵀ: the multiplier of any stress.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn multiplier<T: Real>(&self, reaction: &CauchyStress<T>, deformation: &impl Deformation<T>) -> Symmetric<T> {
        reaction.0.congruence(deformation.inverse_rows()) * T::lit(0.5)
    }

    /// The six constraints C₁₁ − 1, C₂₂ − 1, C₃₃ − 1, C₁₂, C₂₃, C₁₃, to combine with others. Their multipliers are the
    /// diagonal of Λ and twice its shears.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn at(&self, deformation: &impl Deformation<f64>) -> Result<[Restriction; 6], SolidsError> {
        let f = deformation.gradient_rows();
        let value = self.value(deformation).components;
        let restriction = |k: usize| {
            let mut multiplier = Symmetric::zero();
            multiplier.components[k] = if k < 3 { 1.0 } else { 0.5 };
            Restriction::of(value[k], self.gradient(deformation, &multiplier), f)
        };
        Ok([restriction(0)?, restriction(1)?, restriction(2)?, restriction(3)?, restriction(4)?, restriction(5)?])
    }
}
