//! Family 5 in motion: a sector sheared azimuthally.

use piola_numerics::{Jet, Real};

use super::MovingFamily;
use super::moving::{NamedCondition, all_hold, check_conditions, check_jets, sum};
use crate::SolutionsError;
use crate::error::{check_bound, check_finite};
use crate::families::AzimuthalShearing;

/// A, B, C of family 5 as functions of time.
///
/// # Example
/// See [`MovingShear`].
pub trait ShearHistory {
    /// (A, B, C), in 1, rad, 1, with 0 < A and C ≠ 0.
    #[must_use]
    fn constants<T: Real>(&self, t: T) -> [T; 3];
}

/// Family 5 with constants that depend on time.
///
/// ```text
/// r = A R      θ = B ln R + C Θ      z = D Z      D = 1/(A² C)
/// potential  ⇔  Ċ (C Ḃ − B Ċ) = 0,   [A² (C Ḃ − B Ċ)]˙ = 0,   (A² C Ċ)˙ = 0
///            ⇔  C and A² Ḃ are constant, or B/C and A² C Ċ are
/// ζ = −½ α r² + ½ b² r² (l² − l + ½) + ½ c² r² θ² − ½ δ z²
/// α = Ä/A      b = Ḃ − B Ċ/C      c = Ċ/C      δ = D̈/D      l = ln(r/A)
/// ```
/// | symbol | unit |
/// |---|---|
/// | α, δ | 1/s² |
/// | b, c | 1/s |
/// | ζ | m²/s² |
///
/// # Example
/// A sector is sheared at a constant rate: `a_r = −r θ̇²`, θ̇ = ½ ln R.
/// ```
/// use piola_numerics::Real;
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::dynamics::{MovingFamily, MovingShear, ShearHistory};
/// use piola_solutions::families::Datum;
/// struct Sheared;
/// impl ShearHistory for Sheared {
///     fn constants<T: Real>(&self, t: T) -> [T; 3] {
///         [T::lit(1.0), T::lit(0.5) * t, T::lit(1.0)]
///     }
/// }
/// let sheared = MovingShear { history: Sheared };
/// assert!(sheared.has_potential(2.0)?);
/// let particle = [core::f64::consts::E, 0.3, 0.0]; // ln R = 1
/// let acceleration = sheared.acceleration(particle, 2.0)?;
/// assert!((acceleration[0] + 0.25 * particle[0]).abs() < 1e-15);
/// let left = sheared.momentum_residual(&NeoHookean::new(3.0)?, 2.0, &Datum::free_at(particle), particle, 2.0)?;
/// assert!(left.relative() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25, family 5, by the reasoning of W(25.30–25.39).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingShear<H> {
    /// A, B, C as functions of time.
    pub history: H,
}

impl<H: ShearHistory> MovingShear<H> {
    /// A, B, C with their rates.
    fn jets(&self, t: f64) -> Result<[Jet<f64, 0>; 3], SolutionsError> {
        check_finite("t", &[t])?;
        let jets = self.history.constants(Jet::<f64, 0>::time(t));
        check_jets(&jets)?;
        let [a, _, c] = jets;
        check_bound("A", a.value, "0 < A", 0.0 < a.value)?;
        check_bound("C", c.value, "C ≠ 0", 0.0 < c.value.abs())?;
        Ok(jets)
    }

    /// The conditions of the type, each as left side less right with its scale: all zero where the acceleration has a potential.
    ///
    /// | condition | unit |
    /// |---|---|
    /// | `Ċ (C Ḃ − B Ċ) = 0` | rad/s² |
    /// | `[A² (C Ḃ − B Ċ)]˙ = 0` | rad/s² |
    /// | `(A² C Ċ)˙ = 0` | 1/s² |
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] unless 0 < A and C ≠ 0.
    pub fn potential_conditions(&self, t: f64) -> Result<[NamedCondition; 3], SolutionsError> {
        let [a, b, c] = self.jets(t)?;
        let (square, growth) = (a.value * a.value, 2.0 * a.value * a.rate);
        let (forth, back) = (c.value * b.rate, -(b.value * c.rate));
        let shear =
            [growth * forth, growth * back, square * c.value * b.second_rate, -(square * b.value * c.second_rate)];
        let turn = [growth * c.value * c.rate, square * c.rate * c.rate, square * c.value * c.second_rate];
        Ok([
            ("Ċ (C Ḃ − B Ċ) = 0", sum(&[c.rate * forth, c.rate * back])),
            ("[A² (C Ḃ − B Ċ)]˙ = 0", sum(&shear)),
            ("(A² C Ċ)˙ = 0", sum(&turn)),
        ])
    }

    /// Whether the acceleration has a potential at a time: each condition holds to 1e-12 of its terms.
    ///
    /// # Errors
    /// As [`potential_conditions`](Self::potential_conditions).
    pub fn has_potential(&self, t: f64) -> Result<bool, SolutionsError> {
        Ok(all_hold(&self.potential_conditions(t)?))
    }
}

impl<H: ShearHistory> MovingFamily for MovingShear<H> {
    type Family = AzimuthalShearing;

    fn place<T: Real>(&self, [r, theta, z]: [T; 3], t: T) -> [T; 3] {
        let [a, b, c] = self.history.constants(t);
        [a * r, b * r.ln() + c * theta, z / (a * a * c)]
    }

    fn at(&self, t: f64) -> Result<AzimuthalShearing, SolutionsError> {
        check_finite("t", &[t])?;
        AzimuthalShearing::isochoric(self.history.constants(t))
    }

    fn potential<T: Real>(&self, [r, theta, z]: [T; 3], t: f64) -> Result<T, SolutionsError> {
        check_conditions(&self.potential_conditions(t)?, t)?;
        let [a, b, c] = self.jets(t)?;
        let d = (a * a * c).recip();
        let rate_of_turn = c.rate / c.value;
        let rate_of_shear = b.rate - b.value * rate_of_turn;
        let height = (r / T::lit(a.value)).ln();
        let half = T::lit(0.5);
        let shear = T::lit(0.5 * rate_of_shear * rate_of_shear) * (height * height - height + half);
        let turn = T::lit(0.5 * rate_of_turn * rate_of_turn) * theta * theta;
        let radial = shear + turn - T::lit(0.5 * a.second_rate / a.value);
        Ok(radial * r * r - T::lit(0.5 * d.second_rate / d.value) * z * z)
    }
}
