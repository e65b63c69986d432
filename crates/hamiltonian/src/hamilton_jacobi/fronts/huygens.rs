//! Huygens' principle: a front as the envelope of the fronts emitted from the points of an earlier one.
//!
//! ```text
//! Q(σ, d), p:  the end of the ray from q(σ) with momenta along d, after the action ΔS
//! p·∂Q/∂σₖ = 0 for all k                                                                   W(13.28)
//! ```
//! p is normal to the front emitted from q(σ), so these are the directions in which Q stays on that front when σ changes. In
//! the plane det(∂Q/∂σ, ∂Q/∂ω) = ± |∂Q/∂ω| (p·∂Q/∂σ)/|p| with the angle ω of d: it vanishes with p·∂Q/∂σ, and besides where
//! the emitted front itself has a caustic, which is no matter of the envelope.
//!
//! Nothing is used of the front here but its curve or surface q(σ) and its side: neither its momenta nor that rays leave it
//! across.

use core::array::from_fn;

use nalgebra::{SMatrix, SVector};
use piola_numerics::Gradient;

use super::step::{State, advance};
use super::{InitialFront, WaveFront};
use crate::PhaseFunction;
use crate::check::check_finite;
use crate::hamilton_jacobi::momentum_length::{Line, momentum_scale};
use crate::{HamiltonJacobiError, HamiltonianError};

/// Newton steps after which a point of the envelope is given up.
const ITERATIONS: usize = 60;
/// Where the emitted rays of the first attempt point: beside the normal by this part of the tangents.
const ASIDE: f64 = 0.7;

impl<H: PhaseFunction + Sync, C: InitialFront<N, M> + Sync, const N: usize, const M: usize> WaveFront<'_, H, C, N, M> {
    /// The point where the front emitted from the place of one ray touches the envelope of all fronts emitted from
    /// this front, after an action ΔS in so many steps.
    ///
    /// It is found as a point of the envelope, by the condition above, from directions half-way between the normal and the
    /// tangents: where Huygens' principle holds it lies on the front advanced by ΔS, at the end of the ray, also where the
    /// front has passed a caustic by then.
    ///
    /// For Hamiltonians that depend on time, and for any number of coordinates, see
    /// [`Transversals::envelope_event`](crate::hamilton_jacobi::Transversals::envelope_event).
    ///
    /// # Errors
    /// [`HamiltonJacobiError::NotFound`] where the front has no tangents, as at a caustic, or the iteration does not
    /// converge; [`HamiltonianError::NotFinite`]; [`HamiltonianError::WrongLength`] when there is no such ray.
    ///
    /// # Accuracy
    /// That of [`advance`](Self::advance).
    ///
    /// # Example
    /// ```
    /// # use piola_hamiltonian::hamilton_jacobi::{InitialFront, WaveFront};
    /// # use piola_hamiltonian::PhaseFunction;
    /// # use piola_numerics::Real;
    /// # struct Even; // H = |p|
    /// # impl PhaseFunction for Even {
    /// #     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
    /// #         (p[0] * p[0] + p[1] * p[1]).sqrt()
    /// #     }
    /// # }
    /// # struct Circle;
    /// # impl InitialFront<2, 1> for Circle {
    /// #     fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
    /// #         [a.cos(), a.sin()]
    /// #     }
    /// # }
    /// // Circles of radius 1/2 around the points of a circle of radius 1 touch one of radius 3/2.
    /// let front = WaveFront::open(&Even, &Circle, 1.0, 1.0, (0.0, 1.0), 2)?;
    /// let [x, y] = front.envelope_point(0, 0.5, 1)?;
    /// assert!((x - 1.5).abs() < 1e-14 && y.abs() < 1e-14);
    /// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
    /// ```
    ///
    /// # Source
    /// W(13.28).
    pub fn envelope_point(&self, ray: usize, action: f64, steps: usize) -> Result<[f64; N], HamiltonianError> {
        check_finite("ΔS", &[action])?;
        let found = self.rays.get(ray);
        let Some(ray) = found else {
            let (expected, found) = (self.rays.len(), ray);
            return Err(HamiltonianError::WrongLength { quantity: "rays of the front", expected, found });
        };
        let step = action / steps.max(1) as f64;
        let [q, p] = ray.state();
        let lost = |iterations, residual| {
            let unknown = "points of the envelope";
            HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { unknown, iterations, residual })
        };
        let tangents = SMatrix::<f64, M, N>::from_fn(|k, i| q[i].partials[k]);
        let Some(inverse) = (tangents * tangents.transpose()).try_inverse() else { return Err(lost(0, f64::INFINITY)) };
        let across = |v: SVector<f64, N>| v - tangents.transpose() * (inverse * (tangents * v));
        // The side of the front to which its rays go.
        let side = across(SVector::from_fn(|i, _| p[i].value)).normalize();
        let aside =
            (0..M).fold(SVector::zeros(), |sum: SVector<f64, N>, k| sum + tangents.row(k).transpose().normalize());
        let mut direction = (side + aside * ASIDE).normalize();
        let mut guess = SVector::<f64, N>::from_fn(|i, _| p[i].value).norm();
        let emit = |direction: &SVector<f64, N>, guess: f64| -> Result<Emitted<N, M>, HamiltonianError> {
            let along: [Gradient<f64, M>; N] = from_fn(|i| Gradient::constant(direction[i]));
            let (rate, energy) = (Gradient::constant(0.0), Gradient::constant(self.energy));
            let line = Line { direction: &along, rate, energy };
            let (scale, _) = momentum_scale(self.hamiltonian, (q, Gradient::constant(0.0)), line, guess)?;
            let mut state: State<f64, N, M> = [*q, along.map(|x| x * scale)];
            for _ in 0..steps.max(1) {
                (state, _) = advance(self.hamiltonian, &state, step);
            }
            let [place, momenta] = state;
            let left = SVector::from_fn(|k, _| (0..N).map(|i| momenta[i].value * place[i].partials[k]).sum());
            check_finite("envelope", SVector::as_slice(&left))?;
            let terms = |k: usize| (0..N).map(|i| (momenta[i].value * place[i].partials[k]).abs()).sum::<f64>();
            let size = (0..M).map(terms).fold(0.0, f64::max);
            Ok(Emitted { place: place.map(|x| x.value), left, size, length: scale.value })
        };
        let mut now = emit(&direction, guess)?;
        for _ in 0..ITERATIONS {
            // The conditions are p₀·∂q/∂σₖ in other words: p₀ without what they ask of it along the tangents.
            guess = now.length;
            let momenta = direction * now.length - tangents.transpose() * (inverse * now.left);
            direction = momenta.normalize();
            let next = emit(&direction, guess)?;
            if next.left.norm() <= 4.0 * f64::EPSILON * next.size {
                return Ok(next.place);
            }
            // Rounding and the error of the steps are what is left.
            let better = next.left.norm() < 0.5 * now.left.norm();
            if !better && now.left.norm() <= SETTLED * now.size {
                return Ok(now.place);
            }
            now = next;
        }
        Err(lost(ITERATIONS, now.left.norm()))
    }
}

/// Below this part of its terms a condition holds, if it does not improve.
const SETTLED: f64 = 1e-6;

/// The end of an emitted ray.
struct Emitted<const N: usize, const M: usize> {
    place: [f64; N],
    /// p·∂Q/∂σₖ.
    left: SVector<f64, M>,
    /// The terms of these.
    size: f64,
    /// |p₀|.
    length: f64,
}
