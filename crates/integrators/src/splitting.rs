//! The coefficients of symmetric splittings of q̇ = u(t, p), ṗ = w(t, q).

use crate::order::{Order, substeps_of};

/// A symmetric splitting of separable systems: drifts q ← q + aₖh u(p) and kicks p ← p + bₖh w(q) in turn.
///
/// ```text
/// a₀ b₁ a₁ b₂ … bₛ aₛ,    Σ a = Σ b = 1,    aₖ = aₛ₋ₖ,  bₖ = bₛ₊₁₋ₖ
/// ```
/// | scheme | order | forces a step | for |
/// |---|---|---|---|
/// | [`Composition`](Self::Composition) | 2, 4, 6, 8 | 1, 5, 9, 17 | any separable system |
/// | [`Composition10`](Self::Composition10) | 10 | 35 | any separable system |
/// | [`Nystrom4`](Self::Nystrom4) | 4 | 6 | ṗ = w(t, q), q̇ = M⁻¹p with a constant M |
/// | [`Nystrom6`](Self::Nystrom6) | 6 | 11 | the same |
/// | [`Nystrom6Long`](Self::Nystrom6Long) | 6 | 14 | the same |
///
/// Where the kinetic energy is quadratic in p with a constant mass matrix, the threefold bracket of the potential with itself and
/// the kinetic energy vanishes. Runge–Kutta–Nyström splittings use that: they have fewer conditions to obey and smaller errors. On
/// other systems their order is lower, and nothing tells.
///
/// # Accuracy
/// The coefficients are given as doubles. Evaluated with 31 digits at them, the order conditions are obeyed to
/// 2e-15 (tests `compositions_of_order_ten_obey_all_conditions`, `nystrom_splittings_obey_all_conditions`).
///
/// # Example
/// ```
/// use piola_integrators::{Order, SplittingScheme};
/// assert_eq!((SplittingScheme::Nystrom6.order(), SplittingScheme::Nystrom6.forces()), (6, 11));
/// assert_eq!(SplittingScheme::Composition(Order::Four).forces(), 5);
/// assert_eq!(SplittingScheme::Nystrom6.to_string(), "Nyström, order 6, 11 forces");
/// let drifts: f64 = SplittingScheme::Composition10.stages().map(|stage| stage.drift).sum();
/// assert!((drifts - 1.0).abs() < 1e-15);
/// ```
///
/// # References
/// Order 10: M. Sofroniou & G. Spaletta, Optim. Methods Softw. 20 (2005) 597. Nyström splittings, there called `SRKN₆ᵇ`, `SRKN₁₁ᵇ` and
/// `SRKN₁₄ᵃ`: S. Blanes & P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313, published with fifteen digits; Newton's method
/// on the order conditions refined them to full double precision (`testdata/scripts/nystrom_splittings.py`).
#[doc(alias("Blanes", "Moan", "SRKN", "Sofroniou", "Spaletta", "Runge-Kutta-Nyström"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SplittingScheme {
    /// A composition of Störmer–Verlet steps.
    Composition(Order),
    /// A composition of 35 Störmer–Verlet steps, of order ten.
    Composition10,
    /// Runge–Kutta–Nyström of order four, which begins and ends with a kick.
    Nystrom4,
    /// Runge–Kutta–Nyström of order six, which begins and ends with a kick.
    Nystrom6,
    /// Runge–Kutta–Nyström of order six with smaller coefficients of the error, which begins and ends with a drift.
    Nystrom6Long,
}

impl core::fmt::Display for SplittingScheme {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let order = self.order();
        if self.is_for_all_separable() {
            write!(formatter, "composition, order {order}")
        } else {
            write!(formatter, "Nyström, order {order}, {} forces", self.forces())
        }
    }
}

/// A drift and the kick after it, in units of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplittingStage {
    /// a of the drift.
    pub drift: f64,
    /// b of the kick; zero after the last drift.
    pub kick: f64,
    /// The time of the momenta during the drift: the kicks that are done.
    pub drift_time: f64,
    /// The time of the positions at the kick: the drifts that are done.
    pub kick_time: f64,
}

/// The largest number of stages: 35 kicks, and the last drift.
pub(crate) const MOST_STAGES: usize = 36;

impl SplittingScheme {
    /// All schemes, in the order of the table.
    pub const ALL: [Self; 8] = [
        Self::Composition(Order::Two),
        Self::Composition(Order::Four),
        Self::Composition(Order::Six),
        Self::Composition(Order::Eight),
        Self::Composition10,
        Self::Nystrom4,
        Self::Nystrom6,
        Self::Nystrom6Long,
    ];

    /// The order: the error of a run falls as hᵒʳᵈᵉʳ.
    #[must_use]
    pub const fn order(self) -> u32 {
        match self {
            Self::Composition(order) => order.value(),
            Self::Composition10 => 10,
            Self::Nystrom4 => 4,
            Self::Nystrom6 | Self::Nystrom6Long => 6,
        }
    }

    /// Evaluations of the force in a step. A scheme that ends with a kick begins its next step with the same force.
    #[must_use]
    pub const fn forces(self) -> u64 {
        match self {
            Self::Composition(Order::Two) => 1,
            Self::Composition(Order::Four) => 5,
            Self::Composition(Order::Six) => 9,
            Self::Composition(Order::Eight) => 17,
            Self::Composition10 => 35,
            Self::Nystrom4 => 6,
            Self::Nystrom6 => 11,
            Self::Nystrom6Long => 14,
        }
    }

    /// Whether every kinetic energy will do that depends on p and t alone, instead of one that is quadratic in p.
    #[must_use]
    pub const fn is_for_all_separable(self) -> bool {
        matches!(self, Self::Composition(_) | Self::Composition10)
    }

    /// The stages of a step.
    pub fn stages(self) -> impl Iterator<Item = SplittingStage> {
        let (stages, count) = self.table();
        stages.into_iter().take(count)
    }

    /// The stages, and how many there are.
    pub(crate) fn table(self) -> ([SplittingStage; MOST_STAGES], usize) {
        let mut table = Table::new();
        match self {
            Self::Composition(order) => table.compose(order.substeps()),
            Self::Composition10 => table.compose(substeps_of(&SOFRONIOU_SPALETTA_10)),
            Self::Nystrom4 => table.split(&NYSTROM_4),
            Self::Nystrom6 => table.split(&NYSTROM_6),
            Self::Nystrom6Long => table.split(&NYSTROM_6_LONG),
        }
        (table.stages, table.count)
    }
}

/// The stages of a symmetric splitting of half a palindrome, its middle included.
pub(crate) fn palindrome(half: &[f64]) -> ([SplittingStage; MOST_STAGES], usize) {
    let mut table = Table::new();
    table.split(half);
    (table.stages, table.count)
}

/// The stages of drifts and kicks in turn, whose sums vanish: the time at the end is that at the start.
pub(crate) fn processor(coefficients: &[f64], inverse: bool) -> ([SplittingStage; MOST_STAGES], usize) {
    let (mut table, all) = (Table::new(), coefficients.len());
    let of = |index: usize| if inverse { -coefficients[all - 1 - index] } else { coefficients[index] };
    table.alternate(all, of, 0.0);
    (table.stages, table.count)
}

struct Table {
    stages: [SplittingStage; MOST_STAGES],
    count: usize,
}

impl Table {
    const fn new() -> Self {
        let none = SplittingStage { drift: 0.0, kick: 0.0, drift_time: 0.0, kick_time: 0.0 };
        Self { stages: [none; MOST_STAGES], count: 0 }
    }

    fn push(&mut self, drift: f64, kick: f64, drift_time: f64, kick_time: f64) {
        self.stages[self.count] = SplittingStage { drift, kick, drift_time, kick_time };
        self.count += 1;
    }

    /// Störmer–Verlet steps γ₁ … γₛ, whose neighbouring drifts merge.
    fn compose(&mut self, substeps: impl Iterator<Item = f64>) {
        let (mut reached, mut previous) = (0.0, 0.0);
        for gamma in substeps {
            self.push(0.5 * (previous + gamma), gamma, reached, reached + 0.5 * gamma);
            reached += gamma;
            previous = gamma;
        }
        self.push(0.5 * previous, 0.0, 1.0, 1.0);
    }

    /// `all` drifts and kicks in turn; the drifts add up to `sum`, and so do the kicks.
    fn alternate(&mut self, all: usize, of: impl Fn(usize) -> f64, sum: f64) {
        let (mut drifted, mut kicked) = (0.0, 0.0);
        for index in (0..all).step_by(2) {
            let (drift, kick) = (of(index), if index + 1 < all { of(index + 1) } else { 0.0 });
            let is_last = index + 1 == all;
            self.push(drift, kick, if is_last { sum } else { kicked }, if is_last { sum } else { drifted + drift });
            drifted += drift;
            kicked += kick;
        }
    }

    /// Half of a palindrome of drifts and kicks, in turn, its middle included.
    fn split(&mut self, half: &[f64]) {
        let all = half.len() * 2 - 1;
        let of = |index: usize| if index < half.len() { half[index] } else { half[all - 1 - index] };
        self.alternate(all, of, 1.0);
        // After the last drift but one all kicks are done, and after a kick at the end all drifts.
        if half[0].abs() <= 0.0 {
            self.stages[self.count - 2].kick_time = 1.0;
        }
    }
}

// First halves of the symmetric lists; the middle one of a composition is 1 − 2 Σ.
const SOFRONIOU_SPALETTA_10: [f64; 17] = [
    0.078_795_722_521_686_41,
    0.313_096_103_415_108_5,
    0.027_918_383_235_078_066,
    -0.229_592_841_593_907_08,
    0.130_962_061_077_164_88,
    -0.269_733_405_654_510_7,
    0.074_973_343_155_891_44,
    0.111_993_423_999_810_2,
    0.366_133_449_546_226_73,
    -0.399_105_630_136_035_9,
    0.103_087_398_527_471_08,
    0.411_430_873_955_890_23,
    -0.004_866_360_583_135_261_6,
    -0.392_033_353_708_639_9,
    0.051_942_502_962_449_65,
    0.050_665_090_759_924_494,
    0.049_674_370_639_729_876,
];
const NYSTROM_4: [f64; 8] = [
    0.0,
    0.082_984_406_417_405_02,
    0.245_298_957_184_271_17,
    0.396_309_801_498_368_1,
    0.604_872_665_711_08,
    -0.039_056_304_922_348_434,
    -0.350_171_622_895_351_14,
    0.119_524_194_013_150_68,
];
const NYSTROM_6: [f64; 13] = [
    0.0,
    0.041_464_998_518_262_845,
    0.123_229_775_946_271_16,
    0.198_128_671_918_066_55,
    0.290_553_797_799_558_26,
    -0.040_006_192_104_152_69,
    -0.127_049_212_625_416_9,
    0.075_253_984_301_580_34,
    -0.246_331_761_062_075_4,
    -0.011_511_387_420_687_77,
    0.357_208_872_795_927_8,
    0.236_669_924_786_930_72,
    0.204_777_054_291_470_28,
];
const NYSTROM_6_LONG: [f64; 15] = [
    0.037_859_319_840_610_944,
    0.091_719_152_624_462_02,
    0.102_635_633_102_436_55,
    0.183_983_170_005_004_9,
    -0.025_867_888_266_558_333,
    -0.056_534_365_832_889_1,
    0.314_241_403_071_446_43,
    0.004_914_688_774_711_885,
    -0.130_144_459_517_415_1,
    0.143_761_127_168_361_67,
    0.106_417_700_369_541_37,
    0.328_567_693_746_804_1,
    -0.008_794_243_128_510_204,
    -0.196_411_466_486_455_52,
    0.207_305_069_056_896_72,
];
