//! K-BKZ fluids: the stress remembers all strains, large ones less.

use piola_numerics::{Real, parameters};

use crate::error::check_bound;
use crate::{FluidsError, Integral, ViscometricFluid};

/// Damping function h of the memory: h = 1 without strain, less for large strains.
pub trait Damping {
    /// The name of its fluid in errors.
    const NAME: &'static str;

    /// h at I₁ − 3 = tr Cₜ⁻¹ − 3 and I₂ − 3 = tr Cₜ − 3, both at least zero.
    #[must_use]
    fn factor<T: Real>(&self, first: T, second: T) -> T;
}

parameters! {
    FluidsError;
    /// The damping of Papanastasiou, Scriven and Macosko.
    ///
    /// ```text
    /// h = α/(α + β (I₁ − 3) + (1 − β) (I₂ − 3))      in shear: α/(α + γ²)
    /// ```
    /// | symbol | parameter | bounds |
    /// |---|---|---|
    /// | α | `alpha` | 0 < α |
    /// | β | `beta` | 0 ≤ β ≤ 1 |
    ///
    /// # Source
    /// A. C. Papanastasiou, L. E. Scriven, C. W. Macosko, J. Rheol. 27 (1983) 387.
    pub struct RationalDamping("Papanastasiou-Scriven-Macosko") {
        /// α.
        alpha: "0 < α" => 0.0 < alpha,
        /// β.
        beta: "0 ≤ β ≤ 1" => 0.0 <= beta && beta <= 1.0,
    }
}

parameters! {
    FluidsError;
    /// Wagner's damping.
    ///
    /// ```text
    /// h = exp(−n √(β (I₁ − 3) + (1 − β) (I₂ − 3)))      in shear: exp(−n |γ|)
    /// ```
    /// | symbol | parameter | bounds |
    /// |---|---|---|
    /// | n | `strength` | 0 ≤ n |
    /// | β | `beta` | 0 ≤ β ≤ 1 |
    ///
    /// # Source
    /// M. H. Wagner, Rheol. Acta 15 (1976) 136; 18 (1979) 33.
    pub struct ExponentialDamping("Wagner") {
        /// n.
        strength: "0 ≤ n" => 0.0 <= strength,
        /// β.
        beta: "0 ≤ β ≤ 1" => 0.0 <= beta && beta <= 1.0,
    }
}

/// β a + (1 − β) b.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mixed<T: Real>(beta: f64, a: T, b: T) -> T {
    T::lit(beta) * a + T::lit(1.0 - beta) * b
}

impl Damping for RationalDamping {
    const NAME: &'static str = Self::NAME;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn factor<T: Real>(&self, first: T, second: T) -> T {
        (T::one() + mixed(self.beta, first, second) / T::lit(self.alpha)).recip()
    }
}

impl Damping for ExponentialDamping {
    const NAME: &'static str = Self::NAME;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn factor<T: Real>(&self, first: T, second: T) -> T {
        let strain = mixed(self.beta, first, second);
        let none = strain.at_most(T::zero());
        let root = T::select(none, T::zero(), T::select(none, T::one(), strain).sqrt());
        (-(T::lit(self.strength) * root)).exp()
    }
}

/// A term of the memory of a [`Kbkz`] fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Relaxation {
    /// η, Pa s; 0 < η.
    pub viscosity: f64,
    /// λ, s; 0 < λ.
    pub time: f64,
}

/// The fluid of Kaye, Bernstein, Kearsley and Zapas, factored: a memory of Maxwell's kind times a damping.
///
/// ```text
/// T + p 1 = ∫ m(s) h(I₁, I₂) (Cₜ⁻¹(t − s) − 1) ds      m(s) = Σ (η/λ²) e^(−s/λ)
/// in steady shear: τ = ∫ m h k s ds,  N₁ = ∫ m h k² s² ds,  N₂ = 0
/// ```
/// Without damping it is the Maxwell fluid. In steady shear the integrals are sums over equal steps of u with s = s₀ e^(u − e^(−u)), that
/// converge exponentially; elsewhere quadrature is adaptive, with an error bound.
///
/// # Accuracy
/// τ, N₁ in steady shear: 1e-14 for the dampings of this module; [`steady_shear`](Self::steady_shear) has the bound.
///
/// # Example
/// Wagner's fluid has τ = η k/(1 + n λ k)² and N₁ = 2 η λ k²/(1 + n λ k)³:
/// ```
/// use piola_fluids::{ExponentialDamping, Kbkz, Relaxation, ViscometricFluid};
/// let memory = vec![Relaxation { viscosity: 8.0, time: 1.0 }];
/// let melt = Kbkz::new(memory, ExponentialDamping::new(0.5, 1.0)?)?;
/// let [shear, first]: [f64; 2] = [melt.shear_stress(2.0), melt.first_normal_stress_difference(2.0)];
/// assert!((shear - 4.0).abs() < 1e-13);
/// assert!((first - 8.0).abs() < 1e-13);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// B. Bernstein, E. A. Kearsley, L. J. Zapas, Trans. Soc. Rheol. 7 (1963) 391; an example of the simple fluids of W(18.1).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<H>", into = "Written<H>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "H: Damping + Clone + serde::Serialize",
        deserialize = "H: Damping + Clone + serde::Deserialize<'de>"
    ))
)]
pub struct Kbkz<H> {
    memory: Vec<Relaxation>,
    damping: H,
}

/// As it is written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<H> {
    memory: Vec<Relaxation>,
    damping: H,
}

#[cfg(feature = "serde")]
impl<H: Damping> TryFrom<Written<H>> for Kbkz<H> {
    type Error = FluidsError;

    fn try_from(written: Written<H>) -> Result<Self, FluidsError> {
        Self::new(written.memory, written.damping)
    }
}

#[cfg(feature = "serde")]
impl<H> From<Kbkz<H>> for Written<H> {
    fn from(fluid: Kbkz<H>) -> Self {
        Self { memory: fluid.memory, damping: fluid.damping }
    }
}

/// The step of u in s = s₀ e^(u − e^(−u)), where s₀ is about the shorter of λ and 1/k: the integrands vanish double exponentially downwards
/// and are analytic nearly within ±π/2 of the real axis, so that the error is about e^(−π²/step).
const STEP: f64 = 0.2;
/// The distance of the first u below zero: s² counts e⁻⁴⁶ there.
const DEPTH: f64 = 3.0;
/// ln of the s/λ beyond which nothing is remembered in steady shear: e^(−e^3.9).
const FARTHEST: f64 = 3.9;

/// The number of steps from s₀ = e^`start` λ; at most 4000.
#[cfg_attr(not(debug_assertions), inline(always))]
fn steps(start: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 30 and 4000")]
    let count = ((DEPTH + FARTHEST - start) / STEP).ceil().min(4000.0) as usize;
    count
}

impl<H: Damping> Kbkz<H> {
    /// From its memory, in any order, and its damping.
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`]; [`FluidsError::OutOfBounds`] for an empty memory, and unless 0 < η and 0 < λ.
    pub fn new(memory: Vec<Relaxation>, damping: H) -> Result<Self, FluidsError> {
        let count = memory.len() as f64;
        check_bound(H::NAME, "number of terms of the memory", count, "0 < number", 0.0 < count)?;
        for term in &memory {
            check_bound(H::NAME, "viscosity", term.viscosity, "0 < η", 0.0 < term.viscosity)?;
            check_bound(H::NAME, "time", term.time, "0 < λ", 0.0 < term.time)?;
        }
        Ok(Self { memory, damping })
    }

    /// The memory.
    #[must_use]
    pub fn memory(&self) -> &[Relaxation] {
        &self.memory
    }

    /// The damping.
    #[must_use]
    pub const fn damping(&self) -> &H {
        &self.damping
    }

    /// ∫ m ds from s to ∞, Pa: the modulus of relaxation after a small strain.
    #[must_use]
    pub fn relaxation_modulus(&self, t: f64) -> f64 {
        self.memory.iter().map(|term| term.viscosity / term.time * (-t / term.time).exp()).sum()
    }

    /// m(s), Pa/s.
    #[must_use]
    pub fn memory_function(&self, elapsed: f64) -> f64 {
        self.memory.iter().map(|term| term.viscosity / term.time * (-elapsed / term.time).exp() / term.time).sum()
    }

    /// Σ η, Pa s: the viscosity at rest.
    #[must_use]
    pub fn zero_rate_viscosity(&self) -> f64 {
        self.memory().iter().map(|term| term.viscosity).sum()
    }

    /// G′(ω), Pa: in phase with a small oscillating shear.
    #[must_use]
    pub fn storage_modulus(&self, angular_frequency: f64) -> f64 {
        let share = |x: f64| if 1.0 < x { 1.0 / (1.0 + x.recip() * x.recip()) } else { x * x / (1.0 + x * x) };
        self.memory().iter().map(|term| term.viscosity / term.time * share(term.time * angular_frequency.abs())).sum()
    }

    /// G″(ω), Pa: in phase with the rate of a small oscillating shear.
    #[must_use]
    pub fn loss_modulus(&self, angular_frequency: f64) -> f64 {
        let share = |x: f64| if x.abs() <= 0.0 { 0.0 } else { 1.0 / (x + x.recip()) };
        self.memory().iter().map(|term| term.viscosity / term.time * share(term.time * angular_frequency)).sum()
    }

    /// Σ (η/λ) ∫ e⁻ˣ xᵖ h(w² x²) dx · wᵖ with w = λ k: τ for p = 1, N₁ for p = 2. Steps are taken at multiples of
    /// [`STEP`], the first at `offset` of one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sums<T: Real>(&self, shear_rate: T, power: i32, offset: f64) -> T {
        let mut total = T::zero();
        for term in &self.memory {
            let w = T::lit(term.time) * shear_rate.abs();
            let fastest = (0..T::LANES).map(|lane| w.primal(lane)).fold(0.0, f64::max);
            let start = -fastest.ln_1p();
            let mut sum = T::zero();
            for step in 0..steps(start) {
                let u = (step as f64 + offset) * STEP - DEPTH;
                let below = (-u).exp();
                let x = (start + u - below).exp();
                // dx = x (1 + e^(−u)) du.
                let weight = (-x).exp() * x * (1.0 + below);
                let strain = w * T::lit(x);
                let square = strain * strain;
                let share = if power == 1 { strain } else { square };
                sum += T::lit(weight) * share * self.damping.factor(square, square);
            }
            total += sum * T::lit(STEP * term.viscosity / term.time);
        }
        total
    }

    /// τ and N₁ of steady shear, Pa, with bounds of their errors: by how much two grids differ, of which the mean is returned.
    #[must_use]
    pub fn steady_shear(&self, shear_rate: f64) -> [Integral; 2] {
        [1, 2].map(|power| {
            let [a, b] = [0.0, 0.5].map(|offset| self.sums(shear_rate, power, offset));
            let value = f64::midpoint(a, b);
            let bound = (a - b).abs() + 16.0 * f64::EPSILON * value.abs();
            let points = |term: &Relaxation| steps(-(term.time * shear_rate.abs()).ln_1p());
            let evaluations = 2 * self.memory.iter().map(points).sum::<usize>();
            let value = if power == 1 && shear_rate < 0.0 { -value } else { value };
            Integral { value, bound, evaluations }
        })
    }
}

impl<H: Damping> ViscometricFluid for Kbkz<H> {
    const NAME: &'static str = H::NAME;
    const NORMAL_STRESSES: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let size = self.sums(shear_rate, 1, 0.0);
        T::select(shear_rate.less_than(T::zero()), -size, size)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        self.sums(shear_rate, 2, 0.0)
    }
}
