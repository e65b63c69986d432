//! Map of Wisdom and Holman for planets with close encounters. Planets far apart follow Kepler's motion; planets near each other are
//! integrated to rounding. One Hamiltonian describes both.
//!
//! ```text
//! H = Σᵢ [½ Pᵢ²/mᵢ − Gm₀ mᵢ/Qᵢ] − Σᵢ﹤ⱼ Gmᵢ mⱼ/rᵢⱼ (1 − K(rᵢⱼ/R))        motion: Kepler's, or integrated to rounding
//!   + |Σᵢ Pᵢ|²/(2 m₀)          − Σᵢ﹤ⱼ Gmᵢ mⱼ/rᵢⱼ K(rᵢⱼ/R)              motion of the central body, and attractions
//! ```
//!
//! K goes from 0, where two planets are in one place, to 1 at the critical radius R, some Hill radii ([`critical_radii`]). It is the
//! polynomial of degree fifteen that has seven derivatives at both ends.
//! Far apart, planets move as in
//! [`DemocraticHeliocentric`](crate::wisdom_holman::DemocraticHeliocentric). Two planets that come within R move together in the first
//! part, by [`GaussRadau15`](piola_integrators::GaussRadau15) to rounding; all others keep to Kepler's motion. Since both parts are
//! moved exactly, the map is symplectic through encounters too. Both parts can be moved backwards, so every [`Splitting`] applies.
//!
//! # Which planets meet
//! Two planets move apart in a motion if a bound of their distance exceeds R; otherwise they move together. The distance of a
//! Keplerian arc from its chord is bounded by its greatest acceleration, and that from its Hermite cubic by its greatest fourth
//! derivative. An encounter may deflect a planet towards a third one. The motion is then repeated with all three; how far a planet
//! leaves its arc is estimated from the ends of the integrator's steps. A group with too many planets costs time and changes nothing
//! else.
//!
//! # Validity
//! Passages of two planets down to some 10⁻⁵ of their distance from the central body: nearer ones end with
//! [`IntegratorsError::StepTooSmall`], or with [`GravitationError::Collision`] where the bodies have radii. Passages near the central
//! body must be resolved by the step: see [`with_least_distance`](HybridSymplectic::with_least_distance). Test particles do not feel
//! each other and do not collide with each other.
//!
//! # References
//! J. E. Chambers, MNRAS 304 (1999) 793; H. Rein, D. M. Hernandez, D. Tamayo et al., MNRAS 485 (2019) 5490.

mod changeover;
mod critical;
mod encounters;
mod paths;
#[cfg(test)]
mod tests;
mod together;
mod watch;

use core::ops::ControlFlow;

use piola_integrators::{Checkpoint, IntegratorsError, Report, State, Step, unobserved};
use piola_numerics::Real;

pub use critical::critical_radii;

use crate::check::check_length;
use crate::wisdom_holman::planets::{PlanetMasses, Planets};
use crate::wisdom_holman::run::{Course, Failure, OF_STEPS};
use crate::wisdom_holman::{Splitting, check};
use crate::{Gravitation, GravitationError};
use critical::{Sizes, check_radii};
use encounters::Encounters;

/// The map of Wisdom and Holman in democratic heliocentric coordinates with close encounters, with a fixed step.
///
/// # Accuracy
/// As [`Splitting`] says, away from encounters and through them. Momentum and angular momentum are kept to rounding. Two planets of
/// 2⁻¹⁰ and 2⁻¹² of the central mass that pass at 0.04 Hill radii, with critical radii of three Hill radii, where P is the period of
/// the inner one (example `encounter`):
///
/// | splitting | step/P | error of the energy | of a place, by the semi-major axis |
/// |---|---|---|---|
/// | [`Leapfrog`](Splitting::Leapfrog) | 1/60 | 2e-7 | 2e-3 |
/// | [`Leapfrog`](Splitting::Leapfrog) | 1/240 | 2e-9 | 1e-4 |
/// | [`TenSixFour`](Splitting::TenSixFour) | 1/30 | 7e-10 | 1e-7 |
/// | [`TenSixFour`](Splitting::TenSixFour) | 1/120 | 5e-12 | 7e-10 |
/// | [`TenSixFour`](Splitting::TenSixFour) | 1/480 | 7e-15 | 1e-12 |
///
/// Correctors apply, too; through encounters they gain little.
///
/// # Example
/// ```
/// use piola_gravitation::Gravitation;
/// use piola_gravitation::hybrid::HybridSymplectic;
/// use piola_gravitation::wisdom_holman::Splitting;
/// use piola_integrators::State;
/// // Two light planets run against each other on one circle, the second one higher by 0.01: they pass at that distance at t = 0.1.
/// let bodies = Gravitation::new(vec![1.0, 1e-9, 1e-9])?;
/// let (sine, cosine) = 0.2_f64.sin_cos();
/// let start = bodies.state(
///     &[[0.0; 3], [1.0, 0.0, 0.0], [cosine, sine, 0.01]],
///     &[[0.0; 3], [0.0, 1.0, 0.0], [sine, -cosine, 0.0]],
/// )?;
/// let mut state = State::new(0.0, start)?;
/// let report = HybridSymplectic::new(0.3, Splitting::Leapfrog)?.integrate_to(&bodies, &mut state, 3.0)?;
/// let closest = report.closest.ok_or("nobody met")?;
/// assert!((closest.distance - 0.01).abs() < 1e-4 && (closest.t - 0.1).abs() < 1e-4);
/// assert_eq!((closest.first, closest.second), (1, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("MERCURY", "MERCURIUS", "close encounter"))]
#[derive(Clone, Debug)]
pub struct HybridSymplectic {
    course: Course,
    critical: Option<Vec<f64>>,
    radii: Option<Vec<f64>>,
    least_distance: f64,
}

/// Cost, ending and encounters of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct HybridReport {
    /// Steps, evaluations (attractions of all planets, and of those near each other), and the ending.
    pub run: Report,
    /// Steps in which some planets moved together.
    pub encounter_steps: u64,
    /// The nearest approach of two planets that moved together.
    pub closest: Option<ClosestApproach>,
}

/// Two bodies at their least distance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ClosestApproach {
    /// The first body's index.
    pub first: usize,
    /// The second body's index.
    pub second: usize,
    /// Their distance, m.
    pub distance: f64,
    /// The time, s; within a step as exact as the map.
    pub t: f64,
}

/// Default critical radius, in Hill radii.
const HILL_RADII: f64 = 3.0;

impl HybridSymplectic {
    /// The map with steps no longer than `step` (s). Each run computes its critical radii at its start: [`critical_radii`] with
    /// three Hill radii, and with the longest attraction in place of the step (with [`Splitting::TenSixFour`] 0.22 of it).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub const fn new(step: f64, splitting: Splitting) -> Result<Self, IntegratorsError> {
        match Course::new(step, splitting) {
            Ok(course) => Ok(Self { course, critical: None, radii: None, least_distance: 0.0 }),
            Err(error) => Err(error),
        }
    }

    /// Sets the critical radii of the bodies (m), the central one first. A pair has the larger of its two.
    ///
    /// The radii are part of the Hamiltonian: a motion that is followed in several runs, or backwards, needs the same in all.
    ///
    /// # Errors
    /// [`GravitationError::InvalidRadius`] unless every radius is 0 ≤ r < ∞.
    pub fn with_critical_radii(mut self, critical: Vec<f64>) -> Result<Self, GravitationError> {
        check_radii("critical radii", &critical)?;
        self.critical = Some(critical);
        Ok(self)
    }

    /// Gives the bodies radii (m), the central one first: a run ends with [`GravitationError::Collision`] where two bodies come
    /// nearer than the sum of their radii. Critical radii are raised to twice the radii.
    ///
    /// # Errors
    /// [`GravitationError::InvalidRadius`] unless every radius is 0 ≤ r < ∞.
    pub fn with_radii(mut self, radii: Vec<f64>) -> Result<Self, GravitationError> {
        check_radii("radii", &radii)?;
        self.radii = Some(radii);
        Ok(self)
    }

    /// Ends runs with [`GravitationError::NearCentre`] where a planet comes nearer to the central body than this (m).
    ///
    /// The step must resolve the nearest passage at distance q, whose time scale is 2π √(q³/(2Gm₀)); the map does not adapt there.
    ///
    /// # Errors
    /// [`GravitationError::InvalidRadius`] unless 0 ≤ distance < ∞.
    pub fn with_least_distance(mut self, distance: f64) -> Result<Self, GravitationError> {
        check_radii("least distance", &[distance])?;
        self.least_distance = distance;
        Ok(self)
    }

    /// The longest step, s.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.course.step
    }

    /// The sequence of motions and attractions in a step.
    #[must_use]
    pub const fn splitting(&self) -> Splitting {
        self.course.splitting
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
    ) -> Result<HybridReport, IntegratorsError<GravitationError>> {
        self.integrate(bodies, state, end, 0, unobserved)
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than the
    /// state's time.
    ///
    /// The observer sees every `shown`-th step (of 0: none) and the last, and may stop the run there. To show a state costs half a
    /// motion, and the inverse corrector where there is one; it changes the count of evaluations, not the motion.
    ///
    /// # Errors
    /// [`IntegratorsError::Field`] where the forces are not those of this map
    /// ([`GravitationError::NotKeplerian`], [`GravitationError::MasslessCentre`]), the state or the radii do not fit the bodies, two
    /// bodies collide ([`GravitationError::Collision`]) or a planet comes too near the central body
    /// ([`GravitationError::NearCentre`]); [`IntegratorsError::StepTooSmall`] and [`IntegratorsError::NotFinite`] where planets
    /// without radii meet in one place. The state then stands at the last complete step, or where that cannot be shown at the one
    /// shown last. Scalars of several lanes do not compile:
    /// each lane has its own encounters.
    pub fn integrate<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<HybridReport, IntegratorsError<GravitationError>> {
        let sizes = self.sizes(bodies, state)?;
        let mut near = Encounters::new(&PlanetMasses::new(bodies.parameters()), &sizes);
        let ended = self.course.integrate(&mut near, bodies, None, (state, end), shown, observer)?;
        Ok(near.report(ended.report))
    }

    /// Integrates as [`integrate`](Self::integrate). Returns also the run where it ended or where the observer stopped it, which
    /// [`resume`](Self::resume) continues.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to_checkpoint<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<(HybridReport, Checkpoint<T>), IntegratorsError<GravitationError>> {
        let sizes = self.sizes(bodies, state)?;
        self.run(bodies, &sizes, None, (state, end), shown, observer)
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings and bodies: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit. To another end the length of the steps may differ; the
    /// run then begins anew from the state of the checkpoint, and its report goes on counting. The critical radii are those of the start.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate); [`IntegratorsError::WrongMethod`] for a checkpoint of another method or splitting,
    /// [`IntegratorsError::WrongLength`] for one of other bodies, [`IntegratorsError::NotFinite`], [`IntegratorsError::InvalidRow`] where
    /// its number of the splitting is unknown. A refused checkpoint leaves the state unchanged.
    pub fn resume<T: Real>(
        &self,
        bodies: &Gravitation,
        checkpoint: &Checkpoint<T>,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<(HybridReport, Checkpoint<T>), IntegratorsError<GravitationError>> {
        let sizes = self.sizes_of(checkpoint, bodies)?;
        self.run(bodies, &sizes, Some(checkpoint), (state, end), shown, observer)
    }

    fn run<T: Real>(
        &self,
        bodies: &Gravitation,
        sizes: &Sizes,
        resumed: Option<&Checkpoint<T>>,
        (state, end): (&mut State<T>, f64),
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<(HybridReport, Checkpoint<T>), IntegratorsError<GravitationError>> {
        let mut near = Encounters::new(&PlanetMasses::new(bodies.parameters()), sizes);
        let ended = self.course.integrate(&mut near, bodies, resumed, (state, end), shown, observer)?;
        Ok((near.report(ended.report), self.course.checkpoint(&near, bodies, state, &ended)))
    }

    /// The radii of a run that is continued: they are part of the Hamiltonian, so the critical ones are those of its start.
    fn sizes_of<T: Real>(&self, checkpoint: &Checkpoint<T>, bodies: &Gravitation) -> Result<Sizes, Failure> {
        let n = bodies.bodies();
        let lengths = [Planets::<T>::numbers(n), OF_STEPS + encounters::NUMBERS + n];
        checkpoint.open(encounters::NAME, lengths, &[], &mut checkpoint.state().clone(), |_| Ok(()))?;
        let critical = checkpoint.memory().1[OF_STEPS + encounters::NUMBERS..].to_vec();
        let radii = self.radii.clone().unwrap_or_default();
        let checked = || {
            if self.radii.is_some() {
                check_length("radii", n, radii.len())?;
            }
            check_radii("critical radii", &critical)
        };
        checked().map_err(|source| IntegratorsError::Field { t: checkpoint.state().time, source })?;
        Ok(Sizes { critical, radii, least: self.least_distance })
    }

    /// The radii of a run from a state.
    fn sizes<T: Real>(&self, bodies: &Gravitation, state: &State<T>) -> Result<Sizes, Failure> {
        let at_start = |source| IntegratorsError::Field { t: state.time, source };
        self.sizes_at_start(bodies, state).map_err(at_start)
    }

    fn sizes_at_start<T: Real>(&self, bodies: &Gravitation, state: &State<T>) -> Result<Sizes, GravitationError> {
        let n = bodies.bodies();
        check(bodies, &state.values)?;
        let critical = if let Some(critical) = &self.critical {
            critical.clone()
        } else {
            let values: Vec<f64> = state.values.iter().map(|x| x.primal(0)).collect();
            critical_radii(bodies, &values, HILL_RADII, self.course.longest_attraction())?
        };
        let radii = self.radii.clone().unwrap_or_default();
        let mut sizes = Sizes { critical, radii, least: self.least_distance };
        check_length("critical radii", n, sizes.critical.len())?;
        if self.radii.is_some() {
            check_length("radii", n, sizes.radii.len())?;
            // Bodies that touch are near each other.
            for (critical, radius) in sizes.critical.iter_mut().zip(&sizes.radii) {
                *critical = critical.max(2.0 * radius);
            }
        }
        Ok(sizes)
    }
}
