//! The buffers that evaluations write to.

use piola_numerics::linear::least_squares::LeastSquares;
use piola_numerics::{Dual, Gradient, Jet};

use super::collect::Rows;
use super::directions::{CHUNK, HESSIAN_CHUNK};

/// A scalar with two sets of directions.
pub(super) type Twice<T> = Gradient<Gradient<T, HESSIAN_CHUNK>, HESSIAN_CHUNK>;

/// The buffers of one thread: made once, grown at the first evaluation, then never again.
///
/// Systems of up to eight coordinates leave most of it empty.
#[derive(Clone, Debug)]
pub struct Workspace<T = f64> {
    pub(super) rows: Rows<T>,
    pub(super) metric: Vec<T>,
    pub(super) force: Vec<T>,
    pub(super) coordinates: Vec<Gradient<T, CHUNK>>,
    pub(super) jets: Vec<Jet<T, CHUNK>>,
    /// Coordinates along the motion, without directions…
    pub(super) moving: Vec<Jet<T, 0>>,
    /// …and with the time as the only one.
    pub(super) timed: Vec<Jet<T, 1>>,
    /// What callers of other evaluations hold meanwhile: accelerations, a mass matrix.
    pub(super) lent: Vec<T>,
    pub(super) mixed: Vec<Dual<Gradient<T, CHUNK>>>,
    pub(super) mixed_rates: Vec<Dual<Gradient<T, CHUNK>>>,
    pub(super) nested: Vec<Twice<T>>,
    pub(super) duals: Vec<Dual<T>>,
    pub(super) constants: Vec<Gradient<T, CHUNK>>,
    pub(super) linear: Vec<T>,
    pub(super) least_squares: LeastSquares<T>,
}

impl<T> Default for Workspace<T> {
    fn default() -> Self {
        Self {
            rows: Rows::default(),
            metric: Vec::new(),
            force: Vec::new(),
            coordinates: Vec::new(),
            jets: Vec::new(),
            moving: Vec::new(),
            timed: Vec::new(),
            lent: Vec::new(),
            mixed: Vec::new(),
            mixed_rates: Vec::new(),
            nested: Vec::new(),
            duals: Vec::new(),
            constants: Vec::new(),
            linear: Vec::new(),
            least_squares: LeastSquares::default(),
        }
    }
}
