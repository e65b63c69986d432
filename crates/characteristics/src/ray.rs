//! One characteristic with its neighbours: states at given parameters, places where the ray map loses rank.

use core::ops::ControlFlow;

use piola_integrators::{Crossing, DormandPrince853, Event, EventAction, Field, IntegratorsError, State, Tolerance};
use piola_numerics::Real;

use super::{FirstOrderPde, RayField};
use crate::CharacteristicsError;

/// A zero of det(x_s, x_τ) at which it does not change sign is one when |det| is below this share of its largest on the
/// ray.
const TOUCHING: f64 = 1e-9;

/// A place where the ray map (s, τ) ↦ x loses rank: a point of the caustic.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CausticPoint {
    /// τ, the characteristic.
    pub parameters: Vec<f64>,
    /// s, where on it.
    pub s: f64,
    /// x there.
    pub x: Vec<f64>,
    /// u there.
    pub u: f64,
    /// ξ there; empty for an equation that is linear in ξ, since it is infinite there.
    pub xi: Vec<f64>,
    /// Whether the determinant touches zero without a change of sign, as at a focus of rays in space.
    pub touching: bool,
}

/// One characteristic at the levels of s of its solution, with its neighbours.
///
/// A row of `states` is y = (x, u, ξ; ∂(x, u, ξ)/∂τ₁; …); a row of `rates` is ∂y/∂s. For an equation that is
/// [linear in ξ](FirstOrderPde::QUASILINEAR) the derivatives of ξ are left zero.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ray {
    /// τ.
    pub parameters: Vec<f64>,
    /// y at the levels, by rows.
    pub states: Vec<f64>,
    /// ∂y/∂s at the levels, by rows.
    pub rates: Vec<f64>,
    /// det(x_s, x_τ) at the levels.
    pub determinants: Vec<f64>,
    /// Where the determinant vanishes, in the order of s, to the order of dense output; to that of the integration by
    /// [`CauchyProblem::caustic_points`](super::CauchyProblem::caustic_points).
    pub caustic: Vec<CausticPoint>,
    /// The largest |Φ| at the levels: W(A.20) says zero.
    pub drift: f64,
}

/// Integrates characteristics with their neighbours, one after the other; buffers are made once.
#[derive(Debug)]
pub(super) struct Marcher<'a, P> {
    pub(super) field: RayField<'a, P>,
    method: DormandPrince853,
    variables: usize,
}

/// y at s of the ray that starts at s = 0, over any scalar.
pub(super) fn march<P: FirstOrderPde, T: Real>(
    field: &mut RayField<'_, P, T>,
    method: &mut DormandPrince853<T>,
    start: Vec<T>,
    s: f64,
) -> Result<Vec<T>, CharacteristicsError> {
    let mut state = State::new(0.0, start).map_err(|source| failed(0.0, source.with_field_error()))?;
    let mut watch = Watch::new(field.equation, field.variables, s);
    let result = method.integrate(field, &mut state, s, |step| watch.after(step.start(), step.time(), step.values()));
    watch.judge(result.map(|_| ()), state.time, &state.values)?;
    Ok(state.values)
}

/// A characteristic of more steps is given up: rounding keeps its steps short.
const MOST_STEPS: u64 = 1_000_000;
/// A step of less than this share of the way to go says that ξ becomes infinite.
const VANISHING_STEP: f64 = 1e-10;

/// Finds characteristics that end only because an equation does not declare that it is linear in ξ.
struct Watch<'a, P> {
    equation: &'a P,
    variables: usize,
    end: f64,
    linear: Option<bool>,
    stopped: bool,
}

impl<'a, P: FirstOrderPde> Watch<'a, P> {
    fn new(equation: &'a P, variables: usize, end: f64) -> Self {
        Self { equation, variables, end, linear: None, stopped: false }
    }

    /// Ends a run whose steps vanish where ξ is not needed.
    fn after<T: Real>(&mut self, from: f64, to: f64, y: &[T]) -> ControlFlow<()> {
        let reached = (self.end - to).abs() <= 0.0;
        self.stopped =
            !P::QUASILINEAR && !reached && (to - from).abs() < VANISHING_STEP * self.end.abs() && self.is_linear(y);
        if self.stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The error of a run that was ended or failed.
    fn judge<T: Real>(
        &mut self,
        result: Result<(), IntegratorsError<CharacteristicsError>>,
        s: f64,
        y: &[T],
    ) -> Result<(), CharacteristicsError> {
        match result {
            Ok(()) if !self.stopped => Ok(()),
            Err(source) if P::QUASILINEAR || !self.is_linear(y) => Err(failed(s, source)),
            _ => {
                let x = y[..self.variables].iter().map(|x| x.primal(0)).collect();
                Err(CharacteristicsError::UndeclaredQuasilinear { s, x })
            }
        }
    }

    /// Whether Φ is linear in ξ at (x, u): Φ(ξ + η) − Φ(ξ) − Φ(η) + Φ(0) is rounding for some ξ and η in general position.
    fn is_linear<T: Real>(&mut self, y: &[T]) -> bool {
        let (equation, m) = (self.equation, self.variables);
        *self.linear.get_or_insert_with(|| {
            let point: Vec<f64> = y[..=m].iter().map(|y| y.primal(0)).collect();
            let at = |xi: &dyn Fn(f64) -> f64| {
                let xi: Vec<f64> = (0..m).map(|i| xi(i as f64)).collect();
                equation.value(&point[..m], point[m], &xi)
            };
            let zero = at(&|_| 0.0);
            [0.7, 1.9, 5.3].into_iter().all(|angle: f64| {
                let (first, second) = (|i: f64| (angle + i).sin(), |i: f64| (angle + 2.0 * i).cos());
                let (both, one, other) = (at(&|i| first(i) + second(i)), at(&first), at(&second));
                let terms = both.abs() + one.abs() + other.abs() + zero.abs();
                (both - one - other + zero).abs() <= LINEAR * terms
            })
        })
    }
}

/// The share of its terms below which a second difference of Φ is rounding.
const LINEAR: f64 = 1e-12;

fn failed(time: f64, source: IntegratorsError<CharacteristicsError>) -> CharacteristicsError {
    CharacteristicsError::Run { time, source: Box::new(source) }
}

/// A zero of the determinant or of its slope, as it is found.
struct Found {
    s: f64,
    y: Vec<f64>,
    slope: bool,
}

impl<'a, P: FirstOrderPde> Marcher<'a, P> {
    pub(super) fn new(equation: &'a P, variables: usize, tolerance: Tolerance) -> Self {
        Self {
            field: RayField::new(equation, variables, variables - 1),
            method: DormandPrince853::new(tolerance).with_most_steps(MOST_STEPS),
            variables,
        }
    }

    pub(super) fn state_at(&mut self, start: &[f64], s: f64) -> Result<Vec<f64>, CharacteristicsError> {
        march(&mut self.field, &mut self.method, start.to_vec(), s)
    }

    /// The ray through `start` at the levels, which ascend and contain zero.
    pub(super) fn ray(
        &mut self,
        equation: &'a P,
        (tau, start): (&[f64], &[f64]),
        levels: &[f64],
    ) -> Result<Ray, CharacteristicsError> {
        let n = start.len();
        let zero = levels.partition_point(|&s| s < 0.0);
        let mut states = vec![0.0; n * levels.len()];
        states[zero * n..(zero + 1) * n].copy_from_slice(start);
        let mut found = Vec::new();
        let (before, after) = states.split_at_mut(zero * n);
        let mut rows: Vec<_> = levels[..zero].iter().copied().zip(before.chunks_mut(n)).rev().collect();
        self.run(equation, start, &mut rows, &mut found)?;
        let mut rows: Vec<_> = levels[zero + 1..].iter().copied().zip(after[n..].chunks_mut(n)).collect();
        self.run(equation, start, &mut rows, &mut found)?;

        let mut rates = vec![0.0; states.len()];
        let mut drift = 0.0_f64;
        let determinants: Vec<f64> = states.chunks(n).map(|y| self.field.determinant(y)).collect();
        for (y, rate) in states.chunks_mut(n).zip(rates.chunks_mut(n)) {
            let mut value = self.field.rate_into(y, rate);
            if P::QUASILINEAR {
                let xi = self.field.covector(y);
                value = equation.value(&y[..self.variables], y[self.variables], &xi);
                y[self.variables + 1..=2 * self.variables].copy_from_slice(&xi);
            }
            drift = drift.max(value.abs());
        }
        let caustic = self.caustic(tau, found, &determinants);
        Ok(Ray { parameters: tau.to_vec(), states, rates, determinants, caustic, drift })
    }

    fn caustic(&mut self, tau: &[f64], mut found: Vec<Found>, determinants: &[f64]) -> Vec<CausticPoint> {
        let largest = determinants.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        found.retain(|found| !found.slope || self.field.determinant(&found.y).abs() <= TOUCHING * largest);
        found.sort_by(|a, b| a.s.total_cmp(&b.s));
        let m = self.variables;
        let mut caustic: Vec<CausticPoint> = Vec::with_capacity(found.len());
        for Found { s, y, slope } in found {
            // What touches zero may cross it by rounding, and then twice.
            if let Some(last) = caustic.last_mut()
                && (slope || last.touching)
                && (s - last.s).abs() <= TOUCHING.sqrt() * s.abs()
            {
                last.touching = true;
                continue;
            }
            caustic.push(CausticPoint {
                parameters: tau.to_vec(),
                s,
                x: y[..m].to_vec(),
                u: y[m],
                xi: if P::QUASILINEAR { Vec::new() } else { y[m + 1..=2 * m].to_vec() },
                touching: slope,
            });
        }
        caustic
    }

    /// Fills the rows of the levels, which go away from zero, and collects the zeros on the way.
    fn run(
        &mut self,
        equation: &'a P,
        start: &[f64],
        rows: &mut [(f64, &mut [f64])],
        found: &mut Vec<Found>,
    ) -> Result<(), CharacteristicsError> {
        let Some(end) = rows.last().map(|row| row.0) else { return Ok(()) };
        let m = self.variables;
        let mut probe = RayField::new(equation, m, m - 1);
        let mut slope_probe = RayField::new(equation, m, m - 1);
        let mut events = vec![Event::new(Crossing::Either, EventAction::Report, move |_, y| probe.determinant(y))];
        // In the plane the determinant changes sign wherever it vanishes, exceptions apart that a displacement of the
        // data removes; in space it does not at every focus.
        if 2 < m {
            events.push(Event::new(Crossing::Either, EventAction::Report, move |_, y| {
                slope_probe.determinant_and_slope(y).tangent
            }));
        }
        let mut state = State::new(0.0, start.to_vec()).map_err(|source| failed(0.0, source.with_field_error()))?;
        let mut next = 0;
        let mut watch = Watch::new(equation, m, end);
        let result = self.method.integrate_with_events(
            &mut self.field,
            &mut state,
            end,
            &mut events,
            |occurrence| {
                found.push(Found { s: occurrence.time, y: occurrence.values.to_vec(), slope: occurrence.event == 1 });
                ControlFlow::Continue(())
            },
            |step| {
                if watch.after(step.start(), step.time(), step.values()).is_break() {
                    return ControlFlow::Break(());
                }
                while let Some((level, row)) = rows.get_mut(next)
                    && step.contains(*level)
                {
                    if step.at(*level, row).is_err() {
                        return ControlFlow::Break(());
                    }
                    next += 1;
                }
                ControlFlow::Continue(())
            },
        );
        watch.judge(result.map(|_| ()), state.time, &state.values)?;
        debug_assert_eq!(self.field.dimension(), start.len());
        if next == rows.len() {
            Ok(())
        } else {
            // Dense output failed: a plain run to that level tells why.
            let level = rows[next].0;
            let y = self.state_at(start, level)?;
            rows[next].1.copy_from_slice(&y);
            for (level, row) in &mut rows[next + 1..] {
                row.copy_from_slice(&march(&mut self.field, &mut self.method, start.to_vec(), *level)?);
            }
            Ok(())
        }
    }

    /// Improves a simple zero of the determinant, found on dense output, by Newton's steps on the ray itself.
    pub(super) fn polish(&mut self, start: &[f64], point: &mut CausticPoint) -> Result<(), CharacteristicsError> {
        const STEPS: usize = 3;
        let m = self.variables;
        // The state is that of the last s.
        for left in (0..=STEPS).rev() {
            let y = self.state_at(start, point.s)?;
            point.x.copy_from_slice(&y[..m]);
            point.u = y[m];
            if !P::QUASILINEAR {
                point.xi.copy_from_slice(&y[m + 1..=2 * m]);
            }
            let determinant = self.field.determinant_and_slope(&y);
            let step = -determinant.value / determinant.tangent;
            if left == 0 || point.touching || !step.is_finite() || step.abs() <= 4.0 * f64::EPSILON * point.s.abs() {
                break;
            }
            point.s += step;
        }
        Ok(())
    }
}
