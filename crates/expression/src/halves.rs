//! The halves of a separable expression, and the degree of an expression in its conjugates.

use crate::{Expression, ExpressionNode as Node, Operation, Variable};

/// The terms of H(q, p) = T(p) + V(q), each half by itself. A constant term is in neither; a half without terms is absent.
///
/// # Example
/// ```
/// use piola_expression::{Expression, ExpressionNode as Node, Operation, Variable};
/// // (p² + q²)/2
/// let nodes = vec![
///     Node::Variable(Variable::Conjugate(0)),
///     Node::WholePower(0, 2),
///     Node::Variable(Variable::Coordinate(0)),
///     Node::WholePower(2, 2),
///     Node::Operation(Operation::Sum, 1, 3),
///     Node::Constant(2.0),
///     Node::Operation(Operation::Quotient, 4, 5),
/// ];
/// let halves = Expression::new(nodes)?.halves().unwrap();
/// let (kinetic, potential) = (halves.of_conjugates.unwrap(), halves.of_coordinates.unwrap());
/// assert_eq!((kinetic.coordinates(), kinetic.evaluate(&|_| 3.0)), (0, 4.5)); // p²/2
/// assert_eq!(potential.conjugates(), 0);
/// assert_eq!((kinetic.degree_in_conjugates(), potential.degree_in_conjugates()), (Some(2), Some(0)));
/// # Ok::<(), piola_expression::ExpressionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Halves {
    /// V(q).
    pub of_coordinates: Option<Expression>,
    /// T(p).
    pub of_conjugates: Option<Expression>,
}

/// The places of coordinates and conjugates in what a node needs.
const COORDINATES: usize = 0;
const CONJUGATES: usize = 1;

impl Expression {
    /// The halves of an expression that [is separable](Self::is_separable); nothing of another one.
    ///
    /// # Example
    /// See [`Halves`].
    #[must_use]
    pub fn halves(&self) -> Option<Halves> {
        self.is_separable()
            .then(|| Halves { of_coordinates: self.terms_of(COORDINATES), of_conjugates: self.terms_of(CONJUGATES) })
    }

    /// The degree of the expression as a polynomial in its conjugates, at most 1000; nothing where it is none, as √p.
    ///
    /// # Example
    /// See [`Halves`].
    #[must_use]
    pub fn degree_in_conjugates(&self) -> Option<u32> {
        let mut degrees: Vec<Option<u32>> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let of = |a: usize| degrees[a];
            let degree = match *node {
                Node::Variable(Variable::Conjugate(_)) => Some(1),
                Node::Constant(_) | Node::Variable(_) => Some(0),
                Node::Negative(a) => of(a),
                Node::WholePower(a, n) => match of(a) {
                    Some(0) => Some(0),
                    degree => degree.zip(u32::try_from(n).ok()).and_then(|(degree, n)| degree.checked_mul(n)),
                },
                Node::Operation(Operation::Sum | Operation::Difference, a, b) => {
                    of(a).zip(of(b)).map(|(a, b)| a.max(b))
                }
                Node::Operation(Operation::Product, a, b) => of(a).zip(of(b)).map(|(a, b)| a + b),
                Node::Operation(Operation::Quotient, a, b) if of(b) == Some(0) => of(a),
                _ => node.operands().into_iter().flatten().all(|a| of(a) == Some(0)).then_some(0),
            };
            degrees.push(degree.filter(|degree| *degree <= 1000));
        }
        degrees.last().copied().flatten()
    }

    /// The terms of a separable expression that depend on one half of the variables.
    fn terms_of(&self, half: usize) -> Option<Expression> {
        let mut nodes = Vec::new();
        self.copy_terms(self.nodes.len() - 1, half, &mut nodes)?;
        Some(Expression { nodes })
    }

    /// Copies those terms of the sum below `node` that belong to the half, and returns the index of the copy. `None` where no term does.
    fn copy_terms(&self, node: usize, half: usize, to: &mut Vec<Node>) -> Option<usize> {
        let copied = match self.nodes[node] {
            Node::Negative(a) => Node::Negative(self.copy_terms(a, half, to)?),
            Node::Operation(operation @ (Operation::Sum | Operation::Difference), a, b) => {
                let first = self.copy_terms(a, half, to);
                match (first, self.copy_terms(b, half, to)) {
                    (Some(a), Some(b)) => Node::Operation(operation, a, b),
                    (None, Some(b)) if operation == Operation::Difference => Node::Negative(b),
                    (one, other) => return one.or(other),
                }
            }
            Node::Operation(Operation::Product, a, b) if self.is_number(a) => {
                let b = self.copy_terms(b, half, to)?;
                Node::Operation(Operation::Product, self.copy(a, to), b)
            }
            Node::Operation(operation @ (Operation::Product | Operation::Quotient), a, b) if self.is_number(b) => {
                let a = self.copy_terms(a, half, to)?;
                Node::Operation(operation, a, self.copy(b, to))
            }
            _ => return self.needs(node)[half].then(|| self.copy(node, to)),
        };
        to.push(copied);
        Some(to.len() - 1)
    }

    /// Copies a node with all below it.
    fn copy(&self, node: usize, to: &mut Vec<Node>) -> usize {
        let copied = match self.nodes[node] {
            leaf @ (Node::Constant(_) | Node::Variable(_)) => leaf,
            Node::Negative(a) => Node::Negative(self.copy(a, to)),
            Node::WholePower(a, n) => Node::WholePower(self.copy(a, to), n),
            Node::Function(function, a) => Node::Function(function, self.copy(a, to)),
            Node::Operation(operation, a, b) => {
                let a = self.copy(a, to);
                Node::Operation(operation, a, self.copy(b, to))
            }
        };
        to.push(copied);
        to.len() - 1
    }
}
