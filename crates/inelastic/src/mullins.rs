//! Mullins' effect by Ogden and Roxburgh.

use piola_continuum::DeformationGradient;
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Mask, Real};
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, scaled};

use crate::error::check_bound;
use crate::{Evolution, InelasticError};

/// Rubber that is softer when it is unloaded and loaded again: pseudo-elasticity of Ogden and Roxburgh.
///
/// ```text
/// P = η P₀(F)        η = 1 − erf((W̄ − W₀(F))/(m + β W̄))/r        W̄ = the largest W₀ so far
/// ```
/// Independent of the rate. The internal variable is W̄. On the primary path η = 1.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | r | `softening` | – | 1 ≤ r |
/// | m | `energy` | J/m³ | 0 < m |
/// | β | `share` | – | 0 ≤ β |
///
/// # Accuracy
/// A few ulp of P₀.
///
/// # Example
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{StepControl, InelasticPoint, Mullins};
/// use piola_solids::{Hyperelastic, NeoHookeanCiarlet};
/// let rubber = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let law = Mullins::new(rubber, 2.0, 0.5, 0.0)?;
/// let mut point = InelasticPoint::new(&law);
/// let (far, near) = (DeformationGradient::simple_shear(1.0)?, DeformationGradient::simple_shear(0.5)?);
/// let first = point.advance(&near, 1.0, &StepControl::default())?.first_piola.0[(0, 1)];
/// point.advance(&far, 1.0, &StepControl::default())?;
/// let second = point.advance(&near, 1.0, &StepControl::default())?.first_piola.0[(0, 1)];
/// assert_eq!(first, 0.5); // μ k
/// assert!((second / first - (1.0 - 0.711_155_633_653_515_1 / 2.0)).abs() < 1e-14); // 1 − erf((½ − ⅛)/½)/2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. W. Ogden and D. G. Roxburgh, Proc. R. Soc. Lond. A 455 (1999) 2861–2877.
#[doc(alias("damage", "stress softening", "pseudo-elasticity"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Mullins<L> {
    pub(crate) elastic: L,
    softening: f64,
    energy: f64,
    share: f64,
}

const LAW: &str = "Ogden–Roxburgh";

impl<L> Mullins<L> {
    /// Of the primary law, r, m and β.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn new(law: L, softening: f64, energy: f64, share: f64) -> Result<Self, InelasticError> {
        check_bound(LAW, "softening", softening, "1 ≤ r", 1.0 <= softening)?;
        check_bound(LAW, "energy", energy, "0 < m", 0.0 < energy)?;
        check_bound(LAW, "share", share, "0 ≤ β", 0.0 <= share)?;
        Ok(Self { elastic: law, softening, energy, share })
    }
}

/// erf x of 0 ≤ x, by e^(−x²) Σ 2ᵏ x²ᵏ⁺¹/(2k + 1)!!, whose terms are positive.
fn error_function<T: Real>(x: T) -> T {
    let square = x * x;
    let mut term = x;
    let mut sum = x;
    for k in 1..=TERMS {
        term = term * square * T::lit(2.0 / f64::from(2 * k + 1));
        sum += term;
    }
    let value = T::lit(core::f64::consts::FRAC_2_SQRT_PI) * ((-square).exp() * sum);
    T::select(x.less_than(T::lit(FAR)), value, T::one())
}

/// Beyond it 1 − erf is less than half an ulp.
const FAR: f64 = 6.0;
/// Terms after which nothing is left at x = 6.
const TERMS: i32 = 130;

impl<L: Hyperelastic> Evolution<1, 0> for Mullins<L> {
    fn initial(&self) -> [f64; 1] {
        [0.0]
    }

    fn residual<T: Real>(&self, _from: &[T; 1], _gradient: &Rows<T>, _unknowns: &[T; 0], _dt: f64) -> [T; 0] {
        []
    }

    fn updated<T: Real>(&self, from: &[T; 1], gradient: &Rows<T>, _unknowns: &[T; 0], _dt: f64) -> [T; 1] {
        let energy = self.elastic.energy(&DeformationGradient::trusted(*gradient));
        [T::select(from[0].less_than(energy), energy, from[0])]
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 1]) -> Rows<T> {
        let (energy, stress) = self.elastic.energy_and_first_piola(&DeformationGradient::trusted(*gradient));
        let below = state[0] - energy;
        // On the primary path the softening is 1, and so is it along its derivative.
        let unloaded = T::zero().less_than(below);
        if !unloaded.any() {
            return rows_of(&stress.0);
        }
        let argument = below / (T::lit(self.energy) + T::lit(self.share) * state[0]);
        let eta = T::one() - error_function(T::select(unloaded, argument, T::zero())) * T::lit(1.0 / self.softening);
        scaled(rows_of(&stress.0), eta)
    }

    fn check(&self, gradient: &Rows<f64>, _state: &[f64; 1]) -> Result<(), SolidsError> {
        self.elastic.check(&DeformationGradient::trusted(*gradient))
    }
}
