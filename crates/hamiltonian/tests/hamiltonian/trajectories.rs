//! Motions in phase space against reference trajectories.

use piola_hamiltonian::{HamiltonianField, PhaseFunction};
use piola_integrators::{DormandPrince853, Field, GaussLegendre, Order, State, Tolerance};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close_at_scale, golden};
use serde_json::Value;

/// 1e-14 of the sensitivity, or 1e-11, whichever is larger, of the state's own size.
fn allowed(case: &Value, index: usize) -> Tol {
    let sensitivity = case["sensitivity"].get(index).map_or(1.0, golden::number);
    Tol::stated((1e-14 * sensitivity).max(1e-11), "rounding of the state, blown up by the motion's sensitivity")
}

fn cases_of(system: &str) -> Vec<Value> {
    golden::load("trajectories").cases.into_iter().filter(|case| golden::text(&case["system"]) == system).collect()
}

/// H = (p² + q²)/2 + x²y − y³/3.
struct HenonHeiles;

impl PhaseFunction for HenonHeiles {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let half = T::lit(0.5);
        let (x, y) = (q[0], q[1]);
        half * (p[0] * p[0] + p[1] * p[1] + x * x + y * y) + x * x * y - y * y * y / T::lit(3.0)
    }
}

/// Compares two methods with a reference trajectory at all its times. `reading` brings a state to the form of
/// the data.
fn follow_implicitly<F: Field>(
    case: &Value,
    field: &mut F,
    start: Vec<f64>,
    step: f64,
    reading: impl Fn(&[f64]) -> Vec<f64>,
) where
    F::Error: core::fmt::Debug,
{
    let mut adaptive = State::new(0.0, start).unwrap();
    let mut implicit = adaptive.clone();
    for (index, expected) in case["states"].as_array().unwrap().iter().enumerate() {
        let (t, values) = (golden::number(&expected["t"]), golden::vector(&expected["state"]));
        let mut method = DormandPrince853::new(Tolerance::relative(1e-15).unwrap());
        method.integrate_to(field, &mut adaptive, t).unwrap();
        GaussLegendre::new(Order::Eight, step).unwrap().integrate_to(field, &mut implicit, t).unwrap();
        for (what, state) in [("adaptive", &adaptive), ("Gauss–Legendre", &implicit)] {
            let what = format!("{} at {t}, {what}", golden::text(&case["name"]));
            assert_close_at_scale(&what, &reading(&state.values), &values, 1.0, allowed(case, index));
        }
    }
}

#[test]
fn hamiltonian_field_follows_reference_trajectory() {
    for case in cases_of("henon_heiles") {
        let start = golden::vector(&case["initial_state"]);
        follow_implicitly(&case, &mut HamiltonianField::new(&HenonHeiles, 2), start, 0.02, <[f64]>::to_vec);
    }
}
