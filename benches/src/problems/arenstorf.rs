//! A satellite between the Earth and the Moon.

use piola_numerics::Real;

use super::reference::{array, numbers, read};
use super::{Accelerations, Equations, LONGEST_RUN, Problem, ReferenceError};

/// The restricted problem of three bodies in the rotating plane.
#[derive(Clone, Copy, Debug)]
pub struct Arenstorf {
    /// The mass of the Moon over that of both.
    pub moon: f64,
}

impl Arenstorf {
    /// The attraction by Earth and Moon, in the frame that turns with them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn attraction<T: Real>(&self, q: &[T], out: &mut [T]) {
        let (moon, earth) = (T::lit(self.moon), T::lit(1.0 - self.moon));
        let (from_earth, from_moon) = (q[0] + moon, q[0] - earth);
        let height = q[1] * q[1];
        let (r1, r2) = (from_earth * from_earth + height, from_moon * from_moon + height);
        let (d1, d2) = (earth / (r1 * r1.sqrt()), moon / (r2 * r2.sqrt()));
        out[0] = -(d1 * from_earth + d2 * from_moon);
        out[1] = -(d1 + d2) * q[1];
    }
}

impl Accelerations for Arenstorf {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accelerations<T: Real>(&self, q: &[T], v: &[T], out: &mut [T]) {
        self.attraction(q, out);
        out[0] += q[0] + (v[1] + v[1]);
        out[1] += q[1] - (v[0] + v[0]);
    }
}

impl Equations<4> for Arenstorf {
    #[inline]
    fn rate(&self, y: &[f64; 4], rate: &mut [f64; 4]) {
        let (position, velocity) = y.split_at(2);
        let (moving, acceleration) = rate.split_at_mut(2);
        moving.copy_from_slice(velocity);
        self.accelerations(position, velocity, acceleration);
    }
}

/// One period of the closed orbit of three loops.
///
/// # Errors
/// The reference cannot be read.
pub fn arenstorf() -> Result<Problem<Arenstorf, 4>, ReferenceError> {
    // Of the start as it is rounded: the motion magnifies its rounding to 1e-11.
    let data = read("arenstorf_of_doubles")?;
    Ok(Problem {
        name: "arenstorf",
        title: "Arenstorf orbit, one period",
        equations: Arenstorf { moon: 0.012_277_471 },
        start: array(&numbers(&data["initial_state"])?)?,
        end: numbers(&data["period"])?.first().copied().unwrap_or(f64::NAN),
        reference: array(&numbers(&data["own_reference_after_one_period"]["state"])?)?,
        small: 1.0,
        longest_run: LONGEST_RUN,
    })
}
