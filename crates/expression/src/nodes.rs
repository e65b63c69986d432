//! Expressions of coordinates, rates or momenta and time as data: evaluated over any scalar, so with exact derivatives.
//!
//! An expression is a list of nodes in which every node stands after those that it takes. It is made once and evaluated without
//! allocation.

use piola_numerics::{Dual, Real};

use crate::ExpressionError;

/// Largest depth of an expression: an evaluation recurses along it.
pub const DEEPEST_EXPRESSION: usize = 200;

/// A variable of an expression.
///
/// # Example
/// See [`Expression`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// The coordinate qᵢ.
    Coordinate(usize),
    /// The rate q̇ᵢ of a mechanism, the momentum pᵢ of a Hamiltonian.
    Conjugate(usize),
    /// The time t, s.
    Time,
}

/// A function of one number.
///
/// # Example
/// See [`Expression`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// √x.
    Sqrt,
    /// eˣ.
    Exp,
    /// ln x.
    Ln,
    /// sin x.
    Sin,
    /// cos x.
    Cos,
    /// tan x.
    Tan,
    /// arcsin x.
    Asin,
    /// arccos x.
    Acos,
    /// arctan x.
    Atan,
    /// sinh x.
    Sinh,
    /// cosh x.
    Cosh,
    /// tanh x.
    Tanh,
    /// |x|.
    Abs,
    /// −1, or 1 where x is not negative.
    Sign,
}

/// An operation on two numbers.
///
/// # Example
/// See [`Expression`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// a + b.
    Sum,
    /// a − b.
    Difference,
    /// a b.
    Product,
    /// a/b.
    Quotient,
    /// aᵇ for 0 ≤ a.
    Power,
    /// The angle of the point (b, a).
    Atan2,
    /// The lesser one.
    Min,
    /// The greater one.
    Max,
}

/// A step of an expression. The indices are those of nodes before it.
///
/// # Example
/// See [`Expression`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ExpressionNode {
    /// A number.
    Constant(f64),
    /// A variable.
    Variable(Variable),
    /// −a.
    Negative(usize),
    /// aⁿ for a whole number n.
    WholePower(usize, i32),
    /// A function of a node.
    Function(Function, usize),
    /// An operation on two nodes.
    Operation(Operation, usize, usize),
}

/// A formula made of data; its value is that of the last node.
///
/// # Example
/// ```
/// use piola_numerics::Dual;
/// use piola_expression::{Expression, ExpressionNode as Node, Operation, Variable};
/// // 3 t²
/// let nodes = vec![
///     Node::Constant(3.0),
///     Node::Variable(Variable::Time),
///     Node::WholePower(1, 2),
///     Node::Operation(Operation::Product, 0, 2),
/// ];
/// let expression = Expression::new(nodes)?;
/// let at = |t| expression.evaluate(&|_: Variable| t);
/// assert_eq!(at(Dual::variable(2.0)), Dual::new(12.0, 12.0)); // 3 t² and 6 t
/// assert!(expression.depends_on_time() && expression.coordinates() == 0);
/// # Ok::<(), piola_expression::ExpressionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    pub(crate) nodes: Vec<ExpressionNode>,
}

impl Expression {
    /// The expression of these nodes, the last of which is its value.
    ///
    /// # Errors
    /// [`ExpressionError::WrongLength`] for no node, [`ExpressionError::NotFinite`] for a constant,
    /// [`ExpressionError::ExpressionOrder`] for a node that does not stand after those that it takes, or takes what another one
    /// does, [`ExpressionError::ExpressionTooDeep`] for more than [`DEEPEST_EXPRESSION`] levels.
    pub fn new(nodes: Vec<ExpressionNode>) -> Result<Self, ExpressionError> {
        if nodes.is_empty() {
            return Err(ExpressionError::WrongLength { quantity: "nodes of an expression", expected: 1, found: 0 });
        }
        let mut depths: Vec<usize> = Vec::with_capacity(nodes.len());
        // A tree: what is taken twice would be evaluated twice, and along a chain of such nodes ever more often.
        let mut taken = vec![false; nodes.len()];
        for (node, item) in nodes.iter().enumerate() {
            if let ExpressionNode::Constant(value) = *item
                && !value.is_finite()
            {
                return Err(ExpressionError::NotFinite { quantity: "constant", index: node, value });
            }
            let [a, b] = item.operands();
            let mut depth = 0;
            for operand in [a, b].into_iter().flatten() {
                let Some(below) = depths.get(operand).filter(|_| !taken[operand]) else {
                    return Err(ExpressionError::ExpressionOrder { node, operand });
                };
                taken[operand] = true;
                depth = depth.max(*below);
            }
            if DEEPEST_EXPRESSION <= depth {
                let most = DEEPEST_EXPRESSION;
                return Err(ExpressionError::ExpressionTooDeep { depth: depth + 1, most });
            }
            depths.push(depth + 1);
        }
        Ok(Self { nodes })
    }

    /// A number.
    ///
    /// # Errors
    /// [`ExpressionError::NotFinite`].
    pub fn constant(value: f64) -> Result<Self, ExpressionError> {
        Self::new(vec![ExpressionNode::Constant(value)])
    }

    /// The nodes.
    #[must_use]
    pub fn nodes(&self) -> &[ExpressionNode] {
        &self.nodes
    }

    /// The value, where `read` gives the variables. Outside of the domain of a function it is not a number.
    pub fn evaluate<T: Real>(&self, read: &dyn Fn(Variable) -> T) -> T {
        self.at(self.nodes.len() - 1, read)
    }

    /// The value and the partial derivative by one variable.
    pub fn partial<T: Real>(&self, by: Variable, read: &dyn Fn(Variable) -> T) -> Dual<T> {
        self.evaluate(&|variable| {
            let value = read(variable);
            if variable == by { Dual::variable(value) } else { Dual::constant(value) }
        })
    }

    fn at<T: Real>(&self, node: usize, read: &dyn Fn(Variable) -> T) -> T {
        match self.nodes[node] {
            ExpressionNode::Constant(value) => T::lit(value),
            ExpressionNode::Variable(variable) => read(variable),
            ExpressionNode::Negative(a) => -self.at(a, read),
            ExpressionNode::WholePower(a, n) => self.at(a, read).powi(n),
            ExpressionNode::Function(function, a) => apply(function, self.at(a, read)),
            ExpressionNode::Operation(operation, a, b) => combine(operation, self.at(a, read), self.at(b, read)),
        }
    }
}

impl ExpressionNode {
    pub(crate) fn operands(&self) -> [Option<usize>; 2] {
        match *self {
            Self::Constant(_) | Self::Variable(_) => [None, None],
            Self::Negative(a) | Self::WholePower(a, _) | Self::Function(_, a) => [Some(a), None],
            Self::Operation(_, a, b) => [Some(a), Some(b)],
        }
    }
}

pub(crate) fn apply<T: Real>(function: Function, x: T) -> T {
    match function {
        Function::Sqrt => x.sqrt(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Sin => x.sin_cos().0,
        Function::Cos => x.sin_cos().1,
        Function::Tan => {
            let (sine, cosine) = x.sin_cos();
            sine / cosine
        }
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Abs => x.abs(),
        // What is not a number stays so.
        Function::Sign => T::select(x.less_than(T::zero()), T::lit(-1.0), T::select(T::zero().at_most(x), T::one(), x)),
    }
}

pub(crate) fn combine<T: Real>(operation: Operation, a: T, b: T) -> T {
    match operation {
        Operation::Sum => a + b,
        Operation::Difference => a - b,
        Operation::Product => a * b,
        Operation::Quotient => a / b,
        Operation::Power => a.powf(b),
        Operation::Atan2 => a.atan2(b),
        // Neither comparison holds where one is not a number: then the sum is none either.
        Operation::Min => T::select(a.at_most(b), a, T::select(b.less_than(a), b, a + b)),
        Operation::Max => T::select(b.at_most(a), a, T::select(a.less_than(b), b, a + b)),
    }
}
