//! Family 4 in motion: a sphere that is inflated.

use piola_numerics::{Jet, Real};

use super::MovingFamily;
use crate::SolutionsError;
use crate::error::check_finite;
use crate::families::{Orientation, SphereDeformation};

/// A of family 4 as a function of time.
///
/// # Example
/// See [`AsMovingMotion`](super::AsMovingMotion).
pub trait SphereHistory {
    /// A, m³.
    #[must_use]
    fn constant<T: Real>(&self, t: T) -> T;
}

/// Family 4, r = ∛(±R³ + A), with A that depends on time.
///
/// ```text
/// r̈ = Ä/(3 r²) − 2 Ȧ²/(9 r⁵)        ζ = Ä/(3 r) − Ȧ²/(18 r⁴)
/// ```
/// # Example
/// See [`AsMovingMotion`](super::AsMovingMotion).
///
/// # Source
/// W §25; Z.-H. Guo and R. Solecki, Arch. Mech. Stos. 15 (1963) 427.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingSphere<H> {
    /// The signs.
    pub orientation: Orientation,
    /// A as a function of time.
    pub history: H,
}

impl<H: SphereHistory> MovingFamily for MovingSphere<H> {
    type Family = SphereDeformation;

    fn place<T: Real>(&self, [r, theta, phi]: [T; 3], t: T) -> [T; 3] {
        let sign = T::lit(self.orientation.sign());
        [(sign * r * r * r + self.history.constant(t)).cbrt(), sign * theta, phi]
    }

    fn at(&self, t: f64) -> Result<SphereDeformation, SolutionsError> {
        check_finite("t", &[t])?;
        SphereDeformation::new(self.orientation, self.history.constant(t))
    }

    fn potential<T: Real>(&self, [r, _, _]: [T; 3], t: f64) -> Result<T, SolutionsError> {
        check_finite("t", &[t])?;
        let a = self.history.constant(Jet::<f64, 0>::time(t));
        check_finite("A", &[a.value, a.rate, a.second_rate])?;
        let square = r * r;
        Ok(T::lit(a.second_rate / 3.0) / r - T::lit(a.rate * a.rate / 18.0) / (square * square))
    }
}
