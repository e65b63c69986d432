//! Questions to a Hamiltonian: sections, exponents, brackets, changes of variables.

use core::cell::Cell;
use core::ops::ControlFlow;

use piola_hamiltonian::{
    CanonicalTest, LyapunovExponents, PhasePoint, PoincareSection, canonical_test, lyapunov_exponents_observed,
};
use piola_integrators::Tolerance;

use super::{BracketQuestion, NewVariables, PhaseExpression, PhaseSystem};
use crate::Outcome;
use crate::motion::{History, TimeSpan};

/// Intervals after which variations are made of length one again.
const INTERVALS: usize = 400;

/// Recorded instants between two questions to the observer.
const STRIDE: usize = 256;

/// The observer of a search: it gets the part that is done and may stop the search.
type Watch<'w> = &'w mut dyn FnMut(f64) -> ControlFlow<()>;

/// What is computed at a recorded instant from q, p and t.
type AtInstant<'a> = &'a mut dyn FnMut(&[f64], &[f64], f64) -> Result<(), String>;

/// What is asked of a Hamiltonian besides its motion.
///
/// # Example
/// See [`PhaseSystem::answers`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PhaseQuestions {
    /// The surface s(q, p) = 0 of a Poincaré section, crossed upwards, and the most crossings that are sought.
    pub section: Option<(PhaseExpression, usize)>,
    /// Whether the largest Lyapunov exponent is estimated: over a span that ends after its start.
    pub exponent: bool,
    /// Relative tolerance of a step for both.
    pub tolerance: f64,
    /// Poisson brackets at every recorded instant.
    pub brackets: Vec<BracketQuestion>,
    /// A change of variables, of which it is tested at every recorded instant whether it is canonical.
    pub new_variables: Option<NewVariables>,
}

impl PhaseQuestions {
    /// Whether nothing is asked.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.section.is_none() && !self.exponent && self.brackets.is_empty() && self.new_variables.is_none()
    }
}

/// The answers, as far as they came.
///
/// # Example
/// See [`PhaseSystem::answers`].
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct PhaseAnswers {
    /// Crossings of the section: time, then q and p; `None` where no section was sought.
    pub crossings: Option<Vec<(f64, Vec<f64>)>>,
    /// The estimate of the largest exponent at the end, 1/s.
    pub exponent: Option<f64>,
    /// Its estimates over time: (s since the start, 1/s).
    pub estimates: Vec<[f64; 2]>,
    /// The brackets, for each recorded instant until one is not defined, in the order of the questions.
    pub brackets: Vec<Vec<f64>>,
    /// The instant at which the change of variables is farthest from canonical, s, and the test there.
    pub canonical: Option<(f64, CanonicalTest)>,
}

impl PhaseSystem {
    /// The answers to the questions over a span of time: brackets and the test of a change of variables at the instants of the
    /// record, the others by runs of their own. The observer gets the part that is done and may stop the search.
    ///
    /// A question that fails leaves what it found until then, and the others are answered all the same.
    /// [`Outcome::Failed`] names every question that failed.
    ///
    /// # Example
    /// An oscillator from q = 3, p = 4 crosses q = 0 upwards once a turn, with p = 5.
    /// ```
    /// use piola_simulation::expression::{Expression, ExpressionNode as Node, Operation, Variable};
    /// use piola_simulation::motion::{History, TimeSpan};
    /// use piola_simulation::phase::{PhaseExpression, PhaseQuestions, PhaseSystem};
    /// use std::ops::ControlFlow;
    /// let nodes = vec![
    ///     Node::Constant(0.5),
    ///     Node::Variable(Variable::Conjugate(0)),
    ///     Node::WholePower(1, 2),
    ///     Node::Variable(Variable::Coordinate(0)),
    ///     Node::WholePower(3, 2),
    ///     Node::Operation(Operation::Sum, 2, 4),
    ///     Node::Operation(Operation::Product, 0, 5),
    /// ];
    /// let names = (vec!["q".into()], vec!["p".into()]);
    /// let mut oscillator = PhaseSystem::new(Expression::new(nodes)?, names, vec![3.0], vec![4.0])?;
    /// let q = PhaseExpression(Expression::new(vec![Node::Variable(Variable::Coordinate(0))])?);
    /// oscillator.questions = PhaseQuestions { section: Some((q, 10)), tolerance: 1e-12, ..PhaseQuestions::default() };
    /// let span = TimeSpan { start: 0.0, end: 20.0 };
    /// let (answers, _) = oscillator.answers(span, &History::default(), &mut |_| ControlFlow::Continue(()));
    /// let crossings = answers.crossings.unwrap();
    /// assert_eq!(crossings.len(), 3);
    /// assert!((crossings[2].1[1] - 5.0).abs() < 1e-10);
    /// # Ok::<(), piola_simulation::SimulationError>(())
    /// ```
    pub fn answers(
        &self,
        span: TimeSpan,
        history: &History,
        observer: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> (PhaseAnswers, Outcome) {
        let mut answers = PhaseAnswers::default();
        let stopped = Cell::new(false);
        let mut watch = |share: f64| {
            let go = observer(share);
            stopped.set(stopped.get() || go.is_break());
            go
        };
        let mut failures = Vec::new();
        failures.extend(self.brackets_along(history, &mut answers, &mut watch).err());
        if !stopped.get() {
            failures.extend(self.canonical_along(history, &mut answers, &mut watch).err());
        }
        if !stopped.get() {
            failures.extend(self.cross_section(span, &mut answers, &mut watch).err());
        }
        if !stopped.get() {
            failures.extend(self.estimate_exponent(span, &mut answers, &mut watch).err());
        }
        let outcome = match (failures.is_empty(), stopped.get()) {
            (false, _) => Outcome::Failed(failures.join("; ")),
            (true, true) => Outcome::Interrupted,
            (true, false) => Outcome::Completed,
        };
        (answers, outcome)
    }

    /// Calls a function for every recorded instant, until it fails or the observer stops it.
    fn along(&self, history: &History, watch: Watch<'_>, at: AtInstant<'_>) -> Result<(), String> {
        let count = history.times.len();
        for (number, (&t, state)) in history.times.iter().zip(&history.coordinates).enumerate() {
            if 0 < number && number.is_multiple_of(STRIDE) && watch(number as f64 / count as f64).is_break() {
                break;
            }
            let (q, p) = state.split_at(self.freedom());
            at(q, p, t)?;
        }
        Ok(())
    }

    /// The brackets at every recorded instant, until one is not defined.
    fn brackets_along(&self, history: &History, answers: &mut PhaseAnswers, watch: Watch<'_>) -> Result<(), String> {
        if self.questions.brackets.is_empty() {
            return Ok(());
        }
        self.along(history, watch, &mut |q, p, t| {
            let values = self.bracket_values(q, p, t).map_err(|error| format!("a bracket at {t} s: {error}"))?;
            answers.brackets.push(values);
            Ok(())
        })
    }

    /// The worst canonical test of the new variables among the recorded instants, until one is not defined.
    fn canonical_along(&self, history: &History, answers: &mut PhaseAnswers, watch: Watch<'_>) -> Result<(), String> {
        let Some(variables) = &self.questions.new_variables else { return Ok(()) };
        self.along(history, watch, &mut |q, p, t| {
            let test = canonical_test(variables, q, p, t);
            let test = test.map_err(|error| format!("the new variables at {t} s: {error}"))?;
            if !test.relative.is_finite() {
                let why =
                    "products of their derivatives leave the range of doubles; smaller derivatives would be valid";
                return Err(format!("the new variables at {t} s: {why}"));
            }
            if answers.canonical.is_none_or(|(_, worst)| worst.relative < test.relative) {
                answers.canonical = Some((t, test));
            }
            Ok(())
        })
    }

    fn cross_section(&self, span: TimeSpan, answers: &mut PhaseAnswers, watch: Watch<'_>) -> Result<(), String> {
        let PhaseQuestions { section: Some((surface, most)), tolerance, .. } = &self.questions else { return Ok(()) };
        let failed = |error: &dyn core::fmt::Display| format!("the section: {error}");
        let start = PhasePoint::new(&self.position, &self.momentum, span.start).map_err(|error| failed(&error))?;
        let tolerance = Tolerance::relative(*tolerance).map_err(|error| failed(&error))?;
        let section = PoincareSection::new(&self.hamiltonian, surface, tolerance);
        let mut points = Vec::new();
        let followed = section.follow_observed_into(&start, span.end, *most, &mut points, |t| {
            watch((t - span.start) / (span.end - span.start))
        });
        let crossings = points.iter().map(|point| (point.time(), [point.q(), point.p()].concat()));
        answers.crossings = Some(crossings.collect());
        followed.map(drop).map_err(|error| failed(&error))
    }

    fn estimate_exponent(&self, span: TimeSpan, answers: &mut PhaseAnswers, watch: Watch<'_>) -> Result<(), String> {
        let PhaseQuestions { exponent: true, tolerance, .. } = &self.questions else { return Ok(()) };
        if span.end < span.start {
            let why = "the Lyapunov exponent of a run backwards in time: an end after the start would be valid";
            return Err(why.to_string());
        }
        if watch(0.0).is_break() {
            return Ok(());
        }
        let failed = |error: &dyn core::fmt::Display| format!("the Lyapunov exponent: {error}");
        let start = PhasePoint::new(&self.position, &self.momentum, span.start).map_err(|error| failed(&error))?;
        let tolerance = Tolerance::relative(*tolerance).map_err(|error| failed(&error))?;
        let intervals = (span.length() / INTERVALS as f64, INTERVALS);
        let done = |count: usize| watch(count as f64 / INTERVALS as f64);
        let found = lyapunov_exponents_observed(&self.hamiltonian, &start, 1, intervals, tolerance, done);
        let LyapunovExponents { exponents, times, history, .. } = found.map_err(|error| failed(&error))?;
        answers.exponent = exponents.first().copied();
        answers.estimates = times.into_iter().zip(history).map(|(t, estimate)| [t, estimate]).collect();
        Ok(())
    }
}
