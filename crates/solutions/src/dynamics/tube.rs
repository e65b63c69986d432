//! Family 3 in motion: a tube that is inflated, stretched and twisted.

use piola_numerics::{Jet, Real};

use super::MovingFamily;
use super::cylinder::MovingCylinder;
use super::moving::{NamedCondition, all_hold, check_conditions, check_jets};
use crate::SolutionsError;
use crate::error::check_finite;
use crate::families::TubeDeformation;

/// B, C, D, E, F of family 3 as functions of time.
///
/// # Example
/// See [`MovingTube`].
pub trait TubeHistory {
    /// (B, C, D, E, F), in m², 1, rad/m, m/rad, 1, with C F ≠ D E. A tube that is inflated and stretched has (B, 1, 0, 0, F).
    #[must_use]
    fn constants<T: Real>(&self, t: T) -> [T; 5];
}

/// Family 3 with constants that depend on time.
///
/// ```text
/// r = √(A R² + B)      θ = C Θ + D Z      z = E Θ + F Z      A = 1/(C F − D E)
/// potential  ⇔  C Ḋ = D Ċ,   C D̈ = D C̈,   (A C Ċ)˙ = 0,   (A D Ḋ)˙ = 0,   E F̈ = F Ë
/// ζ = −(¼ γ − ⅛ α²) r² − ½ κ̇ ln r − κ²/(8 r²) + ½ β (β r² − κ) θ² − ½ ε z²
/// α = Ȧ/A      γ = Ä/A      κ = Ḃ − α B      β = A (F Ċ − E Ḋ)      ε = A (C F̈ − D Ë)
/// ```
/// Where C is constant, B and the stretch F may change in any way, the twist D may not: torsional oscillations are not universal. Constant C, D, E, F leave
/// ζ = −½ B̈ ln r − Ḃ²/(8 r²): radial oscillation. A potential that depends on θ, β ≠ 0, is that of a sector.
///
/// | symbol | unit |
/// |---|---|
/// | α, β | 1/s |
/// | γ, ε | 1/s² |
/// | κ | m²/s |
/// | ζ | m²/s² |
///
/// # Example
/// ```
/// use piola_numerics::Real;
/// use piola_solutions::dynamics::{MovingFamily, MovingTube, TubeHistory};
/// struct Widening;
/// impl TubeHistory for Widening {
///     fn constants<T: Real>(&self, t: T) -> [T; 5] {
///         [T::lit(3.0) * t * t, T::one(), T::zero(), T::zero(), T::one()]
///     }
/// }
/// // r² = 1 + 3 t²: at t = 1, r = 2, ṙ = 3/2, r̈ = 3/2 − 9/8.
/// let widening = MovingTube { history: Widening };
/// assert!((widening.acceleration([1.0, 0.5, 0.0], 1.0)?[0] - 0.375).abs() < 1e-15);
/// # Ok::<(), piola_solutions::SolutionsError>(())
/// ```
///
/// # Source
/// W §25, family 3, by the reasoning of W(25.30–25.39); J. K. Knowles, Q. Appl. Math. 18 (1960) 71.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingTube<H> {
    /// B, C, D, E, F as functions of time.
    pub history: H,
}

impl<H: TubeHistory> MovingTube<H> {
    /// The constants with their rates.
    fn cylinder(&self, t: f64) -> Result<MovingCylinder, SolutionsError> {
        check_finite("t", &[t])?;
        let constants = self.history.constants(Jet::<f64, 0>::time(t));
        check_jets(&constants)?;
        self.at(t)?;
        let [offset, c, d, e, f] = constants;
        Ok(MovingCylinder { a: (c * f - d * e).recip(), offset, block: [c, d, e, f] })
    }

    /// The conditions of the type, each as left side less right with its scale: all zero where the acceleration has a potential.
    ///
    /// | condition | unit |
    /// |---|---|
    /// | `C Ḋ = D Ċ` | rad/(m s) |
    /// | `C D̈ = D C̈` | rad/(m s²) |
    /// | `(A C Ċ)˙ = 0` | 1/s² |
    /// | `(A D Ḋ)˙ = 0` | rad²/(m² s²) |
    /// | `E F̈ = F Ë` | m/(rad s²) |
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] where C F = D E.
    pub fn potential_conditions(&self, t: f64) -> Result<[NamedCondition; 5], SolutionsError> {
        let names = ["C Ḋ = D Ċ", "C D̈ = D C̈", "(A C Ċ)˙ = 0", "(A D Ḋ)˙ = 0", "E F̈ = F Ë"];
        Ok(self.cylinder(t)?.conditions(names))
    }

    /// Whether the acceleration has a potential at a time: each condition holds to 1e-12 of its terms.
    ///
    /// # Errors
    /// As [`potential_conditions`](Self::potential_conditions).
    pub fn has_potential(&self, t: f64) -> Result<bool, SolutionsError> {
        Ok(all_hold(&self.potential_conditions(t)?))
    }
}

impl<H: TubeHistory> MovingFamily for MovingTube<H> {
    type Family = TubeDeformation;

    fn place<T: Real>(&self, [r, theta, z]: [T; 3], t: T) -> [T; 3] {
        let [b, c, d, e, f] = self.history.constants(t);
        let a = (c * f - d * e).recip();
        [(a * r * r + b).sqrt(), c * theta + d * z, e * theta + f * z]
    }

    fn at(&self, t: f64) -> Result<TubeDeformation, SolutionsError> {
        check_finite("t", &[t])?;
        TubeDeformation::isochoric(self.history.constants(t))
    }

    fn potential<T: Real>(&self, place: [T; 3], t: f64) -> Result<T, SolutionsError> {
        check_conditions(&self.potential_conditions(t)?, t)?;
        Ok(self.cylinder(t)?.potential(place))
    }
}
