//! The motion itself, from a state.

use super::twofold::{TURN, Twofold};

/// 0 < 1/a is violated: the body is not bound, or falls straight into the centre.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the orbit is not an ellipse: 1/a = {inverse_semi_major_axis} 1/m, squared angular momentum {squared_moment} m⁴/s²"
)]
pub struct NotElliptic {
    /// 2/r − v²/μ, 1/m.
    pub inverse_semi_major_axis: f64,
    /// |x × v|², m⁴/s².
    pub squared_moment: f64,
}

/// Elliptic motion from a state at time 0.
///
/// # Example
/// ```
/// use piola_gravitation::kepler::KeplerMotion;
/// let circle = KeplerMotion::new(1.0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])?;
/// assert_eq!(circle.semi_major_axis(), 1.0);
/// let quarter = circle.position(circle.period() / 4.0);
/// assert!(quarter[0].abs() < 1e-15 && (quarter[1] - 1.0).abs() < 1e-15);
/// # Ok::<(), piola_gravitation::kepler::NotElliptic>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct KeplerMotion {
    position: [f64; 3],
    velocity: [f64; 3],
    semi_major_axis: f64,
    /// a/r₀.
    stretch: f64,
    mean_motion: Twofold,
    eccentricity: f64,
    /// 1 − e, without cancellation.
    gap: f64,
    /// E₀.
    anomaly: f64,
    /// M₀.
    mean_anomaly: Twofold,
}

impl KeplerMotion {
    /// Turns up to which [`state`](Self::state) keeps its accuracy, 10¹². Beyond 2⁵³ ≈ 9·10¹⁵ turns the number of whole turns is no
    /// longer a double, and the state is wrong.
    pub const MOST_TURNS: f64 = 1e12;

    /// The motion about a centre of gravitational parameter μ = `gm` (m³/s²) from a position (m) and velocity (m/s).
    ///
    /// # Errors
    /// [`NotElliptic`] unless 0 < 1/a and x × v ≠ 0.
    pub fn new(gm: f64, position: [f64; 3], velocity: [f64; 3]) -> Result<Self, NotElliptic> {
        let mu = Twofold::of(gm);
        let radius = Twofold::dot(position, position).sqrt();
        let radial = Twofold::dot(position, velocity);
        let squared_speed = Twofold::dot(velocity, velocity);
        let inverse_axis = Twofold::of(2.0) / radius - squared_speed / mu;
        // |x × v|² = r²v² − (x·v)², by Lagrange's identity.
        let squared_moment = radius * radius * squared_speed - radial * radial;
        let positive = |x: Twofold| 0.0 < x.value() && x.value().is_finite();
        if !(positive(inverse_axis) && positive(squared_moment)) {
            return Err(NotElliptic {
                inverse_semi_major_axis: inverse_axis.value(),
                squared_moment: squared_moment.value(),
            });
        }
        let mean_motion = (mu * inverse_axis).sqrt() * inverse_axis;
        let e_cos = Twofold::of(1.0) - radius * inverse_axis;
        let e_sin = radial * (inverse_axis / mu).sqrt();
        // 1 − e² = |x × v|²/(μ a)
        let one_minus_square = squared_moment * inverse_axis / mu;
        let eccentricity = (e_cos * e_cos + e_sin * e_sin).value().sqrt();
        let anomaly = e_sin.value().atan2(e_cos.value());
        Ok(Self {
            position,
            velocity,
            semi_major_axis: (Twofold::of(1.0) / inverse_axis).value(),
            stretch: (Twofold::of(1.0) / (inverse_axis * radius)).value(),
            mean_motion,
            eccentricity,
            gap: (one_minus_square / Twofold::of(1.0 + eccentricity)).value(),
            anomaly,
            mean_anomaly: Twofold::of(anomaly) - e_sin,
        })
    }

    /// a, m.
    #[must_use]
    pub fn semi_major_axis(&self) -> f64 {
        self.semi_major_axis
    }

    /// e.
    #[must_use]
    pub fn eccentricity(&self) -> f64 {
        self.eccentricity
    }

    /// 2π/n, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        (TURN / self.mean_motion).value()
    }

    /// The position (m) at t seconds after the state.
    #[must_use]
    pub fn position(&self, t: f64) -> [f64; 3] {
        self.state(t).0
    }

    /// The position (m) and the velocity (m/s) at t seconds after the state.
    ///
    /// ```text
    /// x = f x₀ + g v₀,    f = 1 − (a/r₀)(1 − cos ΔE),    g = (ΔM − ΔE + sin ΔE)/n
    /// v = ḟ x₀ + ġ v₀,    ḟ = −n (a/r₀)(a/r) sin ΔE,    ġ = 1 − (a/r)(1 − cos ΔE)
    /// ```
    ///
    /// # Accuracy
    /// The mean anomaly is off by about n t 2⁻¹⁰⁴ rad besides the rounding of the result, up to [`MOST_TURNS`](Self::MOST_TURNS).
    ///
    /// # Example
    /// ```
    /// use piola_gravitation::kepler::KeplerMotion;
    /// // From the pericentre of an ellipse with e = 1/2, at 1/2 m with √3 m/s, to the apocentre.
    /// let ellipse = KeplerMotion::new(1.0, [0.5, 0.0, 0.0], [0.0, 3.0_f64.sqrt(), 0.0])?;
    /// let ([x, _, _], [_, v, _]) = ellipse.state(ellipse.period() / 2.0);
    /// assert!((x + 1.5).abs() < 1e-15 && (v + 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
    /// # Ok::<(), piola_gravitation::kepler::NotElliptic>(())
    /// ```
    #[must_use]
    pub fn state(&self, t: f64) -> ([f64; 3], [f64; 3]) {
        let advanced = self.mean_motion * Twofold::of(t);
        let mean = self.mean_anomaly + advanced;
        let turns = Twofold::of((mean.high / TURN.high).round());
        let mean = (mean - TURN * turns).value();
        let anomaly = eccentric_anomaly(mean, self.eccentricity, self.gap);
        let change = anomaly - self.anomaly;
        let half = (0.5 * change).sin();
        let n = self.mean_motion.value();
        // ΔM over the same number of turns as ΔE.
        let mean_change = (advanced - TURN * turns).value();
        let f = 1.0 - self.stretch * 2.0 * half * half;
        let g = (mean_change - minus_sine(change)) / n;
        let half_anomaly = (0.5 * anomaly).sin();
        // a/r
        let nearness = 1.0 / (self.gap + 2.0 * self.eccentricity * half_anomaly * half_anomaly);
        let f_rate = -n * self.stretch * nearness * change.sin();
        let g_rate = 1.0 - nearness * 2.0 * half * half;
        let combined = |f: f64, g: f64| [0, 1, 2].map(|i| f * self.position[i] + g * self.velocity[i]);
        (combined(f, g), combined(f_rate, g_rate))
    }
}

/// The root E of E − e sin E = M for |M| ≤ π, given e and 1 − e.
///
/// The equation is solved as (1 − e) E + e (E − sin E) = M, whose terms have one sign, so that no digits are lost near
/// the pericentre of a long ellipse.
pub(super) fn eccentric_anomaly(mean: f64, eccentricity: f64, gap: f64) -> f64 {
    if mean.abs() <= 0.0 {
        return 0.0;
    }
    let size = mean.abs();
    // E − e sin E is increasing and convex on [0, π]; from above its root, Newton's iteration descends to it.
    let cubic = (6.0 * size / eccentricity.max(1e-3)).cbrt();
    let mut anomaly = (size / gap).min(cubic.max(size + eccentricity)).min(core::f64::consts::PI);
    for _ in 0..60 {
        let (s, c) = anomaly.sin_cos();
        let excess = gap * anomaly + eccentricity * minus_sine_of(anomaly, s) - size;
        let half = (0.5 * anomaly).sin();
        let slope = gap + 2.0 * eccentricity * half * half;
        // Halley's correction of Newton's step.
        let newton = excess / slope;
        let step = newton / (1.0 - 0.5 * newton * eccentricity * s / slope).max(0.5);
        let next = (anomaly - step).clamp(0.0, core::f64::consts::PI);
        let settled = (next - anomaly).abs() <= f64::EPSILON * next;
        anomaly = next;
        debug_assert!(c.is_finite());
        if settled {
            break;
        }
    }
    anomaly.copysign(mean)
}

/// x − sin x, by its series near zero.
fn minus_sine(x: f64) -> f64 {
    minus_sine_of(x, x.sin())
}

fn minus_sine_of(x: f64, sine: f64) -> f64 {
    if 0.7 < x.abs() {
        return x - sine;
    }
    // x³/3! (1 − x²/(4·5) (1 − x²/(6·7) (1 − …))); the ninth term is below an ulp for |x| ≤ 0.7.
    let square = x * x;
    let mut sum = 1.0;
    for k in (2..=9).rev() {
        let k = f64::from(2 * k);
        sum = 1.0 - square / (k * (k + 1.0)) * sum;
    }
    x * square / 6.0 * sum
}
