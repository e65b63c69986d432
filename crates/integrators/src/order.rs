//! Orders of methods with equal steps, and the substeps of symmetric compositions.

/// The order of a fixed-step method: the error of a run falls as hᵒʳᵈᵉʳ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Order {
    /// Second order.
    Two,
    /// Fourth order.
    Four,
    /// Sixth order.
    Six,
    /// Eighth order.
    Eight,
}

impl Order {
    /// All orders, ascending.
    pub const ALL: [Self; 4] = [Self::Two, Self::Four, Self::Six, Self::Eight];

    /// The order as a number.
    #[must_use]
    pub const fn value(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Six => 6,
            Self::Eight => 8,
        }
    }

    /// The steps of second order that a step of this order is composed of, in units of the step: γ₁, …, γₛ.
    ///
    /// Any symmetric map of second order may be composed, as a free rotation between two kicks.
    ///
    /// # Example
    /// ```
    /// use piola_integrators::Order;
    /// assert_eq!(Order::Two.substeps().collect::<Vec<_>>(), [1.0]);
    /// // ẋ = v, v̇ = −x by kick, drift, kick: a radian in ten steps of order eight.
    /// let [mut x, mut v] = [1.0_f64, 0.0];
    /// for _ in 0..10 {
    ///     for h in Order::Eight.substeps().map(|part| 0.1 * part) {
    ///         v -= 0.5 * h * x;
    ///         x += h * v;
    ///         v -= 0.5 * h * x;
    ///     }
    /// }
    /// assert!((x - 1.0_f64.cos()).abs() < 1e-11);
    /// ```
    pub fn substeps(self) -> impl Iterator<Item = f64> {
        let half: &[f64] = match self {
            Self::Two => &[],
            Self::Four => &SUZUKI_4,
            Self::Six => &KAHAN_LI_6,
            Self::Eight => &KAHAN_LI_8,
        };
        substeps_of(half)
    }
}

/// A symmetric list whose sum is one, from its first half.
pub(crate) fn substeps_of(half: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let middle = 1.0 - 2.0 * half.iter().sum::<f64>();
    half.iter().copied().chain([middle]).chain(half.iter().rev().copied())
}

// First halves of the symmetric coefficient lists; the middle one is 1 − 2 Σ, so that each list sums to one.
const SUZUKI_4: [f64; 2] = [0.414_490_771_794_375_7, 0.414_490_771_794_375_7];
const KAHAN_LI_6: [f64; 4] =
    [0.392_161_444_007_314_1, 0.332_599_136_789_359_44, -0.706_246_172_557_639_4, 0.082_213_596_293_550_8];
const KAHAN_LI_8: [f64; 8] = [
    0.130_202_483_088_890_08,
    0.561_162_981_775_108_4,
    -0.389_474_962_644_847_3,
    0.158_841_906_555_155_6,
    -0.395_903_894_133_237_57,
    0.184_539_640_978_315_7,
    0.258_374_387_686_322_04,
    0.295_011_723_609_310_3,
];
