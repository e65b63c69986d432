//! Integrals of power along paths, on which the stress may have kinks and jumps.

use piola_numerics::gauss_kronrod::{GAUSS, KRONROD, NODES};

/// The most panels of one integral.
const MOST: usize = 1024;

/// Errors below this share of ∫ |P| |F′| of a panel are rounding: halving it helps no more.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The nodes of the rule, ascending in (−1, 1).
const POINTS: [f64; 15] = {
    let mut points = [0.0; 15];
    let mut k = 0;
    while k < 7 {
        points[k] = -NODES[k];
        points[14 - k] = NODES[k];
        k += 1;
    }
    points
};

/// Lagrange's polynomials of the nodes at the end 1: what a smooth integrand has there. At −1 in the opposite order.
const AT_END: [f64; 15] = {
    let mut weights = [1.0; 15];
    let mut k = 0;
    while k < 15 {
        let mut j = 0;
        while j < 15 {
            if j != k {
                weights[k] *= (1.0 - POINTS[j]) / (POINTS[k] - POINTS[j]);
            }
            j += 1;
        }
        k += 1;
    }
    weights
};

/// ∫ P : dF and ∫ |P| |dF|.
pub(super) struct Integral {
    pub(super) work: f64,
    pub(super) scale: f64,
    /// The error of `work`, estimated.
    pub(super) error: f64,
}

#[derive(Clone, Copy)]
struct Panel {
    side: usize,
    low: f64,
    high: f64,
    work: f64,
    scale: f64,
    error: f64,
}

/// The integral over a panel, its error from what the two rules differ by and from what the integrand has at the ends.
///
/// A kink between an end and the node next to it is seen by neither rule, but at the end itself: there the integrand differs
/// from its continuation by as much as it does at most in between.
fn panel(f: &impl Fn(usize, f64) -> Option<[f64; 2]>, side: usize, low: f64, high: f64) -> Option<Panel> {
    let (centre, half) = (f64::midpoint(low, high), 0.5 * (high - low));
    let (mut fine, mut coarse, mut scale, mut ends) = (0.0, 0.0, 0.0, [f(side, low)?[0], f(side, high)?[0]]);
    for (k, point) in POINTS.into_iter().enumerate() {
        let pair = k.min(14 - k);
        let [power, size] = f(side, centre + half * point)?;
        fine += KRONROD[pair] * power;
        scale += KRONROD[pair] * size;
        if pair % 2 == 1 {
            coarse += GAUSS[pair / 2] * power;
        }
        ends = [ends[0] - AT_END[14 - k] * power, ends[1] - AT_END[k] * power];
    }
    let unseen = (1.0 - NODES[0]) * (ends[0].abs() + ends[1].abs());
    let error = half * ((fine - coarse).abs() + unseen);
    Some(Panel { side, low, high, work: half * fine, scale: half * scale, error })
}

/// The halves of a panel. By luck the two rules can agree across a kink: then what halving has changed tells of it.
fn halves(f: &impl Fn(usize, f64) -> Option<[f64; 2]>, whole: &Panel) -> Option<[Panel; 2]> {
    let middle = f64::midpoint(whole.low, whole.high);
    let halves = [panel(f, whole.side, whole.low, middle)?, panel(f, whole.side, middle, whole.high)?];
    let change = (halves[0].work + halves[1].work - whole.work).abs();
    Some(halves.map(|half| Panel { error: half.error.max(0.5 * change), ..half }))
}

/// The integral of f(side, s) = (P : F′, |P| |F′|) over 0 ≤ s ≤ 1 of all sides; none where f has no value.
///
/// The panel with the largest error is halved until the sum of errors is below `share` of ∫ |P| |dF|, until only rounding is
/// left, or until there are as many panels as are allowed.
pub(super) fn integrate(sides: usize, share: f64, f: impl Fn(usize, f64) -> Option<[f64; 2]>) -> Option<Integral> {
    let mut panels = Vec::with_capacity(8 * sides);
    for side in 0..sides {
        panels.extend(halves(&f, &panel(&f, side, 0.0, 1.0)?)?);
    }
    loop {
        let mut sum = Integral { work: 0.0, scale: 0.0, error: 0.0 };
        for panel in &panels {
            sum.work += panel.work;
            sum.scale += panel.scale;
            sum.error += panel.error;
        }
        let done = sum.error <= share * sum.scale || MOST <= panels.len() || !sum.error.is_finite();
        let worst = (0..panels.len())
            .filter(|&k| ROUNDING * panels[k].scale < panels[k].error)
            .max_by(|&a, &b| panels[a].error.total_cmp(&panels[b].error));
        let Some(worst) = worst.filter(|_| !done) else { return Some(sum) };
        let whole = panels.swap_remove(worst);
        panels.extend(halves(&f, &whole)?);
    }
}
