//! Poisson brackets along a motion, and the test of a change of variables.

use piola_hamiltonian::{HamiltonianError, PhaseFunction as _, PhaseMap, poisson_bracket};
use piola_numerics::Real;

use super::{PhaseExpression, PhaseSystem};
use crate::SimulationError;
use crate::expression::Expression;
use crate::forces::in_coordinates;

/// A Poisson bracket with a name.
///
/// ```text
/// {F, G} = Σ ∂F/∂qᵢ ∂G/∂pᵢ − ∂F/∂pᵢ ∂G/∂qᵢ
/// ```
///
/// # Example
/// See [`PhaseSystem::bracket_values`].
#[derive(Debug, Clone, PartialEq)]
pub struct BracketQuestion {
    /// Its name.
    pub name: String,
    /// F(q, p, t).
    pub first: PhaseExpression,
    /// G(q, p, t); the Hamiltonian when absent.
    pub second: Option<PhaseExpression>,
}

/// New coordinates and momenta as functions of the old ones: Q(q, p, t) and P(q, p, t), as many as there are old ones.
///
/// # Example
/// The exchange Q = p, P = −q is canonical.
/// ```
/// use piola_hamiltonian::canonical_test;
/// use piola_simulation::expression::{Expression, ExpressionNode as Node, Variable};
/// use piola_simulation::phase::NewVariables;
/// let p = Expression::new(vec![Node::Variable(Variable::Conjugate(0))])?;
/// let minus_q = Expression::new(vec![Node::Variable(Variable::Coordinate(0)), Node::Negative(0)])?;
/// let exchange = NewVariables::new(vec![p], vec![minus_q])?;
/// assert_eq!(canonical_test(&exchange, &[2.0], &[3.0], 0.0).map(|test| test.residual), Ok(0.0));
/// # Ok::<(), piola_simulation::SimulationError>(())
/// ```
#[doc(alias("canonical transformation", "symplectic map"))]
#[derive(Debug, Clone, PartialEq)]
pub struct NewVariables {
    /// Q₁ … Qₙ and then P₁ … Pₙ.
    functions: Vec<PhaseExpression>,
}

impl NewVariables {
    /// The change of variables by the functions Q and P.
    ///
    /// # Errors
    /// [`SimulationError::WrongLength`] unless there are as many P as Q; [`SimulationError::NoSuchCoordinate`] for a function of
    /// a coordinate or momentum beyond the last Q.
    pub fn new(coordinates: Vec<Expression>, momenta: Vec<Expression>) -> Result<Self, SimulationError> {
        let (expected, found) = (coordinates.len(), momenta.len());
        if expected != found {
            return Err(SimulationError::WrongLength { quantity: "new momenta", expected, found });
        }
        for (quantity, functions) in [("new coordinate", &coordinates), ("new momentum", &momenta)] {
            for function in functions {
                in_coordinates(quantity, function, expected)?;
            }
        }
        Ok(Self { functions: coordinates.into_iter().chain(momenta).map(PhaseExpression).collect() })
    }

    /// The number of new coordinates.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.functions.len() / 2
    }
}

impl PhaseMap for NewVariables {
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        for (new, function) in new.iter_mut().zip(&self.functions) {
            *new = function.value(q, p, t);
        }
        Ok(())
    }
}

impl PhaseSystem {
    /// The values of the [brackets](super::PhaseQuestions::brackets) at a point, in their order.
    ///
    /// # Errors
    /// [`HamiltonianError`]: lists of different lengths, a value that is not finite.
    ///
    /// # Example
    /// The angular momentum of a plane oscillator is conserved: its bracket with H vanishes. That with a coordinate does not.
    /// ```
    /// use piola_simulation::expression::{Expression, ExpressionNode as Node, Operation, Variable};
    /// use piola_simulation::phase::{BracketQuestion, PhaseExpression, PhaseSystem};
    /// let q = |i| Node::Variable(Variable::Coordinate(i));
    /// let p = |i| Node::Variable(Variable::Conjugate(i));
    /// let squares = [q(0), q(1), p(0), p(1)].into_iter().enumerate();
    /// let mut nodes: Vec<Node> = squares.flat_map(|(i, x)| [x, Node::WholePower(2 * i, 2)]).collect();
    /// nodes.extend([Node::Operation(Operation::Sum, 1, 3), Node::Operation(Operation::Sum, 5, 7)]);
    /// nodes.extend([Node::Operation(Operation::Sum, 8, 9), Node::Constant(0.5), Node::Operation(Operation::Product, 10, 11)]);
    /// let moment = Expression::new(vec![
    ///     q(0), p(1), Node::Operation(Operation::Product, 0, 1),
    ///     q(1), p(0), Node::Operation(Operation::Product, 3, 4),
    ///     Node::Operation(Operation::Difference, 2, 5),
    /// ])?;
    /// let names = (vec!["x".into(), "y".into()], vec!["px".into(), "py".into()]);
    /// let mut system = PhaseSystem::new(Expression::new(nodes)?, names, vec![1.0, 2.0], vec![3.0, 5.0])?;
    /// let bracket = |name: &str, second: Option<Expression>| BracketQuestion {
    ///     name: name.into(), first: PhaseExpression(moment.clone()), second: second.map(PhaseExpression),
    /// };
    /// system.questions.brackets = vec![bracket("rate", None), bracket("turn", Some(Expression::new(vec![q(0)])?))];
    /// // {L, x} = −∂L/∂px = y.
    /// assert_eq!(system.bracket_values(&[1.0, 2.0], &[3.0, 5.0], 0.0).unwrap(), [0.0, 2.0]);
    /// # Ok::<(), piola_simulation::SimulationError>(())
    /// ```
    pub fn bracket_values(&self, q: &[f64], p: &[f64], t: f64) -> Result<Vec<f64>, HamiltonianError> {
        let value = |bracket: &BracketQuestion| {
            poisson_bracket(&bracket.first, bracket.second.as_ref().unwrap_or(&self.hamiltonian), q, p, t)
        };
        self.questions.brackets.iter().map(value).collect()
    }
}
