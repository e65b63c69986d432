//! Huygens' principle: a front as the envelope of the fronts emitted from the points of an earlier one.
//!
//! ```text
//! Q(σ, ω):  the end of the ray from q(σ) in the direction ω after the action ΔS
//! det(∂Q/∂σ, ∂Q/∂ω) = 0                                                                    W(13.28)
//! ```
//!
//! Nothing is used of the front here but its curve q(σ): neither its momenta nor that rays leave it across.

use core::array::from_fn;

use piola_numerics::{Gradient, Real};

use super::step::{State, advance};
use super::{InitialFront, WaveFront};
use crate::PhaseFunction;
use crate::check::check_finite;
use crate::hamilton_jacobi::momentum_length::{Line, momentum_scale};
use crate::{HamiltonJacobiError, HamiltonianError};

/// The directions between which the point of the envelope is sought, on either side of that of the momentum.
const BRACKET: f64 = 0.25;
/// Steps of the search for it.
const ITERATIONS: usize = 200;

impl<H: PhaseFunction + Sync, C: InitialFront<2, 1> + Sync> WaveFront<'_, H, C, 2, 1> {
    /// The point where the front emitted from the place of one ray touches the envelope of all fronts emitted from
    /// this front, after an action ΔS in so many steps.
    ///
    /// It is found as a point of the envelope, by the determinant above, in a wide range of directions around the
    /// ray's: where Huygens' principle holds it lies on the front advanced by ΔS, at the end of the ray.
    ///
    /// # Errors
    /// [`HamiltonJacobiError::NotFound`] where the determinant has no change of sign in that range, as at a caustic;
    /// [`HamiltonianError::NotFinite`]; [`HamiltonianError::WrongLength`] when there is no such ray.
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
    pub fn envelope_point(&self, ray: usize, action: f64, steps: usize) -> Result<[f64; 2], HamiltonianError> {
        check_finite("ΔS", &[action])?;
        let found = self.rays.get(ray);
        let Some(ray) = found else {
            let (expected, found) = (self.rays.len(), ray);
            return Err(HamiltonianError::WrongLength { quantity: "rays of the front", expected, found });
        };
        let step = action / steps.max(1) as f64;
        let [q, p] = ray.state();
        let centre = p[1].value.atan2(p[0].value);
        // Variations by σ, along the curve, and by ω.
        let start: [Gradient<f64, 2>; 2] =
            from_fn(|i| Gradient { value: q[i].value, partials: [q[i].partials[0], 0.0] });
        let emit = |angle: f64| -> Result<(f64, [f64; 2]), HamiltonianError> {
            let (s, c) = Gradient { value: angle, partials: [0.0, 1.0] }.sin_cos();
            let direction = [c, s];
            let line =
                Line { direction: &direction, rate: Gradient::constant(0.0), energy: Gradient::constant(self.energy) };
            let guess = p[0].value.hypot(p[1].value);
            let (scale, _) = momentum_scale(self.hamiltonian, (&start, Gradient::constant(0.0)), line, guess)?;
            let mut state: State<f64, 2, 2> = [start, direction.map(|x| x * scale)];
            for _ in 0..steps.max(1) {
                (state, _) = advance(self.hamiltonian, &state, step);
            }
            let [x, y] = state[0];
            let determinant = x.partials[0] * y.partials[1] - x.partials[1] * y.partials[0];
            check_finite("envelope", &[determinant])?;
            Ok((determinant, [x.value, y.value]))
        };
        // Two directions on unlike sides, so that the ray's own is none of the first places looked at.
        let (mut a, mut b) = (centre - BRACKET, centre + 0.8 * BRACKET);
        let (mut fa, mut fb) = (emit(a)?, emit(b)?);
        let iterations = ITERATIONS;
        if 0.0 < fa.0 * fb.0 {
            let residual = fa.0.abs().min(fb.0.abs());
            return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound {
                unknown: "points of the envelope",
                iterations: 0,
                residual,
            }));
        }
        let mut halve = false;
        for _ in 0..iterations {
            let secant = b - fb.0 * ((b - a) / (fb.0 - fa.0));
            let inside = (a < secant && secant < b) || (b < secant && secant < a);
            let middle = if halve || !inside { 0.5 * (a + b) } else { secant };
            let width = (b - a).abs();
            let fm = emit(middle)?;
            if fm.0.abs() <= 0.0 {
                return Ok(fm.1);
            }
            if (fm.0 < 0.0) == (fa.0 < 0.0) {
                (a, fa) = (middle, fm);
            } else {
                (b, fb) = (middle, fm);
            }
            halve = 0.5 * width < (b - a).abs();
            if (b - a).abs() <= 4.0 * f64::EPSILON * centre.abs().max(1.0) {
                break;
            }
        }
        Ok(if fa.0.abs() < fb.0.abs() { fa.1 } else { fb.1 })
    }
}
