//! Networks that slip: the derivative of Gordon and Schowalter in the place of the upper-convected one.

use piola_numerics::{Dual, Mask, Real};

use super::mode::{DifferentialFluid, Mode};
use super::{OldroydB, UpperConvectedMaxwell};
use crate::FluidsError;
use crate::ViscometricFluid;
use crate::answers::{Relation, finite_rate, moving};
use crate::error::check_bound;
use crate::viscometric::rate_at_stress;

/// A mode of a network whose relaxation depends on tr τ alone, R(τ) = f τ.
pub trait NetworkMode: Mode {
    /// f at (λ/ηₚ) tr τ: 1 at rest, and no less than that where the trace is positive.
    #[must_use]
    fn breaking<T: Real>(&self, trace: T) -> T;
}

macro_rules! unbreaking {
    ($($mode:ty),+) => {
        $(impl NetworkMode for $mode {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn breaking<T: Real>(&self, _trace: T) -> T {
                T::one()
            }
        })+
    };
}
unbreaking!(UpperConvectedMaxwell, OldroydB);

/// A network that slips in the continuum: it is stretched by 1 − ξ of D.
///
/// ```text
/// V = 2 ηₛ D + τ      λ (τ̇ − L′ τ − τ L′ᵀ) + f τ = 2 ηₚ D      L′ = L − ξ D
/// in steady shear, with q = ξ (2 − ξ) and x f(2 (1 − ξ) x²/(1 + q x²)) = λ |k|:
/// T₁₂ = ηₛ k + (ηₚ/λ) x/(1 + q x²) sign k,  N₁ = 2 (ηₚ/λ) x²/(1 + q x²),  N₂ = −½ ξ N₁
/// ```
/// | symbol | method | unit | bounds |
/// |---|---|---|---|
/// | the network without slip | [`network`](Self::network) | | |
/// | ξ | [`slip_of_network`](Self::slip_of_network) | – | 0 ≤ ξ ≤ 1 |
///
/// Of Oldroyd's fluid B it is the fluid of Johnson and Segalman. The polymer's stress in shear falls beyond q x² = 1: without
/// enough solvent, shear rates are found below only.
///
/// # Accuracy
/// 16 ulp of T₁₂, N₁ and N₂ at every rate; without slip, those of the network.
///
/// # Example
/// ```
/// use piola_fluids::{OldroydB, Slipping, ViscometricFluid};
/// // ξ = ½, q = ¾, x = λ k = 2: 1 + q x² = 4.
/// let fluid = Slipping::new(OldroydB::new(0.0, 8.0, 1.0)?, 0.5)?;
/// let [stress, first, second]: [f64; 3] =
///     [fluid.shear_stress(2.0), fluid.first_normal_stress_difference(2.0), fluid.second_normal_stress_difference(2.0)];
/// assert!((stress - 4.0).abs() < 1e-14);
/// assert!((first - 16.0).abs() < 1e-13 && (second + 4.0).abs() < 1e-13);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// R. J. Gordon, W. R. Schowalter, Trans. Soc. Rheol. 16 (1972) 79; M. W. Johnson, D. Segalman, J. Non-Newtonian Fluid Mech. 2
/// (1977) 255; N. Phan-Thien, R. I. Tanner, J. Non-Newtonian Fluid Mech. 2 (1977) 353; an example of the functions of
/// W(23.13–23.24).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<M>", into = "Written<M>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "M: NetworkMode + serde::Serialize",
        deserialize = "M: NetworkMode + serde::Deserialize<'de>"
    ))
)]
pub struct Slipping<M> {
    network: M,
    slip: f64,
}

/// As it is written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<M> {
    network: M,
    slip: f64,
}

#[cfg(feature = "serde")]
impl<M: NetworkMode> TryFrom<Written<M>> for Slipping<M> {
    type Error = FluidsError;

    fn try_from(written: Written<M>) -> Result<Self, FluidsError> {
        Self::new(written.network, written.slip)
    }
}

#[cfg(feature = "serde")]
impl<M> From<Slipping<M>> for Written<M> {
    fn from(fluid: Slipping<M>) -> Self {
        Self { network: fluid.network, slip: fluid.slip }
    }
}

impl<M: NetworkMode> Slipping<M> {
    /// From the network and ξ.
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`]; [`FluidsError::OutOfBounds`] unless 0 ≤ ξ ≤ 1.
    pub fn new(network: M, slip: f64) -> Result<Self, FluidsError> {
        check_bound(M::NAME, "slip", slip, "0 ≤ ξ ≤ 1", 0.0 <= slip && slip <= 1.0)?;
        Ok(Self { network, slip })
    }

    /// The network without slip.
    #[must_use]
    pub const fn network(&self) -> &M {
        &self.network
    }

    /// ξ.
    #[must_use]
    pub const fn slip_of_network(&self) -> f64 {
        self.slip
    }

    /// q = ξ (2 − ξ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn bend(&self) -> f64 {
        self.slip * (2.0 - self.slip)
    }

    /// ηₚ/λ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn modulus(&self) -> f64 {
        self.network.polymer_viscosity() / self.network.time()
    }

    /// x at λ |k| = w.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn strain<T: Real>(&self, shear_rate: T) -> T {
        solve_between(&Breaking(self), T::lit(self.network.time()) * shear_rate.abs())
    }

    /// x, and 1 + q x².
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parts<T: Real>(&self, shear_rate: T) -> [T; 2] {
        let x = self.strain(shear_rate);
        [x, T::one() + T::lit(self.bend()) * x * x]
    }
}

/// w = x f(2 (1 − ξ) x²/(1 + q x²)).
struct Breaking<'a, M>(&'a Slipping<M>);

impl<M: NetworkMode, T: Real> Relation<T> for Breaking<'_, M> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn at(&self, x: Dual<T>) -> Dual<T> {
        let square = x * x;
        let bent = Dual::lit(1.0) + Dual::lit(self.0.bend()) * square;
        x * self.0.network.breaking(Dual::lit(2.0 * (1.0 - self.0.slip)) * square / bent)
    }
}

/// y at x of a growing relation with y ≤ x(y), whatever its curvature: Newton's method on ln x over ln y within a bracket that
/// shrinks, then steps in y itself, in which also derivatives enter, one order a step.
#[cfg_attr(not(debug_assertions), inline(always))]
fn solve_between<T: Real>(relation: &impl Relation<T>, x: T) -> T {
    let wanted = x.frozen();
    let (rest, target) = moving(wanted);
    let aim = target.ln();
    let (mut low, mut high) = (aim - T::lit(700.0), aim);
    let mut u = aim;
    for _ in 0..200 {
        let y = u.exp();
        let at = relation.at(Dual { value: y, tangent: y });
        let excess = (at.value.frozen() / target).ln();
        let above = T::zero().at_most(excess) | excess.is_nan();
        high = T::select(above, u, high);
        low = T::select(above, low, u);
        let step = excess * at.value.frozen() / at.tangent.frozen();
        let newton = u - step;
        // A step as long as the bracket may lead from one end to the other and back.
        let half = T::lit(0.5) * (high - low);
        let inside = low.at_most(newton) & newton.at_most(high) & step.abs().at_most(half);
        let next = T::select(inside, newton, T::lit(0.5) * (low + high));
        let settled = (next - u).abs().at_most(T::lit(4.0 * f64::EPSILON) * (T::one() + u.abs()));
        u = next.frozen();
        if (settled | rest).all() {
            break;
        }
    }
    let mut y = T::select(rest, T::zero(), u.exp());
    for _ in 0..=T::ORDER + 1 {
        let at = relation.at(Dual { value: y, tangent: T::one() });
        y -= (at.value - x) / at.tangent.frozen();
    }
    y
}

impl<M: NetworkMode> ViscometricFluid for Slipping<M> {
    const NAME: &'static str = M::NAME;
    const NORMAL_STRESSES: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let size = shear_rate.abs();
        let [x, bent] = self.parts(size);
        let size = T::lit(self.network.solvent_viscosity()) * size + T::lit(self.modulus()) * x / bent;
        T::select(shear_rate.less_than(T::zero()), -size, size)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        T::lit(-0.5 * self.slip) * self.first_normal_stress_difference(shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        T::lit(1.0 - 0.5 * self.slip) * self.first_normal_stress_difference(shear_rate)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        let [x, bent] = self.parts(shear_rate);
        T::lit(2.0 * self.modulus()) * x * (x / bent)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        if 0.0 < self.network.solvent_viscosity() {
            return rate_at_stress(self, shear_stress);
        }
        let y = shear_stress / T::lit(self.modulus());
        let root = (T::one() - T::lit(4.0 * self.bend()) * y * y).sqrt();
        let x = (y + y) / (T::one() + root);
        let w = Breaking(self).at(Dual::constant(x)).value;
        finite_rate::<Self, T>(shear_stress, w / T::lit(self.network.time()))
    }
}

impl<M: NetworkMode> Mode for Slipping<M> {
    fn solvent_viscosity(&self) -> f64 {
        self.network.solvent_viscosity()
    }

    fn polymer_viscosity(&self) -> f64 {
        self.network.polymer_viscosity()
    }

    fn time(&self) -> f64 {
        self.network.time()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slip(&self) -> f64 {
        self.slip
    }

    fn steady_extension(&self, rates: [f64; 3]) -> Result<[f64; 3], FluidsError> {
        network_extension(self, |trace| self.network.breaking(trace), rates)
    }
}

/// yᵢ = 2 wᵢ/(f − 2 (1 − ξ) wᵢ) with w = λ ε̇, and f that of y₁ + y₂ + y₃, in units of ηₚ/λ.
pub(super) fn network_extension<M: Mode>(
    mode: &M,
    breaking: impl Fn(f64) -> f64,
    rates: [f64; 3],
) -> Result<[f64; 3], FluidsError> {
    let w = rates.map(|rate| 2.0 * mode.time() * rate);
    let carried = w.map(|w| (1.0 - mode.slip()) * w);
    let modulus = mode.polymer_viscosity() / mode.time();
    let largest = carried[0].max(carried[1]).max(carried[2]).max(0.0);
    // By how much f is beyond the pole at the largest w: what a strong flow decides.
    let stresses = |beyond: f64| -> [f64; 3] { core::array::from_fn(|i| w[i] / (beyond + (largest - carried[i]))) };
    let excess = |beyond: f64| breaking(stresses(beyond).iter().sum::<f64>()) - (largest + beyond);
    if breaking(1.0) <= 1.0 {
        if 1.0 <= largest {
            let (law, quantity) = (M::NAME, "2 λ ε̇");
            return Err(FluidsError::BeyondLimit { law, quantity, value: largest, limit: 1.0 });
        }
        return Ok(stresses(1.0 - largest).map(|y| modulus * y));
    }
    // f − f(tr) grows with f beyond the pole: a bracket, halved.
    let (mut low, mut high) = (0.0, 1.0);
    while 0.0 < excess(high) {
        high *= 2.0;
    }
    while 2.0 * f64::EPSILON * high < high - low {
        let middle = f64::midpoint(low, high);
        let above = excess(middle) <= 0.0;
        (low, high) = if above { (low, middle) } else { (middle, high) };
    }
    Ok(stresses(high).map(|y| modulus * y))
}

impl<M: NetworkMode> DifferentialFluid for Slipping<M> {
    type Mode = Self;

    fn modes(&self) -> &[Self] {
        core::slice::from_ref(self)
    }
}
