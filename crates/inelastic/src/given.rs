//! Growth and thermal expansion that another field gives: G or the temperature among the internal variables, which the law leaves alone.

use piola_continuum::DeformationGradient;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{determinant, inverse_and_determinant, rows_of};
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, product, product_transposed, scaled};

use crate::error::check_finite;
use crate::{Evolution, InelasticError, ThermalExpansion, flow};

/// An elastic law behind a stress-free deformation G, which the user writes into the state before each increment.
///
/// ```text
/// P = det G Pₑ(F G⁻¹) G⁻ᵀ
/// ```
/// The nine internal variables are G by rows; the law returns them as they are. [`Grown`](crate::Grown) is the same with one G for all
/// points, a [`Hyperelastic`] law.
///
/// # Errors
/// An update refuses det G ≤ 0.
///
/// # Example
/// A gel swells by a tenth in all directions while it is held.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{GivenGrowth, InelasticPoint, StepControl};
/// use piola_solids::NeoHookeanCiarlet;
/// let law = GivenGrowth::new(NeoHookeanCiarlet::with_constants(1.0, 2.0)?);
/// let held = DeformationGradient::identity();
/// let swollen = [1.1, 0.0, 0.0, 0.0, 1.1, 0.0, 0.0, 0.0, 1.1];
/// let point = InelasticPoint::with_state(&law, &swollen, &held)?;
/// let stress = point.trial(&held, 1.0, &StepControl::one_step())?.first_piola.0[(0, 0)];
/// let j = 1.1_f64.powi(-3);
/// let expected = 1.0 / 1.1 + ((j * j - 1.0) - 1.0) * 1.1; // Pₑ = μ Fₑ + (½ λ (J² − 1) − μ) Fₑ⁻ᵀ
/// assert!((stress - 1.1_f64.powi(2) * expected).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("swelling", "growth", "eigenstrain"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct GivenGrowth<L> {
    pub(crate) elastic: L,
}

impl<L: Hyperelastic> GivenGrowth<L> {
    /// Of the elastic law.
    #[must_use]
    pub const fn new(law: L) -> Self {
        Self { elastic: law }
    }
}

/// Refuses what is not below its limit.
fn check_limit(law: &'static str, quantity: &'static str, value: f64, limit: f64) -> Result<(), SolidsError> {
    if value < limit { Ok(()) } else { Err(SolidsError::BeyondLimit { law, quantity, value, limit }) }
}

impl<L: Hyperelastic> Evolution<9, 0> for GivenGrowth<L> {
    fn initial(&self) -> [f64; 9] {
        flow::virgin()
    }

    fn residual<T: Real>(&self, _from: &[T; 9], _gradient: &Rows<T>, _unknowns: &[T; 0], _dt: f64) -> [T; 0] {
        []
    }

    fn updated<T: Real>(&self, from: &[T; 9], _gradient: &Rows<T>, _unknowns: &[T; 0], _dt: f64) -> [T; 9] {
        *from
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 9]) -> Rows<T> {
        let (inverse, volume) = inverse_and_determinant(flow::inelastic(state));
        let stress = self.elastic.first_piola(&DeformationGradient::trusted(product(*gradient, inverse)));
        scaled(product_transposed(rows_of(&stress.0), inverse), volume)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 9]) -> Result<(), SolidsError> {
        let growth = flow::inelastic(state);
        check_limit("given growth", "−det G", -determinant(growth), 0.0)?;
        let (inverse, _) = inverse_and_determinant(growth);
        self.elastic.check(&DeformationGradient::trusted(product(*gradient, inverse)))
    }
}

/// An elastic law with thermal expansion, whose temperature the user writes into the state before each increment.
///
/// ```text
/// P = ϑ² Pₑ(F/ϑ),   ϑ = e^(α (θ − θ₀))
/// ```
/// The one internal variable is θ, K; the law returns it as it is. It starts at θ₀. [`Grown::heated`](crate::Grown::heated) is the same with
/// one temperature for all points.
///
/// # Errors
/// An update refuses ϑ that is zero or not finite.
///
/// # Example
/// A bar that cannot expand is heated by 100 K.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{InelasticPoint, StepControl, Thermal, ThermalExpansion};
/// use piola_solids::NeoHookeanCiarlet;
/// let expansion = ThermalExpansion { coefficient: 1e-6, reference_temperature: 300.0 };
/// let law = Thermal::new(NeoHookeanCiarlet::with_constants(1.0, 2.0)?, expansion)?;
/// let held = DeformationGradient::identity();
/// let hot = InelasticPoint::with_state(&law, &[400.0], &held)?;
/// let stress = hot.trial(&held, 1.0, &StepControl::one_step())?.first_piola.0[(0, 0)];
/// assert!((stress + 8e-4).abs() < 1e-6); // −(3 λ + 2 μ) α Δθ
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("thermoelasticity", "thermal expansion"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Thermal<L> {
    pub(crate) elastic: L,
    expansion: ThermalExpansion,
}

impl<L: Hyperelastic> Thermal<L> {
    /// Of the elastic law and its expansion.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`].
    pub fn new(law: L, expansion: ThermalExpansion) -> Result<Self, InelasticError> {
        check_finite("thermal expansion", &[expansion.coefficient, expansion.reference_temperature])?;
        Ok(Self { elastic: law, expansion })
    }

    fn stretch<T: Real>(&self, temperature: T) -> T {
        let ThermalExpansion { coefficient, reference_temperature } = self.expansion;
        (T::lit(coefficient) * (temperature - T::lit(reference_temperature))).exp()
    }
}

impl<L: Hyperelastic> Evolution<1, 0> for Thermal<L> {
    fn initial(&self) -> [f64; 1] {
        [self.expansion.reference_temperature]
    }

    fn residual<T: Real>(&self, _from: &[T; 1], _gradient: &Rows<T>, _unknowns: &[T; 0], _dt: f64) -> [T; 0] {
        []
    }

    fn updated<T: Real>(&self, from: &[T; 1], _gradient: &Rows<T>, _unknowns: &[T; 0], _dt: f64) -> [T; 1] {
        *from
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 1]) -> Rows<T> {
        let stretch = self.stretch(state[0]);
        let stress = self.elastic.first_piola(&DeformationGradient::trusted(scaled(*gradient, stretch.recip())));
        scaled(rows_of(&stress.0), stretch * stretch)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 1]) -> Result<(), SolidsError> {
        let stretch = self.stretch(state[0]);
        check_limit("thermal expansion", "ϑ", stretch, f64::MAX)?;
        check_limit("thermal expansion", "1/ϑ", stretch.recip(), f64::MAX)?;
        self.elastic.check(&DeformationGradient::trusted(scaled(*gradient, stretch.recip())))
    }
}
