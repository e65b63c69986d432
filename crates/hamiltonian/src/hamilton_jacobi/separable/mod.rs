//! Systems that separate: the complete integral, and the motion, by quadratures.
//!
//! ```text
//! U(q, c, t) = Σ Sᵢ(qᵢ; c) − c₀ t,   (dSᵢ/dqᵢ)² = Rᵢ(qᵢ; c),   c₀ = E
//! ∂U/∂c_k = Σ ∫ ∂_kRᵢ/(2pᵢ) dqᵢ − δ_k0 t = const
//! ```
//!
//! At a turning point pᵢ = 0 the integrands are singular and the branch of Sᵢ changes. Each coordinate is therefore
//! written by a parameter u over which its motion is smooth: qᵢ = m − h cos u between two turning points, a + u² on one
//! side of one, ±u where there is none; all integrands are smooth in u and the equations hold for all revolutions.

mod chart;
mod systems;

use nalgebra::{DMatrix, DVector};
use piola_numerics::Real;

use self::chart::Chart;
pub use systems::{FixedCentres, KeplerParabolic, KeplerPolar};

use super::complete_integral::newton;
use crate::check::{check_finite, check_length};
use crate::{HamiltonJacobiError, HamiltonianError};

/// The shortest part of the way in time that continuation takes.
const SHORTEST_PART: f64 = 1.0 / 65536.0;

/// A system whose Hamilton–Jacobi equation separates in its coordinates.
///
/// # Example
/// An oscillator with m = ω = 1: p² = 2E − q².
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{Separable, SeparableMotion};
/// use piola_numerics::Real;
/// struct Oscillator;
/// impl Separable for Oscillator {
///     fn freedom(&self) -> usize {
///         1
///     }
///     fn square<T: Real>(&self, _coordinate: usize, x: T, c: &[T]) -> T {
///         T::lit(2.0) * c[0] - x * x
///     }
///     fn constants(&self, q: &[f64], p: &[f64], constants: &mut [f64]) {
///         constants[0] = 0.5 * (q[0] * q[0] + p[0] * p[0]);
///     }
/// }
/// let motion = SeparableMotion::through(&Oscillator, (&[3.0], &[4.0], 0.0))?;
/// assert!((motion.turning_points(0).1.unwrap() - 5.0).abs() < 1e-14);
/// let loop_integral = motion.loop_integral(0)?.unwrap(); // 2πE
/// assert!((loop_integral - 25.0 * std::f64::consts::PI).abs() < 1e-12);
/// let (q, p) = motion.at(10.0)?;
/// assert!((q[0] - (3.0 * 10_f64.cos() + 4.0 * 10_f64.sin())).abs() < 1e-12);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(12.11) with U = Σ Sᵢ − E t.
pub trait Separable {
    /// The number n of coordinates, and of constants.
    fn freedom(&self) -> usize;
    /// The square Rᵢ(x; c) of the momentum of one coordinate at x; c₀ is the energy.
    fn square<T: Real>(&self, coordinate: usize, x: T, constants: &[T]) -> T;
    /// Writes the constants of the motion through a state.
    fn constants(&self, q: &[f64], p: &[f64], constants: &mut [f64]);
    /// The open interval of a coordinate; by default all numbers.
    fn range(&self, _coordinate: usize) -> (f64, f64) {
        (f64::NEG_INFINITY, f64::INFINITY)
    }
}

/// A part of the complete integral and its derivatives, over an interval of one coordinate with p > 0.
///
/// # Example
/// See [`SeparableMotion::integral`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SeparatedIntegral {
    /// ∫ pᵢ dqᵢ, J s.
    pub action: f64,
    /// ∂/∂c_k of it, at a fixed interval.
    pub by_constants: Vec<f64>,
}

/// A motion of a separable system by quadratures.
///
/// # Accuracy
/// Quadratures to 1e-13 of their size; turning points to rounding, √ of it where two of them coincide, as in circular
/// orbits.
///
/// # Example
/// See [`Separable`].
///
/// # Source
/// W(12.11–12.15).
#[derive(Clone, Debug)]
pub struct SeparableMotion<'a, S> {
    system: &'a S,
    constants: Vec<f64>,
    charts: Vec<Chart>,
    start: Vec<f64>,
    time: f64,
}

impl<'a, S: Separable> SeparableMotion<'a, S> {
    /// The motion through a state (q₀, p₀) at t₀.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`]; [`HamiltonJacobiError::ForbiddenCoordinate`]
    /// where a separated square is negative there.
    pub fn through(system: &'a S, (q, p, time): (&[f64], &[f64], f64)) -> Result<Self, HamiltonianError> {
        let n = system.freedom();
        check_length("q", n, q.len())?;
        check_length("p", n, p.len())?;
        check_finite("q", q)?;
        check_finite("p", p)?;
        check_finite("t", &[time])?;
        let mut constants = vec![0.0; n];
        system.constants(q, p, &mut constants);
        check_finite("separation constants", &constants)?;
        let (mut charts, mut start) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for i in 0..n {
            let chart = Chart::around(system, i, &constants, (q[i], p[i]))?;
            start.push(chart.parameter(q[i], p[i]));
            charts.push(chart);
        }
        Ok(Self { system, constants, charts, start, time })
    }

    /// c, the energy first.
    #[must_use]
    pub fn constants(&self) -> &[f64] {
        &self.constants
    }

    /// The turning points below and above a coordinate; none where it goes on for ever or around, and where there is
    /// no such coordinate.
    #[must_use]
    pub fn turning_points(&self, coordinate: usize) -> (Option<f64>, Option<f64>) {
        self.charts.get(coordinate).map_or((None, None), Chart::turning_points)
    }

    /// The state at a time.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`LagrangianError::QuadratureNotConverged`](piola_lagrangian::LagrangianError::QuadratureNotConverged); [`HamiltonJacobiError::NotFound`] when the
    /// equations of the motion could not be solved, as behind a collision; [`HamiltonJacobiError::IncompleteIntegral`].
    pub fn at(&self, t: f64) -> Result<(Vec<f64>, Vec<f64>), HamiltonianError> {
        check_finite("t", &[t])?;
        let n = self.start.len();
        let (mut place, mut part, mut step) = (self.start.clone(), 0.0, 1.0);
        while part < 1.0 {
            let next = f64::min(part + step, 1.0);
            let elapsed = if 1.0 <= next { t - self.time } else { next * (t - self.time) };
            let advance = (next - part) * (t - self.time);
            match self.predicted(&place, advance).and_then(|guess| self.solve(guess, elapsed)) {
                Ok(found) => (place, part, step) = (found, next, 2.0 * step),
                Err(error) if step <= SHORTEST_PART => return Err(error),
                Err(_) => step *= 0.25,
            }
        }
        let (mut q, mut p) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for (i, (chart, &u)) in self.charts.iter().zip(&place).enumerate() {
            let (coordinate, momentum) = chart.state(self.system, i, &self.constants, u);
            q.push(coordinate);
            p.push(momentum);
        }
        Ok((q, p))
    }

    /// The matrix of ∂_kRᵢ/2 · dqᵢ/(pᵢ duᵢ), row by k.
    fn slopes(&self, place: &[f64]) -> DMatrix<f64> {
        let n = place.len();
        let entry = |k: usize, i: usize| self.charts[i].slope(self.system, (i, k), &self.constants, place[i]);
        DMatrix::from_fn(n, n, entry)
    }

    fn predicted(&self, place: &[f64], advance: f64) -> Result<Vec<f64>, HamiltonianError> {
        let n = place.len();
        let right = DVector::from_fn(n, |k, _| if k == 0 { advance } else { 0.0 });
        let change = super::complete_integral::solve(&self.slopes(place), &right)?;
        Ok(place.iter().zip(change.iter()).map(|(u, d)| u + d).collect())
    }

    /// Newton's iteration for Σ ∫ slope du − δ_k0 (t − t₀) = 0.
    fn solve(&self, guess: Vec<f64>, elapsed: f64) -> Result<Vec<f64>, HamiltonianError> {
        let n = guess.len();
        let mut failure = None;
        let solved = newton("parameters of the motion", guess, |place| {
            let mut residual = DVector::zeros(n);
            let mut scale = elapsed.abs();
            for k in 0..n {
                for i in 0..n {
                    let limits = (self.start[i], place[i]);
                    match self.charts[i].integral(self.system, (i, k), &self.constants, limits) {
                        Ok(value) => {
                            residual[k] += value;
                            scale = scale.max(value.abs());
                        }
                        Err(error) => {
                            residual[k] = f64::NAN;
                            failure = Some(error);
                        }
                    }
                }
            }
            residual[0] -= elapsed;
            (residual, self.slopes(place), scale)
        });
        match (solved, failure) {
            (Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { residual, .. })), Some(error))
                if residual.is_nan() =>
            {
                Err(error)
            }
            (solved, _) => solved,
        }
    }

    /// ∫ pᵢ dqᵢ over one interval of a coordinate, rising (p > 0), with its derivatives by the constants. The interval
    /// may begin and end at turning points.
    ///
    /// # Errors
    /// [`HamiltonJacobiError::ForbiddenCoordinate`] when an end lies beyond the turning points of the motion;
    /// [`HamiltonianError::WrongLength`] when there is no such coordinate;
    /// [`LagrangianError::QuadratureNotConverged`](piola_lagrangian::LagrangianError::QuadratureNotConverged); [`HamiltonianError::NotFinite`].
    ///
    /// # Example
    /// ```
    /// use piola_hamiltonian::hamilton_jacobi::{KeplerPolar, SeparableMotion};
    /// // A circle's neighbour: from perihelion to aphelion is half a period, π for a = 1.
    /// let kepler = KeplerPolar { mass: 1.0, strength: 1.0 };
    /// let motion = SeparableMotion::through(&kepler, (&[0.5, 0.0], &[0.0, 0.75_f64.sqrt()], 0.0))?;
    /// let (perihelion, aphelion) = motion.turning_points(0);
    /// let part = motion.integral(0, (perihelion.unwrap(), aphelion.unwrap()))?;
    /// assert!((aphelion.unwrap() - 1.5).abs() < 1e-14);
    /// assert!((part.by_constants[0] - std::f64::consts::PI).abs() < 1e-12); // ∂S/∂E: the time
    /// assert!((part.by_constants[1] + std::f64::consts::PI).abs() < 1e-12); // ∂S/∂L: minus the angle
    /// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
    /// ```
    pub fn integral(&self, coordinate: usize, (from, to): (f64, f64)) -> Result<SeparatedIntegral, HamiltonianError> {
        check_finite("q", &[from, to])?;
        let Some(chart) = self.charts.get(coordinate) else {
            let (expected, found) = (self.charts.len(), coordinate);
            return Err(HamiltonianError::WrongLength { quantity: "coordinates", expected, found });
        };
        let rising = chart.rising();
        for value in [from, to] {
            let square = self.system.square(coordinate, value, &self.constants);
            if !rising.contains(value) {
                return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::ForbiddenCoordinate {
                    coordinate,
                    value,
                    square,
                }));
            }
        }
        let limits = (rising.parameter(from, 1.0), rising.parameter(to, 1.0));
        let part = |k| rising.integral(self.system, (coordinate, k), &self.constants, limits);
        let by_constants = (0..self.constants.len()).map(part).collect::<Result<Vec<_>, _>>()?;
        let action = rising.action(self.system, coordinate, &self.constants, limits)?;
        Ok(SeparatedIntegral { action, by_constants })
    }

    /// ∮ pᵢ dqᵢ over one cycle of a coordinate between two turning points, 2π times its action variable; none where
    /// there are not two.
    ///
    /// # Errors
    /// [`LagrangianError::QuadratureNotConverged`](piola_lagrangian::LagrangianError::QuadratureNotConverged).
    pub fn loop_integral(&self, coordinate: usize) -> Result<Option<f64>, HamiltonianError> {
        match self.turning_points(coordinate) {
            (Some(a), Some(b)) => Ok(Some(2.0 * self.integral(coordinate, (a, b))?.action)),
            _ => Ok(None),
        }
    }
}
