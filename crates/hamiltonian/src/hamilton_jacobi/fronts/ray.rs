//! One ray of a front, with its derivatives by the parameters of the front.

use core::array::from_fn;

use piola_numerics::{Gradient, LaneKernel, Lanes, Real, dispatch_lanes};

use super::InitialFront;
use super::step::{State, advance, rate};
use crate::PhaseFunction;
use crate::check::check_finite;
use crate::differential::rate_in_time;
use crate::hamilton_jacobi::momentum_length::{Line, momentum_scale};
use crate::{HamiltonJacobiError, HamiltonianError};

/// Below this determinant tangents are dependent.
const SINGULAR: f64 = 1e-12;

/// A ray of a front.
///
/// # Example
/// See [`WaveFront`](super::WaveFront).
///
/// # Source
/// W(13.19–13.21).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontRay<const N: usize, const M: usize> {
    parameters: [f64; M],
    state: State<f64, N, M>,
    /// det(∂q/∂σ, dq/dS).
    jacobian: f64,
    /// ∂q/∂σ where they were last independent: after a caustic some have turned round.
    before: [[f64; N]; M],
    caustics: u32,
    error: f64,
}

impl<const N: usize, const M: usize> FrontRay<N, M> {
    /// Where the ray started: the parameters of the initial curve or surface.
    #[must_use]
    pub const fn parameters(&self) -> [f64; M] {
        self.parameters
    }
    /// q.
    #[must_use]
    pub fn coordinates(&self) -> [f64; N] {
        self.state[0].map(|x| x.value)
    }
    /// p = ∂S/∂q.
    #[must_use]
    pub fn momenta(&self) -> [f64; N] {
        self.state[1].map(|x| x.value)
    }
    /// ∂q/∂σ, tangents of the front.
    #[must_use]
    pub fn tangents(&self) -> [[f64; N]; M] {
        from_fn(|k| self.state[0].map(|x| x.partials[k]))
    }
    /// The Jacobian det(∂q/∂σ, dq/dS) of the ray map: zero on a caustic.
    #[must_use]
    pub const fn jacobian(&self) -> f64 {
        self.jacobian
    }
    /// The caustics touched since the start, with their multiplicity: a focus in space counts twice. A ray that has
    /// touched one has not arrived first.
    ///
    /// They are seen by tangents of the front that turn round within one step; it must be short against the length on
    /// which the front itself turns.
    #[must_use]
    pub const fn caustics(&self) -> u32 {
        self.caustics
    }
    /// The largest difference of order six and four of q in one step.
    #[must_use]
    pub const fn error(&self) -> f64 {
        self.error
    }

    pub(super) const fn state(&self) -> &State<f64, N, M> {
        &self.state
    }

    pub(super) fn first_non_finite(&self) -> Option<f64> {
        let numbers = self.state.iter().flatten().flat_map(|x| [x.value].into_iter().chain(x.partials));
        numbers.into_iter().find(|x| !x.is_finite())
    }

    /// The ray that starts from an initial curve or surface.
    pub(super) fn start<H: PhaseFunction, C: InitialFront<N, M>>(
        (hamiltonian, initial, (side, energy)): (&H, &C, (f64, f64)),
        parameters: [f64; M],
    ) -> Result<Self, HamiltonianError> {
        check_finite("parameters of the front", &parameters)?;
        let varied: [Gradient<f64, M>; M] = from_fn(|i| Gradient::variable(parameters[i], i));
        let (q, normal) = (initial.at(varied), initial.normal(varied));
        check_finite("place on the initial front", &q)?;
        check_finite("normal of the initial front", &normal)?;
        let side = Gradient::constant(side);
        let direction = normal.map(|x| side * x);
        let line = Line { direction: &direction, rate: Gradient::constant(0.0), energy: Gradient::constant(energy) };
        let (scale, _) = momentum_scale(hamiltonian, (&q, Gradient::constant(0.0)), line, 1.0)?;
        let p = direction.map(|x| scale * x);
        // Fronts of the action at one energy are those of a Hamiltonian without time.
        let rate = rate_in_time(hamiltonian, &q.map(|x| x.value), &p.map(|x| x.value), 0.0);
        if rate.is_nan() || 0.0 < rate.abs() {
            return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::TimeDependentHamiltonian { rate }));
        }
        let before = [[0.0; N]; M];
        let mut ray = Self { parameters, state: [q, p], jacobian: 0.0, before, caustics: 0, error: 0.0 };
        ray.jacobian = jacobian(hamiltonian, &ray.state);
        ray.count();
        Ok(ray)
    }

    /// The tangents now are B times those before. Negative eigenvalues of B are caustics; where B is singular the ray
    /// is on one, and the next step will tell.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&mut self) {
        let now = self.tangents();
        let dot = |a: &[f64; N], b: &[f64; N]| (0..N).map(|i| a[i] * b[i]).sum::<f64>();
        let (a, b) = (&self.before, &now);
        let (turned, regular) = if M == 1 {
            let (ratio, square) = (dot(&b[0], &a[0]), dot(&a[0], &a[0]));
            (u32::from(ratio < 0.0), SINGULAR * square < ratio.abs() || square <= 0.0)
        } else {
            let (k, l) = (0, M - 1);
            let (g, h, i) = (dot(&a[k], &a[k]), dot(&a[k], &a[l]), dot(&a[l], &a[l]));
            let area = g * i - h * h;
            // B = (now·before)(before·before)⁻¹
            let [c, d, e, f] = [dot(&b[k], &a[k]), dot(&b[k], &a[l]), dot(&b[l], &a[k]), dot(&b[l], &a[l])];
            let determinant = (c * f - d * e) / area;
            let trace = (c * i - d * h + f * g - e * h) / area;
            let turned = if determinant < 0.0 { 1 } else { 2 * u32::from(trace < 0.0) };
            (turned, SINGULAR < determinant.abs() || area <= 0.0)
        };
        if regular {
            self.caustics += turned;
            self.before = now;
        }
    }
}

/// det(∂q/∂σ, dq/dS).
#[cfg_attr(not(debug_assertions), inline(always))]
fn jacobian<H: PhaseFunction, T: Real, const N: usize, const M: usize>(hamiltonian: &H, state: &State<T, N, M>) -> T {
    let [velocity, _] = rate(hamiltonian, state);
    let q = &state[0];
    let mut sum = T::zero();
    for i in 0..N {
        let speed = velocity[i].value;
        let (j, k) = ((i + 1) % N, (i + 2) % N);
        if N == 2 {
            let part = speed * q[j].partials[0];
            sum += if i == 1 { part } else { -part };
        } else {
            let other = M - 1;
            let minor = q[j].partials[0] * q[k].partials[other] - q[k].partials[0] * q[j].partials[other];
            sum += speed * minor;
        }
    }
    sum
}

/// Rays that are advanced together, in the lanes of the machine.
struct Bundle<'r, H, const N: usize, const M: usize> {
    hamiltonian: &'r H,
    rays: &'r mut [FrontRay<N, M>],
    step: f64,
    steps: usize,
}

impl<H: PhaseFunction, const N: usize, const M: usize> LaneKernel for Bundle<'_, H, N, M> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const L: usize>(self) {
        for rays in self.rays.chunks_mut(L) {
            // Lanes without a ray repeat the last one.
            let last = rays.len() - 1;
            let lanes = |f: &dyn Fn(&FrontRay<N, M>) -> f64| Lanes::<f64, L>(from_fn(|lane| f(&rays[lane.min(last)])));
            let mut state: State<Lanes<f64, L>, N, M> = from_fn(|k| {
                from_fn(|i| Gradient {
                    value: lanes(&|ray| ray.state[k][i].value),
                    partials: from_fn(|j| lanes(&|ray| ray.state[k][i].partials[j])),
                })
            });
            for ray in &mut *rays {
                ray.error = 0.0;
            }
            for _ in 0..self.steps {
                let (next, [error, _]) = advance(self.hamiltonian, &state, self.step);
                state = next;
                let determinant = jacobian(self.hamiltonian, &state);
                for (lane, ray) in rays.iter_mut().enumerate() {
                    ray.error = ray.error.max(error.0[lane]);
                    ray.jacobian = determinant.0[lane];
                    ray.state = from_fn(|k| {
                        from_fn(|i| Gradient {
                            value: state[k][i].value.0[lane],
                            partials: state[k][i].partials.map(|x| x.0[lane]),
                        })
                    });
                    ray.count();
                }
            }
        }
    }
}

/// So many steps of the action for each ray.
pub(super) fn advance_all<H: PhaseFunction, const N: usize, const M: usize>(
    hamiltonian: &H,
    rays: &mut [FrontRay<N, M>],
    step: f64,
    steps: usize,
) {
    dispatch_lanes::<_, 2, 4, 8>(Bundle { hamiltonian, rays, step, steps });
}
