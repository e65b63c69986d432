//! How Kepler's motions and the attractions between planets take turns.

use piola_integrators::IntegratorsError;

/// How a step alternates Kepler's motions (K) and the attractions between the planets (A), which are ε times as strong.
///
/// | splitting | attractions a step | error of the energy |
/// |---|---|---|
/// | [`Leapfrog`](Self::Leapfrog) | 1 | ε h² |
/// | [`Corrected`](Self::Corrected) | 1, and some where the state is shown | ε hⁿ⁺¹ + ε² h² |
/// | [`TenSixFour`](Self::TenSixFour) | 8 | ε h¹⁰ + ε² h⁶ + ε³ h⁴ |
///
/// # Example
/// ```
/// use piola_gravitation::wisdom_holman::{Corrector, Splitting};
/// assert_eq!(Splitting::Corrected(Corrector::Seventeen).attractions(), 1);
/// assert_eq!(Splitting::TenSixFour.attractions(), 8);
/// ```
///
/// # Source
/// J. Wisdom & M. Holman, Astron. J. 102 (1991) 1528; J. Wisdom, M. Holman & J. Touma, Fields Inst. Commun. 10 (1996) 217;
/// J. Wisdom, Astron. J. 131 (2006) 2294; S. Blanes, F. Casas, A. Farrés, J. Laskar, J. Makazaga & A. Murua, Appl. Numer.
/// Math. 68 (2013) 58.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Splitting {
    /// K/2 A K/2.
    Leapfrog,
    /// The same, between canonical maps that take the error of first order in ε away: one before the first step, its inverse
    /// where the state is shown.
    Corrected(Corrector),
    /// Eight attractions a step, of generalised order (10, 6, 4).
    #[doc(alias("SABA", "ABA1064"))]
    TenSixFour,
}

/// The order n of a symplectic corrector: what is left of the error of first order in ε is ε hⁿ⁺¹.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Corrector {
    /// Four attractions where the state is shown.
    Three,
    /// Eight.
    Five,
    /// Twelve.
    Seven,
    /// Twenty.
    Eleven,
    /// Thirty-two.
    Seventeen,
}

impl Splitting {
    /// Attractions a step.
    #[must_use]
    pub const fn attractions(self) -> usize {
        self.stages().attractions.len()
    }

    /// The number in a checkpoint, an index of [`NAMES`].
    pub(super) const fn number(self) -> usize {
        match self {
            Self::Leapfrog => 0,
            Self::TenSixFour => 1,
            Self::Corrected(Corrector::Three) => 2,
            Self::Corrected(Corrector::Five) => 3,
            Self::Corrected(Corrector::Seven) => 4,
            Self::Corrected(Corrector::Eleven) => 5,
            Self::Corrected(Corrector::Seventeen) => 6,
        }
    }

    /// Refuses a checkpoint with another number.
    pub(super) fn check_number<E>(self, number: f64) -> Result<(), IntegratorsError<E>> {
        match (0..NAMES.len()).find(|&index| (index as f64).total_cmp(&number).is_eq()) {
            Some(found) if found == self.number() => Ok(()),
            Some(found) => Err(IntegratorsError::WrongMethod { expected: NAMES[self.number()], found: NAMES[found] }),
            None => Err(IntegratorsError::InvalidRow {
                quantity: "checkpoint.numbers",
                index: PLACE_OF_NUMBER,
                value: number,
                dimension: NAMES.len(),
            }),
        }
    }

    pub(super) const fn stages(self) -> Stages {
        match self {
            Self::Leapfrog | Self::Corrected(_) => Stages { motions: &[0.5, 0.5], attractions: &[1.0] },
            Self::TenSixFour => Stages { motions: &MOTIONS_10_6_4, attractions: &ATTRACTIONS_10_6_4 },
        }
    }

    pub(super) const fn corrector(self) -> &'static [f64] {
        match self {
            Self::Corrected(Corrector::Three) => &[0.024_900_596_027_799_867],
            Self::Corrected(Corrector::Five) => &[0.041_500_993_379_666_446, -0.008_300_198_675_933_29],
            Self::Corrected(Corrector::Seven) => {
                &[0.053_964_399_093_127_5, -0.018_270_923_246_702_13, 0.002_492_681_142_692_210_6]
            }
            Self::Corrected(Corrector::Eleven) => &[
                0.072_593_394_748_842_74,
                -0.038_121_613_681_288_65,
                0.012_309_078_592_019_946,
                -0.002_348_721_529_229_535_4,
                0.000_203_615_796_478_546_5,
            ],
            Self::Corrected(Corrector::Seventeen) => &[
                0.093_056_103_771_425_96,
                -0.065_192_863_576_377_9,
                0.032_422_198_864_713_58,
                -0.012_071_760_822_342_29,
                0.003_313_257_706_938_065_6,
                -0.000_635_999_830_758_176_6,
                7.643_635_522_793_574e-5,
                -4.334_741_547_337_358e-6,
            ],
            Self::Leapfrog | Self::TenSixFour => &[],
        }
    }
}

/// Where a checkpoint keeps the number, after when the steps began, their length, how many are made, and whether the memory continues them.
const PLACE_OF_NUMBER: usize = 4;
/// The names of the splittings, by their numbers.
const NAMES: [&str; 7] = [
    "Leapfrog",
    "TenSixFour",
    "Corrected(Three)",
    "Corrected(Five)",
    "Corrected(Seven)",
    "Corrected(Eleven)",
    "Corrected(Seventeen)",
];

/// A step: motions and attractions in turn, from a motion to a motion, in units of the step.
#[derive(Clone, Copy)]
pub(super) struct Stages {
    pub(super) motions: &'static [f64],
    pub(super) attractions: &'static [f64],
}

/// √(7/40): the corrector's motions last k times as long, k = 1, 2, …, in units of the step.
pub(super) const CORRECTOR_MOTION: f64 = 0.418_330_013_267_037_8;

const MOTIONS_10_6_4: [f64; 9] = [
    0.038_094_497_422_412_196,
    0.145_298_716_116_913_75,
    0.207_627_695_725_541_25,
    0.435_909_703_651_526_16,
    -0.653_861_225_832_786_7,
    0.435_909_703_651_526_16,
    0.207_627_695_725_541_25,
    0.145_298_716_116_913_75,
    0.038_094_497_422_412_196,
];

const ATTRACTIONS_10_6_4: [f64; 8] = [
    0.095_858_880_837_075_21,
    0.204_446_153_142_998_78,
    0.217_070_347_978_991_1,
    -0.017_375_381_959_065_093,
    -0.017_375_381_959_065_093,
    0.217_070_347_978_991_1,
    0.204_446_153_142_998_78,
    0.095_858_880_837_075_21,
];

#[cfg(test)]
mod tests {
    use piola_numerics::sums::CompensatedSum;

    use super::{CORRECTOR_MOTION, Corrector, Splitting};

    /// Of first order in ε the splitting is a quadrature: ∫ tᵏ dt = 1/(k + 1), k < 10.
    #[test]
    fn attractions_integrate_polynomials_exactly() {
        for (splitting, order) in [(Splitting::Leapfrog, 2_i32), (Splitting::TenSixFour, 10)] {
            let stages = splitting.stages();
            for power in 0..order {
                let (mut time, mut sum) = (CompensatedSum::<f64>::new(), CompensatedSum::<f64>::new());
                for (motion, attraction) in stages.motions.iter().zip(stages.attractions) {
                    time.add(*motion);
                    sum.add(attraction * time.value().powi(power));
                }
                let expected = 1.0 / f64::from(power + 1);
                assert!((sum.value() - expected).abs() < 4e-16, "{splitting:?}, power {power}: {}", sum.value());
            }
            assert!((stages.motions.iter().sum::<f64>() - 1.0).abs() < 4e-16);
        }
    }

    /// The corrector is to take (x/sinh x − 1)/(2x) away, x = ½L with L the rate of change along Kepler's motion:
    /// Σ 4 bₖ sinh(k a L) = −(x/sinh x − 1)/L up to Lⁿ. Of x/sinh x = 1 − x²/6 + 7x⁴/360 − … the terms are
    /// −2 (2²ᵐ⁻¹ − 1) B₂ₘ x²ᵐ/(2m)!, with Bernoulli's numbers.
    #[test]
    fn correctors_take_the_error_of_first_order_away() {
        let bernoulli =
            [1.0 / 6.0, -1.0 / 30.0, 1.0 / 42.0, -1.0 / 30.0, 5.0 / 66.0, -691.0 / 2730.0, 7.0 / 6.0, -3617.0 / 510.0];
        assert!((CORRECTOR_MOTION.powi(2) - 0.175).abs() < 1e-16);
        let mut compared = 0;
        for (corrector, order) in [
            (Corrector::Three, 3),
            (Corrector::Five, 5),
            (Corrector::Seven, 7),
            (Corrector::Eleven, 11),
            (Corrector::Seventeen, 17),
        ] {
            let attractions = Splitting::Corrected(corrector).corrector();
            assert_eq!(2 * attractions.len() + 1, order);
            for (m, bernoulli) in (1_i32..).zip(&bernoulli[..attractions.len()]) {
                // Both sides times (2m − 1)!.
                let terms =
                    (1..).zip(attractions).map(|(k, b)| 4.0 * b * (f64::from(k) * CORRECTOR_MOTION).powi(2 * m - 1));
                let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term| (sum + term, size + f64::abs(term)));
                let error = -2.0 * (2.0_f64.powi(2 * m - 1) - 1.0) * bernoulli / (f64::from(2 * m) * 4.0_f64.powi(m));
                assert!((sum + error).abs() < 8.0 * f64::EPSILON * size, "{corrector:?}, {m}: {sum} and {error}");
                compared += 1;
            }
        }
        assert_eq!(compared, 19);
    }
}
