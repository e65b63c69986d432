//! Plane motions of attracting bodies against reference trajectories.

use piola_gravitation::Gravitation;
use piola_integrators::{Composition, DormandPrince853, Field, GaussLegendre, Order, Separable, State, Tolerance};
use piola_testkit::{Tol, assert_close_at_scale, golden};
use serde_json::Value;

/// 1e-14 of the sensitivity, or 1e-11, whichever is larger, of the state's own size.
fn allowed(case: &Value, index: usize) -> Tol {
    let sensitivity = case["sensitivity"].get(index).map_or(1.0, golden::number);
    Tol::stated((1e-14 * sensitivity).max(1e-11), "rounding of the state, blown up by the motion's sensitivity")
}

/// Compares two methods with a reference trajectory at all its times. `reading` brings a state to the form of
/// the data.
fn follow_field<F: Field + Separable<Error = <F as Field>::Error>>(
    case: &Value,
    field: &mut F,
    start: Vec<f64>,
    step: f64,
    reading: impl Fn(&[f64]) -> Vec<f64>,
) where
    <F as Field>::Error: core::fmt::Debug,
{
    let mut adaptive = State::new(0.0, start).unwrap();
    let mut implicit = adaptive.clone();
    let mut composed = adaptive.clone();
    for (index, expected) in case["states"].as_array().unwrap().iter().enumerate() {
        let (t, values) = (golden::number(&expected["t"]), golden::vector(&expected["state"]));
        let mut method = DormandPrince853::new(Tolerance::relative(1e-15).unwrap());
        method.integrate_to(field, &mut adaptive, t).unwrap();
        GaussLegendre::new(Order::Eight, step).unwrap().integrate_to(field, &mut implicit, t).unwrap();
        Composition::new(Order::Eight, step).unwrap().integrate_to(field, &mut composed, t).unwrap();
        for (what, state) in [("adaptive", &adaptive), ("Gauss–Legendre", &implicit), ("composition", &composed)] {
            let what = format!("{} at {t}, {what}", golden::text(&case["name"]));
            assert_close_at_scale(&what, &reading(&state.values), &values, 1.0, allowed(case, index));
        }
    }
}

fn cases_of(system: &str) -> Vec<Value> {
    golden::load("trajectories").cases.into_iter().filter(|case| golden::text(&case["system"]) == system).collect()
}

/// The state of plane bodies from (x₁, y₁, …) and (ẋ₁, ẏ₁, …), and back.
fn in_space(bodies: &Gravitation, plane: &[f64]) -> Vec<f64> {
    let (x, v) = plane.split_at(plane.len() / 2);
    let mut triples = [x, v].map(|half| half.chunks(2).map(|pair| [pair[0], pair[1], 0.0]).collect::<Vec<[f64; 3]>>());
    // The centre of Kepler's problem, at rest at the origin.
    for triples in &mut triples {
        triples.resize(bodies.bodies(), [0.0; 3]);
    }
    bodies.state(&triples[0], &triples[1]).unwrap()
}

fn in_plane(bodies: &Gravitation, state: &[f64], n: usize) -> Vec<f64> {
    let pair = |[x, y, _]: [f64; 3]| [x, y];
    let positions = (0..n).flat_map(|i| pair(bodies.position(state, i)));
    positions.chain((0..n).flat_map(|i| pair(bodies.velocity(state, i)))).collect()
}

#[test]
fn figure_eight_follows_reference_trajectory() {
    let cases = cases_of("planar_n_body");
    assert_eq!(cases.len(), 1);
    for case in cases {
        let mut bodies = Gravitation::new(vec![1.0; 3]).unwrap();
        let reader = bodies.clone();
        let start = in_space(&reader, &golden::vector(&case["initial_state"]));
        // At the start and in every state of the reference.
        let states = case["states"].as_array().unwrap().iter().map(|state| golden::vector(&state["state"]));
        for state in states.map(|state| in_space(&reader, &state)).chain([start.clone()]) {
            let (found, expected) = (reader.invariants(&state), &case["invariants"]);
            let check = |what: &str, found: &[f64], expected: &[f64], size: f64| {
                assert_close_at_scale(what, found, expected, size, Tol::ulps(8.0));
            };
            check("energy", &[found.energy], &[golden::number(&expected["energy"])], found.energy.abs());
            let momentum = golden::vector(&expected["momentum"]);
            check("momentum", &found.momentum[..2], &momentum, found.momentum_scale);
            let moment = golden::number(&expected["angular_momentum"]);
            check("angular momentum", &found.angular_momentum, &[0.0, 0.0, moment], found.angular_momentum_scale);
        }
        follow_field(&case, &mut bodies, start, 0.005, |state| in_plane(&reader, state, 3));
    }
}

#[test]
fn test_particle_follows_keplers_ellipses() {
    let cases = cases_of("kepler");
    assert_eq!(cases.len(), 3);
    for case in cases {
        let mut bodies = Gravitation::new(vec![0.0, 1.0]).unwrap();
        let reader = bodies.clone();
        let start = in_space(&reader, &golden::vector(&case["initial_state"]));
        if golden::text(&case["name"]) == "kepler_e0.3" {
            follow_field(&case, &mut bodies, start, 0.005, |state| in_plane(&reader, state, 1));
            continue;
        }
        // Near the centre fixed steps would have to be tiny: these are for adaptive ones.
        let mut state = State::new(0.0, start).unwrap();
        for (index, expected) in case["states"].as_array().unwrap().iter().enumerate() {
            let (t, values) = (golden::number(&expected["t"]), golden::vector(&expected["state"]));
            let mut method = DormandPrince853::new(Tolerance::relative(1e-15).unwrap());
            method.integrate_to(&mut bodies, &mut state, t).unwrap();
            let what = format!("{} at {t}", golden::text(&case["name"]));
            assert_close_at_scale(&what, &in_plane(&reader, &state.values, 1), &values, 1.0, allowed(&case, index));
        }
    }
}
