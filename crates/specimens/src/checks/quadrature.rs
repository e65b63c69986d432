//! Integrals of power along paths, on which the stress may have kinks and jumps.

use piola_numerics::quadrature::{self, Accuracy, GaussKronrod, Growing, Kinks, Panel};

/// The most panels of one integral.
const MOST: usize = 1024;

/// Errors below this share of ∫ |P| |F′| of a panel are rounding: halving it helps no more.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// ∫ P : dF and ∫ |P| |dF|.
pub(super) struct Integral {
    pub(super) work: f64,
    pub(super) scale: f64,
    /// The error of `work`, estimated.
    pub(super) error: f64,
}

/// An error of the work below a share of ∫ |P| |dF|; the error of that does not matter.
struct ShareOfScale(f64);

impl Accuracy<2> for ShareOfScale {
    fn allowed(&self, &[_, scale]: &[f64; 2], _sizes: &[f64; 2]) -> [f64; 2] {
        [self.0 * scale, f64::INFINITY]
    }
    fn is_worth_halving(&self, panel: &Panel<2>) -> bool {
        ROUNDING * panel.values[1] < panel.errors[0]
    }
}

/// The integral of f(side, s) = (P : F′, |P| |F′|) over 0 ≤ s ≤ 1 of all sides; none where f has no value.
///
/// The panel with the largest error is halved until the sum of errors is below `share` of ∫ |P| |dF|, until only rounding is
/// left, or until there are as many panels as are allowed.
pub(super) fn integrate(sides: usize, share: f64, f: impl Fn(usize, f64) -> Option<[f64; 2]>) -> Option<Integral> {
    let ranges = (0..sides).map(|_| (0.0, 1.0));
    let method = (&GaussKronrod::POINTS_15, &Kinks);
    let power = |side, s| f(side, s).ok_or(());
    let found = quadrature::integrate(&mut Growing::up_to(MOST), ranges, method, &ShareOfScale(share), power).ok()?;
    Some(Integral { work: found.values[0], scale: found.values[1], error: found.errors[0] })
}
