//! Hamilton's principle on samples: the action of a computed motion, and how well its samples make a discrete
//! action stationary.
//!
//! ```text
//! I ≈ Σ ∫ L(Hermite's cubic through the samples) dt
//! I_d = Σ h_k L((q_k + q_{k+1})/2, (q_{k+1} − q_k)/h_k, t_k + h_k/2)        ∂I_d/∂q_k = 0
//! ```
//!
//! The samples of a motion satisfy the discrete equations to the second order of their spacing: a check that uses
//! neither the accelerations nor the integrator that made them.

use piola_kinematics::Holonomic;

use super::energy::With;
use super::workspace::Workspace;
use super::{Action, Forces, Lagrangian, Potential, Run};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// Samples (t, q, q̇) of a motion, at increasing times.
///
/// # Example
/// ```
/// use piola_lagrangian::SampledMotion;
/// let samples = SampledMotion::new(1, vec![0.0, 0.5, 2.0], vec![0.0, 1.0, 4.0], vec![2.0, 2.0, 2.0])?;
/// assert_eq!((samples.times()[1], samples.coordinates(1), samples.velocities(1)), (0.5, &[1.0][..], &[2.0][..]));
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct SampledMotion {
    freedom: usize,
    times: Vec<f64>,
    coordinates: Vec<f64>,
    velocities: Vec<f64>,
}

impl SampledMotion {
    /// Samples of a system of `freedom` coordinates, one after the other: the coordinates of the first time, then
    /// those of the second, …
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`]; [`LagrangianError::TimesNotIncreasing`].
    pub fn new(
        freedom: usize,
        times: Vec<f64>,
        coordinates: Vec<f64>,
        velocities: Vec<f64>,
    ) -> Result<Self, LagrangianError> {
        check_length("coordinates", freedom.saturating_mul(times.len()), coordinates.len())?;
        check_length("velocities", freedom.saturating_mul(times.len()), velocities.len())?;
        check_finite("times", &times)?;
        check_finite("coordinates", &coordinates)?;
        check_finite("velocities", &velocities)?;
        for (index, pair) in times.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                return Err(LagrangianError::TimesNotIncreasing { index: index + 1, time: pair[1], before: pair[0] });
            }
        }
        Ok(Self { freedom, times, coordinates, velocities })
    }

    /// All steps of a run forwards in time.
    ///
    /// # Errors
    /// [`LagrangianError::TimesNotIncreasing`] for a run backwards.
    pub fn of_run(run: &Run) -> Result<Self, LagrangianError> {
        let freedom = run.last().0.len();
        let steps = 0..run.times().len();
        let coordinates = steps.clone().filter_map(|step| run.coordinates(step)).flatten().copied().collect();
        let velocities = steps.filter_map(|step| run.velocities(step)).flatten().copied().collect();
        Self::new(freedom, run.times().to_vec(), coordinates, velocities)
    }

    /// The times, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The coordinates of a sample; empty beyond the last.
    #[must_use]
    pub fn coordinates(&self, sample: usize) -> &[f64] {
        let n = self.freedom;
        self.coordinates.chunks_exact(n.max(1)).nth(sample).unwrap_or(&[])
    }

    /// The velocities of a sample; empty beyond the last.
    #[must_use]
    pub fn velocities(&self, sample: usize) -> &[f64] {
        let n = self.freedom;
        self.velocities.chunks_exact(n.max(1)).nth(sample).unwrap_or(&[])
    }

    /// Hermite's cubic between two samples, at the fraction s: q and q̇.
    fn between(&self, (from, to): (usize, usize), s: f64, q: &mut [f64], v: &mut [f64]) {
        let h = self.times[to] - self.times[from];
        let r = 1.0 - s;
        let (q0, q1) = (self.coordinates(from), self.coordinates(to));
        let (v0, v1) = (self.velocities(from), self.velocities(to));
        for i in 0..self.freedom {
            let slope = (q1[i] - q0[i]) / h;
            q[i] =
                r * r * (1.0 + 2.0 * s) * q0[i] + s * s * (1.0 + 2.0 * r) * q1[i] + h * s * r * (r * v0[i] - s * v1[i]);
            v[i] = 6.0 * s * r * slope + r * (1.0 - 3.0 * s) * v0[i] + s * (1.0 - 3.0 * r) * v1[i];
        }
    }
}

/// How far samples are from making the discrete action stationary.
///
/// # Example
/// See [`Lagrangian::stationarity_of_samples`].
///
/// # Source
/// W(7.13–7.18).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StationarityResidual {
    /// The largest |∂I_d/∂q_k + ∫Q dt| over the time that belongs to the sample: a generalised force.
    pub worst: f64,
    /// The sample where it is met.
    pub sample: usize,
    /// The coordinate where it is met.
    pub coordinate: usize,
    /// The largest generalised force among the terms, |Δp|/h, |∂L/∂q| or |Q|: what the residual is small against.
    pub scale: f64,
}

/// Nodes of Gauss's rule with four points on (0, 1), and its weights.
const NODES: [f64; 4] =
    [0.069_431_844_202_973_71, 0.330_009_478_207_571_9, 0.669_990_521_792_428_1, 0.930_568_155_797_026_3];
const WEIGHTS: [f64; 4] =
    [0.173_927_422_568_726_93, 0.326_072_577_431_273_07, 0.326_072_577_431_273_07, 0.173_927_422_568_726_93];

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The action of samples, by Hermite's cubic between them and Gauss's rule with four points.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`]; [`LagrangianError::TooFewSamples`] below three, which give no error
    /// estimate.
    ///
    /// # Accuracy
    /// The error estimate is the difference to every second sample. It falls with the fourth power of the spacing,
    /// and with the sixth along a motion without applied forces: there the action is stationary, and the errors of
    /// the cubic enter by their squares.
    ///
    /// # Source
    /// W(7.10).
    pub fn action_of_samples(&self, samples: &SampledMotion) -> Result<Action, LagrangianError> {
        let last = samples.times.len();
        if last < 3 {
            return Err(LagrangianError::TooFewSamples { found: last, needed: 3 });
        }
        let value = self.action_by_stride(samples, 1)?;
        Ok(Action { value, error: (value - self.action_by_stride(samples, 2)?).abs() })
    }

    fn action_by_stride(&self, samples: &SampledMotion, stride: usize) -> Result<f64, LagrangianError> {
        let n = samples.freedom;
        let mut work = Workspace::default();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        let last = samples.times.len() - 1;
        let mut sum = piola_numerics::sums::CompensatedSum::new();
        for from in (0..last).step_by(stride) {
            let to = (from + stride).min(last);
            let (start, h) = (samples.times[from], samples.times[to] - samples.times[from]);
            for (node, weight) in NODES.into_iter().zip(WEIGHTS) {
                samples.between((from, to), node, &mut q, &mut v);
                sum.add(weight * h * self.energies_with(&mut work, &q, &v, start + h * node)?.lagrangian());
            }
        }
        Ok(sum.value())
    }

    /// How far the samples of a motion are from making the discrete action stationary: a check of Hamilton's
    /// principle that needs only their coordinates.
    ///
    /// ```text
    /// L_d(k) = h L((q_k + q_{k+1})/2, (q_{k+1} − q_k)/h, t_k + h/2)
    /// r_k = (∂L_d(k−1)/∂q_k + ∂L_d(k)/∂q_k) / ((h_{k−1} + h_k)/2) + Q
    /// ```
    ///
    /// Applied forces enter at the midpoints, as in d'Alembert's principle.
    ///
    /// # Errors
    /// [`LagrangianError::TooFewSamples`] below three; [`LagrangianError::WrongLength`].
    ///
    /// # Accuracy
    /// The residual of an exact motion at an even spacing h is O(h²).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_lagrangian::SampledMotion;
    /// # struct Stone;
    /// # impl Holonomic for Stone {
    /// #     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    /// #         bodies.particle(2.0, Vector3::new(T::zero(), T::zero(), q[0]));
    /// #     }
    /// # }
    /// let stone = Lagrangian::of(Stone).with_gravity(10.0);
    /// // At rest in the air: the weight of 20 N is not balanced.
    /// let hanging = SampledMotion::new(1, vec![0.0, 1.0, 2.0], vec![5.0; 3], vec![0.0; 3])?;
    /// assert_eq!(stone.stationarity_of_samples(&hanging)?.worst, 20.0);
    /// // Thrown, it is: the parabola satisfies the discrete equations exactly.
    /// let thrown = SampledMotion::new(1, vec![0.0, 1.0, 2.0], vec![0.0, 5.0, 0.0], vec![10.0, 0.0, -10.0])?;
    /// assert_eq!(stone.stationarity_of_samples(&thrown)?.worst, 0.0);
    /// let action = stone.action_of_samples(&thrown)?; // the cubic is exact
    /// assert!((action.value + 200.0 / 3.0).abs() < 1e-12 && action.error < 1e-12);
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(7.13–7.18).
    pub fn stationarity_of_samples(&self, samples: &SampledMotion) -> Result<StationarityResidual, LagrangianError> {
        let (n, count) = (samples.freedom, samples.times.len());
        if count < 3 {
            return Err(LagrangianError::TooFewSamples { found: count, needed: 3 });
        }
        let mut work = Workspace::default();
        let mut worst = StationarityResidual { worst: 0.0, sample: 1, coordinate: 0, scale: 0.0 };
        let zero = vec![0.0; n];
        let (mut before, mut after) = (zero.clone(), zero.clone());
        let (mut gradient, mut gradient_before) = (zero.clone(), zero.clone());
        let (mut q, mut v) = (zero.clone(), zero);
        let mut step_before = 0.0;
        for k in 0..count - 1 {
            let h = samples.times[k + 1] - samples.times[k];
            let (q0, q1) = (samples.coordinates(k), samples.coordinates(k + 1));
            for i in 0..n {
                q[i] = 0.5 * (q0[i] + q1[i]);
                v[i] = (q1[i] - q0[i]) / h;
            }
            let t = samples.times[k] + 0.5 * h;
            self.differentiate(&mut work, &q, &v, t, With::Velocities, &mut after);
            self.differentiate(&mut work, &q, &v, t, With::Coordinates, &mut gradient);
            self.add_generalised_forces(&mut work, &q, &v, t, &mut gradient)?;
            if 0 < k {
                let step = 0.5 * (step_before + h);
                for i in 0..n {
                    let change = (before[i] - after[i]) / step;
                    let force = 0.5 * (step_before * gradient_before[i] + h * gradient[i]) / step;
                    worst.scale = worst.scale.max(change.abs()).max(force.abs());
                    let residual = (change + force).abs();
                    if worst.worst < residual || residual.is_nan() {
                        worst = StationarityResidual { worst: residual, sample: k, coordinate: i, ..worst };
                    }
                }
            }
            core::mem::swap(&mut before, &mut after);
            core::mem::swap(&mut gradient_before, &mut gradient);
            step_before = h;
        }
        check_finite("residual", &[worst.worst])?;
        Ok(worst)
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    freedom: usize,
    times: Vec<f64>,
    coordinates: Vec<f64>,
    velocities: Vec<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for SampledMotion {
    type Error = LagrangianError;

    fn try_from(samples: Unchecked) -> Result<Self, LagrangianError> {
        Self::new(samples.freedom, samples.times, samples.coordinates, samples.velocities)
    }
}
