//! Points and weights of Kronrod's and Gauss's rules.

/// Nodes and weights of Kronrod's rule on (−1, 1) and of Gauss's rule at every second of its nodes.
///
/// # Source
/// A. S. Kronrod, *Nodes and Weights of Quadrature Formulas* (1965). The numbers are the roots and integrals themselves, found
/// in eighty digits and rounded once.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct GaussKronrod {
    /// The positive nodes, from the outside inwards; those of odd index are Gauss's too. A centre at zero follows.
    pub nodes: &'static [f64],
    /// Kronrod's weights, that of the centre last.
    pub kronrod: &'static [f64],
    /// Gauss's weights of the nodes of odd index.
    pub gauss: &'static [f64],
    /// Gauss's weight of the centre; zero where the centre is none of his nodes.
    pub gauss_at_centre: f64,
    /// Lagrange's polynomials of all nodes, ascending, at the end 1: a polynomial through the nodes is there Σ weight · value.
    pub extrapolation: &'static [f64],
}

impl GaussKronrod {
    /// Fifteen points, exact for polynomials of degree 22, with seven of Gauss's, exact for degree 13.
    pub const POINTS_15: Self = Self {
        nodes: &NODES_15,
        kronrod: &KRONROD_15,
        gauss: &GAUSS_7,
        gauss_at_centre: 0.417_959_183_673_469_4,
        extrapolation: &EXTRAPOLATION_15,
    };
    /// Twenty-one points, exact for polynomials of degree 31, with ten of Gauss's, exact for degree 19.
    pub const POINTS_21: Self = Self {
        nodes: &NODES_21,
        kronrod: &KRONROD_21,
        gauss: &GAUSS_10,
        gauss_at_centre: 0.0,
        extrapolation: &EXTRAPOLATION_21,
    };
}

/// Pairs of nodes of the largest rule.
pub(super) const MOST_PAIRS: usize = 10;

const NODES_15: [f64; 7] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_5,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_48,
];
const KRONROD_15: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_19,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_42,
    0.204_432_940_075_298_89,
    0.209_482_141_084_727_82,
];
const GAUSS_7: [f64; 3] = [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9];
const EXTRAPOLATION_15: [f64; 15] = extrapolation(&NODES_15);

const NODES_21: [f64; 10] = [
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
];
const KRONROD_21: [f64; 11] = [
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
const GAUSS_10: [f64; 5] = [
    0.066_671_344_308_688_14,
    0.149_451_349_150_580_6,
    0.219_086_362_515_982_04,
    0.269_266_719_309_996_35,
    0.295_524_224_714_752_87,
];
const EXTRAPOLATION_21: [f64; 21] = extrapolation(&NODES_21);

/// Lagrange's polynomials of the nodes ±`nodes` and 0, ascending, at 1.
const fn extrapolation<const N: usize>(nodes: &[f64]) -> [f64; N] {
    let mut all = [0.0; N];
    let mut k = 0;
    while k < nodes.len() {
        all[k] = -nodes[k];
        all[N - 1 - k] = nodes[k];
        k += 1;
    }
    let mut weights = [1.0; N];
    k = 0;
    while k < N {
        let mut j = 0;
        while j < N {
            if j != k {
                weights[k] *= (1.0 - all[j]) / (all[k] - all[j]);
            }
            j += 1;
        }
        k += 1;
    }
    weights
}
