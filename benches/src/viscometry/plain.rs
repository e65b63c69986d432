//! What a textbook does: adaptive quadrature by Gauss's and Kronrod's rules of 7 and 15 points, of the printed formula.

/// The name by which it goes as a peer.
pub const NAME: &str = "adaptive Gauss-Kronrod 7-15 (QUADPACK's error), rates by Newton's method";

/// The most intervals.
const MOST: usize = 400;

/// The nodes that are not negative, from the outside inwards.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_5,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
/// Kronrod's weights, the centre last.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_19,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_42,
    0.204_432_940_075_298_89,
    0.209_482_141_084_727_83,
];
/// Gauss's weights at the nodes of odd index, the centre last.
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

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
