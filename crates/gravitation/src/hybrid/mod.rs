//! Planets about one dominant body that come close to each other: the map of Wisdom and Holman away from encounters, an adaptive
//! integrator for those that meet, and one Hamiltonian for both.
//!
//! ```text
//! H = Σᵢ [½ Pᵢ²/mᵢ − Gm₀ mᵢ/Qᵢ] − Σᵢ﹤ⱼ Gmᵢ mⱼ/rᵢⱼ (1 − K(rᵢⱼ/R))        motion: Kepler's, or integrated to rounding
//!   + |Σᵢ Pᵢ|²/(2 m₀)          − Σᵢ﹤ⱼ Gmᵢ mⱼ/rᵢⱼ K(rᵢⱼ/R)              motion of the central body, and attractions
//! ```
//!
//! K goes smoothly from 0, where two planets are in one place, to 1 at the critical radius R, some Hill radii ([`critical_radii`]).
//! Far apart, planets move as in
//! [`DemocraticHeliocentric`](crate::wisdom_holman::DemocraticHeliocentric). Two planets that come within R move together in the first
//! part, by [`GaussRadau15`](piola_integrators::GaussRadau15) to rounding; all others keep to Kepler's motion. Since both parts are
//! moved exactly, the map is symplectic through encounters too. Both parts can be moved backwards, so every [`Splitting`] applies.
//!
//! # Which planets meet
//! A pair counts as apart in a motion if a bound of its distance says so. An arc of Kepler's motion is nearer to its chord than a
//! multiple of its greatest acceleration, and nearer to the cubic through both ends than a multiple of its greatest fourth derivative.
//! A planet in an encounter may be thrown off its arc and meet a third one: then the motion is made again with all three. To take too
//! many planets into a group changes nothing but the time it takes.
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

use piola_integrators::{IntegratorsError, Report, State, Step, unobserved};
use piola_numerics::Real;

pub use changeover::Changeover;
pub use critical::critical_radii;

use crate::check::check_length;
use crate::wisdom_holman::planets::PlanetMasses;
use crate::wisdom_holman::run::Course;
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
    changeover: Changeover,
    sizes: Sizes,
}

/// What a run cost, how it ended, and who met.
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

/// Hill radii of a critical radius, if nothing else is said.
const HILL_RADII: f64 = 3.0;

impl HybridSymplectic {
    /// The map with steps no longer than `step` (s). Each run takes its critical radii from its start: [`critical_radii`] with
    /// three Hill radii, and with the longest attraction in place of the step (with [`Splitting::TenSixFour`] 0.22 of it).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub const fn new(step: f64, splitting: Splitting) -> Result<Self, IntegratorsError> {
        match Course::new(step, splitting) {
            Ok(course) => {
                let sizes = Sizes { critical: Vec::new(), radii: Vec::new(), least: 0.0 };
                Ok(Self { course, changeover: Changeover::Fifteenth, sizes })
            }
            Err(error) => Err(error),
        }
    }

    /// Gives the bodies critical radii (m), the central one first: two planets have the larger of theirs.
    ///
    /// The radii are part of the Hamiltonian: a motion that is followed in several runs, or backwards, needs the same in all.
    ///
    /// # Errors
    /// [`GravitationError::InvalidRadius`] unless every radius is 0 ≤ r < ∞.
    pub fn with_critical_radii(mut self, critical: Vec<f64>) -> Result<Self, GravitationError> {
        check_radii("critical radii", &critical)?;
        self.sizes.critical = critical;
        Ok(self)
    }

    /// Changes the function K.
    #[must_use]
    pub fn with_changeover(mut self, changeover: Changeover) -> Self {
        self.changeover = changeover;
        self
    }

    /// Gives the bodies radii (m), the central one first: a run ends with [`GravitationError::Collision`] where two bodies come
    /// nearer than the sum of their radii. Critical radii are raised to twice the radii.
    ///
    /// # Errors
    /// [`GravitationError::InvalidRadius`] unless every radius is 0 ≤ r < ∞.
    pub fn with_radii(mut self, radii: Vec<f64>) -> Result<Self, GravitationError> {
        check_radii("radii", &radii)?;
        self.sizes.radii = radii;
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
        self.sizes.least = distance;
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
    /// motion, and the inverse corrector where there is one; it does not change the run.
    ///
    /// # Errors
    /// [`IntegratorsError::Field`] where the forces are not those of this map
    /// ([`GravitationError::NotKeplerian`], [`GravitationError::MasslessCentre`]), the state or the radii do not fit the bodies, two
    /// bodies collide ([`GravitationError::Collision`]) or a planet comes too near the central body
    /// ([`GravitationError::NearCentre`]); [`IntegratorsError::StepTooSmall`] and [`IntegratorsError::NotFinite`] where planets
    /// without radii meet in one place. The state then stands at the last complete step. Scalars of several lanes do not compile:
    /// each lane has its own encounters.
    pub fn integrate<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<HybridReport, IntegratorsError<GravitationError>> {
        const { assert!(T::LANES == 1, "each lane has its own encounters") };
        let (n, start) = (bodies.bodies(), state.time);
        let at_start = |source| IntegratorsError::Field { t: start, source };
        check(bodies, &state.values).map_err(at_start)?;
        let mut sizes = self.sizes.clone();
        if sizes.critical.is_empty() {
            let values: Vec<f64> = state.values.iter().map(|x| x.primal(0)).collect();
            sizes.critical =
                critical_radii(bodies, &values, HILL_RADII, self.course.longest_attraction()).map_err(at_start)?;
        }
        check_length("critical radii", n, sizes.critical.len()).map_err(at_start)?;
        if !sizes.radii.is_empty() {
            check_length("radii", n, sizes.radii.len()).map_err(at_start)?;
            // Bodies that touch are near each other.
            for (critical, radius) in sizes.critical.iter_mut().zip(&sizes.radii) {
                *critical = critical.max(2.0 * radius);
            }
        }
        let mut near = Encounters::new(&PlanetMasses::new(bodies.parameters()), &sizes, self.changeover);
        let mut run = self.course.integrate(&mut near, bodies, state, end, shown, observer)?;
        run.evaluations += near.evaluations;
        Ok(HybridReport { run, encounter_steps: near.steps, closest: near.closest })
    }
}
