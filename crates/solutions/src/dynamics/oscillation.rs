//! Radial oscillations of tubes and spherical shells under a constant pressure.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use piola_numerics::{Dual, Real};

use crate::error::{check_bound, check_finite};
use crate::families::Orientation;
use crate::integral::{integrate, integrate_over};
use crate::loads::{Ends, SphereInflation, TubeInflation, shear_modulus};
use crate::roots::{bracketed, places};
use crate::{CurvePoint, LoadCurve, ResponseFunctions, SolutionsError};

/// A body that oscillates along its [`LoadCurve`]: the stretch λ of the inner face is its coordinate.
///
/// Of a shell energies are in J, of a tube in J per metre of its present length.
///
/// # Example
/// See [`RadialOscillation`].
pub trait Oscillator: LoadCurve {
    /// m(λ) of the kinetic energy ½ m λ̇², kg m², for the density ρ.
    #[must_use]
    fn inertia<T: Real>(&self, density: f64, stretch: T) -> T;
    /// dV/dλ of the volume V of the cavity, m³.
    #[must_use]
    fn volume_slope<T: Real>(&self, stretch: T) -> T;
    /// The pressure at rest, Pa.
    ///
    /// # Errors
    /// What the law refuses.
    fn pressure_at_rest(&self, stretch: f64) -> Result<f64, SolutionsError>;
    /// λ d(`p_static`)/dλ at rest, Pa: the size of what rounding of λ changes in the pressure.
    #[must_use]
    fn stiffness(&self) -> f64;
    /// Refuses a body that does not oscillate so.
    ///
    /// # Errors
    /// [`SolutionsError::OutOfBounds`].
    fn check(&self) -> Result<(), SolutionsError>;
}

impl<L: ResponseFunctions> Oscillator for SphereInflation<'_, L> {
    /// `4π ρ r⁴ (1/r − 1/r_o) R_i²`.
    fn inertia<T: Real>(&self, density: f64, stretch: T) -> T {
        let (inner, outer) = (self.shell.inner(), self.shell.outer());
        let r = T::lit(inner) * stretch;
        let cube = r * r * r;
        let outer = (cube + T::lit(outer * outer * outer - inner * inner * inner)).cbrt();
        // r⁴ (1/r − 1/r_o) = r³ (r_o³ − r³)/(r_o (r_o² + r_o r + r²)), without cancellation.
        let gap = T::lit(self.shell.outer().powi(3) - inner.powi(3)) / (outer * (outer * outer + outer * r + r * r));
        T::lit(4.0 * PI * density * inner * inner) * cube * gap
    }
    /// 4π r² `R_i`.
    fn volume_slope<T: Real>(&self, stretch: T) -> T {
        T::lit(4.0 * PI * self.shell.inner().powi(3)) * stretch * stretch
    }
    fn pressure_at_rest(&self, stretch: f64) -> Result<f64, SolutionsError> {
        self.pressure(stretch)
    }
    /// `12 μ (1 − R_i/R_o)` and less where the shell is thick.
    fn stiffness(&self) -> f64 {
        12.0 * shear_modulus(self.law) * (1.0 - self.shell.inner() / self.shell.outer())
    }
    fn check(&self) -> Result<(), SolutionsError> {
        let sign = self.orientation.sign();
        check_bound("orientation", sign, "kept", self.orientation == Orientation::Kept)
    }
}

impl<L: ResponseFunctions> Oscillator for TubeInflation<'_, L> {
    /// `2π ρ r² ln(r_o/r) R_i²`.
    fn inertia<T: Real>(&self, density: f64, stretch: T) -> T {
        let (inner, outer) = (self.tube.inner(), self.tube.outer());
        let axial = if let Ends::Stretch(axial) = self.ends { axial } else { f64::NAN };
        let square = T::lit(inner * inner) * stretch * stretch;
        let ratio = T::lit((outer * outer - inner * inner) / axial) / square;
        T::lit(PI * density * inner * inner) * square * ratio.ln_1p()
    }
    /// 2π r `R_i`.
    fn volume_slope<T: Real>(&self, stretch: T) -> T {
        T::lit(2.0 * PI * self.tube.inner() * self.tube.inner()) * stretch
    }
    fn pressure_at_rest(&self, stretch: f64) -> Result<f64, SolutionsError> {
        self.pressure_of_held(stretch)
    }
    /// `4 μ ln(R_o/R_i)`.
    fn stiffness(&self) -> f64 {
        4.0 * shear_modulus(self.law) * (self.tube.outer() / self.tube.inner()).ln()
    }
    fn check(&self) -> Result<(), SolutionsError> {
        check_bound("inner radius", self.tube.inner(), "0 < R_i", 0.0 < self.tube.inner())?;
        match self.ends.check()? {
            Ends::Stretch(_) => Ok(()),
            // Ends that move carry axial inertia, which the curve knows nothing of.
            Ends::Force(force) => check_bound("axial force", force, "ends held at a stretch", false),
            Ends::Closed => check_bound("axial force of the caps", 0.0, "ends held at a stretch", false),
        }
    }
}

/// A state of a radial oscillation.
///
/// # Example
/// See [`RadialOscillation`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialState {
    /// λ of the inner face.
    pub stretch: f64,
    /// λ̇, 1/s.
    pub rate: f64,
}

/// A state of rest under the pressure.
///
/// # Example
/// See [`RadialOscillation`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestState {
    /// λ.
    pub stretch: f64,
    /// The period of small oscillations, s; none where the state is unstable, a saddle of the phase portrait.
    pub small_period: Option<f64>,
}

/// A periodic motion.
///
/// # Example
/// See [`RadialOscillation`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// λ at the turning points.
    pub turning_points: [f64; 2],
    /// The period, s.
    pub period: f64,
}

/// Free radial oscillation of a tube or a shell with a constant pressure inside: Knowles's problem.
///
/// ```text
/// ½ m(λ) λ̇² + U(λ) − p V(λ) = E        U' = p_static V'
/// tube:   m = 2π ρ R_i² r² ln(r_o/r)          V = π r²         (per metre of present length, at a constant axial stretch)
/// shell:  m = 4π ρ R_i² r⁴ (1/r − 1/r_o)      V = 4π r³/3
/// period = 2 ∫ dλ/λ̇ between the turning points
/// ```
/// The energy is the integral of `p_static`, so that laws without a stored energy have one, too.
///
/// # Errors
/// Methods: [`SolutionsError::OutOfBounds`] for a density or states that are not positive, for a tube whose ends are not held
/// at a stretch, for an everted shell; [`SolutionsError::NotPeriodic`]; what the law refuses.
///
/// # Accuracy
/// Periods: 1e-12, by a quadrature without singular ends.
///
/// # Example
/// A tube of neo-Hookean rubber is let go at λ = 1.2.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::dynamics::{RadialOscillation, RadialState};
/// use piola_solutions::loads::{Ends, Tube, TubeInflation};
/// let law = NeoHookean::new(1.0)?;
/// let body = TubeInflation { tube: Tube::new(1.0, 1.5)?, law: &law, ends: Ends::Stretch(1.0) };
/// let free = RadialOscillation { body, density: 1.0, pressure: 0.0 };
/// let orbit = free.orbit(RadialState { stretch: 1.2, rate: 0.0 }, (0.1, 10.0))?;
/// assert!(orbit.turning_points[0] < 1.0 && (orbit.turning_points[1] - 1.2).abs() < 1e-15);
/// // With small amplitude the period is that of the state of rest.
/// let rest = free.equilibria((0.5, 2.0))?[0];
/// assert!((orbit.period / rest.small_period.unwrap_or(0.0) - 1.0).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// J. K. Knowles, Q. Appl. Math. 18 (1960) 71; 20 (1962) 179; Z.-H. Guo and R. Solecki, Arch. Mech. Stos. 15 (1963) 427.
#[doc(alias("Knowles", "phase portrait"))]
#[derive(Clone, Copy, Debug)]
pub struct RadialOscillation<B> {
    /// The body.
    pub body: B,
    /// ρ, kg/m³.
    pub density: f64,
    /// p inside, Pa.
    pub pressure: f64,
}

/// Places between a start and the end of a range at which a turning point is looked for.
const PLACES: usize = 128;

impl<B: Oscillator> RadialOscillation<B> {
    fn check(&self) -> Result<(), SolutionsError> {
        check_bound("density", self.density, "0 < ρ", 0.0 < self.density)?;
        check_finite("pressure", &[self.pressure])?;
        self.body.check()
    }

    fn check_state(state: RadialState) -> Result<(), SolutionsError> {
        check_bound("stretch", state.stretch, "0 < λ", 0.0 < state.stretch)?;
        check_finite("rate", &[state.rate])
    }

    /// `(p − p_static) V'`, the force along λ.
    fn force(&self, stretch: f64) -> Result<f64, SolutionsError> {
        let excess = self.pressure - self.body.pressure_at_rest(stretch)?;
        Ok(excess * self.body.volume_slope(stretch))
    }

    /// The work of pressure and stress from one stretch to another: the kinetic energy gained, J, of a tube J/m.
    ///
    /// # Errors
    /// See [the type](RadialOscillation#errors).
    pub fn work(&self, from: f64, to: f64) -> Result<f64, SolutionsError> {
        self.check()?;
        for stretch in [from, to] {
            check_bound("stretch", stretch, "0 < λ", 0.0 < stretch)?;
        }
        self.work_over(from, to - from)
    }

    /// The work over a range of a length that is known without cancellation.
    fn work_over(&self, from: f64, length: f64) -> Result<f64, SolutionsError> {
        let stiffness = self.body.stiffness();
        let [work] = integrate_over::<f64, 1, 2>("pressure", (from, length), |stretch| {
            let (at_rest, slope) = (self.body.pressure_at_rest(stretch)?, self.body.volume_slope(stretch));
            Ok(([(self.pressure - at_rest) * slope], (self.pressure.abs() + at_rest.abs() + stiffness) * slope))
        })?;
        Ok(work)
    }

    /// ½ m λ̇², J, of a tube J/m.
    ///
    /// # Errors
    /// See [the type](RadialOscillation#errors).
    pub fn kinetic_energy(&self, state: RadialState) -> Result<f64, SolutionsError> {
        self.check()?;
        Self::check_state(state)?;
        Ok(0.5 * self.body.inertia(self.density, state.stretch) * state.rate * state.rate)
    }

    /// λ̈, 1/s², of the equation of motion m λ̈ + ½ m' λ̇² = (p − `p_static`) V'.
    ///
    /// # Errors
    /// See [the type](RadialOscillation#errors).
    pub fn acceleration(&self, state: RadialState) -> Result<f64, SolutionsError> {
        self.check()?;
        Self::check_state(state)?;
        let inertia = self.body.inertia(self.density, Dual::variable(state.stretch));
        let force = self.force(state.stretch)? - 0.5 * inertia.tangent * state.rate * state.rate;
        Ok(force / inertia.value)
    }

    /// |λ̇| at a stretch on the orbit through a state; none where the orbit does not come there: the phase portrait.
    ///
    /// # Errors
    /// See [the type](RadialOscillation#errors).
    pub fn rate_at(&self, through: RadialState, stretch: f64) -> Result<Option<f64>, SolutionsError> {
        let energy = self.kinetic_energy(through)? + self.work(through.stretch, stretch)?;
        let inertia = self.body.inertia(self.density, stretch);
        Ok((0.0 <= energy).then(|| (2.0 * energy / inertia).sqrt()))
    }

    /// The states of rest within a range, in order: centres and saddles.
    ///
    /// # Errors
    /// See [the type](RadialOscillation#errors). If there is none, the error is that of [`LoadCurve::states_at`].
    pub fn equilibria(&self, range: (f64, f64)) -> Result<Vec<RestState>, SolutionsError> {
        self.check()?;
        let states = self.body.states_at(self.pressure, range)?;
        Ok(states.iter().map(|point| self.equilibrium(point)).collect())
    }

    fn equilibrium(&self, point: &CurvePoint) -> RestState {
        let stiffness = point.slope * self.body.volume_slope(point.parameter);
        let inertia = self.body.inertia(self.density, point.parameter);
        let small_period = (0.0 < stiffness).then(|| TAU * (inertia / stiffness).sqrt());
        RestState { stretch: point.parameter, small_period }
    }

    /// The periodic motion through a state, its turning points within a range of stretches.
    ///
    /// # Errors
    /// See [the type](RadialOscillation#errors): [`SolutionsError::NotPeriodic`] where the motion does not turn within the range.
    pub fn orbit(&self, start: RadialState, range: (f64, f64)) -> Result<Orbit, SolutionsError> {
        let energy = self.kinetic_energy(start)?;
        check_bound("low end of the range", range.0, "0 < low < λ", 0.0 < range.0 && range.0 < start.stretch)?;
        check_bound("high end of the range", range.1, "λ < high", start.stretch < range.1)?;
        let turning_points = if 0.0 < energy {
            let left = self.turning_point(start.stretch, (start.stretch, energy), range.0)?;
            [left, self.turning_point(start.stretch, (start.stretch, energy), range.1)?]
        } else {
            // A start at rest is a turning point itself; beyond the state of rest that it falls to lies the other.
            let force = self.force(start.stretch)?;
            if force.abs() <= 0.0 {
                let small_period = self.equilibrium(&self.body.point(start.stretch)?).small_period;
                return match small_period {
                    Some(period) => Ok(Orbit { turning_points: [start.stretch; 2], period }),
                    None => Err(SolutionsError::NotPeriodic { start: start.stretch, reached: start.stretch, energy }),
                };
            }
            let end = if 0.0 < force { range.1 } else { range.0 };
            let bottom = first_root(start.stretch, force, end, |stretch| self.force(stretch))?;
            let Some(bottom) = bottom else {
                let energy = self.work(start.stretch, end)?;
                return Err(SolutionsError::NotPeriodic { start: start.stretch, reached: end, energy });
            };
            let other = self.turning_point(bottom, (start.stretch, 0.0), end)?;
            [start.stretch.min(other), start.stretch.max(other)]
        };
        Ok(Orbit { turning_points, period: self.period_between(turning_points)? })
    }

    /// The first stretch from `from` towards `end` where the energy is spent; the motion has `energy` at `start`.
    fn turning_point(&self, from: f64, (start, energy): (f64, f64), end: f64) -> Result<f64, SolutionsError> {
        let left = |stretch: f64| Ok(energy + self.work(start, stretch)?);
        match first_root(from, left(from)?, end, left)? {
            Some(root) => Ok(root),
            None => Err(SolutionsError::NotPeriodic { start, reached: end, energy: left(end)? }),
        }
    }

    /// 2 ∫ dλ/λ̇ between two turning points, with λ = middle + half · sin φ: the ends are regular.
    fn period_between(&self, [low, high]: [f64; 2]) -> Result<f64, SolutionsError> {
        let half = 0.5 * (high - low);
        let [time] = integrate::<f64, 1, 2>("time", (-FRAC_PI_2, FRAC_PI_2), |phi: f64| {
            // From the nearer end the work is a sum of terms of one sign, over 1 − |sin φ| = 2 sin²(¼π − ½|φ|).
            let (end, sign) = if phi < 0.0 { (low, 1.0) } else { (high, -1.0) };
            let from_end = 2.0 * half * (0.5 * (FRAC_PI_2 - phi.abs())).sin().powi(2);
            let gained = self.work_over(end, sign * from_end)?;
            let inertia = self.body.inertia(self.density, end + sign * from_end);
            let time = half * phi.cos() * (0.5 * inertia / gained).sqrt();
            // The share of the work that rounding of λ changes.
            let noise = self.body.stiffness() * self.body.volume_slope(end) * from_end / gained;
            Ok(([time], time * (1.0 + noise)))
        })?;
        Ok(2.0 * time)
    }

    /// The largest pressure that, applied at once to the body at rest without pressure, lets it turn back: the first maximum of
    /// the mean of `p_static` over the volume gained, in a range that begins at the state of rest. None where the mean has no
    /// maximum within the range.
    ///
    /// # Errors
    /// See [the type](RadialOscillation#errors).
    #[doc(alias = "dynamic limit load")]
    pub fn limit_of_sudden_pressure(&self, (rest, high): (f64, f64)) -> Result<Option<CurvePoint>, SolutionsError> {
        self.check()?;
        check_bound("stretch", rest, "0 < λ", 0.0 < rest)?;
        check_bound("high end of the range", high, "λ < high", rest < high)?;
        let volume = |to: f64| integrate::<f64, 1, 2>("volume", (rest, to), |x| Ok(([self.body.volume_slope(x)], 0.0)));
        let stored = |to: f64| {
            let density = |x: f64| Ok(([self.body.pressure_at_rest(x)? * self.body.volume_slope(x)], 0.0));
            integrate::<f64, 1, 2>("pressure", (rest, to), density)
        };
        let mean = |to: f64| Ok::<f64, SolutionsError>(stored(to)?[0] / volume(to)?[0]);
        // The mean grows as long as the pressure is above it.
        let above = |to: f64| Ok(self.body.pressure_at_rest(to)? - mean(to)?);
        let start = rest + (high - rest) / PLACES as f64;
        match first_root(start, above(start)?, high, above)? {
            None => Ok(None),
            Some(parameter) => Ok(Some(CurvePoint { parameter, load: mean(parameter)?, slope: 0.0 })),
        }
    }
}

/// The first change of sign of f from `from`, where it is `value`, to `end`.
fn first_root(
    from: f64,
    value: f64,
    end: f64,
    f: impl Fn(f64) -> Result<f64, SolutionsError>,
) -> Result<Option<f64>, SolutionsError> {
    let (mut before, mut at) = (from, value);
    for next in places((from, end), PLACES).skip(1) {
        let found = f(next)?;
        check_finite("energy", &[found])?;
        if (found < 0.0) != (at < 0.0) {
            return bracketed(&f, (before, at), (next, found)).map(Some);
        }
        (before, at) = (next, found);
    }
    Ok(None)
}

#[cfg(feature = "integrators")]
impl<B: Oscillator> piola_integrators::Field for RadialOscillation<B> {
    type Error = SolutionsError;

    fn dimension(&self) -> usize {
        2
    }

    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), SolutionsError> {
        rate[0] = y[1];
        rate[1] = self.acceleration(RadialState { stretch: y[0], rate: y[1] })?;
        Ok(())
    }

    fn is_second_order(&self) -> bool {
        true
    }
}
