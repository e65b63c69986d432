//! Points of an initial strip manifold: completion of ξ, strip conditions, what the manifold is there.

use piola_numerics::linear::lu;
use piola_numerics::{Dual, Real};

use super::determinant::{Basis, determinant, dot, norm};
use super::partials::{Partials, changes};
use super::roots::{Search, zeros};
use super::{Covector, FirstOrderPde, InitialManifold, StripKind};
use crate::check::check_finite;
use crate::{CharacteristicsError, StripError};

/// The sine of the angle between the characteristic and the manifold, in the space of x, below which the manifold
/// counts as tangent: a double root of Φ, that is what tangency is, is known to the root of the rounding only.
pub(super) const TANGENT: f64 = 1e-6;
/// Residuals of the strip conditions, over the magnitude of their terms, above which a given ξ is refused.
const STRIP: f64 = 1e-9;
/// The share of its changes below which a derivative of Φ is rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A point of an initial strip manifold with its first derivatives.
///
/// | symbol | field | shape |
/// |---|---|---|
/// | τ | `parameters` | m − 1 |
/// | x, u, ξ | `x`, `u`, `xi` | m, scalar, m |
/// | x_τ, u_τ, ξ_τ | `x_tau`, `u_tau`, `xi_tau` | m − 1 rows of m, m − 1, m − 1 rows of m |
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InitialPoint {
    /// τ.
    pub parameters: Vec<f64>,
    /// x(τ).
    pub x: Vec<f64>,
    /// u(τ).
    pub u: f64,
    /// ξ(τ).
    pub xi: Vec<f64>,
    /// ∂x/∂τ by rows.
    pub x_tau: Vec<f64>,
    /// ∂u/∂τ.
    pub u_tau: Vec<f64>,
    /// ∂ξ/∂τ by rows; zero where ξ is undetermined.
    pub xi_tau: Vec<f64>,
    /// det(Φ_ξ, x_τ), the Jacobian of the ray map at s = 0, W(A.32).
    pub determinant: f64,
    /// The sine of the angle between Φ_ξ and the manifold, with the sign of the determinant.
    pub transversality: f64,
    /// Φ(x, u, ξ).
    pub equation: f64,
    /// |Φ_ξ|, the speed at which the characteristic leaves.
    pub speed: f64,
    /// u_τ − ξ·x_τ.
    pub strip: Vec<f64>,
    /// Where Φ_ξ = Σ aᵅ x_τᵅ to within the sine: |Σ aᵅ ξ_τᵅ + ξΦ_u + Φ_x| over the magnitude of its terms, W(A.37). Where
    /// the characteristic stands still, a = 0.
    pub characteristic: f64,
    /// What the manifold is here.
    pub kind: StripKind,
}

/// An equation with initial data.
#[derive(Debug)]
pub(super) struct Data<'a, P, M> {
    pub(super) equation: &'a P,
    pub(super) manifold: &'a M,
    pub(super) variables: usize,
}

// Derived, they would ask the same of P and M.
impl<P, M> Clone for Data<'_, P, M> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<P, M> Copy for Data<'_, P, M> {}

/// x, u and the derivatives of both at one τ.
struct Placed {
    x: Vec<f64>,
    u: f64,
    x_tau: Vec<f64>,
    u_tau: Vec<f64>,
    basis: Basis,
}

impl<P: FirstOrderPde, M: InitialManifold> Data<'_, P, M> {
    /// x, u, x_τ by rows and u_τ over any scalar.
    fn tangents<S: Real>(&self, tau: &[S]) -> (Vec<S>, S, Vec<S>, Vec<S>) {
        let m = self.variables;
        let mut x = vec![S::zero(); m];
        let u = self.manifold.place(tau, &mut x);
        let (mut x_tau, mut u_tau) = (Vec::with_capacity(m * tau.len()), Vec::with_capacity(tau.len()));
        let mut dual = vec![Dual::constant(S::zero()); m];
        for a in 0..tau.len() {
            u_tau.push(self.manifold.place(&along(tau, a), &mut dual).tangent);
            x_tau.extend(dual.iter().map(|x| x.tangent));
        }
        (x, u, x_tau, u_tau)
    }

    fn placed(&self, tau: &[f64]) -> Result<Placed, CharacteristicsError> {
        let (x, u, x_tau, u_tau) = self.tangents(tau);
        check_finite("x(τ)", &x)?;
        check_finite("u(τ)", &[u])?;
        check_finite("∂x/∂τ", &x_tau)?;
        check_finite("∂u/∂τ", &u_tau)?;
        let basis = Basis::new(&x_tau, self.variables).map_err(|(index, share)| {
            CharacteristicsError::Strip(StripError::DependentParameters { parameters: tau.to_vec(), index, share })
        })?;
        Ok(Placed { x, u, x_tau, u_tau, basis })
    }

    /// φ(c) = Φ(x, u, ξ₀ + c n) over any scalar c.
    fn on_line<S: Real>(&self, placed: &Placed, shortest: &[f64], c: S) -> S {
        let x: Vec<S> = placed.x.iter().map(|&x| S::lit(x)).collect();
        let xi: Vec<S> =
            shortest.iter().zip(&placed.basis.normal).map(|(&xi, &n)| S::lit(xi) + c * S::lit(n)).collect();
        self.equation.value(&x, S::lit(placed.u), &xi)
    }

    /// ξ(τ) with all derivatives that τ carries, by Newton's steps from its value; `None` where the conditions do not
    /// determine them.
    pub(super) fn lifted<S: Real>(&self, tau: &[S], xi: &[f64]) -> Result<(Vec<S>, S, Vec<S>), CharacteristicsError> {
        let m = self.variables;
        let (x, u, x_tau, u_tau) = self.tangents(tau);
        let mut state: Vec<S> = x.iter().copied().chain([u]).chain(xi.iter().map(|&xi| S::lit(xi))).collect();
        if M::COVECTOR == Covector::Given {
            self.manifold.covector(tau, &mut state[m + 1..]);
            return Ok((x, u, state.split_off(m + 1)));
        }
        let mut work = Partials::new(m);
        let mut exchanges = vec![0; m];
        for _ in 0..S::ORDER {
            let value = work.evaluate(self.equation, &state);
            let mut matrix = vec![S::zero(); m * m];
            let mut residual = vec![value; m];
            for a in 0..m - 1 {
                residual[a] = -u_tau[a];
                for i in 0..m {
                    residual[a] += state[m + 1 + i] * x_tau[a * m + i];
                    matrix[a + i * m] = x_tau[a * m + i];
                }
            }
            for i in 0..m {
                matrix[m - 1 + i * m] = work.gradient[m + 1 + i];
            }
            lu::factor_in_place(&mut matrix, &mut exchanges)?;
            lu::solve_in_place(&matrix, &exchanges, &mut residual)?;
            for (xi, step) in state[m + 1..].iter_mut().zip(residual) {
                *xi -= step;
            }
        }
        Ok((x, u, state.split_off(m + 1)))
    }

    /// The ray's initial state over any scalar: (x, u, ξ; ∂/∂τ₁; …).
    pub(super) fn ray_state<S: Real>(&self, tau: &[S], xi: &[f64]) -> Result<Vec<S>, CharacteristicsError> {
        let mut state = Vec::with_capacity((2 * self.variables + 1) * (1 + tau.len()));
        for a in 0..tau.len() {
            let (x, u, xi) = self.lifted(&along(tau, a), xi)?;
            if a == 0 {
                state.extend(x.iter().chain([&u]).chain(&xi).map(|y| y.value));
            }
            state.extend(x.iter().chain([&u]).chain(&xi).map(|y| y.tangent));
        }
        if P::QUASILINEAR {
            without_covector(self.variables, &mut state);
        }
        Ok(state)
    }

    /// The point of the strip manifold at τ, ξ being completed from a guess where it is not given.
    pub(super) fn point(&self, tau: &[f64], guess: &[f64]) -> Result<InitialPoint, CharacteristicsError> {
        check_finite("τ", tau)?;
        let placed = self.placed(tau)?;
        let mut xi = guess.to_vec();
        if M::COVECTOR != Covector::Sought {
            self.manifold.covector(tau, &mut xi);
        }
        check_finite("ξ(τ)", &xi)?;
        if M::COVECTOR != Covector::Given {
            let shortest = placed.basis.shortest(&placed.u_tau);
            let c = self.complete(tau, &placed, &shortest, dot(&placed.basis.normal, &xi))?;
            xi = shortest.iter().zip(&placed.basis.normal).map(|(xi, n)| xi + c * n).collect();
        }
        self.describe(tau, placed, xi)
    }

    /// What is to be known at τ of a ξ that does not satisfy the equation.
    pub(super) fn point_without_covector(
        &self,
        tau: &[f64],
        xi: Vec<f64>,
    ) -> Result<InitialPoint, CharacteristicsError> {
        let point = self.describe(tau, self.placed(tau)?, xi)?;
        Ok(InitialPoint { kind: StripKind::NoCovector, ..point })
    }

    /// All points of strip manifolds over τ whose ξ = ξ₀ + c n has c in the search.
    pub(super) fn points(&self, tau: &[f64], search: Search) -> Result<Vec<InitialPoint>, CharacteristicsError> {
        check_finite("τ", tau)?;
        search.check()?;
        let placed = self.placed(tau)?;
        let shortest = placed.basis.shortest(&placed.u_tau);
        let mut value = |c| {
            let phi = self.on_line(&placed, &shortest, Dual::variable(c));
            check_finite("Φ", &[phi.value, phi.tangent]).map(|()| (phi.value, phi.tangent))
        };
        let mut slope = |c| {
            let phi = self.on_line(&placed, &shortest, Dual::variable(Dual::variable(c)));
            check_finite("Φ", &[phi.tangent.value, phi.tangent.tangent])
                .map(|()| (phi.tangent.value, phi.tangent.tangent))
        };
        let found = zeros(&mut value, &mut slope, search, TANGENT * TANGENT)?;
        let covector = |c: f64| shortest.iter().zip(&placed.basis.normal).map(|(xi, n)| xi + c * n).collect();
        found.into_iter().map(|c| self.describe(tau, self.placed(tau)?, covector(c))).collect()
    }

    /// Newton's iteration for φ(c) = 0 with steps that are halved until |φ| falls.
    fn complete(
        &self,
        tau: &[f64],
        placed: &Placed,
        shortest: &[f64],
        guess: f64,
    ) -> Result<f64, CharacteristicsError> {
        const ITERATIONS: usize = 200;
        const HALVINGS: usize = 30;
        let line = |c: f64| self.on_line(placed, shortest, Dual::variable(c));
        let length = norm(shortest);
        let (mut c, mut phi) = (guess, line(guess));
        check_finite("Φ", &[phi.value, phi.tangent])?;
        let mut work = Partials::new(self.variables);
        let mut magnitude_at = |c: f64| {
            let xi = shortest.iter().zip(&placed.basis.normal).map(|(xi, n)| xi + c * n);
            let y: Vec<f64> = placed.x.iter().copied().chain([placed.u]).chain(xi).collect();
            work.evaluate(self.equation, &y);
            (work.magnitude(&y), norm(&work.gradient[self.variables + 1..]))
        };
        // Towards a double root the steps fall off like a geometric series, and need not come to an end.
        let mut ended = false;
        for _ in 0..ITERATIONS {
            ended = true;
            let step = -phi.value / phi.tangent;
            if phi.value.abs() <= 0.0 || !step.is_finite() {
                break;
            }
            let mut share = 1.0;
            let mut trial = (c + step, line(c + step));
            for _ in 0..HALVINGS {
                if trial.1.value.abs() < phi.value.abs() {
                    break;
                }
                share *= 0.5;
                trial = (c + share * step, line(c + share * step));
            }
            let falls = trial.1.value.abs() < phi.value.abs();
            if falls {
                (c, phi) = trial;
            }
            if !falls || step.abs() <= 2.0 * f64::EPSILON * (c.abs() + length) {
                break;
            }
            ended = false;
        }
        let (magnitude, speed) = magnitude_at(c);
        if !ended || phi.tangent.abs() <= TANGENT * speed || speed <= 0.0 {
            // A double root: φ′ = 0 tells where it is, to rounding.
            let mut extremum = c;
            for _ in 0..20 {
                let slope = self.on_line(placed, shortest, Dual::variable(Dual::variable(extremum))).tangent;
                let step = -slope.value / slope.tangent;
                if !step.is_finite() || step.abs() <= 2.0 * f64::EPSILON * (extremum.abs() + length) {
                    break;
                }
                extremum += step;
            }
            let reach = 10.0 * TANGENT * (c.abs().max(guess.abs()) + length);
            let (value, near) = (line(extremum), (extremum - c).abs() <= reach);
            if near && value.value.abs() <= (TANGENT * TANGENT) * magnitude_at(extremum).0 {
                return Ok(extremum);
            }
        }
        // A zero is one if no neighbouring number is nearer to it.
        let rounding = f64::EPSILON * (64.0 * magnitude + 8.0 * phi.tangent.abs() * (c.abs() + length));
        if phi.value.abs() <= rounding {
            Ok(c)
        } else {
            Err(CharacteristicsError::Strip(StripError::NoInitialCovector {
                parameters: tau.to_vec(),
                covector: shortest.iter().zip(&placed.basis.normal).map(|(xi, n)| xi + c * n).collect(),
                residual: phi.value,
                slope: phi.tangent,
            }))
        }
    }

    /// Everything that is to be known of a point whose ξ is known.
    fn describe(&self, tau: &[f64], placed: Placed, xi: Vec<f64>) -> Result<InitialPoint, CharacteristicsError> {
        let m = self.variables;
        let Placed { x, u, x_tau, u_tau, basis } = placed;
        let y: Vec<f64> = x.iter().copied().chain([u]).chain(xi.iter().copied()).collect();
        let mut work = Partials::new(m);
        let mut rate = vec![0.0; 2 * m + 1];
        let equation = work.rate_into(self.equation, &y, &mut rate);
        check_finite("Φ", &[equation])?;
        check_finite("∂Φ/∂(x, u, ξ)", &work.gradient)?;
        if P::QUASILINEAR {
            let along = |share: f64| {
                let xi: Vec<f64> = xi.iter().map(|xi| share * xi).collect();
                self.equation.value(&x, u, &xi)
            };
            let residual = along(2.0) - 2.0 * equation + along(0.0);
            if STRIP * (work.magnitude(&y) + along(0.0).abs()) < residual.abs() {
                return Err(CharacteristicsError::Strip(StripError::NotQuasilinear {
                    parameters: tau.to_vec(),
                    residual,
                }));
            }
        }
        let strip: Vec<f64> = x_tau.chunks(m).zip(&u_tau).map(|(x_tau, u_tau)| u_tau - dot(&xi, x_tau)).collect();
        if M::COVECTOR == Covector::Given {
            let scales = x_tau.chunks(m).zip(&u_tau).map(|(row, u_tau)| norm(&xi) * norm(row) + u_tau.abs());
            let residuals = strip.iter().copied().zip(scales).chain([(equation, work.magnitude(&y))]);
            for (condition, (residual, scale)) in residuals.enumerate() {
                if STRIP * scale < residual.abs() {
                    return Err(CharacteristicsError::Strip(StripError::NotAStrip {
                        parameters: tau.to_vec(),
                        condition,
                        residual,
                    }));
                }
            }
        }
        let speed = norm(&rate[..m]);
        let mut rows: Vec<f64> = rate[..m].iter().chain(&x_tau).copied().collect();
        let jacobian = determinant(&mut rows, m);
        let transversality = if 0.0 < speed { jacobian / (speed * basis.volume()) } else { 0.0 };
        let tangent = transversality.abs() <= TANGENT;
        let changes = changes(self.equation, &y);
        let rounding = ROUNDING * norm(&changes[m + 1..]);
        let stationary = speed <= 0.0 || (rounding.is_finite() && speed <= rounding);
        let xi_tau = self.covector_derivatives(tau, &xi, tangent)?;
        let (mut kind, mut characteristic) = (StripKind::Transversal, f64::INFINITY);
        if stationary {
            kind = StripKind::Stationary;
            characteristic = stationary_residual(&y, &work, &changes);
        } else if tangent {
            kind = StripKind::Undetermined;
            if let Some(xi_tau) = &xi_tau {
                characteristic = characteristic_residual(&basis.coefficients(&rate[..m]), xi_tau, &y, &work);
                kind = if characteristic <= TANGENT { StripKind::Characteristic } else { StripKind::Monge };
            }
        }
        let xi_tau = xi_tau.unwrap_or_else(|| vec![0.0; m * tau.len()]);
        let parameters = tau.to_vec();
        Ok(InitialPoint {
            parameters,
            x,
            u,
            xi,
            x_tau,
            u_tau,
            xi_tau,
            determinant: jacobian,
            transversality,
            equation,
            speed,
            strip,
            characteristic,
            kind,
        })
    }

    /// ξ_τ by rows, or `None` where the data do not determine it.
    fn covector_derivatives(
        &self,
        tau: &[f64],
        xi: &[f64],
        tangent: bool,
    ) -> Result<Option<Vec<f64>>, CharacteristicsError> {
        if M::COVECTOR != Covector::Given && tangent {
            return Ok(self.covector_derivatives_where_tangent(tau, xi));
        }
        let mut rows = Vec::with_capacity(self.variables * tau.len());
        for a in 0..tau.len() {
            match self.lifted(&along(tau, a), xi) {
                Ok((_, _, xi)) => rows.extend(xi.iter().map(|xi| xi.tangent)),
                Err(CharacteristicsError::Numerics(_)) => return Ok(None),
                Err(error) => return Err(error),
            }
        }
        Ok(Some(rows))
    }

    /// The derivatives where the whole manifold is tangent to characteristics: of the conditions u_τ = ξ·x_τ and
    /// det(Φ_ξ, x_τ) = 0, since Φ = 0 has a double root there.
    fn covector_derivatives_where_tangent(&self, tau: &[f64], xi: &[f64]) -> Option<Vec<f64>> {
        let m = self.variables;
        let jacobian = |tau: &[Dual<f64>], xi: &[Dual<f64>]| {
            let (x, u, x_tau, u_tau) = self.tangents(tau);
            let state: Vec<_> = x.into_iter().chain([u]).chain(xi.iter().copied()).collect();
            let mut work = Partials::new(m);
            work.evaluate(self.equation, &state);
            let mut rows: Vec<_> = work.gradient[m + 1..].iter().chain(&x_tau).copied().collect();
            let mut strip = u_tau;
            for (strip, row) in strip.iter_mut().zip(x_tau.chunks(m)) {
                for (&xi, &x) in xi.iter().zip(row) {
                    *strip -= xi * x;
                }
            }
            (determinant(&mut rows, m), strip)
        };
        let constant = |values: &[f64]| values.iter().map(|&v| Dual::constant(v)).collect::<Vec<_>>();
        let mut matrix = vec![0.0; m * m];
        for i in 0..m {
            let (determinant, strip) = jacobian(&constant(tau), &along(xi, i));
            matrix[m - 1 + i * m] = determinant.tangent;
            for (a, strip) in strip.iter().enumerate() {
                matrix[a + i * m] = -strip.tangent;
            }
        }
        let mut exchanges = vec![0; m];
        lu::factor_in_place(&mut matrix, &mut exchanges).ok()?;
        let mut rows = Vec::with_capacity(m * tau.len());
        for a in 0..tau.len() {
            let (determinant, strip) = jacobian(&along(tau, a), &constant(xi));
            let mut right: Vec<f64> = strip.iter().map(|s| s.tangent).chain([-determinant.tangent]).collect();
            lu::solve_in_place(&matrix, &exchanges, &mut right).ok()?;
            rows.extend(right);
        }
        Some(rows)
    }
}

/// The parameters with the derivative along the one of index a.
fn along<S: Real>(tau: &[S], a: usize) -> Vec<Dual<S>> {
    let one = |i| if i == a { S::one() } else { S::zero() };
    tau.iter().enumerate().map(|(i, &tau)| Dual::new(tau, one(i))).collect()
}

/// |Σ aᵅ ξ_τᵅ + ξΦ_u + Φ_x| over the magnitude of its terms.
fn characteristic_residual(a: &[f64], xi_tau: &[f64], y: &[f64], work: &Partials<f64>) -> f64 {
    let m = y.len() / 2;
    let (mut residual, mut scale) = (vec![0.0; m], 0.0_f64);
    for i in 0..m {
        let along: f64 = a.iter().zip(xi_tau.chunks(m)).map(|(a, row)| a * row[i]).sum();
        let (by_u, by_x) = (y[m + 1 + i] * work.gradient[m], work.gradient[i]);
        residual[i] = along + by_u + by_x;
        scale = scale.max(along.abs()).max(by_u.abs()).max(by_x.abs());
    }
    if 0.0 < scale { norm(&residual) / scale } else { 0.0 }
}

/// |ξΦ_u + Φ_x| over the magnitude of its terms, without what is rounding.
fn stationary_residual(y: &[f64], work: &Partials<f64>, changes: &[f64]) -> f64 {
    let m = y.len() / 2;
    let (mut residual, mut scale) = (vec![0.0; m], 0.0_f64);
    for i in 0..m {
        let (by_u, by_x) = (y[m + 1 + i] * work.gradient[m], work.gradient[i]);
        let rounding = ROUNDING * (y[m + 1 + i].abs() * changes[m] + changes[i]);
        scale = scale.max(by_u.abs()).max(by_x.abs());
        if rounding < (by_u + by_x).abs() {
            residual[i] = by_u + by_x;
        }
    }
    if 0.0 < scale { norm(&residual) / scale } else { 0.0 }
}

/// Characteristics that need no ξ go with ξ = 0 in its place.
pub(super) fn without_covector<T: Real>(m: usize, state: &mut [T]) {
    for strip in state.chunks_mut(2 * m + 1) {
        strip[m + 1..].fill(T::zero());
    }
}
