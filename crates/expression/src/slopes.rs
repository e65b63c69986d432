//! All partial derivatives of an expression at once: one pass up its nodes and one down.
//!
//! ```text
//! up:    xᵢ = f(xₐ, x_b),  with ∂f/∂xₐ and ∂f/∂x_b
//! down:  x̄ₐ = x̄ᵢ ∂f/∂xₐ,   from x̄ = 1 of the last node
//! ```
//!
//! Every node is taken once, so no sum occurs on the way down. The cost is that of some two evaluations, however many variables
//! there are.

use piola_numerics::{Dual, Gradient, Real};

use crate::nodes::{apply, combine};
use crate::{Expression, ExpressionNode as Node, Operation, Variable};

const fn is_selection(node: &Node) -> bool {
    matches!(node, Node::Operation(Operation::Min | Operation::Max, _, _))
}

/// Whether a number is zero in all lanes.
fn is_zero<T: Real>(number: T) -> bool {
    (0..T::LANES).all(|lane| number.primal(lane).abs() <= 0.0)
}

/// An expression with room for the values and slopes of its nodes.
///
/// What depends on no variable is evaluated once, when it is made. [`differentiate`](Self::differentiate) allocates nothing.
///
/// # Example
/// ```
/// use piola_expression::{Expression, ExpressionNode as Node, Operation, ExpressionSlopes, Variable};
/// // x² p
/// let (x, p) = (Variable::Coordinate(0), Variable::Conjugate(0));
/// let nodes = vec![
///     Node::Variable(x),
///     Node::WholePower(0, 2),
///     Node::Variable(p),
///     Node::Operation(Operation::Product, 1, 2),
/// ];
/// let mut slopes = ExpressionSlopes::of(&Expression::new(nodes)?);
/// let (mut by_x, mut by_p) = (0.0, 0.0);
/// let value = slopes.differentiate(
///     |variable| if variable == x { 3.0 } else { 5.0 },
///     |variable, slope| if variable == x { by_x += slope } else { by_p += slope },
/// );
/// assert_eq!((value, by_x, by_p), (45.0, 30.0, 9.0));
/// # Ok::<(), piola_expression::ExpressionError>(())
/// ```
#[doc(alias("reverse mode", "backpropagation", "gradient", "adjoint"))]
#[derive(Clone, Debug)]
pub struct ExpressionSlopes<T = f64> {
    nodes: Vec<Node>,
    /// Nodes that depend on a variable, in their order.
    moving: Vec<usize>,
    values: Vec<T>,
    /// Derivatives of a node by those that it takes.
    slopes: Vec<[T; 2]>,
    /// Derivatives of the last node by each: x̄.
    adjoints: Vec<T>,
    /// Whether a node depends on a variable.
    moves: Vec<bool>,
    /// Whether there is a minimum or a maximum.
    selects: bool,
    /// Whether a node belongs to what a minimum or maximum does not take: there a derivative may be infinite.
    passed_over: Vec<bool>,
}

impl<T: Real> ExpressionSlopes<T> {
    /// The slopes of an expression.
    #[must_use]
    pub fn of(expression: &Expression) -> Self {
        let nodes = expression.nodes().to_vec();
        let count = nodes.len();
        let mut slopes = Self {
            nodes,
            moving: Vec::new(),
            values: vec![T::zero(); count],
            slopes: vec![[T::zero(); 2]; count],
            adjoints: vec![T::zero(); count],
            moves: vec![true; count],
            selects: expression.nodes().iter().any(is_selection),
            passed_over: vec![false; count],
        };
        // The nodes without a variable stand still with their values.
        for node in 0..count {
            slopes.values[node] = slopes.up(node, |_| T::zero());
            let taken = slopes.nodes[node].operands().into_iter().flatten();
            slopes.moves[node] =
                matches!(slopes.nodes[node], Node::Variable(_)) || taken.into_iter().any(|a| slopes.moves[a]);
            if slopes.moves[node] {
                slopes.moving.push(node);
            }
        }
        slopes
    }

    /// The value, where `read` gives the variables. Each occurrence of a variable is given to `add` with its derivative: their sum
    /// is the partial derivative by that variable.
    ///
    /// Outside of the domain of a function values and derivatives are not numbers. What a minimum or maximum does not take, in any
    /// lane, has no part in the derivatives.
    #[inline]
    pub fn differentiate(&mut self, read: impl Fn(Variable) -> T, mut add: impl FnMut(Variable, T)) -> T {
        for i in 0..self.moving.len() {
            let node = self.moving[i];
            self.values[node] = self.up(node, &read);
        }
        let last = self.nodes.len() - 1;
        self.adjoints[last] = T::one();
        for &node in self.moving.iter().rev() {
            if self.selects {
                let over = self.passed_over[node];
                for (k, operand) in self.nodes[node].operands().into_iter().flatten().enumerate() {
                    let is_taken = !is_selection(&self.nodes[node]) || !is_zero(self.slopes[node][k]);
                    self.passed_over[operand] = over || !is_taken;
                }
                if over {
                    continue;
                }
            }
            let adjoint = self.adjoints[node];
            match self.nodes[node] {
                Node::Constant(_) => {}
                Node::Variable(variable) => add(variable, adjoint),
                Node::Negative(a) => self.adjoints[a] = -adjoint,
                Node::WholePower(a, _) | Node::Function(_, a) => self.adjoints[a] = adjoint * self.slopes[node][0],
                Node::Operation(Operation::Sum, a, b) => {
                    self.adjoints[a] = adjoint;
                    self.adjoints[b] = adjoint;
                }
                Node::Operation(Operation::Difference, a, b) => {
                    self.adjoints[a] = adjoint;
                    self.adjoints[b] = -adjoint;
                }
                Node::Operation(Operation::Product, a, b) => {
                    self.adjoints[a] = adjoint * self.values[b];
                    self.adjoints[b] = adjoint * self.values[a];
                }
                Node::Operation(_, a, b) => {
                    let [by_a, by_b] = self.slopes[node];
                    self.adjoints[a] = adjoint * by_a;
                    self.adjoints[b] = adjoint * by_b;
                }
            }
        }
        self.values[last]
    }

    /// The value of a node from those that it takes. Its slopes are kept where they are not seen at once.
    #[inline]
    fn up(&mut self, node: usize, read: impl Fn(Variable) -> T) -> T {
        let value = |a: usize| self.values[a];
        let (result, slopes) = match self.nodes[node] {
            Node::Constant(constant) => return T::lit(constant),
            Node::Variable(variable) => return read(variable),
            Node::Negative(a) => return -value(a),
            Node::Operation(operation @ (Operation::Sum | Operation::Difference | Operation::Product), a, b) => {
                return combine(operation, value(a), value(b));
            }
            Node::WholePower(a, 2) => {
                let a = value(a);
                (a * a, [a + a, T::zero()])
            }
            Node::WholePower(a, n) => {
                let Dual { value, tangent } = Dual::variable(value(a)).powi(n);
                (value, [tangent, T::zero()])
            }
            Node::Function(function, a) => {
                let Dual { value, tangent } = apply(function, Dual::variable(value(a)));
                (value, [tangent, T::zero()])
            }
            // What stands still needs no derivative: that of a power by its exponent costs a logarithm.
            Node::Operation(operation, a, b) if !self.moves[b] => {
                let Dual { value, tangent } = combine(operation, Dual::variable(value(a)), Dual::constant(value(b)));
                (value, [tangent, T::zero()])
            }
            Node::Operation(operation, a, b) => {
                let pair = [Gradient::<T, 2>::variable(value(a), 0), Gradient::variable(value(b), 1)];
                let Gradient { value, partials } = combine(operation, pair[0], pair[1]);
                (value, partials)
            }
        };
        self.slopes[node] = slopes;
        result
    }
}
