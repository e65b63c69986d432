//! Simple materials: the stress as a functional of the history of the deformation.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_continuum::polar::StretchAnalysis;

use super::Viscoelastic;
use crate::Hyperelastic;
use crate::SolidsError;
use crate::error::check_bound;

/// A history F(t − s) of deformation gradients up to now, s ≥ 0.
///
/// Any closure from s to F is one.
pub trait History {
    /// F at the time s before now, s in seconds.
    #[must_use]
    fn gradient(&self, elapsed: f64) -> Matrix3<f64>;
}

impl<F: Fn(f64) -> Matrix3<f64>> History for F {
    fn gradient(&self, elapsed: f64) -> Matrix3<f64> {
        self(elapsed)
    }
}

/// A simple material: T = G(F(t − s), s ≥ 0), W(18.1).
///
/// # Example
/// A functional with a memory of one second, not frame-indifferent as it stands; [`Reduced`] makes it so: a rotation gives no stress.
/// ```
/// use nalgebra::{Matrix3, Rotation3, Vector3};
/// use piola_solids::memory::{History, Reduced, SimpleMaterial};
///
/// struct Mine;
/// impl SimpleMaterial for Mine {
///     fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
///         let (now, then) = (history.gradient(0.0), history.gradient(1.0));
///         now + now.transpose() - then - then.transpose()
///     }
/// }
///
/// let spin = |elapsed: f64| Rotation3::new(Vector3::z() * elapsed).into_inner();
/// assert!(0.5 < Mine.cauchy(&spin).norm());
/// assert!(Reduced(Mine).cauchy(&spin).norm() < 1e-15);
/// ```
pub trait SimpleMaterial {
    /// T now, Pa.
    #[must_use]
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64>;
}

/// The history U(t − s) of right stretches of a history of deformations. NaN where det F is not positive.
#[expect(missing_debug_implementations, reason = "a history may be a closure")]
pub struct StretchHistory<'a>(
    /// F(t − s).
    pub &'a dyn History,
);

impl History for StretchHistory<'_> {
    fn gradient(&self, elapsed: f64) -> Matrix3<f64> {
        polar(&self.0.gradient(elapsed)).1
    }
}

/// R and U of F.
fn polar(gradient: &Matrix3<f64>) -> (Matrix3<f64>, Matrix3<f64>) {
    DeformationGradient::new(*gradient).map_or_else(
        |_| (Matrix3::from_element(f64::NAN), Matrix3::from_element(f64::NAN)),
        |deformation| {
            let analysis = StretchAnalysis::of(&deformation);
            (Matrix3::from(analysis.rotation()).transpose(), analysis.right_stretch().matrix())
        },
    )
}

/// Noll's reduced form: T = R G(U(t − s)) Rᵀ with R of now, W(18.11).
///
/// Whatever the functional G of symmetric histories, the result is frame-indifferent; and every frame-indifferent simple
/// material equals its own reduced form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced<G>(
    /// G, asked for U-histories only.
    pub G,
);

impl<G: SimpleMaterial> SimpleMaterial for Reduced<G> {
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
        let rotation = polar(&history.gradient(0.0)).0;
        rotation * self.0.cauchy(&StretchHistory(history)) * rotation.transpose()
    }
}

/// The history Uₜ(t − s) V(t) of a history of deformations, with Uₜ of the relative deformation Fₜ(t − s) = F(t − s) F(t)⁻¹. NaN where
/// det F is not positive.
#[expect(missing_debug_implementations, reason = "a history may be a closure")]
pub struct RelativeStretchHistory<'a>(
    /// F(t − s).
    pub &'a dyn History,
);

impl History for RelativeStretchHistory<'_> {
    fn gradient(&self, elapsed: f64) -> Matrix3<f64> {
        let now = self.0.gradient(0.0);
        let (rotation, stretch) = polar(&now);
        let left = rotation * stretch * rotation.transpose();
        let inverse = now.try_inverse().unwrap_or_else(|| Matrix3::from_element(f64::NAN));
        polar(&(self.0.gradient(elapsed) * inverse)).1 * left
    }
}

/// Noll's form of isotropic simple solids: T = G(Uₜ(t − s), V(t)), told as the stress after the history Uₜ(t − s) V(t), W(19.38).
///
/// Every frame-indifferent simple material that is isotropic, with or without memory, equals this form of itself. The form of any
/// functional feels no rotation of the reference, G(F(t − s) Q) = G(F(t − s)), W(19.36); it is frame-indifferent if the functional is
/// isotropic, G(Q H(s) Qᵀ) = Q G(H(s)) Qᵀ, W(19.39).
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Rotation3, Vector3};
/// use piola_solids::memory::{History, IsotropicForm, SimpleMaterial};
///
/// struct Mine;
/// impl SimpleMaterial for Mine {
///     fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
///         let then = history.gradient(1.0);
///         then.transpose() * then // not isotropic: it feels rotations of the reference
///     }
/// }
///
/// let stretch = |elapsed: f64| Matrix3::from_diagonal(&Vector3::new(1.0 + elapsed, 1.0, 1.0));
/// let turn = Rotation3::new(Vector3::z()).into_inner();
/// let turned = move |elapsed: f64| stretch(elapsed) * turn;
/// assert!(0.5 < (Mine.cauchy(&turned) - Mine.cauchy(&stretch)).norm());
/// let change = IsotropicForm(Mine).cauchy(&turned) - IsotropicForm(Mine).cauchy(&stretch);
/// assert!(change.norm() < 1e-14);
/// ```
///
/// # Source
/// W(19.36–19.39).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsotropicForm<G>(
    /// G, asked for histories Uₜ(t − s) V(t) only.
    pub G,
);

impl<G: SimpleMaterial> SimpleMaterial for IsotropicForm<G> {
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
        self.0.cauchy(&RelativeStretchHistory(history))
    }
}

/// A viscoelastic solid as a functional: the history is followed from rest in equal steps.
///
/// # Example
/// See [`Viscoelastic`] for the material.
#[derive(Clone, Copy, Debug)]
pub struct Remembered<'a, E, D> {
    law: &'a Viscoelastic<E, D>,
    horizon: f64,
    steps: u32,
}

impl<'a, E: Hyperelastic, D: Hyperelastic> Remembered<'a, E, D> {
    /// Of a law that remembers the last `horizon` seconds, taken in `steps` steps.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`] and [`SolidsError::OutOfBounds`] unless 0 < horizon and 0 < steps.
    pub fn new(law: &'a Viscoelastic<E, D>, horizon: f64, steps: u32) -> Result<Self, SolidsError> {
        check_bound("memory", "horizon", horizon, "0 < horizon", 0.0 < horizon)?;
        check_bound("memory", "steps", f64::from(steps), "0 < steps", 0 < steps)?;
        Ok(Self { law, horizon, steps })
    }

    fn follow(&self, history: &dyn History) -> Result<Matrix3<f64>, SolidsError> {
        let (jump, step) = (self.law.prony().step(0.0)?, self.law.prony().step(self.horizon / f64::from(self.steps))?);
        let mut state = self.law.at_rest();
        for k in 0..=self.steps {
            let elapsed = self.horizon * f64::from(self.steps - k) / f64::from(self.steps);
            let deformation = DeformationGradient::new(history.gradient(elapsed))?;
            self.law.check(&deformation)?;
            let step = if k == 0 { &jump } else { &step };
            if k == self.steps {
                return Ok(self.law.cauchy(&state, &deformation, step).0.matrix());
            }
            self.law.advance(&mut state, &deformation, step);
        }
        Ok(Matrix3::zeros())
    }
}

impl<E: Hyperelastic, D: Hyperelastic> SimpleMaterial for Remembered<'_, E, D> {
    /// T now; NaN where the laws have no answer.
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
        self.follow(history).unwrap_or(Matrix3::from_element(f64::NAN))
    }
}
