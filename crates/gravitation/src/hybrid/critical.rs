//! The distances within which two planets move together.

use super::paths::{dot, length};
use crate::check::{check_finite, check_length};
use crate::{Gravitation, GravitationError};

/// Least critical radius, in distances that a planet travels in one step.
const STEPS: f64 = 0.4;

/// Critical radius of each body, m: `hill_radii` Hill radii, but at least the distance that the body travels in 0.4 steps.
///
/// ```text
/// Rᵢ = max(k aᵢ (mᵢ/(3m₀))^(1/3), 0.4 h √(Gm₀/aᵢ), 0.4 h |vᵢ − v₀|)        R₀ = 0
/// ```
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | k | `hill_radii`; three suffice for most systems | – |
/// | h | `step` | s |
/// | aᵢ | semi-major axis, or the distance from the central body where the orbit is open | m |
///
/// # Errors
/// [`GravitationError::WrongLength`] and [`GravitationError::NotFinite`] of the state, [`GravitationError::MasslessCentre`], and
/// [`GravitationError::InvalidRadius`] unless `hill_radii`, `step` and every radius are 0 ≤ x < ∞. [`GravitationError::CoincidentBodies`] of a body and
/// the central one.
///
/// # Example
/// ```
/// use piola_gravitation::Gravitation;
/// use piola_gravitation::hybrid::critical_radii;
/// // A planet of 3 × 10⁻³ of the central mass on a circle of radius 1: its Hill radius is a tenth.
/// let bodies = Gravitation::new(vec![1.0, 3e-3])?;
/// let start = bodies.state(&[[0.0; 3], [1.0, 0.0, 0.0]], &[[0.0; 3], [0.0, 1.0, 0.0]])?;
/// let radii = critical_radii(&bodies, &start, 3.0, 0.1)?;
/// assert!((radii[1] - 0.3).abs() < 1e-15);
/// # Ok::<(), piola_gravitation::GravitationError>(())
/// ```
///
/// # Source
/// J. E. Chambers, MNRAS 304 (1999) 793.
pub fn critical_radii(
    bodies: &Gravitation,
    state: &[f64],
    hill_radii: f64,
    step: f64,
) -> Result<Vec<f64>, GravitationError> {
    check_length("state", 6 * bodies.bodies(), state.len())?;
    check_finite("state", state)?;
    let Some(&mu) = bodies.parameters().first().filter(|&&centre| 0.0 < centre) else {
        return Err(GravitationError::MasslessCentre { body: 0 });
    };
    for (quantity, value) in [("hill radii", hill_radii), ("step", step)] {
        check_radii(quantity, &[value])?;
    }
    let (centre, velocity) = (bodies.position(state, 0), bodies.velocity(state, 0));
    let mut radii = vec![0.0];
    for (body, &parameter) in bodies.parameters().iter().enumerate().skip(1) {
        let (x, v) = (bodies.position(state, body), bodies.velocity(state, body));
        let r = length([0, 1, 2].map(|axis| x[axis] - centre[axis]));
        if r <= 0.0 {
            return Err(GravitationError::CoincidentBodies { first: 0, second: body });
        }
        let relative = [0, 1, 2].map(|axis| v[axis] - velocity[axis]);
        let square = dot(relative, relative);
        let inverse = 2.0 / r - square / mu;
        let axis = if 0.0 < inverse { inverse.recip() } else { r };
        let hill = axis * (parameter / (3.0 * mu)).cbrt();
        let way = step * (mu / axis).sqrt().max(square.sqrt());
        radii.push((hill_radii * hill).max(STEPS * way));
    }
    check_radii("critical radii", &radii)?;
    Ok(radii)
}

/// Critical radii, radii and least distance, by body, the central one first.
#[derive(Clone, Debug)]
pub(super) struct Sizes {
    pub(super) critical: Vec<f64>,
    /// Radii of the bodies, m; none where collisions are not looked for.
    pub(super) radii: Vec<f64>,
    /// The least distance from the central body, m.
    pub(super) least: f64,
}

impl Sizes {
    /// The critical radius of two planets, m.
    pub(super) fn critical(&self, first: usize, second: usize) -> f64 {
        self.critical[first + 1].max(self.critical[second + 1])
    }

    /// Whether passages near the central body are to be refused.
    pub(super) fn watch_the_centre(&self) -> bool {
        !self.radii.is_empty() || 0.0 < self.least
    }

    /// Why a body is too near the central one at a distance, m.
    pub(super) fn too_near(&self, body: usize, distance: f64) -> Option<GravitationError> {
        let (contact, least) = (self.contact(0, body), self.least);
        if distance < contact {
            Some(GravitationError::Collision { first: 0, second: body, distance, contact })
        } else if distance < least {
            Some(GravitationError::NearCentre { body, distance, least })
        } else {
            None
        }
    }

    /// The distance at which two bodies touch, m.
    pub(super) fn contact(&self, first: usize, second: usize) -> f64 {
        if self.radii.is_empty() { 0.0 } else { self.radii[first] + self.radii[second] }
    }
}

pub(super) fn check_radii(quantity: &'static str, radii: &[f64]) -> Result<(), GravitationError> {
    for (body, &value) in radii.iter().enumerate() {
        if !(0.0 <= value && value < f64::INFINITY) {
            return Err(GravitationError::InvalidRadius { quantity, body, value });
        }
    }
    Ok(())
}
