//! Derivatives of random expressions in one pass, beside those of one variable at a time.

use core::cell::Cell;

use piola_expression::{Expression, ExpressionNode as Node, ExpressionSlopes, Function, Halves, Operation, Variable};
use piola_testkit::strategies::random_cases;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// An expression of the leaves given, by a machine with a stack: every node is taken once.
fn tree(code: &[(u8, f64)], leaves: &[Variable]) -> Vec<Node> {
    use Function::{Abs, Atan, Cos, Exp, Sin, Sqrt, Tanh};
    use Operation::{Atan2, Difference, Max, Min, Power, Product, Quotient, Sum};
    let (mut nodes, mut stack): (Vec<Node>, Vec<usize>) = (Vec::new(), Vec::new());
    for &(byte, number) in code {
        let pick = usize::from(byte / 8);
        let node = match (byte % 8, stack.len()) {
            (0, _) => Node::Constant(number),
            (1 | 2, _) | (_, 0) => Node::Variable(leaves[pick % leaves.len()]),
            (3, _) => Node::Negative(stack.pop().unwrap_or_default()),
            (4, _) => Node::WholePower(stack.pop().unwrap_or_default(), [0, 1, 2, 3, -1][pick % 5]),
            (5, _) => Node::Function([Sqrt, Exp, Sin, Cos, Atan, Tanh, Abs][pick % 7], stack.pop().unwrap_or_default()),
            (_, 1) => continue,
            _ => {
                let (b, a) = (stack.pop().unwrap_or_default(), stack.pop().unwrap_or_default());
                let operations = [Sum, Difference, Product, Quotient, Power, Atan2, Min, Max];
                Node::Operation(operations[pick % 8], a, b)
            }
        };
        nodes.push(node);
        stack.push(nodes.len() - 1);
    }
    // What is left on the stack is added.
    while let [.., a, b] = stack[..] {
        nodes.push(Node::Operation(Sum, a, b));
        stack.truncate(stack.len() - 2);
        stack.push(nodes.len() - 1);
    }
    nodes
}

fn expression(nodes: Vec<Node>) -> Expression {
    Expression::new(nodes).unwrap_or_else(|error| panic!("{error}"))
}

const Q: [Variable; 2] = [Variable::Coordinate(0), Variable::Coordinate(1)];
const P: [Variable; 2] = [Variable::Conjugate(0), Variable::Conjugate(1)];
const ALL: [Variable; 5] = [Q[0], Q[1], P[0], P[1], Variable::Time];

fn reader(point: &[f64]) -> impl Fn(Variable) -> f64 + '_ {
    move |variable| point[ALL.iter().position(|other| *other == variable).unwrap_or_default()]
}

/// The value and the derivatives in one pass.
fn slopes(expression: &Expression, point: &[f64]) -> (f64, [f64; 5]) {
    let mut found = [0.0; 5];
    let value = ExpressionSlopes::of(expression).differentiate(reader(point), |variable, slope| {
        found[ALL.iter().position(|other| *other == variable).unwrap_or_default()] += slope;
    });
    (value, found)
}

/// The two derivatives add the same products in different orders. They differ by some roundings of the largest term, and each of the hundred
/// operations of an expression may magnify these.
fn close(found: f64, expected: f64, scale: f64) -> bool {
    (found - expected).abs() <= 1e-11 * scale.max(1.0)
}

#[test]
fn derivatives_in_one_pass_equal_those_of_one_variable_at_a_time() {
    let cases = random_cases(10_000);
    let code = proptest::collection::vec((any::<u8>(), 0.2..2.0), 1..24);
    let point = proptest::collection::vec(0.2..2.0, 5);
    let compared = Cell::new(0);
    let result = TestRunner::new(ProptestConfig::with_cases(cases)).run(&(code, point), |(code, point)| {
        let expression = expression(tree(&code, &ALL));
        let (value, found) = slopes(&expression, &point);
        let expected = expression.evaluate(&reader(&point));
        prop_assert!(
            value.to_bits() == expected.to_bits() || (value.is_nan() && expected.is_nan()),
            "{value} {expected}"
        );
        for (variable, found) in ALL.into_iter().zip(found) {
            let expected = expression.partial(variable, &reader(&point)).tangent;
            // Beyond these, terms of different sizes cancel or are no numbers.
            if !(expected.abs() < 1e6 && value.abs() < 1e6) {
                continue;
            }
            prop_assert!(close(found, expected, expected.abs().max(value.abs())), "{variable:?}: {found} {expected}");
            compared.set(compared.get() + 1);
        }
        Ok(())
    });
    assert_eq!(result, Ok(()));
    assert!(3 * cases < compared.get(), "{} derivatives compared in {cases} cases", compared.get());
}

#[test]
fn what_a_minimum_does_not_take_has_no_part_in_the_derivatives() {
    let q = Node::Variable(Q[0]);
    let at_zero = |nodes: Vec<Node>| slopes(&expression(nodes), &[0.0; 5]);
    // min(1/|q|, 100) and max(ln q, −5) at q = 0: the other branch has an infinite derivative.
    let reciprocal = vec![
        q,
        Node::Function(Function::Abs, 0),
        Node::WholePower(1, -1),
        Node::Constant(100.0),
        Node::Operation(Operation::Min, 2, 3),
    ];
    assert_eq!(at_zero(reciprocal), (100.0, [0.0; 5]));
    let logarithm =
        vec![q, Node::Function(Function::Ln, 0), Node::Constant(-5.0), Node::Operation(Operation::Max, 1, 2)];
    assert_eq!(at_zero(logarithm), (-5.0, [0.0; 5]));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn halves_have_the_derivatives_of_the_whole(
        kinetic in proptest::collection::vec((any::<u8>(), 0.2..2.0), 1..12),
        potential in proptest::collection::vec((any::<u8>(), 0.2..2.0), 1..12),
        shape in 0..4_usize,
        point in proptest::collection::vec(0.2..2.0, 5),
    ) {
        let mut nodes = tree(&kinetic, &P);
        let (t, shift) = (nodes.len() - 1, nodes.len());
        let moved = |node: Node| match node {
            Node::Negative(a) => Node::Negative(a + shift),
            Node::WholePower(a, n) => Node::WholePower(a + shift, n),
            Node::Function(function, a) => Node::Function(function, a + shift),
            Node::Operation(operation, a, b) => Node::Operation(operation, a + shift, b + shift),
            leaf => leaf,
        };
        nodes.extend(tree(&potential, &Q).into_iter().map(moved));
        let v = nodes.len() - 1;
        // T + V, T − V, V − T, and 3 (T − V).
        let (a, b) = if shape == 2 { (v, t) } else { (t, v) };
        nodes.push(Node::Operation(if shape == 0 { Operation::Sum } else { Operation::Difference }, a, b));
        if shape == 3 {
            let sum = nodes.len() - 1;
            nodes.extend([Node::Constant(3.0), Node::Operation(Operation::Product, sum + 1, sum)]);
        }
        let whole = expression(nodes);
        let halves = whole.halves();
        prop_assert!(halves.is_some());
        let Some(Halves { of_coordinates, of_conjugates, .. }) = halves else { return Ok(()) };
        let (_, expected) = slopes(&whole, &point);
        for (half, own) in [(of_coordinates, 0..2), (of_conjugates, 2..4)] {
            let found = half.map_or([0.0; 5], |half| slopes(&half, &point).1);
            for i in own {
                if expected[i].abs() < 1e6 {
                    prop_assert!(close(found[i], expected[i], expected[i].abs()), "{found:?} {expected:?}");
                }
            }
        }
    }
}

#[test]
fn degrees_in_conjugates_are_those_of_polynomials_alone() {
    let p = Node::Variable(P[0]);
    let degree = |nodes: Vec<Node>| expression(nodes).degree_in_conjugates();
    assert_eq!(
        degree(vec![p, Node::WholePower(0, 2), Node::Variable(Q[0]), Node::Operation(Operation::Product, 1, 2)]),
        Some(2)
    );
    assert_eq!(degree(vec![p, p, Node::Operation(Operation::Product, 0, 1), Node::WholePower(2, 2)]), Some(4));
    assert_eq!(degree(vec![p, Node::Function(Function::Sqrt, 0)]), None);
    assert_eq!(degree(vec![p, Node::WholePower(0, -2)]), None);
    assert_eq!(degree(vec![Node::Constant(1.0), p, Node::Operation(Operation::Quotient, 0, 1)]), None);
    assert_eq!(degree(vec![Node::Variable(Q[0]), Node::Function(Function::Cos, 0)]), Some(0));
    assert_eq!(degree(vec![p, Node::WholePower(0, 999), Node::WholePower(1, 999)]), None);
}
