//! A rising curve y(u) that is given by the logarithm of its slope.
//!
//! ```text
//! t = (u + y)/2      θ(t) = ln dy/du = Σ cⱼ Bⱼ(t)      du/dt = 2/(1 + e^θ)      y = 2 t − u
//! ```
//! t runs along the curve: steep stretches (a discharge near the yield stress) and flat ones (a torque near it) are as long in t as a power
//! law, of which θ is constant. Near a yield stress θ is a straight line in t.
//!
//! The parameters are u at the anchor and c₀, c₁, …

use std::sync::Arc;

use nalgebra::DMatrix;

use super::splines::{Derivatives, Splines};

/// Gauss and Legendre's four points of [0, 1].
pub(super) const FOUR: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];
/// Panels of an interval between knots.
const PANELS: usize = 2;
/// |θ| that counts: slopes beyond are as good as these.
const STEEPEST: f64 = 60.0;
/// The degree of θ.
pub(super) const DEGREE: usize = 3;

/// Coefficients of a cubic polynomial of x, 0 ≤ x ≤ 1.
type Cubic = [f64; DEGREE + 1];

fn value([a, b, c, d]: &Cubic, x: f64) -> f64 {
    a + x * (b + x * (c + x * d))
}

fn slope([_, b, c, d]: &Cubic, x: f64) -> f64 {
    b + x * (2.0 * c + x * 3.0 * d)
}

/// A stretch of t, with the splines that do not vanish on it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Panel {
    from: f64,
    width: f64,
    /// The first of the splines.
    first: usize,
    splines: [Cubic; DEGREE + 1],
}

/// Splines of θ on panels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Panels {
    panels: Vec<Panel>,
    count: usize,
}

impl Panels {
    /// Of cubic splines.
    pub(super) fn of(splines: &Splines) -> Self {
        let panel = |[from, to]: [f64; 2]| {
            let (first, derivatives) = splines.derivatives(from);
            let width = to - from;
            let scales = [1.0, width, 0.5 * width * width, width * width * width / 6.0];
            let of_spline = |i: usize| core::array::from_fn(|k| scales[k] * derivatives[k][i]);
            Panel { from, width, first, splines: core::array::from_fn(of_spline) }
        };
        let parts =
            |[a, b]: [f64; 2]| (0..PANELS).map(move |k| [k, k + 1].map(|k| a + (b - a) * k as f64 / PANELS as f64));
        Self { panels: splines.intervals().flat_map(parts).map(panel).collect(), count: splines.count() }
    }

    /// The number of panels.
    pub(super) fn len(&self) -> usize {
        self.panels.len()
    }

    /// The beginning of a panel.
    pub(super) fn from(&self, panel: usize) -> f64 {
        self.panels[panel].from
    }
}

/// The curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LogSlope {
    panels: Arc<Panels>,
    /// θ on each panel.
    theta: Vec<Cubic>,
    /// e^θ at the ends of the panels.
    ends: Vec<f64>,
    /// u at the ends of the panels.
    along: Vec<f64>,
    /// −∂u/∂cⱼ at the ends of the panels: a column each.
    reach: DMatrix<f64>,
}

/// Where u is: its panel, x there, and how far beyond the ends of all panels t is.
#[derive(Clone, Copy)]
struct Place {
    panel: usize,
    x: f64,
    beyond: f64,
}

impl LogSlope {
    /// With u at the beginning of the panel `anchor` as the first parameter.
    pub(super) fn new(panels: &Arc<Panels>, anchor: usize, parameters: &[f64]) -> Self {
        let (count, all) = (panels.count, &panels.panels);
        let mut curve = Self {
            panels: Arc::clone(panels),
            theta: Vec::with_capacity(all.len()),
            ends: Vec::with_capacity(all.len() + 1),
            along: vec![0.0; all.len() + 1],
            reach: DMatrix::zeros(count, all.len() + 1),
        };
        let coefficients = &parameters[1..];
        for panel in all {
            let sum = |k: usize| panel.splines.iter().zip(&coefficients[panel.first..]).map(|(s, c)| c * s[k]).sum();
            curve.theta.push(core::array::from_fn(sum));
        }
        for panel in 0..all.len() {
            let (first, length, parts) = curve.kernel(panel, 1.0);
            curve.ends.push(curve.steepness(panel, 0.0));
            curve.along[panel + 1] = curve.along[panel] + length;
            let (before, mut after) = curve.reach.columns_range_pair_mut(panel, panel + 1);
            after.copy_from(&before);
            for (j, part) in parts.into_iter().enumerate() {
                after[first + j] += part;
            }
        }
        curve.ends.push(curve.steepness(all.len() - 1, 1.0));
        let (shift, anchored) = (parameters[0] - curve.along[anchor], curve.reach.column(anchor).into_owned());
        curve.along.iter_mut().for_each(|u| *u += shift);
        curve.reach.column_iter_mut().for_each(|mut column| column -= &anchored);
        curve
    }

    /// The number of parameters.
    pub(super) fn count(&self) -> usize {
        self.panels.count + 1
    }

    /// e^θ.
    fn steepness(&self, panel: usize, x: f64) -> f64 {
        value(&self.theta[panel], x).clamp(-STEEPEST, STEEPEST).exp()
    }

    /// ∫ du/dt dt from the beginning of a panel.
    fn length(&self, panel: usize, x: f64) -> f64 {
        let part = |(node, weight): (f64, f64)| weight * 2.0 / (1.0 + self.steepness(panel, x * node));
        x * self.panels.panels[panel].width * FOUR.into_iter().map(part).sum::<f64>()
    }

    /// ∫ du/dt dt and ∫ 2 e^θ/(1 + e^θ)² Bⱼ dt from the beginning of a panel, from the first spline on.
    fn kernel(&self, panel: usize, x: f64) -> (usize, f64, [f64; DEGREE + 1]) {
        let Panel { width, first, splines, .. } = &self.panels.panels[panel];
        let (mut length, mut sums) = (0.0, [0.0; DEGREE + 1]);
        for (node, weight) in FOUR {
            let rest = (1.0 + self.steepness(panel, x * node)).recip();
            let size = x * width * weight * 2.0 * rest;
            length += size;
            for (sum, spline) in sums.iter_mut().zip(splines) {
                *sum += size * (1.0 - rest) * value(spline, x * node);
            }
        }
        (*first, length, sums)
    }

    /// Where u is; beyond the ends along the tangent.
    fn place(&self, u: f64) -> Place {
        let last = self.theta.len();
        let beyond = |edge: usize, panel: usize, x: f64| {
            let beyond = (u - self.along[edge]) * 0.5 * (1.0 + self.steepness(panel, x));
            Place { panel, x, beyond }
        };
        if u < self.along[0] {
            return beyond(0, 0, 0.0);
        }
        if self.along[last] < u {
            return beyond(last, last - 1, 1.0);
        }
        let panel = self.along[1..last].partition_point(|edge| *edge <= u);
        let (before, after) = (self.along[panel], self.along[panel + 1]);
        let half = 0.5 / self.panels.panels[panel].width;
        // The cubic of u with the slopes at both ends is near: Newton's method squares what it misses.
        let share = ((u - before) / (after - before)).clamp(0.0, 1.0);
        let [low, high] = [0, 1].map(|end| (after - before) * half * (1.0 + self.ends[panel + end]) - 1.0);
        let bend = share * (1.0 - share) * (low * (1.0 - share) - high * share);
        let mut x = (share + bend).clamp(0.0, 1.0);
        for _ in 0..12 {
            let missing = u - before - self.length(panel, x);
            let next = (x + missing * half * (1.0 + self.steepness(panel, x))).clamp(0.0, 1.0);
            let step = (next - x).abs();
            x = next;
            if step <= 1e-9 {
                break;
            }
        }
        Place { panel, x, beyond: 0.0 }
    }

    /// t and the derivatives of θ there, and e^θ.
    fn here(&self, Place { panel, x, beyond }: Place) -> (f64, [f64; 3], f64) {
        let (Panel { from, width, .. }, theta) = (&self.panels.panels[panel], &self.theta[panel]);
        let (second, third) = (2.0 * theta[2] + 6.0 * theta[3] * x, 6.0 * theta[3]);
        let derivatives = [slope(theta, x) / width, second / (width * width), third / (width * width * width)];
        (from + width * x + beyond, derivatives, self.steepness(panel, x))
    }

    /// y and its four derivatives.
    pub(super) fn at(&self, u: f64) -> Derivatives {
        let (t, [a, b, c], s) = self.here(self.place(u));
        let (two, three, four) = (s * s, s * s * s, (1.0 + s) / 8.0);
        [
            2.0 * t - u,
            s,
            0.5 * (s + two) * a,
            0.25 * (1.0 + s) * ((s + 2.0 * two) * a * a + (s + two) * b),
            four * ((s + 6.0 * two + 6.0 * three) * a * a * a
                + (3.0 * s + 10.0 * two + 7.0 * three) * a * b
                + (s + 2.0 * two + three) * c),
        ]
    }

    /// y at u; its derivatives with respect to all parameters, times a weight, are added to a row.
    pub(super) fn accumulate_value(&self, row: &mut [f64], weight: f64, u: f64) -> f64 {
        let place = self.place(u);
        let (t, _, s) = self.here(place);
        self.add(row, place, [-weight * (1.0 + s), 0.0, 0.0]);
        2.0 * t - u
    }

    /// Adds Σ `weights[k]` ∂y⁽ᵏ⁾(u)/∂p, k ≤ 2, to a row of all parameters.
    pub(super) fn accumulate(&self, row: &mut [f64], weights: Derivatives, u: f64) {
        let place = self.place(u);
        let (_, [a, b, _], s) = self.here(place);
        let [of_value, first, second, ..] = weights;
        let (half, steep) = (0.5 * (s + s * s), 0.5 * (s + 2.0 * s * s) * a);
        let of_t = 2.0 * of_value + s * a * first + second * (steep * a + half * b);
        self.add(row, place, [-0.5 * (1.0 + s) * of_t, s * first + steep * second, half * second]);
    }

    /// Adds derivatives with respect to the parameters, which follow from those with respect to u, θ and dθ/dt.
    fn add(&self, row: &mut [f64], place: Place, [of_u, of_theta, of_slope]: [f64; 3]) {
        row[0] += of_u;
        let row = &mut row[1..];
        for (entry, reach) in row.iter_mut().zip(self.reach.column(place.panel).iter()) {
            *entry -= of_u * reach;
        }
        let Panel { width, splines, .. } = &self.panels.panels[place.panel];
        let (begin, _, kernel) = self.kernel(place.panel, place.x);
        for ((entry, part), spline) in row[begin..].iter_mut().zip(kernel).zip(splines) {
            *entry += of_theta * value(spline, place.x) + of_slope * slope(spline, place.x) / width - of_u * part;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::splines::Splines;
    use super::{LogSlope, Panels};

    fn curve(change: usize, by: f64) -> LogSlope {
        let abscissas: Vec<f64> = (0..9).map(|i| 0.5 * f64::from(i)).collect();
        let splines = Splines::on(&abscissas, 3);
        let mut parameters: Vec<f64> = (0..10).map(|k| 0.3 + (1.7 * f64::from(k)).sin()).collect();
        parameters[change] += by;
        LogSlope::new(&Arc::new(Panels::of(&splines)), 5, &parameters)
    }

    #[test]
    fn derivatives_of_the_curve_equal_differences_of_it() {
        let curve = curve(0, 0.0);
        let (u, h) = (0.5 * (curve.along[6] + curve.along[7]), 1e-4);
        let (low, here, high) = (curve.at(u - h), curve.at(u), curve.at(u + h));
        for k in 0..3 {
            let difference = (high[k] - low[k]) / (2.0 * h);
            assert!((difference - here[k + 1]).abs() < 1e-6 * (1.0 + here[k + 1].abs()), "{k}: {difference} {here:?}");
        }
        let along = (high[3] - low[3]) / (2.0 * h);
        assert!((along / here[4] - 1.0).abs() < 1e-4, "{along} {}", here[4]);
    }

    #[test]
    fn sensitivities_equal_differences_with_respect_to_each_parameter() {
        let main = curve(0, 0.0);
        for u in [0.3 * main.along[2] + 0.7 * main.along[3], 0.5 * (main.along[11] + main.along[12])] {
            for k in 0..3 {
                let mut weights = [0.0; 5];
                weights[k] = 1.0;
                let mut row = vec![0.0; main.count()];
                main.accumulate(&mut row, weights, u);
                for (j, found) in row.into_iter().enumerate() {
                    let h = 1e-5;
                    let difference = (curve(j, h).at(u)[k] - curve(j, -h).at(u)[k]) / (2.0 * h);
                    assert!((difference - found).abs() < 1e-7 * (1.0 + found.abs()), "{k}, {j}: {difference} {found}");
                }
            }
        }
    }
}
