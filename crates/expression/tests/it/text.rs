//! Expressions from text: values, units, precedence, and texts that are refused.

use piola_document::units::Dimension;
use piola_expression::text::{ExpressionNames, NameMeaning, parse};
use piola_expression::{Expression, Variable};
use piola_testkit::{Tol, assert_close};

/// x of a length, v its rate, k = 4 N/m, and the time.
fn names() -> ExpressionNames {
    let mut names = ExpressionNames::new(true);
    assert!(names.add("x", NameMeaning::Variable(Variable::Coordinate(0)), Dimension::LENGTH));
    assert!(names.add("k", NameMeaning::Number(4.0), Dimension::FORCE.over(Dimension::LENGTH)));
    names.add_rate("x", Variable::Conjugate(0), Dimension::LENGTH.over(Dimension::TIME));
    names
}

fn at(expression: &Expression) -> f64 {
    expression.evaluate(&|variable| match variable {
        Variable::Coordinate(_) => 0.5,
        Variable::Conjugate(_) => 3.0,
        Variable::Time => 2.0,
    })
}

#[test]
fn values_follow_the_rules_of_precedence() {
    let plain = |text: &str| at(&parse(text, &names(), Dimension::NONE).unwrap());
    let found = [
        plain("2 + 3 * 4 ^ 2"),
        plain("-2 ^ 2"),
        plain("2 ^ 3 ^ 2"),
        plain("8 / 4 / 2"),
        plain("7 - 2 - 1"),
        plain("(1 + 1) * atan2(1, 1)"),
        plain("sin(pi / 6) + max(1, 2) * min(3, 4)"),
        plain("t / 1 [s] * -(2 + 3)"),
        plain("2.5e-1 + 1E+1 + 15e1"),
    ];
    let expected = [50.0, -4.0, 512.0, 1.0, 4.0, core::f64::consts::FRAC_PI_2, 6.5, -10.0, 160.25];
    assert_close("values", &found, &expected, Tol::ulps(2.0));
}

#[test]
fn units_are_converted_and_checked() {
    let force = |text: &str| parse(text, &names(), Dimension::FORCE);
    let found = [
        at(&force("k * x").unwrap()),
        at(&force("2 [kN] - 3 [N s/m] * rate(x)").unwrap()),
        at(&force("5 [N] * sin(2 [1/s] * t)").unwrap()),
        at(&force("7").unwrap()),
        at(&force("1 [N/m^4] * (x ^ 2) ^ 2").unwrap()),
    ];
    assert_close("forces", &found, &[2.0, 1991.0, 5.0 * 4.0_f64.sin(), 7.0, 0.0625], Tol::ulps(2.0));
    for wrong in ["x", "k * x + x", "sin(x)", "k * rate(x)", "x ^ t", "2 [furlong]"] {
        assert!(force(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_what_would_be_valid() {
    let texts = [
        ("2 x", "cannot stand"),
        ("2e", "cannot stand"),
        ("y + 1", "y"),
        ("(1", ""),
        ("", ""),
        ("rate(k)", ""),
        ("1e999", ""),
    ];
    for (text, part) in texts {
        let mistake = parse(text, &names(), Dimension::NONE).unwrap_err();
        assert!(mistake.found.contains(part) && !mistake.valid.is_empty(), "{text}: {mistake:?}");
    }
    // Deep brackets end in a refusal, not in the stack.
    let deep = format!("{}1{}", "(".repeat(10_000), ")".repeat(10_000));
    assert!(parse(&deep, &names(), Dimension::NONE).is_err());
    // Brackets beside each other are no depth.
    assert_close(
        "seventy",
        &[at(&parse(&["(1)"; 70].join("+"), &names(), Dimension::NONE).unwrap())],
        &[70.0],
        Tol::ulps(0.0),
    );
    let mut names = names();
    assert!(names.add("mass[12]", NameMeaning::Number(3.0), Dimension::NONE));
    assert_close("index", &[at(&parse("mass[12] * 2", &names, Dimension::NONE).unwrap())], &[6.0], Tol::ulps(0.0));
    assert!(
        !names.add("t", NameMeaning::Number(1.0), Dimension::NONE)
            && !names.add("sin", NameMeaning::Number(1.0), Dimension::NONE)
    );
}

#[test]
fn only_a_written_zero_without_a_unit_has_every_dimension() {
    let mut names = names();
    assert!(names.add("none", NameMeaning::Number(0.0), Dimension::FORCE));
    let length = |text: &str| parse(text, &names, Dimension::LENGTH);
    for text in ["0 + 3 [m]", "3 [m] - 0", "0 + 0 + 3 [m]", "(0) + 3 [m]"] {
        assert_close(text, &[at(&length(text).unwrap())], &[3.0], Tol::ulps(0.0));
    }
    for text in ["none + 3 [m]", "3 [m] + none", "0 [N] + 3 [m]", "0 + none + 3 [m]"] {
        let mistake = length(text).unwrap_err();
        assert!(mistake.valid.starts_with("two parts of the dimension"), "{text}: {mistake:?}");
    }
}

#[test]
fn a_bare_number_with_signs_and_brackets_takes_the_dimension_that_is_needed() {
    for (text, value) in [("7", 7.0), ("+3", 3.0), ("(3)", 3.0), ("-(3)", -3.0), ("(-3)", -3.0)] {
        assert_close(text, &[at(&parse(text, &names(), Dimension::FORCE).unwrap())], &[value], Tol::ulps(0.0));
    }
    assert!(parse("(1) + (2)", &names(), Dimension::FORCE).is_err());
}
