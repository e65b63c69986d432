//! The coefficients, compared with the conditions that define them in 31 digits.

use piola_geometric::ActionRule;
use piola_geometric::internal::ActionTableau;
use piola_integrators::Order;
use piola_numerics::Real;
use piola_testkit::DoubleDouble;

use super::all;

fn lit(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

fn power(c: f64, k: usize) -> DoubleDouble {
    (0..k).fold(lit(1.0), |product, _| product * lit(c))
}

/// What rounding of the stored doubles may leave.
fn assert_zero(what: &str, value: DoubleDouble) {
    let value = value.primal(0);
    assert!(value.abs() < 4e-15, "{what}: {value:e}");
}

#[test]
fn quadratures_are_exact_below_the_order_and_not_beyond() {
    for (rule, order) in all() {
        let tableau = ActionTableau::new(rule, order);
        let defect = |k: usize| {
            let terms = (0..tableau.points).map(|i| lit(tableau.weights[i]) * power(tableau.times[i], k));
            terms.fold(lit(-1.0) / lit((k + 1) as f64), |sum, term| sum + term)
        };
        let order_value = usize::try_from(order.value()).unwrap();
        for k in 0..order_value {
            assert_zero(&format!("{rule:?} {order:?} of degree {k}"), defect(k));
        }
        assert!(1e-5 < defect(order_value).primal(0).abs(), "{rule:?} {order:?}");
        let times = &tableau.times[..tableau.points];
        assert!(times.is_sorted());
        let has_ends = [times[0].to_bits(), times[tableau.points - 1].to_bits()] == [0.0, 1.0].map(f64::to_bits);
        assert_eq!(rule == ActionRule::Lobatto, has_ends, "{rule:?} {order:?}");
    }
}

#[test]
fn polynomials_are_interpolated_with_their_slopes() {
    for (rule, order) in all() {
        let tableau = ActionTableau::new(rule, order);
        let (s, nodes) = (tableau.degree, ActionTableau::new(ActionRule::Lobatto, order).times);
        // The node 0 has no part in xᵏ, 1 ≤ k ≤ s.
        for k in 1..=s {
            for i in 0..tableau.points {
                let sum = |row: &[f64]| (1..=s).fold(lit(0.0), |sum, j| sum + lit(row[j - 1]) * power(nodes[j], k));
                let c = tableau.times[i];
                assert_zero("value", sum(&tableau.values[i]) - power(c, k));
                assert_zero("slope", (sum(&tableau.slopes[i]) - lit(k as f64) * power(c, k - 1)) * lit(0.25));
            }
        }
    }
    assert_eq!(ActionTableau::new(ActionRule::Gauss, Order::Eight).degree, 4);
}
