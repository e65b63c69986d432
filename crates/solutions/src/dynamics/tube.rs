//! Family 3 in motion: a tube that is inflated and stretched.

use piola_numerics::{Jet, Real};

use super::MovingFamily;
use crate::SolutionsError;
use crate::error::{check_bound, check_finite};
use crate::families::TubeDeformation;

/// B and F of family 3 as functions of time.
///
/// # Example
/// See [`MovingTube`].
pub trait TubeHistory {
    /// (B, F), in m² and 1, with F ≠ 0.
    #[must_use]
    fn constants<T: Real>(&self, t: T) -> [T; 2];
}

/// Family 3 without shear and twist, r = √(R²/F + B), θ = Θ, z = F Z, with B and F that depend on time.
///
/// ```text
/// ζ = −(½ γ − ¼ α²) ½ r² − ½ (δ − α β) ln r − β²/(8 r²) − ½ (F̈/F) z²
/// A = 1/F      α = Ȧ/A      γ = Ä/A      β = Ḃ − α B      δ = B̈ − γ B
/// ```
/// A constant F leaves ζ = −½ B̈ ln r − Ḃ²/(8 r²): radial oscillation.
///
/// # Example
/// ```
/// use piola_numerics::Real;
/// use piola_solutions::dynamics::{MovingFamily, MovingTube, TubeHistory};
/// struct Widening;
/// impl TubeHistory for Widening {
///     fn constants<T: Real>(&self, t: T) -> [T; 2] {
///         [T::lit(3.0) * t * t, T::lit(1.0)]
///     }
/// }
/// // r² = 1 + 3 t²: at t = 1, r = 2, ṙ = 3/2, r̈ = 3/2 − 9/8.
/// let widening = MovingTube { history: Widening };
/// assert!((widening.acceleration([1.0, 0.5, 0.0], 1.0)?[0] - 0.375).abs() < 1e-15);
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W §25; J. K. Knowles, Q. Appl. Math. 18 (1960) 71.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingTube<H> {
    /// B and F as functions of time.
    pub history: H,
}

impl<H: TubeHistory> MovingFamily for MovingTube<H> {
    type Family = TubeDeformation;

    fn place<T: Real>(&self, [r, theta, z]: [T; 3], t: T) -> [T; 3] {
        let [b, f] = self.history.constants(t);
        [(r * r / f + b).sqrt(), theta, f * z]
    }

    fn at(&self, t: f64) -> Result<TubeDeformation, SolutionsError> {
        check_finite("t", &[t])?;
        let [b, f] = self.history.constants(t);
        TubeDeformation::isochoric([b, 1.0, 0.0, 0.0, f])
    }

    fn potential<T: Real>(&self, [r, _, z]: [T; 3], t: f64) -> Result<T, SolutionsError> {
        check_finite("t", &[t])?;
        let [b, f] = self.history.constants(Jet::<f64, 0>::time(t));
        check_finite("constants", &[b.value, b.rate, b.second_rate, f.value, f.rate, f.second_rate])?;
        check_bound("F", f.value, "F ≠ 0", 0.0 < f.value.abs())?;
        let a = f.recip();
        let (alpha, gamma) = (a.rate / a.value, a.second_rate / a.value);
        let (beta, delta) = (b.rate - alpha * b.value, b.second_rate - gamma * b.value);
        let square = r * r;
        let radial = T::lit(0.25 * gamma - 0.125 * alpha * alpha) * square
            + T::lit(0.5 * (delta - alpha * beta)) * r.ln()
            + T::lit(0.125 * beta * beta) / square;
        Ok(-radial - T::lit(0.5 * f.second_rate / f.value) * z * z)
    }
}
