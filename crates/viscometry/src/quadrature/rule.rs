//! Kronrod's rule of 21 points with Gauss's of 10 in it, on one panel.

/// Positive nodes of Kronrod's rule, descending; the odd positions are Gauss's. The last is the centre.
///
/// R. Piessens, E. de Doncker-Kapenga, C. W. Überhuber, D. K. Kahaner, *QUADPACK*, Springer 1983, rule QK21.
const NODES: [f64; 11] = [
    0.995_657_163_025_808_1,
    0.973_906_528_517_171_7,
    0.930_157_491_355_708_2,
    0.865_063_366_688_984_5,
    0.780_817_726_586_416_9,
    0.679_409_568_299_024_4,
    0.562_757_134_668_604_7,
    0.433_395_394_129_247_2,
    0.294_392_862_701_460_2,
    0.148_874_338_981_631_22,
    0.0,
];

/// Kronrod's weights of [`NODES`].
const KRONROD: [f64; 11] = [
    0.011_694_638_867_371_874,
    0.032_558_162_307_964_725,
    0.054_755_896_574_351_995,
    0.075_039_674_810_919_96,
    0.093_125_454_583_697_6,
    0.109_387_158_802_297_64,
    0.123_491_976_262_065_84,
    0.134_709_217_311_473_34,
    0.142_775_938_577_060_09,
    0.147_739_104_901_338_49,
    0.149_445_554_002_916_9,
];

/// Gauss's weights of the nodes at odd positions.
const GAUSS: [f64; 5] = [
    0.066_671_344_308_688_14,
    0.149_451_349_150_580_6,
    0.219_086_362_515_982_04,
    0.269_266_719_309_996_35,
    0.295_524_224_714_752_87,
];

/// A part of the interval with its integral.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Panel {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) value: f64,
    pub(super) error: f64,
    /// The part of the error that no bisection removes.
    pub(super) rounding: f64,
}

impl Panel {
    /// The integral over one panel, and the error as QUADPACK estimates it.
    pub(super) fn integrate<E>(
        from: f64,
        to: f64,
        integrand: &mut impl FnMut(f64) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut values = [[0.0; 2]; 10];
        let middle = integrand(centre)?;
        let (mut kronrod, mut gauss, mut size) = (KRONROD[10] * middle, 0.0, KRONROD[10] * middle.abs());
        for (i, pair) in values.iter_mut().enumerate() {
            let offset = half * NODES[i];
            *pair = [integrand(centre - offset)?, integrand(centre + offset)?];
            kronrod += KRONROD[i] * (pair[0] + pair[1]);
            size += KRONROD[i] * (pair[0].abs() + pair[1].abs());
            if i % 2 == 1 {
                gauss += GAUSS[i / 2] * (pair[0] + pair[1]);
            }
        }
        // The variation about the mean is the scale of the difference of the rules.
        let mean = 0.5 * kronrod;
        let mut variation = KRONROD[10] * (middle - mean).abs();
        for (i, pair) in values.iter().enumerate() {
            variation += KRONROD[i] * ((pair[0] - mean).abs() + (pair[1] - mean).abs());
        }
        let difference = (kronrod - gauss).abs();
        let scaled =
            if variation > 0.0 { variation * (200.0 * difference / variation).powf(1.5).min(1.0) } else { difference };
        let half = half.abs();
        let rounding = 8.0 * f64::EPSILON * size * half;
        let sign = if from <= to { 1.0 } else { -1.0 };
        Ok(Self { from, to, value: sign * kronrod * half, error: scaled * half + rounding, rounding })
    }
}

#[cfg(test)]
mod tests {
    use super::{GAUSS, KRONROD, NODES};

    /// ∫ xᵐ dx over (−1, 1) for even m.
    fn moment(weights: impl Iterator<Item = (f64, f64)>, power: i32) -> f64 {
        weights
            .map(
                |(node, weight)| {
                    if node == 0.0 { weight * 0.0_f64.powi(power) } else { 2.0 * weight * node.powi(power) }
                },
            )
            .sum()
    }

    #[test]
    fn kronrods_rule_equals_the_integral_of_every_polynomial_to_degree_31_and_gausss_to_19() {
        for power in (0..=31).step_by(2) {
            let exact = 2.0 / f64::from(power + 1);
            let kronrod = moment(NODES.into_iter().zip(KRONROD), power);
            assert!((kronrod - exact).abs() <= 4.0 * f64::EPSILON, "{power}");
            if power <= 19 {
                let gauss = moment(NODES.into_iter().skip(1).step_by(2).zip(GAUSS), power);
                assert!((gauss - exact).abs() <= 4.0 * f64::EPSILON, "{power}");
            }
        }
    }
}
