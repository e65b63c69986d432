//! Functions that pass from zero to one with some derivatives.

use piola_numerics::{Mask, Real};

/// How the attraction of two planets passes from the part of attractions, far away, to Kepler's part, near by.
///
/// The attraction's energy is −Gm m′ K/r in the part of attractions and −Gm m′ (1 − K)/r in Kepler's part, with K a function of
/// y = r/R, the distance over the critical radius, from 0 at y = 0 to 1 at y = 1:
///
/// | changeover | K | derivatives that exist everywhere |
/// |---|---|---|
/// | [`Quintic`](Self::Quintic) | y³ (10 − 15 y + 6 y²) | 2 |
/// | [`Fifteenth`](Self::Fifteenth) | ∝ ∫ y⁷ (1 − y)⁷ dy | 7 |
/// | [`Smooth`](Self::Smooth) | 1/(1 + exp(1/y − 1/(1 − y))) | all |
///
/// What the energy loses in an encounter depends on it. The example `encounter` has, for the splitting of order (10, 6, 4) with 60
/// steps a revolution, errors of 5e-7, 2e-10 and 2e-8 in this order. The smooth one is steeper in its middle than the polynomial of
/// degree fifteen, and better only with very short steps.
///
/// # Example
/// ```
/// use piola_gravitation::hybrid::{Changeover, HybridSymplectic};
/// use piola_gravitation::wisdom_holman::Splitting;
/// let method = HybridSymplectic::new(0.1, Splitting::Leapfrog)?.with_changeover(Changeover::Quintic);
/// assert_ne!(Changeover::Quintic, Changeover::default());
/// # assert_eq!(method.step(), 0.1);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Changeover {
    /// Two derivatives.
    Quintic,
    /// Seven derivatives.
    #[default]
    Fifteenth,
    /// All derivatives.
    Smooth,
}

/// The coefficients of y⁸, y⁹, …, y¹⁵ in the polynomial of degree fifteen: (−1)ᵏ binom(7 + k, k) binom(15, 7 − k).
const FIFTEENTH: [f64; 8] = [6435.0, -40040.0, 108_108.0, -163_800.0, 150_150.0, -83_160.0, 25_740.0, -3432.0];

impl Changeover {
    /// K and y K′ at 0 ≤ y ≤ 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of<T: Real>(self, y: T) -> [T; 2] {
        let one = T::one();
        match self {
            Self::Quintic => {
                let (cube, rest) = (y * y * y, one - y);
                let value = cube * (T::lit(10.0) + y * (T::lit(-15.0) + y * T::lit(6.0)));
                [value, T::lit(30.0) * cube * rest * rest]
            }
            Self::Fifteenth => {
                // Near one it is the function of the distance from one.
                let is_high = T::lit(0.5).less_than(y);
                let x = T::select(is_high, one - y, y);
                let mut sum = T::zero();
                for coefficient in FIFTEENTH.iter().rev() {
                    sum = sum * x + T::lit(*coefficient);
                }
                let low = x.powi(8) * sum;
                [T::select(is_high, one - low, low), T::lit(51480.0) * y * (y * (one - y)).powi(7)]
            }
            Self::Smooth => {
                // Closer to the ends than this the exponential is zero or infinite.
                let margin = T::lit(1.0 / 512.0);
                let rest = one - y;
                if y.less_than(margin).all() {
                    return [T::zero(), T::zero()];
                }
                if rest.less_than(margin).all() {
                    return [one, T::zero()];
                }
                let power = (y.recip() - rest.recip()).exp();
                let value = (one + power).recip();
                // K (1 − K), without the cancellation at the ends.
                let product = power * value * value;
                [value, product * (y.recip() + y / (rest * rest))]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Changeover, FIFTEENTH};
    use piola_numerics::{Dual, Real};

    const ALL: [Changeover; 3] = [Changeover::Quintic, Changeover::Fifteenth, Changeover::Smooth];

    #[test]
    fn changeovers_go_from_zero_to_one_and_are_symmetric() {
        for changeover in ALL {
            for (y, expected) in [(0.0, 0.0), (0.5, 0.5), (1.0, 1.0)] {
                assert!((changeover.of(y)[0] - expected).abs() < 4e-16, "{changeover:?} at {y}");
            }
            for y in [0.001, 0.1, 0.25, 0.4, 0.499] {
                let [low, high] = [changeover.of(y)[0], changeover.of(1.0 - y)[0]];
                assert!((low + high - 1.0).abs() < 8e-16, "{changeover:?} at {y}: {low} and {high}");
            }
        }
        assert!((FIFTEENTH.iter().sum::<f64>() - 1.0).abs() <= 0.0);
    }

    #[test]
    fn second_number_is_the_derivative_times_the_argument() {
        let mut compared = 0;
        for changeover in ALL {
            for part in 1..64 {
                let y = f64::from(part) / 64.0;
                let [value, slope] = changeover.of(Dual::variable(y));
                let expected = y * value.tangent;
                assert!((slope.primal(0) - expected).abs() < 1e-13 * (1.0 + expected), "{changeover:?} at {y}");
                compared += 1;
            }
        }
        assert_eq!(compared, 189);
    }
}
