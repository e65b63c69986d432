//! Histories seen by other observers and from other references, and theorems of simple fluids on them.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::Symmetric;
use piola_continuum::rates::{ExponentialMotion, HomogeneousMotion, RivlinEricksen};
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Dual, Real};

use super::simple_fluid::SimpleFluid;
use crate::FluidsError;
use crate::error::{check_bound, check_finite};

/// A motion as a turning observer sees it: Q(t) F(t).
///
/// # Source
/// W(18.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenFrom<M, Q> {
    /// F(t).
    pub motion: M,
    /// Q(t), orthogonal.
    pub observer: Q,
}

impl<M: HomogeneousMotion, Q: HomogeneousMotion> HomogeneousMotion for SeenFrom<M, Q> {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        self.observer.gradient(t) * self.motion.gradient(t)
    }
}

/// A motion from another reference: F(t) H.
///
/// # Source
/// W(18.24).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Referred<M> {
    /// F(t).
    pub motion: M,
    /// H; det H = 1 keeps the density.
    pub reference: Matrix3<f64>,
}

impl<M: HomogeneousMotion> HomogeneousMotion for Referred<M> {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        self.motion.gradient(t) * self.reference.map(T::lit)
    }
}

/// A motion of constant stretch history, F(t) = Q(t) H exp(K t), W(22.33): apart from turning with Q it looks the same at all times.
///
/// ```text
/// Fₜ(t − s) = Q(t − s) H exp(−K s) H⁻¹ Q(t)ᵀ
/// ```
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fluids::{ConstantStretchHistory, stretch_history};
/// use piola_continuum::rates::{ExponentialMotion, LinearMotion};
/// let turning = ExponentialMotion::new(Vector3::new(0.5, -0.25, 1.0).cross_matrix(), Matrix3::identity())?;
/// let generator = Matrix3::new(0.5, 0.25, 0.0, 0.0, -0.25, 1.0, 0.0, 0.0, -0.25);
/// let motion = ConstantStretchHistory { turning, reference: Matrix3::identity(), generator };
/// assert!(stretch_history(&motion, &[0.0, 0.5, 2.0], 1.0)? < 1e-12);
/// let linear = LinearMotion::new(Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(0.5, 0.0, 0.0)))?;
/// assert!(0.1 < stretch_history(&linear, &[0.0, 0.5, 2.0], 1.0)?);
/// # Ok::<(), piola_fluids::FluidsError>(())
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
        let rows = piola_continuum::rates::exponential_rows(rows_of(&(generator * t)));
        let exponential = Matrix3::from_fn(|i, j| rows[i][j]);
        self.turning.gradient(t) * self.reference.map(T::lit) * exponential
    }
}

/// A violation relative to a size; 0 where both are.
fn ratio(violation: f64, size: f64) -> f64 {
    if 0.0 < size { violation / size } else { violation }
}

/// Relative violation of objectivity, W(19.11) and W(19.13): the difference between the stress seen by an observer who turns with Q(t)
/// and the turned stress, over the stress. Zero for a simple fluid.
///
/// A constant Q, which may be improper, tries the isotropy of the functional.
///
/// # Errors
/// As [`SimpleFluid::response_to_motion`].
///
/// # Accuracy
/// The `tolerance` of what is integrated; rounding and quadrature elsewhere.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fluids::{UpperConvectedMaxwell, fluid_indifference};
/// use piola_continuum::rates::ExponentialMotion;
/// let fluid = UpperConvectedMaxwell::new(2.0, 0.5)?;
/// let l = Matrix3::new(0.5, 1.0, 0.0, 0.0, -0.25, 0.5, 0.0, 0.0, -0.25);
/// let motion = ExponentialMotion::new(l, Matrix3::identity())?;
/// let observer = ExponentialMotion::new(Vector3::new(0.5, -2.0, 1.0).cross_matrix(), Matrix3::identity())?;
/// assert!(fluid_indifference(&fluid, motion, observer, 1.5, 1e-11)? < 1e-9);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
pub fn fluid_indifference<M: HomogeneousMotion, Q: HomogeneousMotion>(
    fluid: &impl SimpleFluid,
    motion: M,
    observer: Q,
    t: f64,
    tolerance: f64,
) -> Result<f64, FluidsError> {
    let turn = observer.gradient(t);
    let stress = fluid.response_to_motion(&motion, t, tolerance)?.matrix();
    let seen = fluid.response_to_motion(&SeenFrom { motion, observer }, t, tolerance)?.matrix();
    Ok(ratio((seen - turn * stress * turn.transpose()).norm(), stress.norm()))
}

/// Relative change of the stress where the same motion is described from another reference of the same density, F(t) H with
/// det H = 1, W(19.6) and W(19.10): zero for a fluid.
///
/// # Errors
/// As [`SimpleFluid::response_to_motion`]; [`FluidsError::OutOfBounds`] unless det H = 1 to rounding.
///
/// # Accuracy
/// As [`fluid_indifference`].
pub fn reference_indifference<M: HomogeneousMotion>(
    fluid: &impl SimpleFluid,
    motion: M,
    reference: &Matrix3<f64>,
    t: f64,
    tolerance: f64,
) -> Result<f64, FluidsError> {
    let determinant = reference.determinant();
    let unimodular = (determinant - 1.0).abs() <= 1e-12 * (1.0 + reference.norm().powi(3));
    check_bound("change of reference", "det H", determinant, "det H = 1", unimodular)?;
    let stress = fluid.response_to_motion(&motion, t, tolerance)?.matrix();
    let seen = fluid.response_to_motion(&Referred { motion, reference: *reference }, t, tolerance)?.matrix();
    Ok(ratio((seen - stress).norm(), stress.norm()))
}

/// Deviations of a vector f from a proper vector of the history and of the stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneHistory {
    /// The largest |Cₜ(t − s) f − (f·Cₜ f) f| beside |Cₜ|, at times since the start: zero for a plane history.
    pub history: f64,
    /// |T f − (f·T f) f| beside |T + p 1|: then zero too.
    pub stress: f64,
}

/// Tries the theorem of plane histories, W(19.18): where f is a proper vector of all Uₜ(t − s), it is one of the stress.
///
/// # Errors
/// As [`SimpleFluid::response_to_motion`]; [`FluidsError::OutOfBounds`] for an f without direction.
///
/// # Accuracy
/// As [`fluid_indifference`].
///
/// # Example
/// See [`fluid_indifference`].
pub fn plane_history(
    fluid: &impl SimpleFluid,
    motion: &impl HomogeneousMotion,
    normal: &Vector3<f64>,
    t: f64,
    tolerance: f64,
) -> Result<PlaneHistory, FluidsError> {
    let size = normal.norm();
    check_bound("plane history", "|f|", size, "0 < |f|", 0.0 < size)?;
    let f = normal / size;
    let across = |a: &Symmetric| {
        let image = *a * f;
        ratio((image - f * f.dot(&image)).norm(), a.norm())
    };
    let mut history = 0.0_f64;
    for i in 1..=16 {
        let relative = motion.relative(t, -t * f64::from(i) / 16.0)?;
        history = history.max(across(&relative.right_cauchy_green()));
    }
    let stress = across(&fluid.response_to_motion(motion, t, tolerance)?);
    Ok(PlaneHistory { history, stress })
}

/// Deviation of a motion from a constant stretch history, W(22.33): the largest change, from the first of the `times` to
/// the others, of an invariant of the tensors Cₜ(t − s) − 1 within the last `horizon` seconds, beside the invariant's size.
///
/// The invariants are the traces of products of up to three of Cₜ(t − s) − 1 at eight s: where the histories at two times differ by
/// a rotation only they are the same. A value far from rounding refutes; a small one is as good as the times and s tried.
///
/// # Errors
/// [`FluidsError::OutOfBounds`] for fewer than two times, and unless 0 < `horizon`; [`FluidsError::Continuum`] where the
/// motion is none.
///
/// # Example
/// See [`ConstantStretchHistory`].
pub fn stretch_history(motion: &impl HomogeneousMotion, times: &[f64], horizon: f64) -> Result<f64, FluidsError> {
    let count = times.len() as f64;
    check_bound("stretch history", "number of times", count, "2 ≤ number", 2.0 <= count)?;
    check_bound("stretch history", "horizon", horizon, "0 < horizon", 0.0 < horizon)?;
    let at = |t: f64| -> Result<[Matrix3<f64>; 8], FluidsError> {
        check_finite("stretch history", "time", t)?;
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
/// [`FluidsError::Continuum`] where the motion is none.
///
/// # Accuracy
/// A few ulp × (|L|/k)³ of the residual.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_fluids::viscometric_motion;
/// use piola_continuum::rates::ExponentialMotion;
/// let shear = Matrix3::new(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0);
/// let found = viscometric_motion(&ExponentialMotion::new(shear, Matrix3::identity())?, 2.0)?.expect("it flows");
/// assert!((found.shear_rate - 3.0).abs() < 1e-14 && found.residual < 1e-14);
/// assert!((found.axes[1].y.abs() - 1.0).abs() < 1e-15); // 2 is the flow
/// let stretching = Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0);
/// let found = viscometric_motion(&ExponentialMotion::new(stretching, Matrix3::identity())?, 0.0)?.expect("it flows");
/// assert!(0.5 < found.residual);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// W(22.29–22.33), W(23.10); C.-C. Wang, Arch. Rational Mech. Anal. 20 (1965) 329.
pub fn viscometric_motion(motion: &impl HomogeneousMotion, t: f64) -> Result<Option<Viscometric>, FluidsError> {
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
    check_finite("motion", "rate of deformation", rate)?;
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
/// [`FluidsError::Continuum`] for an ω that is not finite.
pub fn steady_turn(angular_velocity: &Vector3<f64>) -> Result<ExponentialMotion, FluidsError> {
    Ok(ExponentialMotion::new(angular_velocity.cross_matrix(), Matrix3::identity())?)
}
