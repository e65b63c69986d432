//! Family 2 in motion: a sector straightened to a block that is stretched and sheared.

use piola_fields::Residual;
use piola_numerics::{Jet, Real};

use super::MovingFamily;
use super::moving::{NamedCondition, all_hold, check_conditions, check_jets, sum};
use crate::SolutionsError;
use crate::error::check_finite;
use crate::families::SectorStraightening;

/// B, C, D, E of family 2 as functions of time.
///
/// # Example
/// See [`MovingSector`].
pub trait SectorHistory {
    /// (B, C, D, E), in m/rad, 1, m/rad, 1, with B E ≠ C D.
    #[must_use]
    fn constants<T: Real>(&self, t: T) -> [T; 4];
}

/// Family 2 with constants that depend on time.
///
/// ```text
/// x = ½ A R²      y = B Θ + C Z      z = D Θ + E Z      A = 1/(B E − C D)
/// a = G x,   G = diag(Ä/A, M̈ M⁻¹),   M = [B C; D E]
/// potential  ⇔  B C̈ − C B̈ = E D̈ − D Ë        W(25.35)
///            ⇔  B Ċ − C Ḃ = E Ḋ − D Ė + k      W(25.36)
/// ζ = −½ x·G x                                  W(25.39)
/// ```
/// # Example
/// ```
/// use piola_numerics::Real;
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::dynamics::{MovingFamily, MovingSector, SectorHistory};
/// use piola_solutions::families::Datum;
/// /// The block is drawn out along y.
/// struct Drawn;
/// impl SectorHistory for Drawn {
///     fn constants<T: Real>(&self, t: T) -> [T; 4] {
///         [T::lit(1.0) + t * t, T::zero(), T::zero(), T::lit(1.0)]
///     }
/// }
/// let drawn = MovingSector { history: Drawn };
/// assert!(drawn.has_potential(1.0)?);
/// let particle = [1.0, 0.5, 0.0];
/// assert_eq!(drawn.acceleration(particle, 1.0)?[1], 1.0); // B̈ Θ
/// let left = drawn.momentum_residual(&NeoHookean::new(3.0)?, 2.0, &Datum::free_at(particle), particle, 1.0)?;
/// assert!(left.relative() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(25.35–25.39).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingSector<H> {
    /// B, C, D, E as functions of time.
    pub history: H,
}

impl<H: SectorHistory> MovingSector<H> {
    fn jets(&self, t: f64) -> Result<[Jet<f64, 0>; 4], SolutionsError> {
        check_finite("t", &[t])?;
        let jets = self.history.constants(Jet::<f64, 0>::time(t));
        check_jets(&jets)?;
        Ok(jets)
    }

    /// B C̈ − C B̈ − (E D̈ − D Ë), m²/(rad s²), with its scale: zero where the acceleration has a potential, W(25.35).
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`].
    pub fn potential_condition(&self, t: f64) -> Result<Residual, SolutionsError> {
        let [b, c, d, e] = self.jets(t)?;
        let terms =
            [b.value * c.second_rate, -(c.value * b.second_rate), -(e.value * d.second_rate), d.value * e.second_rate];
        Ok(sum(&terms))
    }

    /// k = B Ċ − C Ḃ − (E Ḋ − D Ė), m²/(rad s): constant in time where the acceleration always has a potential, W(25.36).
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`].
    pub fn first_integral(&self, t: f64) -> Result<f64, SolutionsError> {
        let [b, c, d, e] = self.jets(t)?;
        Ok((b.value * c.rate - c.value * b.rate) - (e.value * d.rate - d.value * e.rate))
    }

    /// Whether the acceleration has a potential at a time, to 1e-12 of the terms of W(25.35).
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`].
    pub fn has_potential(&self, t: f64) -> Result<bool, SolutionsError> {
        Ok(all_hold(&[self.named_condition(t)?]))
    }

    fn named_condition(&self, t: f64) -> Result<NamedCondition, SolutionsError> {
        Ok(("B C̈ − C B̈ = E D̈ − D Ë", self.potential_condition(t)?))
    }

    /// grad a = diag(Ä/A, M̈ M⁻¹), 1/s², by rows.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] where B E = C D.
    pub fn acceleration_gradient(&self, t: f64) -> Result<[[f64; 3]; 3], SolutionsError> {
        let [b, c, d, e] = self.jets(t)?;
        self.at(t)?;
        let a = (b * e - c * d).recip();
        let (b2, c2, d2, e2) = (b.second_rate, c.second_rate, d.second_rate, e.second_rate);
        let (b, c, d, e) = (b.value, c.value, d.value, e.value);
        Ok([
            [a.second_rate / a.value, 0.0, 0.0],
            [0.0, (b2 * e - c2 * d) * a.value, (c2 * b - b2 * c) * a.value],
            [0.0, (d2 * e - e2 * d) * a.value, (e2 * b - d2 * c) * a.value],
        ])
    }
}

impl<H: SectorHistory> MovingFamily for MovingSector<H> {
    type Family = SectorStraightening;

    fn place<T: Real>(&self, [r, theta, z]: [T; 3], t: T) -> [T; 3] {
        let [b, c, d, e] = self.history.constants(t);
        let a = (b * e - c * d).recip();
        [T::lit(0.5) * a * r * r, b * theta + c * z, d * theta + e * z]
    }

    fn at(&self, t: f64) -> Result<SectorStraightening, SolutionsError> {
        check_finite("t", &[t])?;
        SectorStraightening::isochoric(self.history.constants(t))
    }

    fn potential<T: Real>(&self, [x, y, z]: [T; 3], t: f64) -> Result<T, SolutionsError> {
        check_conditions(&[self.named_condition(t)?], t)?;
        let g = self.acceleration_gradient(t)?.map(|row| row.map(T::lit));
        let across = T::lit(0.5) * (g[1][2] + g[2][1]);
        let square = g[0][0] * x * x + g[1][1] * y * y + g[2][2] * z * z;
        Ok(T::lit(-0.5) * square - across * y * z)
    }
}
