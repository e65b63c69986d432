//! An eccentric orbit.

use core::f64::consts::PI;

use super::{Accelerations, Equations, Force, LONGEST_RUN, Problem};
use piola_numerics::Real;

/// The attraction of a fixed centre in the plane.
#[derive(Clone, Copy, Debug)]
pub struct Kepler {
    /// The parameter Gm.
    pub parameter: f64,
}

impl Force for Kepler {
    #[inline]
    fn force(&self, position: &[f64], force: &mut [f64]) {
        let (Some(&[x, y]), Some(force)) = (position.first_chunk(), force.first_chunk_mut()) else { return };
        let square: f64 = x * x + y * y;
        let factor = -self.parameter / (square * square.sqrt());
        *force = [factor * x, factor * y];
    }
}

impl Equations<4> for Kepler {
    #[inline]
    fn rate(&self, y: &[f64; 4], rate: &mut [f64; 4]) {
        let (position, velocity) = y.split_at(2);
        let (moving, force) = rate.split_at_mut(2);
        moving.copy_from_slice(velocity);
        self.force(position, force);
    }
}

impl Accelerations for Kepler {
    const VELOCITY_DEPENDENT: bool = false;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accelerations<T: Real>(&self, q: &[T], _v: &[T], out: &mut [T]) {
        let square = q[0] * q[0] + q[1] * q[1];
        let factor = T::lit(-self.parameter) / (square * square.sqrt());
        out[0] = factor * q[0];
        out[1] = factor * q[1];
    }
}

/// Ten revolutions of an orbit of eccentricity 0.9, from apocentre to apocentre.
///
/// With the half-axis a = 10 and the parameter 190 the start is exact in doubles: r = a(1 + e) = 19 and
/// v² = (190/10)(1 − e)/(1 + e) = 1. After whole periods 2π √(a³/190) the exact solution is back.
#[must_use]
pub fn kepler() -> Problem<Kepler, 4> {
    orbit("kepler", "Kepler orbit of eccentricity 0.9, 10 revolutions", [19.0, 10.0, 190.0])
}

/// The same of eccentricity 0.3: r = 13, and the parameter is 130/7, rounded.
#[must_use]
pub fn kepler_round() -> Problem<Kepler, 4> {
    orbit("kepler-03", "Kepler orbit of eccentricity 0.3, 10 revolutions", [13.0, 10.0, 130.0 / 7.0])
}

/// The same of eccentricity 0.99: r = 199, a = 100 and the parameter 19900, exactly.
#[must_use]
pub fn kepler_long() -> Problem<Kepler, 4> {
    orbit("kepler-099", "Kepler orbit of eccentricity 0.99, 10 revolutions", [199.0, 100.0, 19_900.0])
}

/// Ten revolutions from the apocentre r with speed 1 across, half-axis a and parameter ra/(2a − r).
fn orbit(name: &'static str, title: &'static str, [r, a, parameter]: [f64; 3]) -> Problem<Kepler, 4> {
    let start = [r, 0.0, 0.0, 1.0];
    let end = 20.0 * PI * (a * a * a / parameter).sqrt();
    Problem {
        name,
        title,
        equations: Kepler { parameter },
        start,
        end,
        reference: start,
        small: 1.0,
        longest_run: LONGEST_RUN,
    }
}
