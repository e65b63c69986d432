//! Hamiltonians H(q, p, t) made of data: an expression of coordinates, momenta and time.
//!
//! ```text
//! q̇ = ∂H/∂p        ṗ = −∂H/∂q        dH/dt = ∂H/∂t
//! ```

mod canonical;
mod equations;
mod questions;

use core::ops::ControlFlow;

use piola_hamiltonian::{PhaseFunction, hessian};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::Real;

use crate::SimulationError;
use crate::expression::{Expression, Variable};
use crate::forces::{exists, in_coordinates};
use crate::joints::finite;
use crate::motion::TimeSpan;

pub use canonical::{BracketQuestion, NewVariables};
pub(crate) use equations::{Newtonian, PhaseField, Split};
pub use questions::{PhaseAnswers, PhaseQuestions};

/// A function of coordinates, momenta and time as an expression: [`Variable::Conjugate`] are the momenta.
///
/// # Example
/// See [`PhaseSystem`].
#[derive(Debug, Clone, PartialEq)]
pub struct PhaseExpression(pub Expression);

impl PhaseFunction for PhaseExpression {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        self.0.evaluate(&|variable| match variable {
            Variable::Coordinate(i) => q[i],
            Variable::Conjugate(i) => p[i],
            Variable::Time => t,
        })
    }
}

/// A system given by its Hamiltonian, with its state at the start.
///
/// # Example
/// An oscillator, H = ½ (p² + q²).
/// ```
/// use piola_simulation::expression::{Expression, ExpressionNode as Node, Operation, Variable};
/// use piola_simulation::phase::PhaseSystem;
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
/// let oscillator = PhaseSystem::new(Expression::new(nodes)?, names, vec![3.0], vec![4.0])?;
/// assert!(oscillator.hamiltonian.0.is_separable() && oscillator.has_constant_inertia());
/// assert_eq!(oscillator.turn(0.0), Some(std::f64::consts::TAU));
/// # Ok::<(), piola_simulation::SimulationError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PhaseSystem {
    /// H(q, p, t).
    pub hamiltonian: PhaseExpression,
    /// Names of the coordinates.
    pub coordinates: Vec<String>,
    /// Names of the momenta.
    pub momenta: Vec<String>,
    /// q at the start.
    pub position: Vec<f64>,
    /// p at the start.
    pub momentum: Vec<f64>,
    /// What is asked besides the motion.
    pub questions: PhaseQuestions,
}

impl PhaseSystem {
    /// The system of a Hamiltonian, names of coordinates and momenta, and a state.
    ///
    /// # Errors
    /// [`SimulationError::WrongLength`], [`SimulationError::NotFinite`], [`SimulationError::NoSuchCoordinate`].
    pub fn new(
        hamiltonian: Expression,
        (coordinates, momenta): (Vec<String>, Vec<String>),
        position: Vec<f64>,
        momentum: Vec<f64>,
    ) -> Result<Self, SimulationError> {
        let expected = position.len();
        if expected == 0 {
            exists("hamiltonian", 0, 0)?;
        }
        for (quantity, found) in
            [("coordinates", coordinates.len()), ("momenta", momenta.len()), ("momentum", momentum.len())]
        {
            if found != expected {
                return Err(SimulationError::WrongLength { quantity, expected, found });
            }
        }
        finite("position", position.iter().copied())?;
        finite("momentum", momentum.iter().copied())?;
        in_coordinates("hamiltonian", &hamiltonian, expected)?;
        let (hamiltonian, questions) = (PhaseExpression(hamiltonian), PhaseQuestions::default());
        Ok(Self { hamiltonian, coordinates, momenta, position, momentum, questions })
    }

    /// The number of degrees of freedom.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.position.len()
    }

    /// Whether H = ½ p·W p + w·p + V(q) with a constant W that has an inverse: then q̈ = −W ∂V/∂q depends on coordinates alone, and
    /// the methods [`Nystrom86`](crate::motion::Method::Nystrom86) and [`Nystrom1210`](crate::motion::Method::Nystrom1210) apply.
    ///
    /// # Example
    /// The oscillator of [`PhaseSystem`] is such a system.
    #[must_use]
    pub fn has_constant_inertia(&self) -> bool {
        Newtonian::of(self).is_some()
    }

    /// About the shortest period of small motions at the start, s: 2π/√(|∂²H/∂p²| |∂²H/∂q²|); none where one of them is zero.
    #[must_use]
    pub fn turn(&self, t: f64) -> Option<f64> {
        self.turn_at(&self.position, &self.momentum, t)
    }

    fn turn_at(&self, q: &[f64], p: &[f64], t: f64) -> Option<f64> {
        let n = self.freedom();
        let second = hessian(&self.hamiltonian, q, p, t).ok()?;
        let size = |first: usize| second.view((first, first), (n, n)).norm();
        let rate = (size(0) * size(n)).sqrt();
        (0.0 < rate && rate.is_finite()).then(|| core::f64::consts::TAU / rate)
    }

    /// The shortest of the [turns](Self::turn) along a trial of the motion, s; none where all are infinite.
    ///
    /// The trial takes at most 500 adaptive steps of the tolerance 1e-6, fewer of many coordinates.
    ///
    /// # Example
    /// H = ½ p² − cos q from q = π/2, where the second derivative of H by q vanishes: at the lowest place the turn is 2π.
    /// ```
    /// use piola_simulation::expression::{Expression, ExpressionNode as Node, Function, Operation, Variable};
    /// use piola_simulation::motion::TimeSpan;
    /// use piola_simulation::phase::PhaseSystem;
    /// let nodes = vec![
    ///     Node::Constant(0.5),
    ///     Node::Variable(Variable::Conjugate(0)),
    ///     Node::WholePower(1, 2),
    ///     Node::Operation(Operation::Product, 0, 2),
    ///     Node::Variable(Variable::Coordinate(0)),
    ///     Node::Function(Function::Cos, 4),
    ///     Node::Operation(Operation::Difference, 3, 5),
    /// ];
    /// let names = (vec!["q".into()], vec!["p".into()]);
    /// let start = vec![std::f64::consts::FRAC_PI_2];
    /// let pendulum = PhaseSystem::new(Expression::new(nodes)?, names, start, vec![0.0])?;
    /// assert!(pendulum.turn(0.0).is_some_and(|turn| 1e8 < turn));
    /// let fastest = pendulum.fastest_turn(TimeSpan { start: 0.0, end: 100.0 });
    /// assert!(fastest.is_some_and(|turn| (turn - std::f64::consts::TAU).abs() < 0.01));
    /// # Ok::<(), piola_simulation::SimulationError>(())
    /// ```
    #[must_use]
    pub fn fastest_turn(&self, span: TimeSpan) -> Option<f64> {
        /// Relative tolerance of a step: the trial need not be a result.
        const TOLERANCE: f64 = 1e-6;
        let n = self.freedom();
        // A Hessian takes some n² values of H, a step some n: neither may take long.
        let (most, every) = ((2000 / n).clamp(20, 500), 1 + n / 12);
        let mut fastest = self.turn(span.start);
        let (Ok(mut state), Ok(tolerance)) =
            (State::new(span.start, [&self.position[..], &self.momentum].concat()), Tolerance::relative(TOLERANCE))
        else {
            return fastest;
        };
        let mut steps = 0;
        let mut field = PhaseField::of_motion(self);
        // A trial that fails was long enough until then.
        let _ = DormandPrince853::new(tolerance).integrate(&mut field, &mut state, span.end, |step| {
            steps += 1;
            if steps % every == 0 {
                let (q, p) = step.values().split_at(n);
                fastest = fastest.into_iter().chain(self.turn_at(q, p, step.time())).reduce(f64::min);
            }
            if most <= steps { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        fastest
    }
}
