//! One damped oscillator, exactly: ρ ü + c u̇ + k u = f(t) with f a polynomial.

/// The highest degree of the force in time.
pub(crate) const DEGREE: usize = 3;

/// What one step of length h does to displacement and velocity, and what each power of time of the force adds.
///
/// ```text
/// u(h) = P₁₁ u + P₁₂ v + Σ_m f_m A_m,   v(h) = P₂₁ u + P₂₂ v + Σ_m f_m B_m,   f(t) = Σ_m f_m t^m
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct Propagator {
    pub(crate) transfer: [[f64; 2]; 2],
    pub(crate) forced: [[f64; 2]; DEGREE + 1],
}

impl Propagator {
    /// The exact propagator.
    ///
    /// With γ = c/2ρ, ω₀² = k/ρ and S the response to a unit impulse, S″ + 2γS′ + ω₀²S = 0, S(0) = 0, S′(0) = 1:
    ///
    /// ```text
    /// ω² = ω₀² − γ² > 0:  S = e^{−γh} sin(ωh)/ω
    /// σ² = γ² − ω₀² > 0:  S = (e^{−r₁h} − e^{−r₂h})/(r₂ − r₁),  r₂ = γ + σ,  r₁ = ω₀²/r₂
    /// ```
    /// r₁ is not formed as a difference, so a slow decay keeps its digits.
    /// Without `has_force` the answers to forces stay zero.
    pub(crate) fn new(density: f64, drag: f64, stiffness: f64, h: f64, has_force: bool) -> Self {
        let half_damping = drag / (2.0 * density);
        let squared = stiffness / density;
        let natural = squared.sqrt();
        let discriminant = (natural - half_damping) * (natural + half_damping);
        let decay = Decay { half_damping, squared, natural, discriminant, h };
        let (impulse, slope, relaxed) = decay.response();
        let transfer = [[relaxed, impulse], [-squared * impulse, slope]];
        let forced = if has_force { decay.forced(impulse) } else { [[0.0; 2]; DEGREE + 1] };
        let forced = forced.map(|[a, b]| [a / density, b / density]);
        Self { transfer, forced }
    }
}

#[derive(Clone, Copy)]
struct Decay {
    /// γ.
    half_damping: f64,
    /// ω₀².
    squared: f64,
    /// ω₀.
    natural: f64,
    /// ω₀² − γ².
    discriminant: f64,
    h: f64,
}

impl Decay {
    /// S, S′ and S′ + 2γS, the response to a unit displacement.
    fn response(self) -> (f64, f64, f64) {
        let Self { half_damping, squared, discriminant, h, .. } = self;
        if 0.0 < discriminant {
            let frequency = discriminant.sqrt();
            let (sin, cos) = (frequency * h).sin_cos();
            let envelope = (-half_damping * h).exp();
            let impulse = envelope * sin / frequency;
            let mean = envelope * cos;
            return (impulse, mean - half_damping * impulse, mean + half_damping * impulse);
        }
        let spread = (-discriminant).sqrt();
        let fast = half_damping + spread;
        let slow = if fast == 0.0 { 0.0 } else { squared / fast };
        let slow_decay = (-slow * h).exp();
        let twice = 2.0 * spread * h;
        // (1 − e^{−x})/x is 1 at x = 0.
        let ratio = if twice == 0.0 { 1.0 } else { -(-twice).exp_m1() / twice };
        let impulse = h * slow_decay * ratio;
        let fast_decay = (-fast * h).exp();
        let (slope, relaxed) = if half_damping <= 2.0 * spread {
            let width = 2.0 * spread;
            if width == 0.0 {
                (1.0, 1.0)
            } else {
                ((fast * fast_decay - slow * slow_decay) / width, (fast * slow_decay - slow * fast_decay) / width)
            }
        } else {
            let mean = 0.5 * (slow_decay + fast_decay);
            (mean - half_damping * impulse, mean + half_damping * impulse)
        };
        (impulse, slope, relaxed)
    }

    /// ∫ S(h − t) t^m dt and ∫ S′(h − t) t^m dt over the step.
    fn forced(self, impulse: f64) -> [[f64; 2]; DEGREE + 1] {
        let Self { half_damping, squared, natural, discriminant, h } = self;
        let mut displacement = [0.0; DEGREE + 1];
        if natural * h <= 2.0 && half_damping * h <= 1.0 {
            self.series(&mut displacement);
        } else if discriminant < 0.0 && half_damping <= 2.0 * (-discriminant).sqrt() {
            // The difference of two exponentials whose rates differ by a factor of three or more.
            let spread = (-discriminant).sqrt();
            let fast = half_damping + spread;
            let (slow, fast) = (moments(squared / fast, h), moments(fast, h));
            for m in 0..=DEGREE {
                displacement[m] = (slow[m] - fast[m]) / (2.0 * spread);
            }
        } else {
            // By parts, twice: ω₀² A_m = h^m − m B_{m−1} − 2γ B_m with B_m = m A_{m−1}, B_0 = S.
            let mut power = 1.0;
            for m in 0..=DEGREE {
                let count = m as f64;
                displacement[m] = if m == 0 {
                    // 1 − S′ − 2γS.
                    let (_, _, relaxed) = self.response();
                    (1.0 - relaxed) / squared
                } else {
                    let before = if m == 1 { impulse } else { (count - 1.0) * displacement[m - 2] };
                    (power - count * before - 2.0 * half_damping * count * displacement[m - 1]) / squared
                };
                power *= h;
            }
        }
        let mut forced = [[0.0; 2]; DEGREE + 1];
        for m in 0..=DEGREE {
            let velocity = if m == 0 { impulse } else { m as f64 * displacement[m - 1] };
            forced[m] = [displacement[m], velocity];
        }
        forced
    }

    /// The sum over n of S⁽ⁿ⁾(0) m!/(n + m + 1)! h^{n+m+1}, for slow oscillators.
    fn series(self, displacement: &mut [f64; DEGREE + 1]) {
        let Self { half_damping, squared, h, .. } = self;
        let mut power = h * h;
        for (m, sum) in displacement.iter_mut().enumerate() {
            // The derivatives of S times h^{n−1}: 0, 1, −2γh, …
            let (mut derivative, mut next) = (0.0, 1.0);
            // m! h^{m+2}/(n + m + 1)! for n = 0.
            let mut factor = power / (m as f64 + 1.0);
            power *= h;
            for n in 0..40_i32 {
                *sum += factor * derivative;
                factor /= f64::from(n) + m as f64 + 2.0;
                (derivative, next) = (next, -2.0 * half_damping * h * next - squared * h * h * derivative);
            }
        }
    }
}

/// ∫ e^{−r(h−t)} t^m dt over the step.
fn moments(rate: f64, h: f64) -> [f64; DEGREE + 1] {
    let mut moments = [0.0; DEGREE + 1];
    let z = rate * h;
    if z < 1.0 {
        let mut power = h;
        // h^{m+1} m! Σ_n (−z)^n/(n + m + 1)!
        for (m, moment) in moments.iter_mut().enumerate() {
            let mut term = power / (m as f64 + 1.0);
            power *= h;
            for n in 0..24 {
                *moment += term;
                term *= -z / (f64::from(n) + m as f64 + 2.0);
            }
        }
    } else {
        moments[0] = -(-z).exp_m1() / rate;
        let mut power = h;
        for m in 1..=DEGREE {
            moments[m] = (power - m as f64 * moments[m - 1]) / rate;
            power *= h;
        }
    }
    moments
}
