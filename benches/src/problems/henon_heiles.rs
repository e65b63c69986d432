//! Motion in the potential of Hénon and Heiles.

use piola_numerics::Real;

use super::reference::{array, numbers, read};
use super::{Accelerations, Equations, Force, LONGEST_RUN, Problem, ReferenceError};

/// V = (x² + y²)/2 + x²y − y³/3.
#[derive(Clone, Copy, Debug)]
pub struct HenonHeiles;

impl Accelerations for HenonHeiles {
    const VELOCITY_DEPENDENT: bool = false;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accelerations<T: Real>(&self, q: &[T], _v: &[T], out: &mut [T]) {
        let (x, y) = (q[0], q[1]);
        out[0] = -x - (x + x) * y;
        out[1] = y * y - y - x * x;
    }
}

impl Force for HenonHeiles {
    #[inline]
    fn force(&self, position: &[f64], force: &mut [f64]) {
        self.accelerations(position, &[], force);
    }
}

impl Equations<4> for HenonHeiles {
    #[inline]
    fn rate(&self, y: &[f64; 4], rate: &mut [f64; 4]) {
        let (position, velocity) = y.split_at(2);
        let (moving, force) = rate.split_at_mut(2);
        moving.copy_from_slice(velocity);
        self.force(position, force);
    }
}

/// A regular orbit, to t = 100.
///
/// # Errors
/// The reference cannot be read.
pub fn henon_heiles() -> Result<Problem<HenonHeiles, 4>, ReferenceError> {
    Ok(Problem {
        name: "henon-heiles",
        title: "Hénon–Heiles, to t = 100",
        equations: HenonHeiles,
        start: [0.0, 0.1, 0.490_577_889_167_25, 0.0],
        end: 100.0,
        reference: array(&numbers(&read("henon_heiles")?["own_reference_T100"]["state"])?)?,
        small: 1.0,
        longest_run: LONGEST_RUN,
    })
}
