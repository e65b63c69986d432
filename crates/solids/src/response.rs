//! Isotropic elastic solids by their response functions, and the forms of these.
//!
//! ```text
//! T = φ₀ 1 + φ₁ V + φ₂ V²            in V           W(19.42)
//! T = α₀ 1 + α₁ B + α₂ B²            in B           W(24.17)
//! T = β₀ 1 + β₁ B⁻¹ + β₂ B⁻²         in B⁻¹         W(24.22)
//! T = γ₀ 1 + γ₁ B + γ₋₁ B⁻¹          in B and B⁻¹   W(25.4)
//! ```
//! The coefficients are functions of the invariants. By the theorem of Cayley and Hamilton each form turns into each other:
//!
//! ```text
//! B² = I₁ B − I₂ 1 + I₃ B⁻¹        I₃ B⁻² = I₂ B⁻¹ − I₁ 1 + B
//! V = [(i₁² − i₂) B + i₁ i₃ 1 − B²]/(i₁ i₂ − i₃)        i₁ i₂ − i₃ = (λ₁ + λ₂)(λ₂ + λ₃)(λ₃ + λ₁) > 0
//! ```
//! with I of B and i of V.

use piola_continuum::internal::strain as kernels;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::stress::invariants::principal_invariants;
use piola_continuum::{CauchyStress, Deformation, Symmetric};
use piola_numerics::Real;

use super::invariant::{InvariantEnergy, invariants_of};

/// The tensors that the coefficients of an [`IsotropicResponse`] multiply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ResponseForm {
    /// 1, V, V², W(19.42).
    Stretch,
    /// 1, B, B², W(24.17).
    Square,
    /// 1, B⁻¹, B⁻², W(24.22).
    Inverse,
    /// 1, B, B⁻¹, W(25.4).
    Mixed,
}

/// The response coefficients of an isotropic elastic solid at a deformation.
///
/// # Accuracy
/// Conversions: a few ulp × the condition number of B, of the largest term; i₁ i₂ − i₃ does not cancel.
///
/// # Example
/// ```
/// use piola_solids::{IsotropicResponse, ResponseForm};
/// use piola_continuum::DeformationGradient;
/// // The incompressible Mooney–Rivlin solid: γ₁ = 2 C₁₀, γ₋₁ = −2 C₀₁.
/// let rubber = IsotropicResponse { form: ResponseForm::Mixed, coefficients: [0.0, 1.0, -0.5] };
/// let shear = DeformationGradient::simple_shear(1.0)?;
/// assert_eq!(rubber.cauchy(&shear).0.components[3], 1.5);
/// // I₁ = I₂ = 4, I₃ = 1: B⁻¹ = B² − 4 B + 4.
/// assert_eq!(rubber.converted(ResponseForm::Square, &shear).coefficients, [-2.0, 3.0, -0.5]);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(19.42), W(24.17), W(24.22), W(25.4).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct IsotropicResponse<T = f64> {
    /// The tensors that the coefficients multiply.
    pub form: ResponseForm,
    /// The coefficients, Pa, in the order of the form.
    pub coefficients: [T; 3],
}

impl<T: Real> IsotropicResponse<T> {
    /// Of an isotropic law W(I₁, I₂, J), in 1, B and B².
    ///
    /// ```text
    /// α₀ = ∂W/∂J      α₁ = 2 J⁻¹ (W₁ + I₁ W₂)      α₂ = −2 J⁻¹ W₂
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of<L: InvariantEnergy>(law: &L, deformation: &impl Deformation<T>) -> Self {
        let invariants = invariants_of(law, deformation);
        let slopes = law.slopes(&invariants);
        let two = T::lit(2.0);
        let reciprocal = invariants.jacobian.recip();
        let volume = slopes.volume * reciprocal;
        let trace = invariants.first + T::lit(3.0);
        let twice = two * reciprocal;
        Self {
            form: ResponseForm::Square,
            coefficients: [volume, twice * (slopes.first + trace * slopes.second), -(twice * slopes.second)],
        }
    }

    /// T.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        let (first, second) = match self.form {
            ResponseForm::Stretch => {
                let stretch = StretchAnalysis::of(deformation).left_stretch();
                (stretch, stretch.square())
            }
            ResponseForm::Square => {
                let left = kernels::left_cauchy_green(deformation.gradient_rows());
                (left, left.square())
            }
            ResponseForm::Inverse => {
                let inverse = inverse_left(deformation);
                (inverse, inverse.square())
            }
            ResponseForm::Mixed => (kernels::left_cauchy_green(deformation.gradient_rows()), inverse_left(deformation)),
        };
        let [a, b, c] = self.coefficients;
        CauchyStress(Symmetric::identity() * a + first * b + second * c)
    }

    /// The same stress in another form, at the deformation that the coefficients belong to.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn converted(&self, form: ResponseForm, deformation: &impl Deformation<T>) -> Self {
        if form == self.form {
            return *self;
        }
        let invariants = Traces::of(deformation);
        Self { form, coefficients: invariants.turned(form, invariants.mixed(self)) }
    }
}

/// B⁻¹ = Cof F Cof Fᵀ/J².
#[cfg_attr(not(debug_assertions), inline(always))]
fn inverse_left<T: Real>(deformation: &impl Deformation<T>) -> Symmetric<T> {
    let reciprocal = deformation.jacobian().recip();
    kernels::left_cauchy_green(deformation.cofactor_rows()) * (reciprocal * reciprocal)
}

/// The invariants of B, and those of V.
struct Traces<T> {
    b: [T; 3],
    v: [T; 3],
}

impl<T: Real> Traces<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(deformation: &impl Deformation<T>) -> Self {
        let jacobian = deformation.jacobian();
        let first = piola_continuum::strain::invariants::first(deformation);
        let second = piola_continuum::strain::invariants::second(deformation);
        let [i, ii, _] = principal_invariants(&StretchAnalysis::of(deformation).left_stretch());
        Self { b: [first, second, jacobian * jacobian], v: [i, ii, jacobian] }
    }

    /// (i₁² − i₂, i₁ i₃, i₁ i₂ − i₃).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_stretch(&self) -> (T, T, T) {
        let [i, ii, iii] = self.v;
        (i * i - ii, i * iii, i * ii - iii)
    }

    /// (γ₀, γ₁, γ₋₁).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mixed(&self, response: &IsotropicResponse<T>) -> [T; 3] {
        let [i, ii, iii] = self.b;
        let [a, b, c] = response.coefficients;
        match response.form {
            ResponseForm::Mixed => [a, b, c],
            ResponseForm::Square => [a - ii * c, b + i * c, iii * c],
            ResponseForm::Inverse => {
                let first = c / iii;
                [a - i * first, first, b + ii * first]
            }
            ResponseForm::Stretch => {
                let (p, q, d) = self.of_stretch();
                let share = b / d;
                let square = [a + share * q, c + share * p, -share];
                self.mixed(&IsotropicResponse { form: ResponseForm::Square, coefficients: square })
            }
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turned(&self, form: ResponseForm, [a, b, c]: [T; 3]) -> [T; 3] {
        let [i, ii, iii] = self.b;
        match form {
            ResponseForm::Mixed => [a, b, c],
            ResponseForm::Square => {
                let second = c / iii;
                [a + ii * second, b - i * second, second]
            }
            ResponseForm::Inverse => [a + i * b, c - ii * b, iii * b],
            ResponseForm::Stretch => {
                let [zero, first, second] = self.turned(ResponseForm::Square, [a, b, c]);
                let (p, q, d) = self.of_stretch();
                [zero + second * q, -(second * d), first + second * p]
            }
        }
    }
}

/// An isotropic elastic solid by its response functions: elastic, not necessarily hyperelastic.
///
/// # Example
/// T = μ (V − 1), the simplest law in V.
/// ```
/// use piola_solids::{IsotropicResponse, IsotropicSolid, ResponseForm};
/// use piola_continuum::DeformationGradient;
/// use piola_numerics::Real;
/// struct Spring(f64);
/// impl IsotropicSolid for Spring {
///     fn response<T: Real>(&self, _invariants: [T; 3]) -> IsotropicResponse<T> {
///         let mu = T::lit(self.0);
///         IsotropicResponse { form: ResponseForm::Stretch, coefficients: [-mu, mu, T::zero()] }
///     }
/// }
/// let stress: f64 = Spring(2.0).cauchy(&DeformationGradient::diagonal([3.0, 1.0, 1.0])?).0.components[0];
/// assert!((stress - 4.0).abs() < 1e-14);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(19.42).
pub trait IsotropicSolid {
    /// The coefficients at the invariants (I₁, I₂, I₃) of B.
    #[must_use]
    fn response<T: Real>(&self, invariants: [T; 3]) -> IsotropicResponse<T>;

    /// T.
    #[must_use]
    fn cauchy<T: Real>(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        let jacobian = deformation.jacobian();
        let first = piola_continuum::strain::invariants::first(deformation);
        let second = piola_continuum::strain::invariants::second(deformation);
        self.response([first, second, jacobian * jacobian]).cauchy(deformation)
    }
}
