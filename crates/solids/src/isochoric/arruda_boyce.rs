//! The eight-chain network of Arruda and Boyce.

use piola_numerics::{Mask, Real};

use super::Isochoric;
use super::langevin::{inverse_langevin, langevin, ratio_and_slope};
use crate::SolidsError;
use crate::exponent_range::{check_below, within};
use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// The network of Arruda and Boyce: eight chains of N freely jointed links, exactly.
    ///
    /// ```text
    /// W̄ = n N (f(λ) − f(λ₀)),   f = β λ − ln(sinh β/β)        ℒ(β) = coth β − 1/β = λ,   λ = √(Ī₁/(3 N)),   λ₀ = N^(−½)
    /// ∂W̄/∂Ī₁ = n β/(6 λ)
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | n = n k θ | `rubbery_modulus` | Pa | 0 < n |
    /// | N | `links` | 1 | 1 < N; Ī₁ stays below 3 N |
    ///
    /// The shear modulus of the reference is n β₀/(3 λ₀) with λ₀ = N^(−½), larger than n: see
    /// [`shear_modulus`](Isochoric::shear_modulus).
    ///
    /// # Accuracy
    /// ∂W̄/∂Ī₁ a few ulp × 1/(1 − λ), see [`inverse_langevin`]; the energy a few ulp × β also for the smallest strains.
    ///
    /// # Errors
    /// `check` refuses 3 N ≤ Ī₁; without it energy, stresses and tangents are NaN there.
    ///
    /// # Example
    /// ```
    /// use piola_solids::isochoric::{ArrudaBoyce, Isochoric};
    /// let network = ArrudaBoyce::new(2.0, 1e9)?; // chains so long that they are Gaussian
    /// assert!((network.shear_modulus() - 2.0).abs() < 1e-8);
    /// let rubber = ArrudaBoyce::new(2.0, 4.0)?; // λ = ½ at the reference, β = 1.7967…
    /// assert!((rubber.shear_modulus() - 2.0 * 1.796_755_984_723_713 / 1.5).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// Arruda & Boyce 1993.
    pub struct ArrudaBoyce("Arruda–Boyce") {
        /// n k θ, Pa.
        rubbery_modulus: "0 < n" => 0.0 < rubbery_modulus,
        /// N, links of a chain.
        links: "1 < N" => 1.0 < links,
    }
}

/// Nodes and weights of Gauss and Legendre on [−1, 1], the positive half of eight.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

impl ArrudaBoyce {
    /// The limit of Ī₁ − 3, 3 (N − 1).
    #[must_use]
    pub fn limit(&self) -> f64 {
        3.0 * (self.links - 1.0)
    }

    /// λ of x = Ī₁ − 3.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stretch<T: Real>(&self, first: T) -> T {
        stretch_of(T::lit(self.links), first)
    }

    /// [∂W̄/∂Ī₁, 0] of x, λ and β.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope<T: Real>(&self, first: T, stretch: T, beta: T) -> [T; 2] {
        let slope = T::lit(self.rubbery_modulus / 6.0) * (beta / stretch);
        [within(first, T::lit(self.limit()), slope), T::zero()]
    }
}

/// λ of N and x = Ī₁ − 3.
#[cfg_attr(not(debug_assertions), inline(always))]
fn stretch_of<T: Real>(links: T, first: T) -> T {
    ((first + T::lit(3.0)) / (T::lit(3.0) * links)).sqrt()
}

/// ln(sinh β/β), for 0 < β.
#[cfg_attr(not(debug_assertions), inline(always))]
fn logarithm<T: Real>(beta: T) -> T {
    // sinh β/β = e^β (1 − e^(−2β))/(2β).
    let two = T::lit(2.0);
    beta + (-(-two * beta).exp_m1() / (two * beta)).ln()
}

/// n N (f(λ) − f(λ₀)), over any scalar: parameters may have derivatives too.
///
/// It is β₀ (λ − λ₀) + ∫ (λ − ℒ(b)) db from β₀ to β: of second order where it must be, by quadrature while β − β₀ ≤ 1.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn arruda_boyce<T: Real>(modulus: T, links: T, first: T) -> T {
    let (one, half, three) = (T::one(), T::lit(0.5), T::lit(3.0));
    let rest = stretch_of(links, T::zero());
    let now = stretch_of(links, first);
    let (start, end) = (inverse_langevin(rest), inverse_langevin(now));
    // λ − λ₀ of λ² − λ₀².
    let change = first / (three * links * (now + rest));
    let length = end - start;
    let near = length.abs().at_most(one);
    let mut second = now * length - (logarithm(end) - logarithm(start));
    if near.any() {
        let (centre, reach) = (half * (start + end), half * length);
        let mut sum = T::zero();
        for (node, weight) in GAUSS {
            let away = T::lit(node) * reach;
            let below = now - langevin(centre - away);
            let above = now - langevin(centre + away);
            sum += T::lit(weight) * (below + above);
        }
        second = T::select(near, sum * reach, second);
    }
    within(first, three * (links - one), modulus * links * (start * change + second))
}

impl Isochoric for ArrudaBoyce {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        arruda_boyce(T::lit(self.rubbery_modulus), T::lit(self.links), first)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, _second: T) -> [T; 2] {
        let stretch = self.stretch(first);
        self.slope(first, stretch, inverse_langevin(stretch))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        self.slopes_and_curvatures(first, second).1
    }

    /// ∂²W̄/∂Ī₁² = n/(36 N λ²) (1/ℒ′(β) − β/λ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_and_curvatures<T: Real>(&self, first: T, _second: T) -> ([T; 2], [T; 3]) {
        let stretch = self.stretch(first);
        let beta = inverse_langevin(stretch);
        let (_, slope) = ratio_and_slope(beta);
        let inner = slope.recip() - beta / stretch;
        let curvature = T::lit(self.rubbery_modulus / (36.0 * self.links)) * (inner / (stretch * stretch));
        (self.slope(first, stretch, beta), [within(first, T::lit(self.limit()), curvature), T::zero(), T::zero()])
    }

    fn check(&self, first: f64, _second: f64) -> Result<(), SolidsError> {
        check_below(Self::NAME, "I1 − 3", first, self.limit())
    }
}

/// The coefficients of the series of [`ArrudaBoyceSeries`].
const SERIES: [f64; 5] = [0.5, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673_750.0];

parameters! {
    SolidsError;
    /// The first five terms of the series of [`ArrudaBoyce`], as it stands in many programs.
    ///
    /// ```text
    /// W̄ = n Σ cₖ N^(1−k) (Ī₁ᵏ − 3ᵏ)     c = ½, 1/20, 11/1050, 19/7000, 519/673750
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | n = n k θ | `rubbery_modulus` | Pa | 0 < n |
    /// | N | `links` | 1 | 1 < N |
    ///
    /// It has no limit: its slope falls short of the network's by 0.2 % at λ² = Ī₁/(3 N) = 0.3, 2.7 % at 0.5, 16 % at
    /// 0.7 and 59 % at 0.9.
    ///
    /// # Example
    /// ```
    /// use piola_solids::isochoric::{ArrudaBoyceSeries, Isochoric};
    /// let series = ArrudaBoyceSeries::new(2.0, 1e9)?;
    /// assert!((series.energy(1.0, 0.0) - 1.0_f64).abs() < 1e-8); // ½ n (Ī₁ − 3)
    /// # Ok::<(), piola_solids::SolidsError>(())
    /// ```
    ///
    /// # Source
    /// Arruda & Boyce 1993.
    pub struct ArrudaBoyceSeries("Arruda–Boyce series") {
        /// n k θ, Pa.
        rubbery_modulus: "0 < n" => 0.0 < rubbery_modulus,
        /// N, links of a chain.
        links: "1 < N" => 1.0 < links,
    }
}

impl Isochoric for ArrudaBoyceSeries {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const STRAIGHT: bool = true;

    /// Ī₁ᵏ − 3ᵏ = x (Ī₁ᵏ⁻¹ + 3 Ī₁ᵏ⁻² + … + 3ᵏ⁻¹).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        let whole = first + T::lit(3.0);
        let (mut sum, mut quotient, mut three, mut scale) = (T::zero(), T::one(), 1.0, self.rubbery_modulus);
        for coefficient in SERIES {
            sum += T::lit(scale * coefficient) * quotient;
            three *= 3.0;
            quotient = whole * quotient + T::lit(three);
            scale /= self.links;
        }
        first * sum
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, _second: T) -> [T; 2] {
        let ratio = (first + T::lit(3.0)) / T::lit(self.links);
        let mut sum = T::zero();
        for (coefficient, k) in SERIES.into_iter().zip([1.0, 2.0, 3.0, 4.0, 5.0]).rev() {
            sum = sum * ratio + T::lit(k * coefficient);
        }
        [T::lit(self.rubbery_modulus) * sum, T::zero()]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, _second: T) -> [T; 3] {
        let ratio = (first + T::lit(3.0)) / T::lit(self.links);
        let mut sum = T::zero();
        for (coefficient, k) in SERIES.into_iter().zip([0.0, 2.0, 6.0, 12.0, 20.0]).skip(1).rev() {
            sum = sum * ratio + T::lit(k * coefficient);
        }
        [T::lit(self.rubbery_modulus / self.links) * sum, T::zero(), T::zero()]
    }
}
