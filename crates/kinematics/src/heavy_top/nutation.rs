//! The angle between the axis of a symmetric top and the vertical.

use nalgebra::Complex;

use crate::elliptic::{first_kind, jacobi};

/// Steps of a search for a root, which ends when it stands still.
const MOST_STEPS: usize = 200;

/// u = cos θ as a function of time. Heights are counted from the lowest place, y = 1 + u, and from the highest, x = 1 − u: both
/// are accurate where they are small.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nutation {
    /// A, kg m².
    pub(super) across: f64,
    /// P, N m.
    pub(super) weight: f64,
    /// L + L₃ and L − L₃, kg m²/s.
    pub(super) sums: [f64; 2],
    /// L₃.
    spin: f64,
    /// y₁ and y₂.
    pub(super) below: [f64; 2],
    /// x₁ and x₂.
    pub(super) above: [f64; 2],
    /// u₂ − u₁.
    pub(super) width: f64,
    /// P(u₃ − u₁), P(u₃ − u₂), P(u₃ − 1).
    pub(super) heights_to_third: [f64; 3],
    /// p, rad/s.
    pub(super) rate: f64,
    /// m and 1 − m.
    pub(super) parameters: [f64; 2],
    /// K(m).
    pub(super) quarter: f64,
    /// v₀.
    argument: f64,
}

/// v, as half periods 2K and what is left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Phase {
    pub(super) half_periods: f64,
    /// sn, cn and dn of what is left, which is within ±K: cn is not negative.
    pub(super) functions: [f64; 3],
}

impl Nutation {
    /// Of moments A and C, the weight P, the start as q₀ + i q₃ and q₁ + i q₂, and ω across the axis and along it.
    pub(super) fn new(
        [across, along]: [f64; 2],
        weight: f64,
        [alpha, beta]: [Complex<f64>; 2],
        omega: [f64; 3],
    ) -> Self {
        let spin = along * omega[2];
        let (y0, x0) = (2.0 * alpha.norm_sqr(), 2.0 * beta.norm_sqr());
        let up = Complex::new(0.0, 2.0) * alpha.conj() * beta;
        // The parts of ω along and across the shadow of the vertical, times the length of the shadow.
        let moving = up.conj() * Complex::new(omega[0], omega[1]);
        let energy = 0.5 * across * (omega[0] * omega[0] + omega[1] * omega[1]);
        let sums = [across * moving.re + spin * y0, across * moving.re - spin * x0];
        let cubic = Cubic { across, weight, spin, y0, x0, energy, sums, shadow: moving };
        let (fallen, y1) = cubic.lower();
        let (risen, x2) = cubic.upper();
        let width = fallen + risen;
        let (y2, x1) = (y1 + width, x2 + width);
        // P(u₃ − 1), from the product of the roots' distances to the vertical: what belongs together must agree to all digits.
        let product = if 0.0 < x1 { sums[1] * sums[1] / (2.0 * across * x1) } else { 0.0 };
        let third = if 0.0 < x2 { product / x2 } else { cubic.third_over_vertical(y1, x1) };
        let sum = third + weight * x2;
        let whole = sum + weight * width;
        let parameters = if 0.0 < whole { [weight * width / whole, sum / whole] } else { [0.0, 1.0] };
        let quarter = if 0.0 < parameters[1] { first_kind([0.0, parameters[1], 1.0]) } else { f64::INFINITY };
        let (sn2, cn2) = if 0.0 < width { (fallen / width, risen / width) } else { (0.0, 1.0) };
        let sine = sn2.sqrt().copysign(moving.im);
        let argument = sine * first_kind([cn2, parameters[1] + parameters[0] * cn2, 1.0]);
        Self {
            across,
            weight,
            sums,
            spin,
            below: [y1, y2],
            above: [x1, x2],
            width,
            heights_to_third: [whole, sum, third],
            rate: (0.5 * whole / across).sqrt(),
            parameters,
            quarter,
            argument,
        }
    }

    pub(super) fn phase(&self, t: f64) -> Phase {
        let argument = self.argument + self.rate * t;
        let half_periods = (argument / (2.0 * self.quarter)).round();
        let rest = if 0.0 < half_periods.abs() { argument - 2.0 * self.quarter * half_periods } else { argument };
        let [sn, cn, dn] = jacobi(rest, self.parameters[1]);
        Phase { half_periods, functions: [sn, cn.max(0.0), dn] }
    }

    /// y and x.
    pub(super) fn heights(&self, phase: &Phase) -> [f64; 2] {
        let [sn, cn, _] = phase.functions;
        [self.below[0] + self.width * (sn * sn), self.above[1] + self.width * (cn * cn)]
    }

    /// (L − L₃ u)/A and u̇, over sin θ.
    pub(super) fn rates(&self, phase: &Phase) -> [f64; 2] {
        let [y, x] = self.heights(phase);
        let [sn, cn, dn] = phase.functions;
        let across = if y < x { self.sums[0] - self.spin * y } else { self.sums[1] + self.spin * x } / self.across;
        let sine = (x * y).sqrt();
        if 0.0 < sine {
            return [across / sine, 2.0 * self.rate * self.width * (sn * cn * dn) / sine];
        }
        // Through the vertical.
        let root = 2.0 * self.rate * (0.5 * self.width).sqrt() * dn;
        let along = if y < x { cn.copysign(sn) } else { sn };
        [0.0, root * along]
    }

    pub(super) fn period(&self) -> f64 {
        2.0 * self.quarter / self.rate
    }

    pub(super) fn range(&self) -> [f64; 2] {
        let [y1, x1] = [self.below[0], self.above[0]];
        let [y2, x2] = [self.below[1], self.above[1]];
        [if y1 < x1 { y1 - 1.0 } else { 1.0 - x1 }, if y2 < x2 { y2 - 1.0 } else { 1.0 - x2 }]
    }
}

/// u̇² as a function of the height over the start, over the lowest place, and under the highest.
struct Cubic {
    across: f64,
    weight: f64,
    spin: f64,
    y0: f64,
    x0: f64,
    /// Kinetic energy of the turn across the axis, at the start.
    energy: f64,
    sums: [f64; 2],
    /// The product of ω with the shadow of the vertical, and u̇, at the start.
    shadow: Complex<f64>,
}

impl Cubic {
    /// u̇² and its derivative, `z` over the start.
    fn over_start(&self, z: f64) -> [f64; 2] {
        let [c0, c1, c2, c3] = self.coefficients();
        [c0 + z * (c1 + z * (c2 + z * c3)), c1 + z * (2.0 * c2 + z * (3.0 * c3))]
    }

    fn coefficients(&self) -> [f64; 4] {
        let a = self.across;
        let (u0, turn) = (0.5 * (self.y0 - self.x0), self.spin / a);
        [
            self.shadow.im * self.shadow.im,
            2.0 * (turn * self.shadow.re - (self.weight * (self.x0 * self.y0) + 2.0 * u0 * self.energy) / a),
            (4.0 * self.weight * u0 - 2.0 * self.energy) / a - turn * turn,
            2.0 * self.weight / a,
        ]
    }

    /// u̇² and its derivative, `y` over the lowest place.
    fn over_lowest(&self, y: f64) -> [f64; 2] {
        let turn = (self.sums[0] - self.spin * y) / self.across;
        let left = self.energy - self.weight * (y - self.y0);
        let (room, factor) = (y * (2.0 - y), 2.0 / self.across);
        [
            factor * left * room - turn * turn,
            factor * (left * (2.0 - 2.0 * y) - self.weight * room) + 2.0 * turn * self.spin / self.across,
        ]
    }

    /// u̇² and its derivative, `x` under the highest place.
    fn under_highest(&self, x: f64) -> [f64; 2] {
        let turn = (self.sums[1] + self.spin * x) / self.across;
        let left = self.energy + self.weight * (x - self.x0);
        let (room, factor) = (x * (2.0 - x), 2.0 / self.across);
        [
            factor * left * room - turn * turn,
            factor * (left * (2.0 - 2.0 * x) + self.weight * room) - 2.0 * turn * self.spin / self.across,
        ]
    }

    /// P(u₃ − 1) where u₂ = 1.
    fn third_over_vertical(&self, y1: f64, x1: f64) -> f64 {
        // By the sum of the roots, or by the sum of their products in pairs: as less is lost.
        let (energy, turn) = (self.energy, 0.5 * self.spin * self.spin / self.across);
        let sum = [energy, turn, -self.weight * (self.x0 + y1)];
        let pairs = [2.0 * energy, -2.0 * self.weight * self.x0, -self.sums[1] * self.spin / self.across];
        let size = |terms: &[f64]| terms.iter().map(|term| term.abs()).sum::<f64>();
        let by_pairs = size(&pairs) < x1 * size(&sum);
        let third: f64 = if by_pairs { pairs.iter().sum::<f64>() / x1 } else { sum.iter().sum() };
        third.max(0.0)
    }

    /// u₀ − u₁ and 1 + u₁.
    fn lower(&self) -> (f64, f64) {
        let [c0, c1, ..] = self.coefficients();
        if c0 <= 0.0 && 0.0 <= c1 {
            return (0.0, self.y0);
        }
        let fallen = -root(|z| self.over_start(z), 0.0, -self.y0);
        if fallen <= 0.5 * self.y0 {
            return (fallen, self.y0 - fallen);
        }
        let y1 = root(|y| self.over_lowest(y), self.y0, 0.0);
        (self.y0 - y1, y1)
    }

    /// u₂ − u₀ and 1 − u₂.
    fn upper(&self) -> (f64, f64) {
        let [c0, c1, ..] = self.coefficients();
        if c0 <= 0.0 && c1 <= 0.0 {
            return (0.0, self.x0);
        }
        let risen = root(|z| self.over_start(z), 0.0, self.x0);
        if risen <= 0.5 * self.x0 {
            return (risen, self.x0 - risen);
        }
        let x2 = root(|x| self.under_highest(x), self.x0, 0.0);
        (self.x0 - x2, x2)
    }
}

/// The root between a place where the function is not negative and one where it is not positive: by Newton's steps from the
/// latter, halving where they leave the interval.
fn root(function: impl Fn(f64) -> [f64; 2], mut inside: f64, mut outside: f64) -> f64 {
    let mut x = outside;
    for step in 0..MOST_STEPS {
        let [value, slope] = function(x);
        if step == 0 && 0.0 <= value {
            // Zero but for rounding: the root, if the function is positive inside of it.
            if 0.0 <= slope * (inside - x) {
                return x;
            }
            x = 0.5 * (inside + outside);
            continue;
        }
        if 0.0 < value {
            inside = x;
        } else {
            outside = x;
        }
        let newton = x - value / slope;
        let is_between = (newton - inside) * (newton - outside) < 0.0;
        let next = if is_between { newton } else { 0.5 * (inside + outside) };
        if (next - x).abs() <= 0.5 * f64::EPSILON * next.abs() {
            return next;
        }
        x = next;
    }
    x
}
