//! Family 1 in motion: a block bent to a sector of a tube.

use piola_numerics::{Jet, Real};

use super::MovingFamily;
use super::cylinder::MovingCylinder;
use super::moving::{NamedCondition, all_hold, check_conditions, check_jets};
use crate::SolutionsError;
use crate::error::check_finite;
use crate::families::BlockBending;

/// B, C, D, E of family 1 as functions of time.
///
/// # Example
/// See [`MovingBlock`].
pub trait BlockHistory {
    /// (B, C, D, E), in rad/m, rad/m, 1, 1, with B E ≠ C D.
    #[must_use]
    fn constants<T: Real>(&self, t: T) -> [T; 4];
}

/// Family 1 with constants that depend on time.
///
/// ```text
/// r = √(2 A X)      θ = B Y + C Z      z = D Y + E Z      A = 1/(B E − C D)
/// potential  ⇔  B Ċ = C Ḃ,   B C̈ = C B̈,   (A B Ḃ)˙ = 0,   (A C Ċ)˙ = 0,   D Ë = E D̈
/// ζ = −½ (½ γ − ¼ α²) r² + ½ β² r² θ² − ½ ε z²
/// α = Ȧ/A      γ = Ä/A      β = A (E Ḃ − D Ċ)      ε = A (B Ë − C D̈)
/// ```
/// The conditions say that the vorticity of each particle, A Ḃ (B, C) about the axis and E Ḋ − D Ė along r, is constant in
/// time: the ratio of B and C is constant, and so are A B Ḃ, A C Ċ and E Ḋ − D Ė.
///
/// | symbol | unit |
/// |---|---|
/// | α, β | 1/s |
/// | γ, ε | 1/s² |
/// | ζ | m²/s² |
///
/// # Example
/// A block is bent with A = 1 m, B = √(1 + t) rad/m: B Ḃ = ½ is constant, and β = Ḃ/B = ½/(1 + t).
/// ```
/// use piola_numerics::Real;
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::dynamics::{BlockHistory, MovingBlock, MovingFamily};
/// use piola_solutions::families::Datum;
/// struct Bent;
/// impl BlockHistory for Bent {
///     fn constants<T: Real>(&self, t: T) -> [T; 4] {
///         let b = (T::lit(1.0) + t).sqrt();
///         [b, T::zero(), T::zero(), b.recip()]
///     }
/// }
/// let bent = MovingBlock { history: Bent };
/// assert!(bent.has_potential(0.0)?);
/// // At t = 0 the particle X = ½ m, Y = 1 m is at r = 1 m, θ = 1: a_r = −r θ̇² = −¼, a_θ = r B̈ Y = −¼ m/s².
/// let particle = [0.5, 1.0, 0.0];
/// let acceleration = bent.acceleration(particle, 0.0)?;
/// assert!((acceleration[0] + 0.25).abs() < 1e-15 && (acceleration[1] + 0.25).abs() < 1e-15);
/// let left = bent.momentum_residual(&NeoHookean::new(3.0)?, 2.0, &Datum::free_at(particle), particle, 0.0)?;
/// assert!(left.relative() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25, family 1, by the reasoning of W(25.30–25.39); C. Truesdell, Arch. Rational Mech. Anal. 11 (1962) 106.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingBlock<H> {
    /// B, C, D, E as functions of time.
    pub history: H,
}

impl<H: BlockHistory> MovingBlock<H> {
    /// The constants with their rates.
    fn cylinder(&self, t: f64) -> Result<MovingCylinder, SolutionsError> {
        check_finite("t", &[t])?;
        let block = self.history.constants(Jet::<f64, 0>::time(t));
        check_jets(&block)?;
        self.at(t)?;
        let [b, c, d, e] = block;
        Ok(MovingCylinder { a: (b * e - c * d).recip(), offset: Jet::constant(0.0), block })
    }

    /// The conditions of the type, each as left side less right with its scale: all zero where the acceleration has a potential.
    ///
    /// | condition | unit |
    /// |---|---|
    /// | `B Ċ = C Ḃ` | rad²/(m² s) |
    /// | `B C̈ = C B̈` | rad²/(m² s²) |
    /// | `(A B Ḃ)˙ = 0`, `(A C Ċ)˙ = 0` | rad²/(m s²) |
    /// | `D Ë = E D̈` | 1/s² |
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] where B E = C D.
    pub fn potential_conditions(&self, t: f64) -> Result<[NamedCondition; 5], SolutionsError> {
        let names = ["B Ċ = C Ḃ", "B C̈ = C B̈", "(A B Ḃ)˙ = 0", "(A C Ċ)˙ = 0", "D Ë = E D̈"];
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

impl<H: BlockHistory> MovingFamily for MovingBlock<H> {
    type Family = BlockBending;

    fn place<T: Real>(&self, [x, y, z]: [T; 3], t: T) -> [T; 3] {
        let [b, c, d, e] = self.history.constants(t);
        let a = (b * e - c * d).recip();
        [(T::lit(2.0) * a * x).sqrt(), b * y + c * z, d * y + e * z]
    }

    fn at(&self, t: f64) -> Result<BlockBending, SolutionsError> {
        check_finite("t", &[t])?;
        BlockBending::isochoric(self.history.constants(t))
    }

    fn potential<T: Real>(&self, place: [T; 3], t: f64) -> Result<T, SolutionsError> {
        check_conditions(&self.potential_conditions(t)?, t)?;
        Ok(self.cylinder(t)?.potential(place))
    }
}
