//! Planets about one dominant body in democratic heliocentric coordinates.

use core::ops::ControlFlow;

use piola_integrators::{Checkpoint, IntegratorsError, Report, State, Step, unobserved};
use piola_numerics::Real;

use super::Splitting;
use super::planets::{PlanetMasses, Planets, whole};
use super::run::{Course, Failure, Moment, Near};
use crate::kepler::Increment;
use crate::{Gravitation, GravitationError};

/// The map of Wisdom and Holman in democratic heliocentric coordinates, with a fixed step, over any scalar.
///
/// ```text
/// H = Σᵢ [½ Pᵢ²/mᵢ − Gm₀ mᵢ/Qᵢ]        Kepler's motions about the central body, exact
///   + |Σᵢ Pᵢ|²/(2 m₀)                  motion of the central body
///   − Σᵢ﹤ⱼ Gmᵢ mⱼ/|Qᵢ − Qⱼ|            attractions between planets
/// ```
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | Qᵢ | xᵢ − x₀, place from the central body | m |
/// | Pᵢ | mᵢ (vᵢ − V), momentum seen from the mass centre of all bodies, V its velocity | kg m/s |
///
/// The last two parts commute, so that together they are one part with an exact motion: every [`Splitting`] applies, correctors
/// included, as in [`WisdomHolman`](super::WisdomHolman). Which coordinates? The list may have any
/// order here, and orbits may cross. Jacobi's coordinates have smaller errors where the orbits are nested, and follow a single
/// planet exactly; these do not, since the motion of the central body is a part by itself. For planets that come within some Hill
/// radii of each other see [`HybridSymplectic`](crate::hybrid::HybridSymplectic).
///
/// Over `Dual` a run carries derivatives with respect to the start; over `Lanes` it follows several systems of equal masses at once.
///
/// # Accuracy
/// As [`Splitting`] says. The momentum and the motion of the mass centre are kept to rounding of the state, the angular momentum
/// to rounding. The step must resolve the nearest passage of each planet by the central body, 2π √(q³/(2Gm₀)), with some twenty
/// steps: the motion of the central body is not a small part there.
///
/// # Example
/// ```
/// use piola_gravitation::Gravitation;
/// use piola_gravitation::wisdom_holman::{DemocraticHeliocentric, Splitting};
/// use piola_integrators::State;
/// // Two planets of 10⁻³ and 3 × 10⁻⁴ of the central mass, the outer one first, for 1000 revolutions of the inner one.
/// let bodies = Gravitation::new(vec![1.0, 3e-4, 1e-3])?;
/// let start = bodies.state(
///     &[[0.0; 3], [0.0, 1.84, 0.0], [1.0, 0.0, 0.0]],
///     &[[0.0; 3], [-0.737, 0.0, 0.0], [0.0, 1.0, 0.0]],
/// )?;
/// let before = bodies.invariants(&start).energy;
/// let mut state = State::new(0.0, start)?;
/// DemocraticHeliocentric::new(0.5, Splitting::TenSixFour)?.integrate_to(&bodies, &mut state, 6283.0)?;
/// let change = bodies.invariants(&state.values).energy / before - 1.0;
/// assert!(change.abs() < 1e-9, "{change}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
/// M. Duncan, H. Levison & M. H. Lee, Astron. J. 116 (1998) 2067; J. Wisdom, Astron. J. 131 (2006) 2294 (correctors).
#[doc(alias("WHDS", "heliocentric", "SyMBA"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DemocraticHeliocentric {
    course: Course,
}

impl DemocraticHeliocentric {
    /// The map with steps no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub const fn new(step: f64, splitting: Splitting) -> Result<Self, IntegratorsError> {
        match Course::new(step, splitting) {
            Ok(course) => Ok(Self { course }),
            Err(error) => Err(error),
        }
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
    ) -> Result<Report, IntegratorsError<GravitationError>> {
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
    /// ([`GravitationError::NotKeplerian`], [`GravitationError::MasslessCentre`]) or the state does not fit them;
    /// [`IntegratorsError::StepTooSmall`]; [`IntegratorsError::NotFinite`] where two bodies meet, or where `end` is not finite.
    /// The state then stands at the last complete step, or where that cannot be shown at the one shown last.
    pub fn integrate<T: Real>(
        &self,
        bodies: &Gravitation,
        state: &mut State<T>,
        end: f64,
        shown: u64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<GravitationError>> {
        Ok(self.course.integrate(&mut Nowhere, bodies, None, (state, end), shown, observer)?.report)
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
    ) -> Result<(Report, Checkpoint<T>), IntegratorsError<GravitationError>> {
        let ended = self.course.integrate(&mut Nowhere, bodies, None, (state, end), shown, observer)?;
        Ok((ended.report, self.course.checkpoint(&Nowhere, bodies, state, &ended)))
    }

    /// Continues a run from a [`Checkpoint`] that this method made with the same settings and bodies: the state becomes that of the
    /// checkpoint. To the same end the run takes the same steps, to the last bit. To another end the length of the steps may differ; the
    /// run then begins anew from the state of the checkpoint, and its report goes on counting.
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
    ) -> Result<(Report, Checkpoint<T>), IntegratorsError<GravitationError>> {
        let ended = self.course.integrate(&mut Nowhere, bodies, Some(checkpoint), (state, end), shown, observer)?;
        Ok((ended.report, self.course.checkpoint(&Nowhere, bodies, state, &ended)))
    }
}

/// No planets come near each other.
struct Nowhere;

impl<T: Real> Near<T> for Nowhere {
    const NAME: &'static str = "DemocraticHeliocentric";

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn weight(&self, first: usize, second: usize, distance: [T; 3]) -> T {
        whole(first, second, distance)
    }

    fn correct(
        &mut self,
        _masses: &PlanetMasses,
        _planets: &Planets<T>,
        _time: f64,
        _moment: Moment,
        _increments: &mut [Increment<T>],
    ) -> Result<(), Failure> {
        Ok(())
    }
}
