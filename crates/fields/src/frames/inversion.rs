//! The particle at a place: X(x, t) by a damped Newton iteration, with a certificate.
//!
//! ```text
//! X ← X + λ F⁻¹ (x − x(X, t))        λ = 1, ½, ¼, … until |x − x(X, t)| falls and 0 < det F
//! η = |F⁻¹(X)| |x − x(X, t)|,    κ = max |1 − F⁻¹(X) F(Y)| over |Y − X| ≤ 2η
//! κ ≤ ½:   |X − X*| ≤ η/(1 − κ),  and X* is the only particle within 2η of X that is at x
//! ```
//!
//! Y − F⁻¹(X) (x(Y) − x) contracts the ball by κ and moves its centre by no more than η, so it has one fixed point
//! in it (Banach). Norms are of the largest component, so the ball is a cube; the residual in η is increased by the
//! rounding of x(X, t).
//!
//! | | |
//! |---|---|
//! | proved | the bound and the uniqueness within it, **given** κ |
//! | exact | κ where F is linear in X: motions of the first and second degree, whose κ is attained at a corner |
//! | estimated | κ of any other motion: twice the largest at the eight corners of the cube |
//!
//! The cube is a few ulp wide unless F is nearly singular. How far beyond it no other particle is at the place
//! is a different question, answered on request by [`Preimage::uniqueness_radius`], as an estimate.

use nalgebra::Vector3;
use piola_numerics::linear::matrix3::{determinant, inverse_and_determinant};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, apply, difference, identity, product};

use crate::FieldsError;
use crate::error::check_finite;
use crate::motion::{Motion, kernels};

/// How hard to look for the particle at a place.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_continuum::DeformationGradient;
/// use piola_fields::{Affine, Inversion};
/// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&Vector3::new(2.0, 1.0, 1.0)))?;
/// let motion = Affine::new(stretch, Vector3::new(0.0, 0.0, 5.0))?;
/// let found = Inversion::default().preimage(&motion, &Vector3::new(6.0, 1.0, 5.0), 0.0)?;
/// assert_eq!(found.reference, Vector3::new(3.0, 1.0, 0.0));
/// assert!(found.error_bound < 1e-13);
/// # Ok::<(), piola_fields::FieldsError>(())
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
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::DeformationGradient;
/// use piola_fields::{Affine, Inversion, Preimage};
/// let motion = Affine::new(DeformationGradient::diagonal([2.0, 1.0, 1.0])?, Vector3::zeros())?;
/// let found: Preimage = Inversion::default().preimage(&motion, &Vector3::new(6.0, 1.0, 5.0), 0.0)?;
/// assert_eq!(found.reference, Vector3::new(3.0, 1.0, 5.0));
/// assert!(found.residual <= found.error_bound && found.error_bound < 1e-13);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: crate::integrand::Integrand<Scalar = T> + Real + serde::Deserialize<'de>"
    ))
)]
pub struct Preimage<T = f64> {
    /// X, m; over differentiable scalars with the derivatives of the inverse motion.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub reference: Vector3<T>,
    /// |x − x(X, t)|, m.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub residual: T,
    /// |X − X*| is at most this, m, where x(X*, t) = x exactly; X* is the only such particle within this distance.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub error_bound: T,
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
        t: T,
    ) -> Result<Preimage<T>, FieldsError> {
        self.preimage_near(motion, place, t, place)
    }

    /// X(x, t), looking from a guess.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | x, t | `place`, `t` | m, s |
    /// | first X | `guess` | m |
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`]; what the motion refuses at the guess;
    /// [`ContinuumError::NonPositiveJacobian`](piola_continuum::ContinuumError::NonPositiveJacobian) at the guess; [`FieldsError::InversionFailed`] with the best
    /// particle and its numbers when no step reduces the residual, the steps run out, or the certificate does
    /// not hold.
    ///
    /// # Accuracy
    /// `error_bound` is proved but for two estimates: how far F changes within it is taken as twice the most at the
    /// eight corners of its cube, which is more than enough for motions of the second degree; the rounding of
    /// x(X, t) is taken as 8 ulp of |x| + |F| |X|.
    pub fn preimage_near<T: Real>(
        &self,
        motion: &impl Motion,
        place: &Vector3<T>,
        t: T,
        guess: &Vector3<T>,
    ) -> Result<Preimage<T>, FieldsError> {
        check_finite("place", place.as_slice())?;
        check_finite("t", &[t])?;
        check_finite("guess", guess.as_slice())?;
        let (target, instant) = (place.map(T::frozen), t.frozen());
        let start = guess.map(T::frozen);
        motion.check_domain(&start, instant)?;
        let mut best = trial(motion, &target, instant, start);
        piola_continuum::internal::check_jacobian(determinant(best.gradient))?;

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
        certified(motion, place, t, &target, &best, iterations)
    }

    /// The first of X + λ δ, λ = 1, ½, ¼, …, that is better in every lane; lanes that have converged may stay.
    fn damped<T: Real>(
        &self,
        motion: &impl Motion,
        target: &Vector3<T>,
        t: T,
        from: &Trial<T>,
        step: &Vector3<T>,
    ) -> Option<Trial<T>> {
        let converged = from.size.at_most(from.rounding);
        let mut fraction = T::select(converged, T::zero(), T::one());
        for _ in 0..=self.halvings {
            let reference = from.reference + step * fraction;
            let half = T::lit(0.5);
            if motion.check_domain(&reference, t).is_err() {
                fraction *= half;
                continue;
            }
            let candidate = trial(motion, target, t, reference);
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
fn trial<T: Real>(motion: &impl Motion, target: &Vector3<T>, t: T, reference: Vector3<T>) -> Trial<T> {
    let (place, gradient) = kernels::place_and_gradient(motion, &reference, t);
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

impl<T: Real> Preimage<T> {
    /// How far around X no two particles share a place, m, looked for up to `reach`: an estimate.
    ///
    /// ```text
    /// |1 − F⁻¹(X) F(Y)| ≤ κ < 1 for all Y in the cube |Y − X| ≤ ρ     ⟹     x(Y) ≠ x(Z) for Y ≠ Z in it
    /// ```
    /// The cubes of ρ = `reach`·2⁻⁵², …, ½ `reach`, `reach` are tried from the smallest on, each at its 8 corners and
    /// the centres of its 12 edges and 6 faces; the last one before one of these points exceeds κ = ½ is the answer,
    /// zero where the first does. The implication is a theorem; the estimate is that F changes between
    /// the points no more than twice as much as at them. A motion with ripples shorter than the distance of the points may
    /// deceive it.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | t | `t`, that of the inversion | s |
    /// | largest ρ | `reach` | m |
    ///
    /// Particles for which the motion is not defined are left out. Costs at most 26 · 53 evaluations of F.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`]; what the motion refuses at X; [`ContinuumError::NonPositiveJacobian`](piola_continuum::ContinuumError::NonPositiveJacobian) at X.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_fields::{Inversion, Motion};
    /// use piola_numerics::Real;
    /// // x = X − X³ has F = 1 − 3X²: the particles −1, 0 and 1 are all at the place 0.
    /// struct Cubic;
    /// impl Motion for Cubic {
    ///     fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
    ///         let [x, y, z] = (*reference).into();
    ///         Vector3::new(x - x * x * x, y, z)
    ///     }
    /// }
    /// let found = Inversion::default().preimage(&Cubic, &Vector3::zeros(), 0.0)?;
    /// // 3 ρ² ≤ ½ holds for ¼ and fails for ½.
    /// assert_eq!(found.uniqueness_radius(&Cubic, 0.0, 8.0)?, 0.25);
    /// # Ok::<(), piola_fields::FieldsError>(())
    /// ```
    pub fn uniqueness_radius(&self, motion: &impl Motion, t: T, reach: T) -> Result<T, FieldsError> {
        check_finite("X", self.reference.as_slice())?;
        check_finite("t", &[t])?;
        check_finite("reach", &[reach])?;
        let (centre, instant) = (self.reference.map(T::frozen), t.frozen());
        motion.check_domain(&centre, instant)?;
        let gradient = kernels::gradient(motion, &centre, instant);
        check_finite("F", gradient.as_flattened())?;
        piola_continuum::internal::check_jacobian(determinant(gradient))?;
        let (inverse, _) = inverse_and_determinant(gradient);

        let mut radius = T::zero();
        let mut size = reach.frozen().abs() * T::lit(f64::EPSILON);
        let mut inside = size.at_most(size);
        for _ in 0..=52 {
            let change = change_of_gradient(motion, &centre, instant, inverse, size, &LATTICE);
            inside = inside & change.at_most(T::lit(0.5));
            if !inside.any() {
                break;
            }
            radius = T::select(inside, size, radius);
            size = size + size;
        }
        Ok(radius)
    }
}

/// The corners of a cube, then the centres of its edges and faces.
const LATTICE: [[f64; 3]; 26] = lattice();
const CORNERS: usize = 8;

const fn lattice() -> [[f64; 3]; 26] {
    const STEPS: [f64; 3] = [-1.0, 0.0, 1.0];
    let mut points = [[0.0; 3]; 26];
    let (mut corners, mut others, mut n) = (0, CORNERS, 0);
    while n < 27 {
        let (i, j, k) = (n / 9, n / 3 % 3, n % 3);
        let point = [STEPS[i], STEPS[j], STEPS[k]];
        if i != 1 && j != 1 && k != 1 {
            points[corners] = point;
            corners += 1;
        } else if n != 13 {
            points[others] = point;
            others += 1;
        }
        n += 1;
    }
    points
}

/// max |1 − F⁻¹(X) F(Y)| over those of the points Y = X + ρ eₖ for which the motion is defined.
fn change_of_gradient<T: Real>(
    motion: &impl Motion,
    centre: &Vector3<T>,
    t: T,
    inverse: Rows<T>,
    radius: T,
    points: &[[f64; 3]],
) -> T {
    let mut most = T::zero();
    for point in points {
        let there = centre + Vector3::from(point.map(T::lit)) * radius;
        if motion.check_domain(&there, t).is_err() {
            continue;
        }
        let moved = product(inverse, kernels::gradient(motion, &there, t));
        let change = norm(&difference(moved, identity()));
        // What is not a number is no small change.
        most = T::select(change.at_most(most), most, change);
        most = T::select(most.is_finite(), most, T::lit(f64::INFINITY));
    }
    most
}

/// The certificate of the contraction, and the derivatives of X where `T` has some.
fn certified<T: Real>(
    motion: &impl Motion,
    place: &Vector3<T>,
    t: T,
    target: &Vector3<T>,
    best: &Trial<T>,
    iterations: usize,
) -> Result<Preimage<T>, FieldsError> {
    let (inverse, _) = inverse_and_determinant(best.gradient);
    let eta = norm(&inverse) * (best.size + best.rounding);
    let two = T::lit(2.0);
    let corners = &LATTICE[..CORNERS];
    let change = two * change_of_gradient(motion, &best.reference, t.frozen(), inverse, two * eta, corners);
    if !change.at_most(T::lit(0.5)).all() {
        return Err(failure(target, best, iterations, change));
    }

    // Each step with the value of F⁻¹ brings in one more order of derivatives.
    let mut reference = best.reference;
    for _ in 0..T::ORDER {
        let residual = place - motion.place(&reference, t);
        reference += Vector3::from(apply(inverse, residual.into()));
    }
    Ok(Preimage { reference, residual: best.size, error_bound: eta / (T::one() - change), iterations })
}

/// The first lane without a certificate, as an error.
fn failure<T: Real>(target: &Vector3<T>, best: &Trial<T>, iterations: usize, change: T) -> FieldsError {
    let certain = |lane: usize| best.size.primal(lane) <= best.rounding.primal(lane) && change.primal(lane) <= 0.5;
    let lane = (0..T::LANES).find(|&lane| !certain(lane)).unwrap_or(0);
    let number = |x: T| x.primal(lane);
    FieldsError::InversionFailed {
        place: target.map(number).into(),
        best: best.reference.map(number).into(),
        residual: number(best.size),
        determinant: number(determinant(best.gradient)),
        change: number(change),
        iterations,
    }
}

/// The largest component in modulus.
#[cfg_attr(not(debug_assertions), inline(always))]
fn largest<T: Real>(v: &Vector3<T>) -> T {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

/// The norm that belongs to the largest component: the largest sum of a row.
#[cfg_attr(not(debug_assertions), inline(always))]
fn norm<T: Real>(a: &Rows<T>) -> T {
    let sums = a.map(|row| row[0].abs() + row[1].abs() + row[2].abs());
    sums[0].max(sums[1]).max(sums[2])
}
