//! Errors fall with the power of the step that the method promises, and the tableaux obey their order conditions.

use core::convert::Infallible;

use piola_geometric::{CommutatorFree, GeneralisedAlpha, MuntheKaas, Translations, group_field};
use piola_integrators::{IntegratorsError, Order, Report, State};
use piola_testkit::{Tol, assert_each_close, assert_order};

use super::{Top, reference};

type Outcome = Result<Report, IntegratorsError<Infallible>>;

/// The error of (q, Ω) of the asymmetric heavy top after 2 s, for so many steps, falls with the order.
fn assert_order_of_tops(
    what: &str,
    steps: &[f64],
    order: f64,
    mut run: impl FnMut(f64, &mut Top, &mut State, f64) -> Outcome,
) {
    let (mut top, start, states) = reference("heavy top, asymmetric");
    let (end, expected) = states.iter().find(|(t, _)| 1.5 < *t).unwrap();
    let errors: Vec<f64> = steps
        .iter()
        .map(|&h| {
            let mut state = start.clone();
            run(h, &mut top, &mut state, *end).unwrap();
            state.values.iter().zip(expected).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
        })
        .collect();
    assert_order(what, steps, &errors, order, 0.1);
}

#[test]
fn munthe_kaas_error_falls_with_its_order() {
    let steps: [(Order, &[f64]); 4] = [
        (Order::Two, &[0.02, 0.005, 0.002, 0.0005, 0.0002]),
        (Order::Four, &[0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001]),
        (Order::Six, &[0.0625, 0.05, 0.04, 0.025, 0.02, 0.0125]),
        (Order::Eight, &[0.2, 0.125, 0.1, 0.08, 0.0625, 0.05]),
    ];
    for (order, steps) in steps {
        assert_order_of_tops(&format!("{order:?}"), steps, f64::from(order.value()), |h, top, state, end| {
            MuntheKaas::new(order, h).unwrap().integrate_to(top, state, end)
        });
    }
}

#[test]
fn commutator_free_error_falls_with_the_fourth_power() {
    assert_order_of_tops(
        "commutator-free",
        &[0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001],
        4.0,
        |h, top, state, end| CommutatorFree::new(h).unwrap().integrate_to(top, state, end),
    );
}

#[test]
fn generalised_alpha_error_falls_with_the_square() {
    let steps = [0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005];
    for radius in [0.0, 0.5, 0.8, 1.0] {
        assert_order_of_tops(&format!("ρ∞ = {radius}"), &steps, 2.0, |h, top, state, end| {
            GeneralisedAlpha::new(radius, h).unwrap().integrate_to(top, state, end)
        });
    }
    assert_order_of_tops("Newmark", &steps, 2.0, |h, top, state, end| {
        GeneralisedAlpha::newmark(h).unwrap().integrate_to(top, state, end)
    });
}

/// Rooted trees: for each the list of its root's branches, trees before it. The order of a tree is the number of its nodes.
struct Trees {
    branches: Vec<Vec<usize>>,
    orders: Vec<u32>,
    densities: Vec<f64>,
}

impl Trees {
    fn up_to(order: u32) -> Self {
        let mut trees = Self { branches: Vec::new(), orders: Vec::new(), densities: Vec::new() };
        for order in 1..=order {
            for branches in trees.forests(order - 1, trees.orders.len()) {
                let density = branches.iter().map(|&b| trees.densities[b]).product::<f64>() * f64::from(order);
                trees.branches.push(branches);
                trees.orders.push(order);
                trees.densities.push(density);
            }
        }
        trees
    }

    /// All sets of the first `count` trees that have so many nodes together.
    fn forests(&self, nodes: u32, count: usize) -> Vec<Vec<usize>> {
        if nodes == 0 {
            return vec![Vec::new()];
        }
        let mut found = Vec::new();
        for tree in (0..count).filter(|&tree| self.orders[tree] <= nodes) {
            for mut rest in self.forests(nodes - self.orders[tree], tree + 1) {
                rest.push(tree);
                found.push(rest);
            }
        }
        found
    }
}

const EIGHT: Tol = Tol::ulps_because(2048.0, "coefficients of up to 43 and of alternating sign, up to seven times");

/// A step of length one from zero of the system `ẏ_τ = Π y_branches` gives Σ bᵢ Φᵢ(τ), which must be 1/γ(τ), the exact value, for all
/// trees τ with no more nodes than the order. The largest coefficient is 43, by which roundings grow.
#[test]
fn tableaux_obey_their_order_conditions() {
    let trees = Trees::up_to(9);
    assert_eq!(trees.orders.len(), 1 + 1 + 2 + 4 + 9 + 20 + 48 + 115 + 286);
    for order in Order::ALL {
        let mut field = group_field(Translations(trees.orders.len()), |_t, y: &[f64], rate: &mut [f64]| {
            for (rate, branches) in rate.iter_mut().zip(&trees.branches) {
                *rate = branches.iter().map(|&branch| y[branch]).product();
            }
        });
        let mut state = State::new(0.0, vec![0.0; trees.orders.len()]).unwrap();
        MuntheKaas::new(order, 1.0).unwrap().integrate_to(&mut field, &mut state, 1.0).unwrap();
        let count = trees.orders.iter().filter(|&&nodes| nodes <= order.value()).count();
        let expected: Vec<f64> = trees.densities.iter().map(|density| 1.0 / density).collect();
        let tol = if order == Order::Eight { EIGHT } else { Tol::ulps(8.0) };
        assert_each_close(&format!("{order:?}"), &state.values[..count], &expected[..count], tol);
        // Some tree with one node more is off: the order is no higher, and one is not what these sums are by themselves.
        let beyond = (count..trees.orders.len()).take_while(|&i| trees.orders[i] == order.value() + 1);
        let most = beyond.map(|i| (state.values[i] * trees.densities[i] - 1.0).abs()).fold(0.0, f64::max);
        assert!(1e-4 < most, "{order:?}: {most:e}");
    }
}
