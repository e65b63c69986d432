//! Interpolating splines along one axis, in B-splines.
//!
//! Coefficients solve the collocation equations, whose matrix is banded and totally positive: elimination
//! without pivoting is stable (C. de Boor, A. Pinkus, *Backward error analysis for totally positive linear
//! systems*, Numer. Math. 27 (1977)).

use piola_numerics::{Mask, Real};

use super::Interpolation;
use crate::FieldsError;
use crate::error::check_finite;

/// The most B-splines that do not vanish at a point.
pub const WIDTH: usize = 6;

/// One axis of samples: its nodes and the knots of the spline through them.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    name: &'static str,
    nodes: Box<[f64]>,
    knots: Box<[f64]>,
    degree: usize,
}

impl Axis {
    /// From nodes that increase.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`] without nodes, [`FieldsError::NotFinite`], [`FieldsError::NotIncreasing`].
    pub fn new(name: &'static str, nodes: &[f64], interpolation: Interpolation) -> Result<Self, FieldsError> {
        if nodes.is_empty() {
            return Err(FieldsError::WrongLength { quantity: name, found: 0, expected: 1 });
        }
        check_finite(name, nodes)?;
        for (index, pair) in nodes.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                let (previous, value) = (pair[0], pair[1]);
                return Err(FieldsError::NotIncreasing { quantity: name, index: index + 1, previous, value });
            }
        }
        let (count, degree) = (nodes.len(), interpolation.degree().min(nodes.len() - 1));
        // Not-a-knot: of the inner nodes, those next to the ends are no knots.
        let skipped = degree.div_ceil(2);
        let inner = if degree + 1 < count { &nodes[skipped..count - skipped] } else { &[] };
        let end = |node: f64| core::iter::repeat_n(node, degree + 1);
        let knots = end(nodes[0]).chain(inner.iter().copied()).chain(end(nodes[count - 1])).collect();
        Ok(Self { name, nodes: nodes.into(), knots, degree })
    }

    /// The number of nodes, and of coefficients.
    #[expect(clippy::len_without_is_empty, reason = "an axis has at least one node")]
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The nodes.
    #[must_use]
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// The number of B-splines that do not vanish at a point.
    #[must_use]
    pub fn width(&self) -> usize {
        self.degree + 1
    }

    /// Refuses what lies outside the nodes; an axis with one node has no outside.
    ///
    /// # Errors
    /// [`FieldsError::OutsideSamples`].
    pub fn check<T: Real>(&self, x: T) -> Result<(), FieldsError> {
        let (low, high) = (self.nodes[0], self.nodes[self.len() - 1]);
        if self.len() == 1 || (T::lit(low).at_most(x) & x.at_most(T::lit(high))).all() {
            return Ok(());
        }
        let inside = |lane: usize| low <= x.primal(lane) && x.primal(lane) <= high;
        let lane = (0..T::LANES).find(|&lane| !inside(lane)).unwrap_or(0);
        Err(FieldsError::OutsideSamples { quantity: self.name, value: x.primal(lane), low, high })
    }

    /// The index of the first B-spline that does not vanish at x.
    #[must_use]
    pub fn first(&self, x: f64) -> usize {
        // Knot spans run from knot `degree` to knot `count`; the last one is closed.
        let spans = &self.knots[self.degree..self.len()];
        spans.partition_point(|&knot| knot <= x).saturating_sub(1)
    }

    /// Where x lies in the span that begins with B-spline `first`.
    #[must_use]
    pub fn within<T: Real>(&self, first: usize, x: T) -> T::Mask {
        if self.len() == self.width() {
            return T::Mask::splat(true);
        }
        let (low, high) = (self.knots[first + self.degree], self.knots[first + self.degree + 1]);
        T::lit(low).at_most(x) & x.at_most(T::lit(high))
    }

    /// The B-splines from `first` on at x; the rest of the array is zero.
    #[must_use]
    pub fn basis<T: Real>(&self, first: usize, x: T) -> [T; WIDTH] {
        let mut basis = [T::zero(); WIDTH];
        basis[0] = T::one();
        let span = first + self.degree;
        // The recursion of Cox and de Boor, one degree after another.
        for degree in 1..=self.degree {
            let mut carried = T::zero();
            let knots = self.knots[span + 1 - degree..=span].iter().zip(&self.knots[span + 1..]);
            for (value, (&low, &high)) in basis[..degree].iter_mut().zip(knots) {
                let share = *value / T::lit(high - low);
                *value = carried + (T::lit(high) - x) * share;
                carried = (x - T::lit(low)) * share;
            }
            basis[degree] = carried;
        }
        basis
    }

    /// The collocation matrix, factored.
    #[must_use]
    pub fn factor(&self) -> Factors {
        let (count, p) = (self.len(), self.degree);
        // Row i holds columns i − p … i + p.
        let mut band = vec![0.0; count * (2 * p + 1)];
        for (i, &node) in self.nodes.iter().enumerate() {
            let first = self.first(node);
            let basis = self.basis(first, node);
            for (k, &value) in basis.iter().enumerate().take(self.width()) {
                // Outside the band the B-spline vanishes at the node.
                if i <= first + k + p && first + k <= i + p {
                    band[i * (2 * p + 1) + first + k + p - i] = value;
                }
            }
        }
        for k in 0..count {
            let pivot = band[k * (2 * p + 1) + p];
            for i in k + 1..count.min(k + p + 1) {
                let factor = band[i * (2 * p + 1) + k + p - i] / pivot;
                band[i * (2 * p + 1) + k + p - i] = factor;
                for j in k + 1..count.min(k + p + 1) {
                    let above = band[k * (2 * p + 1) + j + p - k];
                    band[i * (2 * p + 1) + j + p - i] -= factor * above;
                }
            }
        }
        Factors { band, degree: p, count }
    }
}

/// The factors of a collocation matrix.
#[derive(Debug)]
pub struct Factors {
    band: Vec<f64>,
    degree: usize,
    count: usize,
}

impl Factors {
    /// Turns samples into coefficients along one axis of an array: entries `start + stride · i`.
    pub fn solve(&self, values: &mut [[f64; 3]], start: usize, stride: usize) {
        let (p, count) = (self.degree, self.count);
        let entry = |i: usize, j: usize| self.band[i * (2 * p + 1) + j + p - i];
        let row = |i: usize| start + stride * i;
        for i in 0..count {
            for j in i.saturating_sub(p)..i {
                subtract(values, row(i), row(j), entry(i, j));
            }
        }
        for i in (0..count).rev() {
            for j in i + 1..count.min(i + p + 1) {
                subtract(values, row(i), row(j), entry(i, j));
            }
            values[row(i)] = values[row(i)].map(|value| value / entry(i, i));
        }
    }
}

/// values[i] −= factor · values[j].
fn subtract(values: &mut [[f64; 3]], i: usize, j: usize, factor: f64) {
    let from = values[j];
    for (value, from) in values[i].iter_mut().zip(from) {
        *value -= factor * from;
    }
}
