//! Which method, with which tolerance, and what it will cost: chosen from measured curves of error against time.
//!
//! The curves are those of eight problems, measured by `cargo xtask work-precision --table`. A method that the declared
//! character of the problem allows is judged by the problems of the same kind: those whose steps must vary (close encounters,
//! large eccentricities) or those whose steps need not. Its time for the error asked for is the geometric mean over them.
//!
//! ```text
//! E = E_table (turns / turns_table)ᵖ,    p = 2, for symplectic methods 1
//! t = (t_table + N_table (c − c_table)) turns / turns_table
//! ```
//!
//! with N evaluations of c seconds each. The method is chosen for a third of the error asked for, since problems of one kind
//! differ. Where evaluations take longer, methods that need fewer of them win.

#[expect(clippy::unreadable_literal, reason = "written by a program")]
mod measured;
mod table;

use core::fmt;
use core::fmt::Write as _;

use self::table::{Curve, Measured};
use crate::IntegratorsError;

/// How the equations of a problem are written, and what they are like.
///
/// # Example
/// ```
/// use piola_integrators::{AdvisedMethod, Character, advise};
/// // A comet, in f64 only, followed for ten revolutions to 1e-9 of its orbit.
/// let comet = Character::of_positions().with_uneven_steps();
/// let advice = advise(&comet, 1e-9)?;
/// assert_eq!(advice.method, AdvisedMethod::Nystrom1210);
/// println!("{advice}"); // the method, its tolerance, what it will cost, and why
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Character {
    equations: Equations,
    lanes: bool,
    uneven: bool,
    turns: f64,
    evaluation: Option<f64>,
}

/// The form of the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Equations {
    /// ẏ = f(t, y).
    FirstOrder,
    /// q̈ = f(t, q, q̇).
    SecondOrder,
    /// q̈ = f(t, q).
    Positions,
    /// Stiff, or with constraints.
    Stiff,
    /// On a Lie group.
    Group,
    /// Planets about a dominant body.
    Planets { encounters: bool },
    /// A few bodies that collide or nearly do.
    Colliding,
}

impl Character {
    const fn of(equations: Equations) -> Self {
        Self { equations, lanes: false, uneven: false, turns: 10.0, evaluation: None }
    }
    /// Equations of first order, ẏ = f(t, y).
    #[must_use]
    pub const fn of_first_order() -> Self {
        Self::of(Equations::FirstOrder)
    }
    /// Equations of motion q̈ = f(t, q, q̇): magnetic forces, rotating frames, mechanisms.
    #[must_use]
    pub const fn of_second_order() -> Self {
        Self::of(Equations::SecondOrder)
    }
    /// Equations of motion q̈ = f(t, q) whose forces do not depend on velocities: gravitation, springs, potentials.
    #[must_use]
    pub const fn of_positions() -> Self {
        Self::of(Equations::Positions)
    }
    /// Equations in which something decays much faster than the motion that is wanted, or with constraints.
    #[must_use]
    pub const fn stiff() -> Self {
        Self::of(Equations::Stiff)
    }
    /// Motion on a Lie group: attitudes, rigid motions.
    #[must_use]
    pub const fn of_group() -> Self {
        Self::of(Equations::Group)
    }
    /// Planets about a dominant body over very many revolutions; with or without encounters of planets.
    #[must_use]
    pub const fn of_planets(encounters: bool) -> Self {
        Self::of(Equations::Planets { encounters })
    }
    /// A few bodies that collide or nearly do.
    #[must_use]
    pub const fn of_colliding_bodies() -> Self {
        Self::of(Equations::Colliding)
    }
    /// The equations are generic over their scalar, so that stages are evaluated in lanes.
    #[must_use]
    pub const fn over_any_scalar(mut self) -> Self {
        self.lanes = true;
        self
    }
    /// The motion is much faster at some times than at others: close encounters, large eccentricities.
    #[must_use]
    pub const fn with_uneven_steps(mut self) -> Self {
        self.uneven = true;
        self
    }
    /// The length of the run in turns: revolutions, swings, oscillations. Ten unless stated.
    ///
    /// # Errors
    /// [`IntegratorsError::NotFinite`], or [`IntegratorsError::NotPositive`] unless 0 < turns.
    pub fn for_turns(mut self, turns: f64) -> Result<Self, IntegratorsError> {
        self.turns = positive("turns", turns)?;
        Ok(self)
    }
    /// The time of one evaluation of the equations, s. Unless stated it is that of the measured problems, 1 to 106 ns.
    ///
    /// # Errors
    /// [`IntegratorsError::NotFinite`], or [`IntegratorsError::NotPositive`] unless 0 < seconds.
    pub fn with_evaluation_time(mut self, seconds: f64) -> Result<Self, IntegratorsError> {
        self.evaluation = Some(positive("seconds", seconds)?);
        Ok(self)
    }
}

fn positive(quantity: &'static str, value: f64) -> Result<f64, IntegratorsError> {
    if !value.is_finite() {
        Err(IntegratorsError::NotFinite { quantity, index: 0, value, t: None })
    } else if value <= 0.0 {
        Err(IntegratorsError::NotPositive { quantity, value })
    } else {
        Ok(value)
    }
}

/// A method that [`advise`] may name. Display gives its path in the facade.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum AdvisedMethod {
    /// [`DormandPrince853`](crate::DormandPrince853).
    DormandPrince853,
    /// [`Verner98`](crate::Verner98).
    Verner98,
    /// [`Nystrom86`](crate::Nystrom86).
    Nystrom86,
    /// [`Nystrom1210`](crate::Nystrom1210).
    Nystrom1210,
    /// [`GaussLegendre16`](crate::GaussLegendre16).
    GaussLegendre16,
    /// [`GaussRadau15`](crate::GaussRadau15).
    GaussRadau15,
    /// [`Composition`](crate::Composition) of order eight.
    Composition8,
    /// `piola_stiff::RadauIia`.
    RadauIia,
    /// `piola_geometric::AdaptiveMuntheKaas`.
    AdaptiveMuntheKaas,
    /// `gravitation::wisdom_holman::WisdomHolman`.
    WisdomHolman,
    /// `gravitation::hybrid::HybridSymplectic`.
    HybridSymplectic,
    /// `gravitation::regularised::Regularised`.
    Regularised,
}

impl AdvisedMethod {
    /// The power of the time by which errors grow.
    const fn growth(self) -> i32 {
        if matches!(self, Self::Composition8) { 1 } else { 2 }
    }
    /// Time that a counted evaluation takes, in times of a single one: a sweep over eight lanes counts as eight, and costs some
    /// three.
    const fn share(self) -> f64 {
        if matches!(self, Self::GaussLegendre16) { 0.35 } else { 1.0 }
    }
}

impl fmt::Display for AdvisedMethod {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::DormandPrince853 => "integrators::DormandPrince853",
            Self::Verner98 => "integrators::Verner98",
            Self::Nystrom86 => "integrators::Nystrom86",
            Self::Nystrom1210 => "integrators::Nystrom1210",
            Self::GaussLegendre16 => "integrators::GaussLegendre16",
            Self::GaussRadau15 => "integrators::GaussRadau15",
            Self::Composition8 => "integrators::Composition of order 8",
            Self::RadauIia => "stiff::RadauIia",
            Self::AdaptiveMuntheKaas => "geometric::AdaptiveMuntheKaas",
            Self::WisdomHolman => "gravitation::wisdom_holman::WisdomHolman with the splitting (10, 6, 4)",
            Self::HybridSymplectic => "gravitation::hybrid::HybridSymplectic",
            Self::Regularised => "gravitation::regularised::Regularised",
        })
    }
}

/// A method with its parameter, its cost and the reason: see [`advise`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Advice {
    /// The method.
    pub method: AdvisedMethod,
    /// The tolerance to give it; none for a method of fixed step.
    pub tolerance: Option<f64>,
    /// Steps in a turn, of a method of fixed step.
    pub steps_per_turn: Option<f64>,
    /// Evaluations of the whole run, where measured curves tell.
    pub evaluations: Option<f64>,
    /// Time of the whole run on the machine of the measurements, s, where they tell.
    pub seconds: Option<f64>,
    /// The reason, as a sentence.
    pub reason: String,
}

impl fmt::Display for Advice {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.method)?;
        if let Some(tolerance) = self.tolerance {
            write!(formatter, ", tolerance {tolerance:.1e}")?;
        }
        if let Some(steps) = self.steps_per_turn {
            write!(formatter, ", {steps:.0} steps a turn")?;
        }
        if let (Some(evaluations), Some(seconds)) = (self.evaluations, self.seconds) {
            write!(formatter, "; about {evaluations:.1e} evaluations, {seconds:.1e} s")?;
        }
        write!(formatter, ": {}", self.reason)
    }
}

/// The method that reaches an error at the end of a run in the least time, of those that the character of the problem allows.
///
/// The error is relative to the largest position, and to the largest velocity.
///
/// # Accuracy
/// Predictions come from problems of the same kind, not from this one: expect the error within a factor of ten, and the time
/// within a factor of three on a machine like the one of the measurements. `integrate_and_estimate` tells the true error.
///
/// # Cost
/// The advised method is not always the fastest of all libraries, nor by the factors aimed at, 1.5 and 2. On the double pendulum at 1e-6, and in
/// Hénon and Heiles' potential at 1e-12, heyoka's compiled Taylor series takes 0.9 of our time. At smaller errors on the double pendulum it takes
/// 1.0 to 1.4 times our time.
/// The page *Integration* of the measurements lists each aim that is not met, beside the times below which these methods cannot go.
///
/// # Errors
/// [`IntegratorsError::NotFinite`], or [`IntegratorsError::InvalidTolerance`] unless 0 < error < 1.
///
/// # Example
/// ```
/// use piola_integrators::{AdvisedMethod, Character, advise};
/// let swinging = Character::of_second_order().over_any_scalar();
/// let advice = advise(&swinging, 1e-12)?;
/// assert_eq!(advice.method, AdvisedMethod::GaussLegendre16);
/// assert!(advice.tolerance < Some(1e-9));
/// let decaying = advise(&Character::stiff(), 1e-6)?;
/// assert_eq!(decaying.method, AdvisedMethod::RadauIia);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("choose", "recommend", "which integrator"))]
pub fn advise(character: &Character, error: f64) -> Result<Advice, IntegratorsError> {
    if !error.is_finite() {
        return Err(IntegratorsError::NotFinite { quantity: "error", index: 0, value: error, t: None });
    }
    if error <= 0.0 || 1.0 <= error {
        return Err(IntegratorsError::InvalidTolerance { relative: error, absolute: 0.0 });
    }
    let declared = |method, reason: &str| Advice {
        method,
        tolerance: matches!(method, AdvisedMethod::RadauIia | AdvisedMethod::AdaptiveMuntheKaas).then_some(0.1 * error),
        steps_per_turn: matches!(method, AdvisedMethod::WisdomHolman | AdvisedMethod::HybridSymplectic).then_some(30.0),
        evaluations: None,
        seconds: None,
        reason: reason.to_owned(),
    };
    let candidates: &[AdvisedMethod] = match character.equations {
        Equations::Stiff => {
            return Ok(declared(
                AdvisedMethod::RadauIia,
                "stiff problems and constraints need an implicit method that damps what decays",
            ));
        }
        Equations::Group => {
            return Ok(declared(
                AdvisedMethod::AdaptiveMuntheKaas,
                "steps are exponentials, so that the state never leaves the group",
            ));
        }
        Equations::Planets { encounters: false } => {
            return Ok(declared(
                AdvisedMethod::WisdomHolman,
                "about a dominant body only the perturbations are left to integrate, and errors do not drift",
            ));
        }
        Equations::Planets { encounters: true } => {
            return Ok(declared(
                AdvisedMethod::HybridSymplectic,
                "planets that meet are integrated to rounding, and one Hamiltonian is kept throughout",
            ));
        }
        Equations::Colliding => {
            return Ok(declared(
                AdvisedMethod::Regularised,
                "after the transformation of time a collision is no singularity: steps follow the potential",
            ));
        }
        Equations::FirstOrder => &[AdvisedMethod::DormandPrince853, AdvisedMethod::Verner98],
        Equations::SecondOrder => &[
            AdvisedMethod::DormandPrince853,
            AdvisedMethod::Verner98,
            AdvisedMethod::GaussRadau15,
            AdvisedMethod::GaussLegendre16,
        ],
        Equations::Positions => &[
            AdvisedMethod::DormandPrince853,
            AdvisedMethod::Verner98,
            AdvisedMethod::Nystrom86,
            AdvisedMethod::Nystrom1210,
            AdvisedMethod::GaussRadau15,
            AdvisedMethod::Composition8,
            AdvisedMethod::GaussLegendre16,
        ],
    };
    let judged: Vec<Judged> = candidates
        .iter()
        .filter(|method| character.lanes || **method != AdvisedMethod::GaussLegendre16)
        .filter_map(|&method| Judged::of(method, character, error))
        .collect();
    let best = judged.iter().min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let Some(best) = best else {
        // Smaller than what any method reaches: the one whose steps shrink until rounding is all that is left.
        return Ok(if character.equations == Equations::FirstOrder {
            let reason = "no measured method reaches this error: of those for equations of first order this has the highest order";
            Advice { tolerance: Some(1e-15), ..declared(AdvisedMethod::Verner98, reason) }
        } else {
            let reason = "no measured method reaches this error: the steps of this one leave nothing but rounding";
            declared(AdvisedMethod::GaussRadau15, reason)
        });
    };
    let second =
        judged.iter().filter(|other| other.method != best.method).min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let kind = if character.uneven { "whose steps must vary" } else { "of even motion" };
    let mut reason = format!("the least time for this error on {} measured problems {kind}", best.problems);
    if let Some(second) = second {
        let _ = write!(reason, "; {} takes {:.1} times as long", second.method, second.seconds / best.seconds);
    }
    let fixed = best.method == AdvisedMethod::Composition8;
    Ok(Advice {
        method: best.method,
        tolerance: (!fixed).then_some(best.parameter),
        steps_per_turn: fixed.then_some(best.parameter),
        evaluations: Some(best.evaluations),
        seconds: Some(best.seconds),
        reason,
    })
}

/// The part of the error asked for that is aimed at: problems of one kind differ.
const MARGIN: f64 = 0.3;

/// A method on the problems of a kind: geometric means of cost, and the strictest parameter.
struct Judged {
    method: AdvisedMethod,
    parameter: f64,
    evaluations: f64,
    seconds: f64,
    problems: usize,
}

impl Judged {
    /// Nothing where the method does not reach the error on one of the problems.
    fn of(method: AdvisedMethod, character: &Character, error: f64) -> Option<Self> {
        let velocities = character.equations == Equations::SecondOrder;
        let (mut sums, mut problems) = ([0.0; 2], 0);
        // Of fixed steps the most, of tolerances the smallest: the error must hold on all problems.
        let strictest = if method == AdvisedMethod::Composition8 { f64::max } else { f64::min };
        let mut parameter = f64::NAN;
        for measured in measured::MEASURED {
            if measured.uneven != character.uneven
                || (measured.velocity_dependent && character.equations == Equations::Positions)
            {
                continue;
            }
            // Where forces depend on velocities, sweeps converge more slowly: such problems alone count, if there are some.
            if velocities && !measured.velocity_dependent {
                continue;
            }
            let Some(curve) = measured.curves.iter().find(|curve| curve.method == method) else { continue };
            let [found, evaluations, seconds] = Self::on(method, character, error, measured, curve)?;
            parameter = strictest(parameter, found);
            for (sum, x) in sums.iter_mut().zip([evaluations, seconds]) {
                *sum += x.ln();
            }
            problems += 1;
        }
        (0 < problems).then(|| {
            let [evaluations, seconds] = sums.map(|sum| (sum / problems as f64).exp());
            Self { method, parameter, evaluations, seconds, problems }
        })
    }

    /// The parameter, the evaluations and the time for an error, as this problem tells them.
    fn on(
        method: AdvisedMethod,
        character: &Character,
        error: f64,
        measured: &Measured,
        curve: &Curve,
    ) -> Option<[f64; 3]> {
        let longer = character.turns / measured.turns;
        let point = curve.at(MARGIN * error / longer.powi(method.growth()))?;
        let more = character.evaluation.map_or(0.0, |evaluation| evaluation - measured.evaluation);
        // What the method itself takes is not less than a tenth.
        let seconds = (point.seconds + point.evaluations * method.share() * more).max(0.1 * point.seconds);
        Some([point.parameter, point.evaluations * longer, seconds * longer])
    }
}
