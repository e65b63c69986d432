//! K-BKZ fluids: the stress remembers all strains, large ones less.

use piola_continuum::Symmetric;
use piola_numerics::Real;

use super::differential::ShearStresses;
use super::quadrature::{Integral, integrate};
use super::viscometric::ViscometricFluid;
use crate::ConstitutiveError;
use crate::error::{check_bound, check_finite};
use piola_numerics::parameters;

/// How much less a large strain is remembered than a small one: h, with h = 1 at no strain.
pub trait Damping {
    /// The name of its fluid in errors.
    const NAME: &'static str;

    /// h at I₁ − 3 = tr Cₜ⁻¹ − 3 and I₂ − 3 = tr Cₜ − 3, both at least zero.
    #[must_use]
    fn factor<T: Real>(&self, first: T, second: T) -> T;
}

parameters! {
    ConstitutiveError;
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
    ConstitutiveError;
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
#[inline(always)]
fn mixed<T: Real>(beta: f64, a: T, b: T) -> T {
    T::lit(beta) * a + T::lit(1.0 - beta) * b
}

impl Damping for RationalDamping {
    const NAME: &'static str = Self::NAME;

    #[inline(always)]
    fn factor<T: Real>(&self, first: T, second: T) -> T {
        (T::one() + mixed(self.beta, first, second) / T::lit(self.alpha)).recip()
    }
}

impl Damping for ExponentialDamping {
    const NAME: &'static str = Self::NAME;

    #[inline(always)]
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
/// use piola_constitutive::fluids::{ExponentialDamping, Kbkz, Relaxation, ViscometricFluid};
/// let memory = vec![Relaxation { viscosity: 8.0, time: 1.0 }];
/// let melt = Kbkz::new(memory, ExponentialDamping::new(0.5, 1.0)?)?;
/// let [shear, first]: [f64; 2] = [melt.shear_stress(2.0), melt.first_normal_stress_difference(2.0)];
/// assert!((shear - 4.0).abs() < 1e-13);
/// assert!((first - 8.0).abs() < 1e-13);
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
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
    type Error = ConstitutiveError;

    fn try_from(written: Written<H>) -> Result<Self, ConstitutiveError> {
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
/// How far below zero u begins: s² counts e⁻⁴⁶ there.
const DEPTH: f64 = 3.0;
/// ln of the s/λ beyond which nothing is remembered in steady shear: e^(−e^3.9).
const FARTHEST: f64 = 3.9;
/// The same where a history is given.
const HEIGHT: f64 = 6.5;

/// How many steps there are from s₀ = e^`start` λ; at most 4000.
#[inline(always)]
fn steps(start: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 30 and 4000")]
    let count = ((DEPTH + FARTHEST - start) / STEP).ceil().min(4000.0) as usize;
    count
}

impl<H: Damping> Kbkz<H> {
    /// From its memory, in any order, and its damping.
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`]; [`ConstitutiveError::OutOfBounds`] for an empty memory, and unless 0 < η and 0 < λ.
    pub fn new(memory: Vec<Relaxation>, damping: H) -> Result<Self, ConstitutiveError> {
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
    pub fn relaxation_modulus(&self, time: f64) -> f64 {
        self.memory.iter().map(|term| term.viscosity / term.time * (-time / term.time).exp()).sum()
    }

    /// m(s), Pa/s.
    #[must_use]
    pub fn memory_function(&self, elapsed: f64) -> f64 {
        self.memory.iter().map(|term| term.viscosity / term.time * (-elapsed / term.time).exp() / term.time).sum()
    }

    /// Σ (η/λ) ∫ e⁻ˣ xᵖ h(w² x²) dx · wᵖ with w = λ k: τ for p = 1, N₁ for p = 2. Steps are taken at multiples of
    /// [`STEP`], the first at `offset` of one.
    #[inline(always)]
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

    /// T + p 1, Pa, now, from the history Cₜ⁻¹(t − s) of a motion that began from rest `age` seconds ago; ∞ for one that lasts
    /// since always.
    ///
    /// By adaptive quadrature in ln s, with its error bound. The motion must be smooth within (0, age).
    ///
    /// # Errors
    /// [`ConstitutiveError::OutOfBounds`] unless 0 < age.
    pub fn stress_of_history(
        &self,
        inverse: impl Fn(f64) -> Symmetric,
        age: f64,
    ) -> Result<Integral<Symmetric>, ConstitutiveError> {
        let longest = self.memory.iter().map(|term| term.time).fold(0.0, f64::max);
        let end = if age < f64::INFINITY { age } else { HEIGHT.exp() * longest };
        check_bound(H::NAME, "age", end, "0 < age", 0.0 < end)?;
        let damped = |s: f64| {
            let inverse = inverse(s);
            let strain = inverse - Symmetric::identity();
            // tr C = tr of the inverse, where det C = 1: the second invariant of C⁻¹.
            let second = 0.5 * (inverse.trace() * inverse.trace() - inverse.double_contraction(&inverse)) - 3.0;
            strain * self.damping.factor(strain.trace().max(0.0), second.max(0.0))
        };
        let remembered = integrate(|s| (damped(s) * self.memory_function(s)).components, end);
        let older = if age < f64::INFINITY { damped(age) * self.relaxation_modulus(age) } else { Symmetric::zero() };
        let value = Symmetric { components: remembered.value } + older;
        Ok(remembered.within(value, value.norm()))
    }

    /// The stresses at the time t after the start of shear at the rate k from rest, and the bound of their errors.
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`]; [`ConstitutiveError::OutOfBounds`] unless 0 < t.
    pub fn start_up(&self, shear_rate: f64, time: f64) -> Result<Integral<ShearStresses>, ConstitutiveError> {
        check_finite(H::NAME, "shear rate", shear_rate)?;
        check_bound(H::NAME, "time", time, "0 < time", 0.0 < time)?;
        let parts = |strain: f64| {
            let damped = self.damping.factor(strain * strain, strain * strain);
            [damped * strain, damped * strain * strain]
        };
        let remembered = integrate(|s| parts(shear_rate * s).map(|part| self.memory_function(s) * part), time);
        let older = parts(shear_rate * time).map(|part| self.relaxation_modulus(time) * part);
        let value =
            ShearStresses { shear: remembered.value[0] + older[0], first: remembered.value[1] + older[1], second: 0.0 };
        Ok(remembered.within(value, value.shear.abs().max(value.first)))
    }

    /// The stresses at the time t after the end of a long steady shear at the rate k, and the bound of their errors.
    ///
    /// ```text
    /// ∫ m(t + s) h(k² s²) (k s, k² s²) ds
    /// ```
    ///
    /// # Errors
    /// As [`start_up`](Self::start_up).
    pub fn cessation(&self, shear_rate: f64, time: f64) -> Result<Integral<ShearStresses>, ConstitutiveError> {
        check_finite(H::NAME, "shear rate", shear_rate)?;
        check_bound(H::NAME, "time", time, "0 < time", 0.0 < time)?;
        let longest = self.memory.iter().map(|term| term.time).fold(0.0, f64::max);
        let left = integrate(
            |s| {
                let strain = shear_rate * s;
                let damped = self.memory_function(time + s) * self.damping.factor(strain * strain, strain * strain);
                [damped * strain, damped * strain * strain]
            },
            HEIGHT.exp() * longest,
        );
        let value = ShearStresses { shear: left.value[0], first: left.value[1], second: 0.0 };
        Ok(left.within(value, value.shear.abs().max(value.first)))
    }

    /// T₁₂ and N₁ at the time t after a step of shear γ: G(t) h γ and G(t) h γ².
    #[must_use]
    pub fn step_strain(&self, strain: f64, time: f64) -> ShearStresses {
        let damped = self.relaxation_modulus(time) * self.damping.factor(strain * strain, strain * strain);
        ShearStresses { shear: damped * strain, first: damped * strain * strain, second: 0.0 }
    }
}

impl<H: Damping> ViscometricFluid for Kbkz<H> {
    const NAME: &'static str = H::NAME;
    const NORMAL_STRESSES: bool = true;

    #[inline(always)]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let size = self.sums(shear_rate, 1, 0.0);
        T::select(shear_rate.less_than(T::zero()), -size, size)
    }

    #[inline(always)]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        self.sums(shear_rate, 2, 0.0)
    }
}
