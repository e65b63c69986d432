//! Expressions: values, derivatives, variables, and lists of nodes that are refused.

use piola_expression::{
    DEEPEST_EXPRESSION, Expression, ExpressionError, ExpressionNode as Node, Function, Operation, Variable,
};
use piola_numerics::Dual;
use piola_testkit::{Tol, assert_close};

fn expression(nodes: Vec<Node>) -> Expression {
    Expression::new(nodes).unwrap_or_else(|error| panic!("{error}"))
}

const Q: Node = Node::Variable(Variable::Coordinate(0));
const P: Node = Node::Variable(Variable::Conjugate(1));

#[test]
fn every_function_has_its_value_and_its_derivative() {
    use Function::{Abs, Acos, Asin, Atan, Cos, Cosh, Exp, Ln, Sign, Sin, Sinh, Sqrt, Tan, Tanh};
    let x = 0.4_f64;
    let root = (1.0 - x * x).sqrt();
    let cases = [
        (Sqrt, x.sqrt(), 0.5 / x.sqrt()),
        (Exp, x.exp(), x.exp()),
        (Ln, x.ln(), 1.0 / x),
        (Sin, x.sin(), x.cos()),
        (Cos, x.cos(), -x.sin()),
        (Tan, x.tan(), 1.0 + x.tan() * x.tan()),
        (Asin, x.asin(), 1.0 / root),
        (Acos, x.acos(), -1.0 / root),
        (Atan, x.atan(), 1.0 / (1.0 + x * x)),
        (Sinh, x.sinh(), x.cosh()),
        (Cosh, x.cosh(), x.sinh()),
        (Tanh, x.tanh(), 1.0 - x.tanh() * x.tanh()),
        (Abs, x, 1.0),
        (Sign, 1.0, 0.0),
    ];
    for (function, value, derivative) in cases {
        let found = expression(vec![Q, Node::Function(function, 0)]).partial(Variable::Coordinate(0), &|_| x);
        let expected = [value, derivative];
        assert_close(&format!("{function:?}"), &[found.value, found.tangent], &expected, Tol::ulps(8.0));
    }
}

#[test]
fn every_operation_has_its_value_and_its_partial_derivatives() {
    use Operation::{Atan2, Difference, Max, Min, Power, Product, Quotient, Sum};
    let (a, b) = (3.0_f64, 0.5_f64);
    let square = a * a + b * b;
    let cases = [
        (Sum, a + b, [1.0, 1.0]),
        (Difference, a - b, [1.0, -1.0]),
        (Product, a * b, [b, a]),
        (Quotient, a / b, [1.0 / b, -a / (b * b)]),
        (Power, a.powf(b), [b * a.powf(b - 1.0), a.powf(b) * a.ln()]),
        (Atan2, a.atan2(b), [b / square, -a / square]),
        (Min, b, [0.0, 1.0]),
        (Max, a, [1.0, 0.0]),
    ];
    let read = |variable| if variable == Variable::Coordinate(0) { a } else { b };
    for (operation, value, partials) in cases {
        let of_two = expression(vec![Q, P, Node::Operation(operation, 0, 1)]);
        let [by_a, by_b] = [Variable::Coordinate(0), Variable::Conjugate(1)].map(|by| of_two.partial(by, &read));
        let found = [by_a.value, by_a.tangent, by_b.tangent];
        assert_close(&format!("{operation:?}"), &found, &[value, partials[0], partials[1]], Tol::ulps(8.0));
    }
}

#[test]
fn second_derivatives_follow_from_nested_scalars() {
    // d²/dx² x⁵ = 20 x³
    let fifth = expression(vec![Q, Node::WholePower(0, 5)]);
    let found = fifth.evaluate(&|_| Dual::new(Dual::new(2.0, 1.0), Dual::new(1.0, 0.0)));
    assert_close("second derivative", &[found.tangent.tangent], &[160.0], Tol::ulps(4.0));
}

#[test]
fn a_sum_of_terms_of_q_and_of_p_is_separable() {
    // ½ p² − cos q
    let pendulum = |last: Vec<Node>| {
        let nodes = vec![
            Node::Constant(0.5),
            P,
            Node::WholePower(1, 2),
            Node::Operation(Operation::Product, 0, 2),
            Q,
            Node::Function(Function::Cos, 4),
            Node::Operation(Operation::Difference, 3, 5),
        ];
        expression(nodes.into_iter().chain(last).collect())
    };
    let plain = pendulum(vec![]);
    assert!(plain.is_separable() && !plain.depends_on_time());
    assert_eq!((plain.coordinates(), plain.conjugates()), (1, 2));
    // Times a number it still is; times q, or with the time, it is not.
    let product = |node| vec![node, Node::Operation(Operation::Product, 6, 7)];
    assert!(pendulum(product(Node::Constant(2.0))).is_separable());
    assert!(!pendulum(product(Q)).is_separable());
    let sum = vec![Node::Variable(Variable::Time), Node::Operation(Operation::Sum, 6, 7)];
    assert!(!pendulum(sum).is_separable());
}

#[test]
fn nodes_that_form_no_tree_are_refused() {
    let refused = |nodes| Expression::new(nodes).err();
    assert!(matches!(refused(vec![]), Some(ExpressionError::WrongLength { expected: 1, found: 0, .. })));
    assert!(matches!(
        refused(vec![Q, Node::Constant(f64::NAN)]),
        Some(ExpressionError::NotFinite { index: 1, value, .. }) if value.is_nan()
    ));
    let later = vec![Node::Negative(1), Q];
    assert_eq!(refused(later), Some(ExpressionError::ExpressionOrder { node: 0, operand: 1 }));
    let twice = vec![Q, Node::Operation(Operation::Sum, 0, 0)];
    assert_eq!(refused(twice), Some(ExpressionError::ExpressionOrder { node: 1, operand: 0 }));
    let chain = |levels: usize| core::iter::once(Q).chain((1..levels).map(|i| Node::Negative(i - 1))).collect();
    assert_eq!(refused(chain(DEEPEST_EXPRESSION)), None);
    let (depth, most) = (DEEPEST_EXPRESSION + 1, DEEPEST_EXPRESSION);
    assert_eq!(refused(chain(depth)), Some(ExpressionError::ExpressionTooDeep { depth, most }));
}

#[test]
fn what_is_not_a_number_stays_so() {
    let read = |variable| if variable == Variable::Coordinate(0) { f64::NAN } else { 2.0 };
    let sign = expression(vec![Q, Node::Function(Function::Sign, 0)]);
    assert!(sign.evaluate(&read).is_nan());
    let signs = [-3.0, 0.0, 3.0].map(|x| sign.evaluate(&|_| x));
    assert_close("signs", &signs, &[-1.0, 1.0, 1.0], Tol::ulps(0.0));
    for operation in [Operation::Min, Operation::Max] {
        for order in [[Q, P], [P, Q]] {
            let of_two = expression(vec![order[0], order[1], Node::Operation(operation, 0, 1)]);
            assert!(of_two.evaluate(&read).is_nan(), "{operation:?} of {order:?}");
            assert!(of_two.partial(Variable::Coordinate(0), &read).value.is_nan());
        }
    }
}
