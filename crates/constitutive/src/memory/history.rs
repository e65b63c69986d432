//! Simple materials: the stress as a functional of the history of the deformation.

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_continuum::spectral::StretchAnalysis;

use super::Viscoelastic;
use crate::ConstitutiveError;
use crate::checks::{Observers, Report, Sampler, Search};
use crate::error::check_bound;
use crate::solids::Hyperelastic;

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
/// A functional with a memory of one second, not frame-indifferent as it stands; [`Reduced`] makes it so.
/// ```
/// use nalgebra::Matrix3;
/// use piola_constitutive::checks::Search;
/// use piola_constitutive::memory::{History, Reduced, SimpleMaterial, history_indifference};
///
/// struct Mine;
/// impl SimpleMaterial for Mine {
///     fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
///         let (now, then) = (history.gradient(0.0), history.gradient(1.0));
///         now + now.transpose() - then - then.transpose()
///     }
/// }
///
/// let search = Search { samples: 50, ..Search::default() };
/// assert!(!history_indifference(&Mine, 1.0, &search).passes());
/// assert!(history_indifference(&Reduced(Mine), 1.0, &search).passes());
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
    /// [`ConstitutiveError::NotFinite`] and [`ConstitutiveError::OutOfBounds`] unless 0 < horizon and 0 < steps.
    pub fn new(law: &'a Viscoelastic<E, D>, horizon: f64, steps: u32) -> Result<Self, ConstitutiveError> {
        check_bound("memory", "horizon", horizon, "0 < horizon", 0.0 < horizon)?;
        check_bound("memory", "steps", f64::from(steps), "0 < steps", 0 < steps)?;
        Ok(Self { law, horizon, steps })
    }

    fn follow(&self, history: &dyn History) -> Result<Matrix3<f64>, ConstitutiveError> {
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

/// A smooth history drawn by the sampler, with periods about `time`.
struct Drawn {
    rotations: [Matrix3<f64>; 2],
    spin: nalgebra::Vector3<f64>,
    strain: f64,
    phases: [f64; 3],
    rates: [f64; 3],
}

impl Drawn {
    fn new(sampler: &mut Sampler, strain: f64, time: f64) -> Self {
        let mut numbers = |scale: f64| core::array::from_fn(|_| scale * sampler.balanced());
        let (phases, rates) = (numbers(core::f64::consts::PI), numbers(4.0 / time));
        let spin = nalgebra::Vector3::from(numbers(3.0 / time));
        Self { rotations: [sampler.rotation(), sampler.rotation()], spin, strain, phases, rates }
    }

    fn rotation(&self, elapsed: f64) -> Matrix3<f64> {
        self.rotations[0] * nalgebra::Rotation3::new(self.spin * elapsed).into_inner()
    }

    fn gradient(&self, elapsed: f64) -> Matrix3<f64> {
        let stretch: [f64; 3] =
            core::array::from_fn(|i| (self.strain * (self.rates[i] * elapsed + self.phases[i]).cos()).exp());
        self.rotation(elapsed) * Matrix3::from_diagonal(&stretch.into()) * self.rotations[1]
    }
}

/// Tries to refute G(Q(t − s) F(t − s)) = Q(t) G(F(t − s)) Q(t)ᵀ, W(18.3), for histories that change within about `time`
/// seconds, and observers that spin as fast.
///
/// The report holds the present values of the worst histories.
#[must_use]
pub fn history_indifference(material: &impl SimpleMaterial, time: f64, search: &Search) -> Report<Observers> {
    let mut sampler = Sampler::new(search.seed);
    let samples = (0..search.samples).map(|_| {
        let body = Drawn::new(&mut sampler, search.strain, time);
        let observer = Drawn::new(&mut sampler, 0.0, time);
        let stress = material.cauchy(&|elapsed: f64| body.gradient(elapsed));
        let seen = material.cauchy(&|elapsed: f64| observer.rotation(elapsed) * body.gradient(elapsed));
        let (gradient, rotation) = (body.gradient(0.0), observer.rotation(0.0));
        let violation = (seen - rotation * stress * rotation.transpose()).norm();
        Some((violation, stress.norm().max(seen.norm()), Observers { gradient, rotation, stress, seen }))
    });
    Report::of(search, samples)
}
