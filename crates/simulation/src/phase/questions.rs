//! Questions to a Hamiltonian: sections, exponents, brackets, changes of variables.

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
    /// Crossings of the section: time, then q and p.
    pub crossings: Vec<(f64, Vec<f64>)>,
    /// The estimate of the largest exponent at the end, 1/s.
    pub exponent: Option<f64>,
    /// Its estimates over time: (s since the start, 1/s).
    pub estimates: Vec<[f64; 2]>,
    /// The brackets, for each recorded instant, in the order of the questions.
    pub brackets: Vec<Vec<f64>>,
    /// The instant at which the change of variables is farthest from canonical, s, and the test there.
    pub canonical: Option<(f64, CanonicalTest)>,
}

impl PhaseSystem {
    /// The answers to the questions over a span of time: brackets and the test of a change of variables at the instants of the
    /// record, the others by runs of their own. The observer gets the part that is done and may stop the search.
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
    /// assert_eq!(answers.crossings.len(), 3);
    /// assert!((answers.crossings[2].1[1] - 5.0).abs() < 1e-10);
    /// # Ok::<(), piola_simulation::SimulationError>(())
    /// ```
    pub fn answers(
        &self,
        span: TimeSpan,
        history: &History,
        observer: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> (PhaseAnswers, Outcome) {
        let mut answers = PhaseAnswers::default();
        if let Err(why) = self.look_along(history, &mut answers) {
            return (answers, Outcome::Failed(why));
        }
        let mut stopped = false;
        let mut watch = |share: f64| {
            let go = observer(share);
            stopped |= go.is_break();
            go
        };
        let found = self.find(&mut answers, span, &mut watch);
        let outcome = match found {
            Err(why) => Outcome::Failed(why),
            Ok(()) if stopped => Outcome::Interrupted,
            Ok(()) => Outcome::Completed,
        };
        (answers, outcome)
    }

    /// Finds the brackets at every recorded instant, and the worst canonical test of the new variables among these instants; or
    /// says what is not defined, and when.
    fn look_along(&self, history: &History, answers: &mut PhaseAnswers) -> Result<(), String> {
        if self.questions.brackets.is_empty() && self.questions.new_variables.is_none() {
            return Ok(());
        }
        for (&t, state) in history.times.iter().zip(&history.coordinates) {
            let (q, p) = state.split_at(self.freedom());
            if !self.questions.brackets.is_empty() {
                let values = self.bracket_values(q, p, t);
                answers.brackets.push(values.map_err(|error| format!("a bracket at {t} s: {error}"))?);
            }
            if let Some(variables) = &self.questions.new_variables {
                let test = canonical_test(variables, q, p, t);
                let test = test.map_err(|error| format!("the new variables at {t} s: {error}"))?;
                if answers.canonical.is_none_or(|(_, worst)| worst.relative < test.relative) {
                    answers.canonical = Some((t, test));
                }
            }
        }
        Ok(())
    }

    fn find(
        &self,
        answers: &mut PhaseAnswers,
        span: TimeSpan,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), String> {
        let PhaseQuestions { section, exponent, tolerance, .. } = &self.questions;
        let start = PhasePoint::new(&self.position, &self.momentum, span.start).map_err(|error| error.to_string())?;
        if let Some((surface, most)) = section {
            let tolerance = Tolerance::relative(*tolerance).map_err(|error| error.to_string())?;
            let section = PoincareSection::new(&self.hamiltonian, surface, tolerance);
            let mut points = Vec::new();
            let followed = section.follow_observed_into(&start, span.end, *most, &mut points, |t| {
                watch((t - span.start) / (span.end - span.start))
            });
            answers.crossings = points.iter().map(|point| (point.time(), [point.q(), point.p()].concat())).collect();
            followed.map_err(|error| format!("the section: {error}"))?;
        }
        if *exponent && span.end < span.start {
            let why = "the Lyapunov exponent of a run backwards in time: an end after the start would be valid";
            return Err(why.to_string());
        }
        if *exponent && watch(0.0).is_continue() {
            let tolerance = Tolerance::relative(*tolerance).map_err(|error| error.to_string())?;
            let intervals = (span.length() / INTERVALS as f64, INTERVALS);
            let done = |count: usize| watch(count as f64 / INTERVALS as f64);
            let found = lyapunov_exponents_observed(&self.hamiltonian, &start, 1, intervals, tolerance, done);
            let LyapunovExponents { exponents, times, history, .. } =
                found.map_err(|error| format!("the Lyapunov exponent: {error}"))?;
            answers.exponent = exponents.first().copied();
            answers.estimates = times.into_iter().zip(history).map(|(t, estimate)| [t, estimate]).collect();
        }
        Ok(())
    }
}
