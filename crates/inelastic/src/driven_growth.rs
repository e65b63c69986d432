//! Isotropic growth that the stress drives.

use piola_continuum::DeformationGradient;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, scaled};

use crate::error::check_bound;
use crate::{Evolution, InelasticError, flow};

/// A tissue that grows where it is pulled, up to a limit (Lubarda and Hoger).
///
/// ```text
/// G = ϑ 1        ϑ̇ = k ((ϑ⁺ − ϑ)/(ϑ⁺ − 1))^γ tr M for 0 < tr M,   k ((ϑ − ϑ⁻)/(1 − ϑ⁻))^γ tr M otherwise
/// ```
/// M = Cₑ Sₑ. The internal variable is ϑ.
///
/// | symbol | field | unit | bounds |
/// |---|---|---|---|
/// | k | `rate` | 1/(Pa s) | 0 < k |
/// | ϑ⁻, ϑ⁺ | `bounds` | – | 0 < ϑ⁻ < 1 < ϑ⁺ |
/// | γ | `exponent` | – | 1 ≤ γ |
///
/// # Accuracy
/// That of the [`StepControl`](crate::StepControl).
///
/// # Example
/// A stretched ball grows until it has no stress.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{StepControl, DrivenGrowth, InelasticPoint};
/// use piola_solids::NeoHookeanCiarlet;
/// let law = DrivenGrowth::new(NeoHookeanCiarlet::with_constants(1.0, 2.0)?, 1.0, [0.5, 2.0], 1.0)?;
/// let mut point = InelasticPoint::new(&law);
/// let grown = point.advance(&DeformationGradient::dilatation(1.1)?, 100.0, &StepControl::one_step())?;
/// assert!((grown.state[0] - 1.1).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// V. A. Lubarda and A. Hoger, Int. J. Solids Structures 39 (2002) 4627–4664.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DrivenGrowth<L> {
    pub(crate) elastic: L,
    rate: f64,
    bounds: [f64; 2],
    exponent: f64,
}

const LAW: &str = "driven growth";

impl<L> DrivenGrowth<L> {
    /// Of the elastic law, k, (ϑ⁻, ϑ⁺) and γ.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn new(law: L, rate: f64, bounds: [f64; 2], exponent: f64) -> Result<Self, InelasticError> {
        check_bound(LAW, "rate", rate, "0 < k", 0.0 < rate)?;
        check_bound(LAW, "bounds", bounds[0], "0 < ϑ⁻ < 1", 0.0 < bounds[0] && bounds[0] < 1.0)?;
        check_bound(LAW, "bounds", bounds[1], "1 < ϑ⁺", 1.0 < bounds[1])?;
        check_bound(LAW, "exponent", exponent, "1 ≤ γ", 1.0 <= exponent)?;
        Ok(Self { elastic: law, rate, bounds, exponent })
    }
}

impl<L: Hyperelastic> Evolution<1, 1> for DrivenGrowth<L> {
    fn initial(&self) -> [f64; 1] {
        [1.0]
    }

    fn residual<T: Real>(&self, from: &[T; 1], gradient: &Rows<T>, unknowns: &[T; 1], dt: f64) -> [T; 1] {
        let growth = from[0] + unknowns[0];
        let trace = flow::mandel(&self.elastic, &scaled(*gradient, growth.recip())).trace();
        let [low, high] = self.bounds;
        let grows = T::zero().less_than(trace);
        let growing = (T::lit(high) - growth) * T::lit(1.0 / (high - 1.0));
        let shrinking = (growth - T::lit(low)) * T::lit(1.0 / (1.0 - low));
        let left = T::select(grows, growing, shrinking).powf(T::lit(self.exponent));
        [unknowns[0] - T::lit(dt * self.rate) * left * trace]
    }

    fn updated<T: Real>(&self, from: &[T; 1], _gradient: &Rows<T>, unknowns: &[T; 1], _dt: f64) -> [T; 1] {
        [from[0] + unknowns[0]]
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 1]) -> Rows<T> {
        let growth = state[0];
        let stress = self.elastic.first_piola(&DeformationGradient::trusted(scaled(*gradient, growth.recip())));
        // det G/ϑ = ϑ².
        scaled(rows_of(&stress.0), growth * growth)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 1]) -> Result<(), SolidsError> {
        self.elastic.check(&DeformationGradient::trusted(scaled(*gradient, state[0].recip())))
    }
}
