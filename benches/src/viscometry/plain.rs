//! What a textbook does: adaptive quadrature by Gauss's and Kronrod's rules of 7 and 15 points, of the printed formula.

use piola_numerics::gauss_kronrod::{GAUSS, KRONROD, NODES};

/// The name by which it goes as a peer.
pub const NAME: &str = "adaptive Gauss-Kronrod 7-15 (QUADPACK's error), rates by Newton's method";

/// The most intervals.
const MOST: usize = 400;

/// A part of an interval with its integral.
#[derive(Clone, Copy, Debug)]
struct Part {
    from: f64,
    to: f64,
    value: f64,
    error: f64,
}

impl Part {
    fn integrate(from: f64, to: f64, integrand: &mut impl FnMut(f64) -> f64) -> Self {
        let (centre, half) = (f64::midpoint(from, to), 0.5 * (to - from));
        let mut values = [0.0; 15];
        let (mut kronrod, mut gauss) = (0.0, 0.0);
        for (k, node) in NODES.into_iter().enumerate() {
            for (side, sign) in [1.0, -1.0].into_iter().enumerate().take(if k < 7 { 2 } else { 1 }) {
                let value = integrand(centre + sign * half * node);
                values[2 * k + side] = value;
                kronrod += KRONROD[k] * value;
                if k % 2 == 1 {
                    gauss += GAUSS[k / 2] * value;
                }
            }
        }
        let mean = 0.5 * kronrod;
        let variation: f64 = (0..15).map(|i| KRONROD[i / 2] * (values[i] - mean).abs()).sum();
        let difference = (kronrod - gauss).abs();
        let share = if variation > 0.0 { (200.0 * difference / variation).powf(1.5).min(1.0) } else { 0.0 };
        Self { from, to, value: kronrod * half, error: (variation * share * half).abs() }
    }
}

/// ∫ f to a relative tolerance, as far as 400 intervals reach, and how often f was evaluated.
pub fn integrate(from: f64, to: f64, tolerance: f64, mut integrand: impl FnMut(f64) -> f64) -> (f64, usize) {
    let mut parts = vec![Part::integrate(from, to, &mut integrand)];
    loop {
        let value: f64 = parts.iter().map(|part| part.value).sum();
        let error: f64 = parts.iter().map(|part| part.error).sum();
        if error <= tolerance * value.abs() || MOST <= parts.len() {
            return (value, 15 * (2 * parts.len() - 1));
        }
        let worst = (0..parts.len()).max_by(|&a, &b| parts[a].error.total_cmp(&parts[b].error)).unwrap_or(0);
        let Part { from, to, .. } = parts.swap_remove(worst);
        let middle = f64::midpoint(from, to);
        parts.push(Part::integrate(from, middle, &mut integrand));
        parts.push(Part::integrate(middle, to, &mut integrand));
    }
}

/// Where an increasing function of positive numbers is `target`, by secants of logarithms from two places near one another.
pub fn inverse(target: f64, start: f64, tolerance: f64, mut function: impl FnMut(f64) -> f64) -> f64 {
    let (mut a, mut b) = (start, 1.1 * start);
    let (mut at_a, mut at_b) = ((function(a) / target).ln(), (function(b) / target).ln());
    for _ in 0..60 {
        if at_b.abs() <= tolerance || (at_b - at_a).abs() <= 0.0 {
            break;
        }
        let next = b * (-at_b * (b / a).ln() / (at_b - at_a)).exp();
        (a, at_a) = (b, at_b);
        b = next;
        at_b = (function(b) / target).ln();
    }
    b
}

#[cfg(test)]
mod tests {
    use super::{integrate, inverse};

    #[test]
    fn the_integral_of_a_kink_equals_its_area_to_the_tolerance() {
        for power in 3..=12 {
            let tolerance = 10.0_f64.powi(-power);
            let (value, _) = integrate(0.0, 1.0, tolerance, |x| (x - 1.0 / 3.0).max(0.0));
            assert!((value / (2.0 / 9.0) - 1.0).abs() <= tolerance);
        }
    }

    #[test]
    fn the_place_of_a_power_equals_its_root() {
        assert!((inverse(8.0, 1.0, 1e-14, |x| x * x * x) / 2.0 - 1.0).abs() < 1e-14);
    }
}
