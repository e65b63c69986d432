//! The degree of the map p₀ ↦ q(t₁; p₀): how many more extremals there are of one orientation than of the other.

use super::events::{Event, SearchRegion};
use super::geodetic_distance::{Extremal, GeodeticDistance, Problem, check_events};
use crate::HamiltonianError;
use crate::PhaseFunction;

/// How often a side of the boundary is halved where the miss turns fast; beyond, an extremal lies on it.
const HALVINGS: u32 = 24;

impl Extremal {
    /// The sign of det ∂q₁/∂p₀, which changes at a simple conjugate point.
    #[must_use]
    pub fn orientation(&self) -> i32 {
        orientation((-&self.mixed_hessian).determinant())
    }
}

pub(super) const fn orientation(determinant: f64) -> i32 {
    if 0.0 < determinant {
        1
    } else if determinant < 0.0 {
        -1
    } else {
        0
    }
}

impl<H: PhaseFunction> GeodeticDistance<'_, H> {
    /// The degree of q(t₁; p₀) − q₁ on a search region, from its boundary alone: the sum of the
    /// [orientations](Extremal::orientation) of **all** extremals whose initial momentum lies in the region, found or
    /// not.
    ///
    /// ```text
    /// n = 1:  ½ (sgn at the upper end − sgn at the lower end)
    /// n = 2:  the number of turns of q(t₁; p₀) − q₁ as p₀ goes once around the box
    /// ```
    ///
    /// Sheets that do not add up to it are not all there are; sheets that do can only lack pairs of opposite
    /// orientation. `None` where it is not known: for more than two degrees of freedom, where an extremal lies on the
    /// boundary, where a ray of the boundary ends in a singularity.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`], [`HamiltonJacobiError::EventsAtOneTime`](crate::HamiltonJacobiError::EventsAtOneTime).
    ///
    /// # Accuracy
    /// The boundary is followed in steps in which the miss changes by at most half of itself.
    ///
    /// # Example
    /// Free motion in the plane: one extremal.
    /// ```
    /// use piola_hamiltonian::hamilton_jacobi::{Event, GeodeticDistance, SearchRegion};
    /// use piola_hamiltonian::PhaseFunction;
    /// use piola_numerics::Real;
    /// struct Free; // mass 2
    /// impl PhaseFunction for Free {
    ///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
    ///         T::lit(0.25) * (p[0] * p[0] + p[1] * p[1])
    ///     }
    /// }
    /// let (from, to) = (Event::new(&[0.0, 0.0], 0.0), Event::new(&[1.0, 2.0], 1.0));
    /// let distance = GeodeticDistance::new(&Free);
    /// let region = SearchRegion::new(&[0.0, 0.0], &[5.0, 5.0], 2)?; // p = m q₁/t₁ = (2, 4) lies in it
    /// assert_eq!(distance.degree(&from, &to, &region)?, Some(1));
    /// let elsewhere = SearchRegion::new(&[0.0, 0.0], &[5.0, 3.0], 2)?;
    /// assert_eq!(distance.degree(&from, &to, &elsewhere)?, Some(0));
    /// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
    /// ```
    pub fn degree(&self, from: &Event, to: &Event, region: &SearchRegion) -> Result<Option<i32>, HamiltonianError> {
        check_events(from, to, region.lower.len())?;
        Ok(self.problem(from, to).degree(region))
    }
}

impl<H: PhaseFunction> Problem<'_, '_, H> {
    pub(super) fn degree(&self, region: &SearchRegion) -> Option<i32> {
        match (&region.lower[..], &region.upper[..]) {
            (&[lower], &[upper]) => {
                let sign = |p: f64| match orientation(self.shoot(&[p])?.coordinates()[0] - self.target()[0]) {
                    0 => None,
                    sign => Some(sign),
                };
                Some((sign(upper)? - sign(lower)?) / 2)
            }
            (&[left, low], &[right, high]) if left < right && low < high => {
                let corners = [[left, low], [right, low], [right, high], [left, high], [left, low]];
                let parts = region.resolution;
                let mut before = (corners[0], self.miss(corners[0])?);
                let mut angle = 0.0;
                for side in corners.windows(2) {
                    for part in 1..=parts {
                        let share = part as f64 / parts as f64;
                        let along = |i: usize| side[0][i] + share * (side[1][i] - side[0][i]);
                        let p = if part == parts { side[1] } else { [along(0), along(1)] };
                        let next = (p, self.miss(p)?);
                        angle += self.turn(before, next, HALVINGS)?;
                        before = next;
                    }
                }
                #[expect(clippy::cast_possible_truncation, reason = "a number of turns of a few steps each")]
                let turns = (angle / core::f64::consts::TAU).round() as i32;
                Some(turns)
            }
            _ => None,
        }
    }

    /// q(t₁; p₀) − q₁ in the plane.
    fn miss(&self, p: [f64; 2]) -> Option<[f64; 2]> {
        let end = self.shoot(&p)?;
        Some([end.coordinates()[0] - self.target()[0], end.coordinates()[1] - self.target()[1]])
    }

    /// The angle by which the miss turns between two momenta.
    fn turn(&self, a: ([f64; 2], [f64; 2]), b: ([f64; 2], [f64; 2]), halvings: u32) -> Option<f64> {
        let (from, to) = (a.1, b.1);
        let change = (to[0] - from[0]).hypot(to[1] - from[1]);
        if change <= 0.5 * from[0].hypot(from[1]).min(to[0].hypot(to[1])) {
            return Some((from[0] * to[1] - from[1] * to[0]).atan2(from[0] * to[0] + from[1] * to[1]));
        }
        let halvings = halvings.checked_sub(1)?;
        let middle = [0.5 * (a.0[0] + b.0[0]), 0.5 * (a.0[1] + b.0[1])];
        let middle = (middle, self.miss(middle)?);
        Some(self.turn(a, middle, halvings)? + self.turn(middle, b, halvings)?)
    }
}
