//! Motions of constant stretch history, and the tests for them and for viscometric motions.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Dual, Real};

use super::{ExponentialMotion, HomogeneousMotion, RivlinEricksen, exponential_rows};
use crate::error::{check_bound, check_finite};
use crate::{ContinuumError, Symmetric};

/// A motion of constant stretch history, F(t) = Q(t) H exp(K t), W(22.33): apart from turning with Q it looks the same at all times.
///
/// ```text
/// Fₜ(t − s) = Q(t − s) H exp(−K s) H⁻¹ Q(t)ᵀ
/// ```
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_continuum::rates::{ConstantStretchHistory, ExponentialMotion, LinearMotion, stretch_history};
/// let turning = ExponentialMotion::new(Vector3::new(0.5, -0.25, 1.0).cross_matrix(), Matrix3::identity())?;
/// let generator = Matrix3::new(0.5, 0.25, 0.0, 0.0, -0.25, 1.0, 0.0, 0.0, -0.25);
/// let motion = ConstantStretchHistory { turning, reference: Matrix3::identity(), generator };
/// assert!(stretch_history(&motion, &[0.0, 0.5, 2.0], 1.0)? < 1e-12);
/// let linear = LinearMotion::new(Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(0.5, 0.0, 0.0)))?;
/// assert!(0.1 < stretch_history(&linear, &[0.0, 0.5, 2.0], 1.0)?);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantStretchHistory<Q> {
    /// Q(t), orthogonal.
    pub turning: Q,
    /// H.
    pub reference: Matrix3<f64>,
    /// K, 1/s.
    pub generator: Matrix3<f64>,
}

impl<Q: HomogeneousMotion> HomogeneousMotion for ConstantStretchHistory<Q> {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        let generator: Matrix3<T> = self.generator.map(T::lit);
        let rows = exponential_rows(rows_of(&(generator * t)));
        let exponential = Matrix3::from_fn(|i, j| rows[i][j]);
        self.turning.gradient(t) * self.reference.map(T::lit) * exponential
    }
}

/// A violation relative to a size; 0 where both are.
fn ratio(violation: f64, size: f64) -> f64 {
    if 0.0 < size { violation / size } else { violation }
}

/// Deviation of a motion from a constant stretch history, W(22.33): the largest change, from the first of the `times` to
/// the others, of an invariant of the tensors Cₜ(t − s) − 1 within the last `horizon` seconds, beside the invariant's size.
///
/// The invariants are the traces of products of up to three of Cₜ(t − s) − 1 at eight s: where the histories at two times differ by
/// a rotation only they are the same. A value far from rounding refutes; a small one is as good as the times and s tried.
///
/// # Errors
/// [`ContinuumError::OutOfBounds`] for fewer than two times, and unless 0 < `horizon`; [`ContinuumError::NonPositiveJacobian`] where the
/// motion is none.
///
/// # Example
/// See [`ConstantStretchHistory`].
pub fn stretch_history(motion: &impl HomogeneousMotion, times: &[f64], horizon: f64) -> Result<f64, ContinuumError> {
    let count = times.len() as f64;
    check_bound("number of times", count, "2 ≤ number", 2.0 <= count)?;
    check_bound("horizon", horizon, "0 < horizon", 0.0 < horizon)?;
    let at = |t: f64| -> Result<[Matrix3<f64>; 8], ContinuumError> {
        check_finite("t", &[t])?;
        let mut tensors = [Matrix3::zeros(); 8];
        for (i, tensor) in (1..=8).zip(&mut tensors) {
            let lapse = -horizon * f64::from(i) / 8.0;
            *tensor = motion.relative(t, lapse)?.right_cauchy_green_change().matrix();
        }
        Ok(tensors)
    };
    let first = at(times[0])?;
    let mut worst = 0.0_f64;
    for &t in &times[1..] {
        let other = at(t)?;
        for i in 0..8 {
            worst = worst.max(ratio((first[i].trace() - other[i].trace()).abs(), first[i].norm()));
            for j in i..8 {
                let (here, there) = (first[i] * first[j], other[i] * other[j]);
                let size = first[i].norm() * first[j].norm();
                worst = worst.max(ratio((here.trace() - there.trace()).abs(), size));
                for k in j..8 {
                    let change = (here * first[k]).trace() - (there * other[k]).trace();
                    worst = worst.max(ratio(change.abs(), size * first[k].norm()));
                }
            }
        }
    }
    Ok(worst)
}

/// A motion as a shear, seen by an observer who turns with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscometric {
    /// k, 1/s.
    pub shear_rate: f64,
    /// Unit vectors: of the gradient, 1, the flow, 2, and neutral, 3.
    pub axes: [Vector3<f64>; 3],
    /// The largest of what A₁, A₂, A₃ are beyond those of a shear, beside k, k², k³: far from rounding the motion is not
    /// viscometric.
    pub residual: f64,
}

/// The steady shear that a motion is at the time t, s, for an observer who turns with it, from its Rivlin–Ericksen tensors, which
/// determine a constant stretch history.
///
/// ```text
/// A₁ = k (e₁e₂ + e₂e₁)      A₂ = 2 k² e₁e₁      A₃ = 0
/// ```
/// `None` for a motion that is rigid there.
///
/// # Errors
/// [`ContinuumError::NonPositiveJacobian`] where the motion is none.
///
/// # Accuracy
/// A few ulp × (|L|/k)³ of the residual.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::rates::{ExponentialMotion, viscometric_motion};
/// let shear = Matrix3::new(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0);
/// let found = viscometric_motion(&ExponentialMotion::new(shear, Matrix3::identity())?, 2.0)?.expect("it flows");
/// assert!((found.shear_rate - 3.0).abs() < 1e-14 && found.residual < 1e-14);
/// assert!((found.axes[1].y.abs() - 1.0).abs() < 1e-15); // 2 is the flow
/// let stretching = Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0);
/// let found = viscometric_motion(&ExponentialMotion::new(stretching, Matrix3::identity())?, 0.0)?.expect("it flows");
/// assert!(0.5 < found.residual);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(22.29–22.33), W(23.10); C.-C. Wang, Arch. Rational Mech. Anal. 20 (1965) 329.
pub fn viscometric_motion(motion: &impl HomogeneousMotion, t: f64) -> Result<Option<Viscometric>, ContinuumError> {
    type Third = Dual<Dual<Dual<f64>>>;
    motion.deformation(t)?;
    let one = Dual::lit(1.0);
    let lapse: Third = Dual { value: Dual { value: Dual::variable(0.0), tangent: one }, tangent: Dual::lit(1.0) };
    let change = motion.relative_displacement(Third::lit(t), lapse);
    let strain = change + change.transpose() + change.transpose() * change;
    let part = |of: fn(&Third) -> f64| Symmetric::symmetric_part(rows_of(&strain.map(|x| of(&x))));
    let first = RivlinEricksen(part(|x| x.tangent.value.value));
    let second = RivlinEricksen(part(|x| x.tangent.tangent.value));
    let third = RivlinEricksen(part(|x| x.tangent.tangent.tangent));
    let rate = (0.5 * first.0.double_contraction(&first.0)).sqrt();
    check_finite("rate of deformation", &[rate])?;
    if rate <= 0.0 {
        return Ok(None);
    }
    // A₂ is 2 k² e₁e₁: its largest column is along e₁; A₁ leads from there to e₂.
    let columns = second.0.matrix();
    let widest = (0..3).max_by(|&i, &j| columns.column(i).norm().total_cmp(&columns.column(j).norm())).unwrap_or(0);
    let along: Vector3<f64> = columns.column(widest).into_owned();
    let gradient = if 0.0 < along.norm() { along / along.norm() } else { Vector3::x() };
    let image = first.0 * gradient;
    let flow = image - gradient * gradient.dot(&image);
    let flow = if 0.0 < flow.norm() { flow / flow.norm() } else { gradient.cross(&Vector3::y()) };
    let neutral = gradient.cross(&flow);
    let (n, m) = ([gradient.x, gradient.y, gradient.z], [flow.x, flow.y, flow.z]);
    let beyond = [
        (first.0 - Symmetric::symmetric_dyad(n, m) * (2.0 * rate)).norm() / rate,
        (second.0 - Symmetric::dyad(n) * (2.0 * rate * rate)).norm() / (rate * rate),
        third.0.norm() / (rate * rate * rate),
    ];
    let residual = beyond.into_iter().fold(0.0, f64::max);
    Ok(Some(Viscometric { shear_rate: rate, axes: [gradient, flow, neutral], residual }))
}

/// An observer who turns steadily: Q(t) = exp(Ω t), Ω v = ω × v.
///
/// # Errors
/// [`ContinuumError::NotFinite`].
pub fn steady_turn(angular_velocity: &Vector3<f64>) -> Result<ExponentialMotion, ContinuumError> {
    ExponentialMotion::new(angular_velocity.cross_matrix(), Matrix3::identity())
}
