//! Fluids whose flows are known over any scalar.

use piola_fluids::ViscometricFluid;
use piola_numerics::Real;
use piola_viscometry::recover::MeasuredCurve;

/// τ = k (η∞ + (η₀ − η∞)(1 + (λk)ᵃ)^((n−1)/a)), after Carreau and Yasuda.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plateau {
    pub(super) eta: [f64; 2],
    pub(super) time: f64,
    pub(super) power: f64,
    pub(super) exponent: f64,
}

impl ViscometricFluid for Plateau {
    const NAME: &'static str = "plateau";

    fn shear_stress<T: Real>(&self, k: T) -> T {
        let beyond = (T::lit(self.time) * k.abs()).powf(T::lit(self.power));
        let share = (T::lit((self.exponent - 1.0) / self.power) * beyond.ln_1p()).exp();
        k * (T::lit(self.eta[1]) + T::lit(self.eta[0] - self.eta[1]) * share)
    }
}

/// ΔΩ(M) of a fluid between cylinders of radii 1 and R₂: ½ ∫ ζ(T₁ e⁻ᵛ) dv from 0 to δ.
pub(super) struct Speed<'f, F> {
    pub(super) fluid: &'f F,
    pub(super) outer: f64,
}

impl<F: ViscometricFluid> MeasuredCurve for Speed<'_, F> {
    fn response<T: Real>(&self, torque: T) -> T {
        let wall = torque * T::lit(core::f64::consts::TAU.recip());
        let step = 2.0 * (self.outer - 1.0).ln_1p();
        let rate = |v: f64| self.fluid.shear_rate(wall * T::lit((-v).exp()));
        integral(step, |v| rate(v).unwrap_or_else(|error| panic!("{error}"))) * T::lit(0.5)
    }
}

/// Q(c) of a pipe of radius 1: 8π c⁻³ ∫ s² ζ(s) ds up to c/2.
pub(super) struct Discharge<'f, F> {
    pub(super) fluid: &'f F,
}

impl<F: ViscometricFluid> MeasuredCurve for Discharge<'_, F> {
    fn response<T: Real>(&self, gradient: T) -> T {
        let wall = gradient * T::lit(0.5);
        let rate = |x: f64| self.fluid.shear_rate(wall * T::lit(x));
        // s = x c/2: Q = π ∫ x² ζ(x c/2) dx.
        let inside = |x: f64| T::lit(x * x) * rate(x).unwrap_or_else(|error| panic!("{error}"));
        integral(1.0, inside) * T::lit(core::f64::consts::PI)
    }
}

/// Q(c) for each width of a channel of half width 1: 2 ∫ x ζ(x c) dx.
pub(super) struct Sheet<'f, F> {
    pub(super) fluid: &'f F,
}

impl<F: ViscometricFluid> MeasuredCurve for Sheet<'_, F> {
    fn response<T: Real>(&self, gradient: T) -> T {
        let rate = |x: f64| self.fluid.shear_rate(gradient * T::lit(x));
        let inside = |x: f64| T::lit(2.0 * x) * rate(x).unwrap_or_else(|error| panic!("{error}"));
        integral(1.0, inside)
    }
}

/// Torque of discs of radius and gap 1: 2π ∫ x² τ(x Ω) dx, and thrust π ∫ x N(x Ω) dx with N = k².
pub(super) struct Discs<'f, F> {
    pub(super) fluid: &'f F,
    pub(super) thrust: bool,
}

impl<F: ViscometricFluid> MeasuredCurve for Discs<'_, F> {
    fn response<T: Real>(&self, speed: T) -> T {
        let torque = |x: f64| T::lit(x * x) * self.fluid.shear_stress(speed * T::lit(x));
        let thrust = |x: f64| T::lit(x * x * x) * speed * speed;
        if self.thrust {
            integral(1.0, thrust) * T::lit(core::f64::consts::PI)
        } else {
            integral(1.0, torque) * T::lit(core::f64::consts::TAU)
        }
    }
}

/// ∫ f from 0 to `width` by the rule of Gauss and Legendre with 24 points on each of two halves.
fn integral<T: Real>(width: f64, f: impl Fn(f64) -> T) -> T {
    let mut sum = T::zero();
    for (node, weight) in legendre(24) {
        for half in [0.0, 1.0] {
            let x = 0.5 * width * (half + 0.5 * (1.0 + node));
            sum += T::lit(0.25 * width * weight) * f(x);
        }
    }
    sum
}

/// Nodes and weights on [−1, 1], by Newton's method.
pub(super) fn legendre(count: u32) -> Vec<(f64, f64)> {
    let n = f64::from(count);
    (0..count)
        .map(|i| {
            let mut x = (core::f64::consts::PI * (f64::from(i) + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..50 {
                let (mut before, mut p) = (1.0, x);
                for k in 2..=count {
                    let k = f64::from(k);
                    (before, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k);
                }
                slope = n * (before - x * p) / (1.0 - x * x);
                x -= p / slope;
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}
