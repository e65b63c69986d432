//! The coefficients, compared with the conditions that define them in 31 digits.

use piola_geometric::internal::PairTableau;
use piola_integrators::Order;
use piola_numerics::Real;
use piola_testkit::{DoubleDouble, Tol, assert_each_close};

fn lit(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

fn power(c: f64, k: usize) -> DoubleDouble {
    (0..k).fold(lit(1.0), |product, _| product * lit(c))
}

/// Σⱼ μᵢⱼ bⱼ cⱼᵏ⁻¹ − cᵢᵏ/k.
fn simplifying(tableau: &PairTableau, row: &[f64], i: usize, k: usize) -> f64 {
    let term = |j: usize| lit(row[j]) * lit(tableau.weights[j]) * power(tableau.nodes[j], k - 1);
    let sum = (0..tableau.stages).fold(lit(0.0), |sum, j| sum + term(j));
    (sum - power(tableau.nodes[i], k) / lit(k as f64)).primal(0)
}

#[test]
fn pairs_obey_the_simplifying_conditions() {
    for order in Order::ALL {
        let tableau = PairTableau::lobatto(order);
        let s = tableau.stages;
        for i in 0..s {
            // IIIA: C(s). IIIB: C(s − 2), and not C(s − 1).
            for k in 1..=s {
                let defect = simplifying(&tableau, &tableau.positions[i], i, k);
                assert!(defect.abs() < 1e-15, "IIIA {order:?} {i} {k}: {defect:e}");
            }
            for k in 1..=s.saturating_sub(2) {
                let defect = simplifying(&tableau, &tableau.momenta[i], i, k);
                assert!(defect.abs() < 1e-15, "IIIB {order:?} {i} {k}: {defect:e}");
            }
        }
        let largest =
            |k: usize| (0..s).map(|i| simplifying(&tableau, &tableau.momenta[i], i, k).abs()).fold(0.0, f64::max);
        assert!(1e-3 < largest(s - 1), "IIIB {order:?}");
    }
}

#[test]
fn pairs_are_symplectic_as_they_are_stored_and_symmetric() {
    for order in Order::ALL {
        let tableau = PairTableau::lobatto(order);
        let s = tableau.stages;
        for i in 0..s {
            assert_eq!((tableau.positions[0][i], tableau.momenta[i][s - 1]), (0.0, 0.0));
            assert_eq!((tableau.positions[s - 1][i], tableau.momenta[i][0]), (1.0, 1.0));
            for j in 0..s {
                let defect = (lit(tableau.momenta[i][j]) + lit(tableau.positions[j][i]) - lit(1.0)).primal(0);
                assert!(defect.abs() <= 0.0, "{order:?} {i} {j}: {defect:e}");
                let mirrored = 1.0 - tableau.positions[s - 1 - i][s - 1 - j];
                assert!((tableau.positions[i][j] - mirrored).abs() < 1e-15, "{order:?} {i} {j}");
            }
        }
    }
}

#[test]
fn three_stages_equal_those_in_print() {
    // Hairer, Lubich & Wanner, II, table 1.3: aᵢⱼ of IIIA.
    let tableau = PairTableau::lobatto(Order::Four);
    let row: Vec<f64> = (0..3).map(|j| tableau.positions[1][j] * tableau.weights[j]).collect();
    assert_each_close("IIIA", &row, &[5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0], Tol::ulps(8.0));
    let row: Vec<f64> = (0..3).map(|j| tableau.momenta[1][j] * tableau.weights[j]).collect();
    assert_each_close("IIIB", &row, &[1.0 / 6.0, 1.0 / 3.0, 0.0], Tol::ulps(8.0));
}
