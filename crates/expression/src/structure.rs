//! What an expression depends on.

use crate::{Expression, ExpressionNode, Operation, Variable};

impl Expression {
    /// One more than the largest index of a coordinate; 0 without coordinates.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.most(|variable| if let Variable::Coordinate(i) = variable { Some(i) } else { None })
    }

    /// One more than the largest index of a rate or momentum; 0 without them.
    #[must_use]
    pub fn conjugates(&self) -> usize {
        self.most(|variable| if let Variable::Conjugate(i) = variable { Some(i) } else { None })
    }

    /// Whether the time stands in it.
    #[must_use]
    pub fn depends_on_time(&self) -> bool {
        self.nodes.contains(&ExpressionNode::Variable(Variable::Time))
    }

    /// The expression with other variables in the places of its own.
    ///
    /// # Example
    /// ```
    /// use piola_expression::{Expression, ExpressionNode as Node, Variable};
    /// let first = Expression::new(vec![Node::Variable(Variable::Coordinate(0))])?;
    /// let third = first.with_variables(|_| Variable::Coordinate(2));
    /// assert_eq!(third.nodes(), [Node::Variable(Variable::Coordinate(2))]);
    /// # Ok::<(), piola_expression::ExpressionError>(())
    /// ```
    #[must_use]
    pub fn with_variables(&self, other: impl Fn(Variable) -> Variable) -> Self {
        let nodes = self.nodes.iter().map(|node| match node {
            ExpressionNode::Variable(variable) => ExpressionNode::Variable(other(*variable)),
            node => *node,
        });
        Self { nodes: nodes.collect() }
    }

    /// Whether it is a sum of terms of which each depends on coordinates alone or on momenta alone, and none on time.
    ///
    /// ```text
    /// H(q, p) = T(p) + V(q)
    /// ```
    #[must_use]
    pub fn is_separable(&self) -> bool {
        let mut terms = vec![self.nodes.len() - 1];
        while let Some(term) = terms.pop() {
            match self.nodes[term] {
                ExpressionNode::Negative(a) => terms.push(a),
                ExpressionNode::Operation(Operation::Sum | Operation::Difference, a, b) => terms.extend([a, b]),
                // A sum times or over a number is a sum.
                ExpressionNode::Operation(Operation::Product, a, b) if self.is_number(a) => terms.push(b),
                ExpressionNode::Operation(Operation::Product | Operation::Quotient, a, b) if self.is_number(b) => {
                    terms.push(a);
                }
                _ => {
                    let [q, p, t] = self.needs(term);
                    if t || (q && p) {
                        return false;
                    }
                }
            }
        }
        true
    }

    pub(crate) fn is_number(&self, node: usize) -> bool {
        self.needs(node) == [false; 3]
    }

    /// Whether coordinates, conjugates and time stand below a node.
    pub(crate) fn needs(&self, node: usize) -> [bool; 3] {
        let (mut found, mut below) = ([false; 3], vec![node]);
        while let Some(node) = below.pop() {
            if let ExpressionNode::Variable(variable) = self.nodes[node] {
                found[match variable {
                    Variable::Coordinate(_) => 0,
                    Variable::Conjugate(_) => 1,
                    Variable::Time => 2,
                }] = true;
            }
            below.extend(self.nodes[node].operands().into_iter().flatten());
        }
        found
    }

    fn most(&self, index: impl Fn(Variable) -> Option<usize>) -> usize {
        let indices = self.nodes.iter().filter_map(|node| match node {
            ExpressionNode::Variable(variable) => index(*variable),
            _ => None,
        });
        indices.map(|i| i + 1).max().unwrap_or(0)
    }
}
