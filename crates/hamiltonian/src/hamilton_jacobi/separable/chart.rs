//! One coordinate of a separable motion by a parameter over which it is smooth.
//!
//! ```text
//! libration     q = m − h cos u     R = (q − a)(b − q) g     dq/p = du/√g      p = h sin u √g
//! reflection    q = a ± u²          R = u² g                  dq/p = 2du/√g     p = ±u √g
//! passage       q = ±u              R = g                     dq/p = du/√g      p = ±√g
//! ```

use core::f64::consts::TAU;

use piola_numerics::Dual;

use super::Separable;
use crate::{HamiltonJacobiError, HamiltonianError};
use piola_lagrangian::internal::integrate;

/// The accuracy asked of quadratures, relative to ∫|f|.
const ACCURACY: f64 = 1e-13;
/// Steps in the search for a turning point.
const MOST_STEPS: usize = 2000;
/// How far from a turning point, in parts of the distance over which R′ changes, R is taken from its derivative.
const NEAR: f64 = 0.02;

/// The difference of R from both ends below which R′ is integrated exactly by Gauss's rule.
const MILD: f64 = 1e-13;

/// Below so many ulp a well is rounding.
const SHALLOW: f64 = 1e4;

/// Nodes in [0, 1] and weights of Gauss's rule with five points.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668_0, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// How a coordinate moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Chart {
    /// To and fro between a and b.
    Libration { a: f64, b: f64, well: Well },
    /// To a turning point and back; the side is 1 where the coordinate stays above it.
    Reflection { at: f64, side: f64 },
    /// In one sense for ever.
    Passage { sense: f64 },
}

/// What R is like between two turning points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Well {
    /// Anything: away from its zeros it is as it is evaluated.
    Deep,
    /// So smooth that it follows from R′ everywhere.
    Mild,
    /// So shallow that it is rounding: g is −R″/2.
    Shallow(f64),
}

/// R and R′ of one coordinate.
fn square<S: Separable>(system: &S, coordinate: usize, constants: &[f64], x: f64) -> Dual<f64> {
    let constants: Vec<Dual<f64>> = constants.iter().map(|&c| Dual::constant(c)).collect();
    system.square(coordinate, Dual::variable(x), &constants)
}

/// R, R′ and R″.
fn parabola<S: Separable>(system: &S, coordinate: usize, constants: &[f64], x: f64) -> [f64; 3] {
    let constants: Vec<Dual<Dual<f64>>> = constants.iter().map(|&c| Dual::constant(Dual::constant(c))).collect();
    let x = Dual { value: Dual::variable(x), tangent: Dual::constant(1.0) };
    let r = system.square(coordinate, x, &constants);
    [r.value.value, r.value.tangent, r.tangent.tangent]
}

/// R″.
fn curvature<S: Separable>(system: &S, coordinate: usize, constants: &[f64], x: f64) -> f64 {
    parabola(system, coordinate, constants, x)[2]
}

/// R/(x − end) for a zero of R at `end`, without cancellation; from R′ alone where it is `mild`.
fn quotient<S: Separable>(system: &S, coordinate: usize, constants: &[f64], (end, x, mild): (f64, f64, bool)) -> f64 {
    if !mild {
        let at_end = square(system, coordinate, constants, end).tangent;
        let reach = (at_end / curvature(system, coordinate, constants, end)).abs();
        if NEAR * reach < (x - end).abs() {
            return square(system, coordinate, constants, x).value / (x - end);
        }
    }
    let slope = |s: f64| square(system, coordinate, constants, end + s * (x - end)).tangent;
    GAUSS.into_iter().map(|(node, weight)| weight * slope(node)).sum()
}

impl Chart {
    /// The chart of a coordinate at q with the momentum p.
    pub(super) fn around<S: Separable>(
        system: &S,
        coordinate: usize,
        constants: &[f64],
        (q, p): (f64, f64),
    ) -> Result<Self, HamiltonianError> {
        let found = square(system, coordinate, constants, q);
        let refused = HamiltonianError::HamiltonJacobi(HamiltonJacobiError::ForbiddenCoordinate {
            coordinate,
            value: q,
            square: found.value,
        });
        if !found.value.is_finite() || !found.tangent.is_finite() {
            return Err(refused);
        }
        // A negative square is rounding only where the momentum is small as well.
        let size = found.tangent.abs() * q.abs().max(f64::MIN_POSITIVE)
            + curvature(system, coordinate, constants, q).abs() * q * q;
        if found.value < -1e-12 * (size + p * p) {
            return Err(refused);
        }
        let range = system.range(coordinate);
        let local = |x| parabola(system, coordinate, constants, x);
        let (below, above) = (turning_point(local, (q, range.0)), turning_point(local, (q, range.1)));
        Ok(match (below, above) {
            (Some(a), Some(b)) => {
                // In wells so small that R is rounding its derivative still is exact: both ends then tell one R.
                let middle = 0.5 * (a + b);
                let from = |end| quotient(system, coordinate, constants, (end, middle, true)) * (middle - end);
                let (left, right) = (from(a), from(b));
                let bend = -0.5 * curvature(system, coordinate, constants, middle);
                let noise = f64::EPSILON * bend.abs() * a.abs().max(b.abs()).powi(2);
                let well = if (left - right).abs() <= MILD * left.abs() && 0.0 < left {
                    Well::Mild
                } else if left.abs().max(right.abs()) <= SHALLOW * noise && 0.0 < bend {
                    Well::Shallow(bend)
                } else {
                    Well::Deep
                };
                Self::Libration { a, b, well }
            }
            (Some(at), None) => Self::Reflection { at, side: 1.0 },
            (None, Some(at)) => Self::Reflection { at, side: -1.0 },
            (None, None) => Self::Passage { sense: 1.0_f64.copysign(p) },
        })
    }

    pub(super) const fn turning_points(&self) -> (Option<f64>, Option<f64>) {
        match *self {
            Self::Libration { a, b, .. } => (Some(a), Some(b)),
            Self::Reflection { at, side } if 0.0 < side => (Some(at), None),
            Self::Reflection { at, .. } => (None, Some(at)),
            Self::Passage { .. } => (None, None),
        }
    }

    /// The chart in which q rises with u while p > 0.
    pub(super) const fn rising(self) -> Self {
        match self {
            Self::Passage { .. } => Self::Passage { sense: 1.0 },
            other => other,
        }
    }

    pub(super) fn contains(&self, q: f64) -> bool {
        let (below, above) = self.turning_points();
        below.is_none_or(|a| a <= q) && above.is_none_or(|b| q <= b)
    }

    /// u of a state.
    pub(super) fn parameter(&self, q: f64, p: f64) -> f64 {
        match *self {
            Self::Libration { a, b, .. } => {
                if b <= a {
                    return 0.0;
                }
                // From the nearer end, where the cosine of the angle would lose it.
                let (low, high) = ((q - a).max(0.0), (b - q).max(0.0));
                let angle = 2.0 * low.sqrt().atan2(high.sqrt());
                if p < 0.0 { TAU - angle } else { angle }
            }
            Self::Reflection { at, side } => {
                let u = (side * (q - at)).max(0.0).sqrt();
                // p = side u √g.
                if side * p < 0.0 { -u } else { u }
            }
            Self::Passage { sense } => sense * q,
        }
    }

    /// q(u).
    fn coordinate(&self, u: f64) -> f64 {
        match *self {
            Self::Libration { a, b, .. } => {
                let half = (0.5 * u).sin();
                // Near the upper end from there.
                let other = (0.5 * u).cos();
                if half * half < 0.5 { a + (b - a) * half * half } else { b - (b - a) * other * other }
            }
            Self::Reflection { at, side } => at + side * u * u,
            Self::Passage { sense } => sense * u,
        }
    }

    /// √g, and q.
    fn root<S: Separable>(&self, system: &S, coordinate: usize, constants: &[f64], u: f64) -> (f64, f64) {
        let q = self.coordinate(u);
        let g = match *self {
            Self::Libration { a, b, well } => {
                let mild = well == Well::Mild;
                match well {
                    Well::Shallow(g) => g,
                    _ if q - a < b - q => quotient(system, coordinate, constants, (a, q, mild)) / (b - q),
                    _ => -quotient(system, coordinate, constants, (b, q, mild)) / (q - a),
                }
            }
            Self::Reflection { at, side } => side * quotient(system, coordinate, constants, (at, q, false)),
            Self::Passage { .. } => square(system, coordinate, constants, q).value,
        };
        (g.sqrt(), q)
    }

    /// dq/(p du), and q.
    fn rate<S: Separable>(&self, system: &S, coordinate: usize, constants: &[f64], u: f64) -> (f64, f64) {
        let (root, q) = self.root(system, coordinate, constants, u);
        let factor = if matches!(self, Self::Reflection { .. }) { 2.0 } else { 1.0 };
        (factor / root, q)
    }

    /// (q, p) at u.
    pub(super) fn state<S: Separable>(&self, system: &S, coordinate: usize, constants: &[f64], u: f64) -> (f64, f64) {
        let (root, q) = self.root(system, coordinate, constants, u);
        let p = match *self {
            Self::Libration { a, b, .. } => 0.5 * (b - a) * u.sin() * root,
            Self::Reflection { side, .. } => side * u * root,
            Self::Passage { sense } => sense * root,
        };
        (q, p)
    }

    /// ∂_kR/2 · dq/(p du).
    pub(super) fn slope<S: Separable>(
        &self,
        system: &S,
        (coordinate, k): (usize, usize),
        constants: &[f64],
        u: f64,
    ) -> f64 {
        let (rate, q) = self.rate(system, coordinate, constants, u);
        let direction = constants.iter().enumerate();
        let constants: Vec<Dual<f64>> =
            direction.map(|(i, &value)| Dual { value, tangent: f64::from(u8::from(i == k)) }).collect();
        0.5 * rate * system.square(coordinate, Dual::constant(q), &constants).tangent
    }

    /// The integral of [`slope`](Self::slope).
    pub(super) fn integral<S: Separable>(
        &self,
        system: &S,
        which: (usize, usize),
        constants: &[f64],
        limits: (f64, f64),
    ) -> Result<f64, HamiltonianError> {
        self.quadrature(limits, |u| self.slope(system, which, constants, u))
    }

    /// ∫ p dq = ∫ R dq/p.
    pub(super) fn action<S: Separable>(
        &self,
        system: &S,
        coordinate: usize,
        constants: &[f64],
        limits: (f64, f64),
    ) -> Result<f64, HamiltonianError> {
        self.quadrature(limits, |u| {
            let (rate, _) = self.rate(system, coordinate, constants, u);
            let (_, p) = self.state(system, coordinate, constants, u);
            p * p * rate
        })
    }

    /// Librations of many periods are whole ones and a rest.
    fn quadrature(&self, (from, to): (f64, f64), f: impl Fn(f64) -> f64) -> Result<f64, HamiltonianError> {
        let over = |from: f64, to: f64| -> Result<f64, HamiltonianError> {
            if (to - from).abs() <= 0.0 {
                return Ok(0.0);
            }
            Ok(integrate((from, to), (ACCURACY, 0.0), |u| Ok::<_, HamiltonianError>([f(u)]))?.values[0])
        };
        let periods = if matches!(self, Self::Libration { .. }) { ((to - from) / TAU).trunc() } else { 0.0 };
        let whole = if periods.abs() < 1.0 { 0.0 } else { periods * over(0.0, TAU)? };
        Ok(whole + over(from, to - periods * TAU)?)
    }
}

/// The first zero of R from q towards a bound of the coordinate; none when R stays positive.
///
/// R departs from its parabola R + R′s + R″s²/2 with s³. A step in which the parabola is above twice that has no barrier, however
/// far from the origin q is; others are halved.
fn turning_point(r: impl Fn(f64) -> [f64; 3], (q, bound): (f64, f64)) -> Option<f64> {
    let direction = if bound < q { -1.0 } else { 1.0 };
    let (mut inside, mut step) = (q, 1e-3 * q.abs().max(1e-3));
    let mut here = r(q);
    for _ in 0..MOST_STEPS {
        let [value, slope, curvature] = here;
        let (slope, bend) = (direction * slope, 0.5 * curvature);
        let mut smallest = 4.0 * f64::EPSILON * inside.abs();
        if 0.0 < value {
            step = step.min(beyond_the_first_zero([value, slope, bend])).max(smallest);
        }
        // A finite bound is approached, never reached.
        if bound.is_finite() {
            let most = 0.2 * (bound - inside).abs();
            (step, smallest) = (step.min(most), smallest.min(most));
        }
        let (next, there) = loop {
            let next = inside + direction * step;
            if !next.is_finite() || 1e15 < next.abs() {
                return None;
            }
            let parabola = |s: f64| value + s * (slope + s * bend);
            // Halfway too: at the end R may meet its parabola by chance.
            let (there, halfway) = (r(next), r(inside + direction * 0.5 * step));
            let departure = (there[0] - parabola(step)).abs().max(8.0 * (halfway[0] - parabola(0.5 * step)).abs());
            let noise = f64::EPSILON * (slope * inside).abs().max(bend.abs() * inside * inside);
            let cubic = [value.max(0.0), slope, bend, -2.0 * departure / (step * step * step)];
            let is_beyond = there[0] < 0.0 && parabola(step) + 2.0 * departure < 0.0;
            if is_beyond || departure <= noise || step <= smallest || is_positive(cubic, step) {
                break (next, there);
            }
            step *= 0.5;
        };
        if there[0].is_nan() {
            return None;
        }
        if there[0] < 0.0 {
            return Some(zero(|x| r(x)[0], inside, next));
        }
        step = (1.25 * step).max(smallest);
        (inside, here) = (next, there);
    }
    None
}

/// Whether a + b s + c s² + d s³ is not negative from 0 to the end.
fn is_positive([a, b, c, d]: [f64; 4], end: f64) -> bool {
    let cubic = |s: f64| a + s * (b + s * (c + s * d));
    // Places where its derivative vanishes, without cancellation.
    let root = (c * c - 3.0 * d * b).sqrt();
    let large = -(c + root.copysign(c));
    [large / (3.0 * d), b / large].into_iter().filter(|s| 0.0 < *s && *s < end).chain([end]).all(|s| 0.0 <= cubic(s))
}

/// A place between the first zero of R + R′s + bs² at s > 0 and its second; infinite without one.
fn beyond_the_first_zero([value, slope, bend]: [f64; 3]) -> f64 {
    let discriminant = slope * slope - 4.0 * bend * value;
    if discriminant.is_nan() || discriminant < 0.0 {
        return f64::INFINITY;
    }
    // Both zeros without cancellation.
    let large = -0.5 * (slope + discriminant.sqrt().copysign(slope));
    let zeros = [large / bend, value / large].map(|s| if 0.0 < s { s } else { f64::INFINITY });
    let (first, second) = (zeros[0].min(zeros[1]), zeros[0].max(zeros[1]));
    (1.5 * first).min(0.5 * (first + second))
}

/// A zero between a place where R is not negative and one where it is: the last place where it is not.
fn zero(r: impl Fn(f64) -> f64, mut inside: f64, mut outside: f64) -> f64 {
    let (mut a, mut b) = (r(inside).max(0.0), r(outside));
    let mut bisect = false;
    for _ in 0..200 {
        let width = (outside - inside).abs();
        if width <= 2.0 * f64::EPSILON * inside.abs().max(outside.abs()) {
            break;
        }
        let secant = inside + (outside - inside) * (a / (a - b));
        let between = (inside < secant && secant < outside) || (outside < secant && secant < inside);
        let middle = if bisect || !between { 0.5 * (inside + outside) } else { secant };
        if middle.total_cmp(&inside).is_eq() || middle.total_cmp(&outside).is_eq() {
            break;
        }
        let value = r(middle);
        if value < 0.0 {
            (outside, b) = (middle, value);
        } else {
            (inside, a) = (middle, value);
        }
        bisect = 0.5 * width < (outside - inside).abs();
    }
    inside
}
