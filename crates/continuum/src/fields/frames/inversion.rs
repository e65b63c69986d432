//! The particle at a place: X(x, t) by a damped Newton iteration, with a certificate.
//!
//! ```text
//! X ← X + λ F⁻¹ (x − x(X, t))        λ = 1, ½, ¼, … until |x − x(X, t)| falls and 0 < det F
//! h = β γ η ≤ ½,   β = |F⁻¹|,  η = β |x − x(X, t)|,  γ = Lipschitz constant of F
//! |X − X*| ≤ 2η/(1 + √(1 − 2h))      X* is the only solution within (1 + √(1 − 2h))/(βγ)
//! ```
//!
//! The bound is the theorem of Newton and Kantorovich in the maximum norm. The residual in η is increased by
//! the rounding of x(X, t).

use nalgebra::Vector3;
use piola_numerics::linear::matrix3::{determinant, inverse_and_determinant};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use crate::ContinuumError;
use crate::error::check_finite;
use crate::fields::motion::{Motion, kernels};
use crate::tensor::rows::{Rows, apply};

/// How hard to look for the particle at a place.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_continuum::DeformationGradient;
/// use piola_continuum::fields::{Affine, Inversion};
/// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&Vector3::new(2.0, 1.0, 1.0)))?;
/// let motion = Affine::new(stretch, Vector3::new(0.0, 0.0, 5.0))?;
/// let found = Inversion::default().preimage(&motion, &Vector3::new(6.0, 1.0, 5.0), 0.0)?;
/// assert_eq!(found.reference, Vector3::new(3.0, 1.0, 0.0));
/// assert!(found.error_bound < 1e-13);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Inversion {
    /// The most Newton steps.
    pub iterations: usize,
    /// The most halvings of one step.
    pub halvings: usize,
}

impl Default for Inversion {
    /// 50 steps, each halved up to 30 times.
    fn default() -> Self {
        Self { iterations: 50, halvings: 30 }
    }
}

/// The particle found at a place, with what is certain about it.
///
/// Lengths are in the maximum norm; over lanes each lane has its own.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: nalgebra::Scalar + serde::Deserialize<'de>"
    ))
)]
pub struct Preimage<T = f64> {
    /// X, m; over differentiable scalars with the derivatives of the inverse motion.
    pub reference: Vector3<T>,
    /// |x − x(X, t)|, m.
    pub residual: T,
    /// |X − X*| is at most this, m, where x(X*, t) = x exactly.
    pub error_bound: T,
    /// No other particle within this distance of X is at the place, m; infinite where F is uniform.
    pub uniqueness_radius: T,
    /// Newton steps taken.
    pub iterations: usize,
}

/// A particle under trial, with the place it has.
#[derive(Clone, Copy)]
struct Trial<T> {
    reference: Vector3<T>,
    residual: Vector3<T>,
    /// Largest component of the residual.
    size: T,
    gradient: Rows<T>,
    /// What of the residual may be rounding.
    rounding: T,
}

impl Inversion {
    /// X(x, t), looking from X = x.
    ///
    /// # Errors
    /// As [`preimage_near`](Self::preimage_near).
    #[inline]
    pub fn preimage<T: Real>(
        &self,
        motion: &impl Motion,
        place: &Vector3<T>,
        time: T,
    ) -> Result<Preimage<T>, ContinuumError> {
        self.preimage_near(motion, place, time, place)
    }

    /// X(x, t), looking from a guess.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | x, t | `place`, `time` | m, s |
    /// | first X | `guess` | m |
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`]; what the motion refuses at the guess;
    /// [`ContinuumError::NonPositiveJacobian`] at the guess; [`ContinuumError::InversionFailed`] with the best
    /// particle and its numbers when no step reduces the residual, the steps run out, or the certificate does
    /// not hold.
    ///
    /// # Accuracy
    /// `error_bound` is rigorous but for two estimates: the Lipschitz constant γ is taken as twice the second
    /// gradient of x(X, t) at X, which is exact there and doubled for its variation over the ball of the bound
    /// (a few ulp wide unless F is nearly singular); the rounding of x(X, t) as 8 ulp of |x| + |F| |X|.
    pub fn preimage_near<T: Real>(
        &self,
        motion: &impl Motion,
        place: &Vector3<T>,
        time: T,
        guess: &Vector3<T>,
    ) -> Result<Preimage<T>, ContinuumError> {
        check_finite("place", place.as_slice())?;
        check_finite("t", &[time])?;
        check_finite("guess", guess.as_slice())?;
        let (target, instant) = (place.map(T::frozen), time.frozen());
        let start = guess.map(T::frozen);
        motion.check_domain(&start, instant)?;
        let mut best = trial(motion, &target, instant, start);
        crate::deformation::gradient::check_jacobian(determinant(best.gradient))?;

        let mut iterations = 0;
        while !best.size.at_most(best.rounding).all() {
            let (step, step_size) = newton_step(&best);
            let stalled = step_size.at_most(T::lit(unit_in_last_place::<T>()) * largest(&best.reference));
            if (stalled | best.size.at_most(best.rounding)).all() {
                break;
            }
            if iterations == self.iterations {
                return Err(failure(&target, &best, iterations, T::lit(f64::INFINITY)));
            }
            iterations += 1;
            match self.damped(motion, &target, instant, &best, &step) {
                Some(better) => best = better,
                // Rounding larger than expected: the certificate decides whether this is a solution.
                None => break,
            }
        }
        certified(motion, place, time, &target, &best, iterations)
    }

    /// The first of X + λ δ, λ = 1, ½, ¼, …, that is better in every lane; lanes that have converged may stay.
    fn damped<T: Real>(
        &self,
        motion: &impl Motion,
        target: &Vector3<T>,
        time: T,
        from: &Trial<T>,
        step: &Vector3<T>,
    ) -> Option<Trial<T>> {
        let converged = from.size.at_most(from.rounding);
        let mut fraction = T::select(converged, T::zero(), T::one());
        for _ in 0..=self.halvings {
            let reference = from.reference + step * fraction;
            let half = T::lit(0.5);
            if motion.check_domain(&reference, time).is_err() {
                fraction *= half;
                continue;
            }
            let candidate = trial(motion, target, time, reference);
            // A quarter of the decrease that the linear model promises.
            let enough = candidate.size.at_most((T::one() - T::lit(0.25) * fraction) * from.size);
            let better = (enough & T::zero().less_than(determinant(candidate.gradient))) | converged;
            if better.all() {
                return Some(candidate);
            }
            fraction = T::select(better, fraction, fraction * half);
        }
        None
    }
}

/// What the motion makes of a particle.
#[inline]
fn trial<T: Real>(motion: &impl Motion, target: &Vector3<T>, time: T, reference: Vector3<T>) -> Trial<T> {
    let (place, gradient) = kernels::place_and_gradient(motion, &reference, time);
    let residual = target - place;
    let scale = largest(&place) + norm(&gradient) * largest(&reference);
    let rounding = T::lit(8.0 * unit_in_last_place::<T>()) * scale;
    Trial { reference, residual, size: largest(&residual), gradient, rounding }
}

/// (δ = F⁻¹ r, |δ|).
#[inline]
fn newton_step<T: Real>(trial: &Trial<T>) -> (Vector3<T>, T) {
    let (inverse, _) = inverse_and_determinant(trial.gradient);
    let step = Vector3::from(apply(inverse, trial.residual.into()));
    (step, largest(&step))
}

/// The certificate of Newton and Kantorovich, and the derivatives of X where `T` has some.
fn certified<T: Real>(
    motion: &impl Motion,
    place: &Vector3<T>,
    time: T,
    target: &Vector3<T>,
    best: &Trial<T>,
    iterations: usize,
) -> Result<Preimage<T>, ContinuumError> {
    let (inverse, _) = inverse_and_determinant(best.gradient);
    let beta = norm(&inverse);
    let eta = beta * (best.size + best.rounding);
    let second = kernels::second_gradient(motion, &best.reference, time.frozen());
    let curvature = second.map(|matrix| matrix.as_flattened().iter().fold(T::zero(), |sum, x| sum + x.abs()));
    let gamma = T::lit(2.0) * curvature[0].max(curvature[1]).max(curvature[2]);
    let h = beta * gamma * eta;
    if !h.at_most(T::lit(0.5)).all() {
        return Err(failure(target, best, iterations, h));
    }
    let root = T::one() + (T::one() - T::lit(2.0) * h).sqrt();

    // Each step with the value of F⁻¹ brings in one more order of derivatives.
    let mut reference = best.reference;
    for _ in 0..T::ORDER {
        let residual = place - motion.place(&reference, time);
        reference += Vector3::from(apply(inverse, residual.into()));
    }
    Ok(Preimage {
        reference,
        residual: best.size,
        error_bound: T::lit(2.0) * eta / root,
        uniqueness_radius: root / (beta * gamma),
        iterations,
    })
}

/// The first lane without a certificate, as an error.
fn failure<T: Real>(target: &Vector3<T>, best: &Trial<T>, iterations: usize, h: T) -> ContinuumError {
    let certain = |lane: usize| best.size.primal(lane) <= best.rounding.primal(lane) && h.primal(lane) <= 0.5;
    let lane = (0..T::LANES).find(|&lane| !certain(lane)).unwrap_or(0);
    let number = |x: T| x.primal(lane);
    ContinuumError::InversionFailed {
        place: target.map(number).into(),
        best: best.reference.map(number).into(),
        residual: number(best.size),
        determinant: number(determinant(best.gradient)),
        kantorovich: number(h),
        iterations,
    }
}

/// The largest component in modulus.
#[inline(always)]
fn largest<T: Real>(v: &Vector3<T>) -> T {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

/// The norm that belongs to the largest component: the largest sum of a row.
#[inline(always)]
fn norm<T: Real>(a: &Rows<T>) -> T {
    let sums = a.map(|row| row[0].abs() + row[1].abs() + row[2].abs());
    sums[0].max(sums[1]).max(sums[2])
}
