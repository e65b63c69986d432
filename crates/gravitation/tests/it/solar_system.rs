//! Attracting bodies followed in time, beside reference values.

use core::ops::ControlFlow;

use piola_gravitation::{Gravitation, GravitationInvariants, PostNewtonian, SPEED_OF_LIGHT};
use piola_integrators::{Composition, GaussLegendre, Order, State};
use piola_testkit::{golden, ulps_between};
use serde_json::Value;

const DAY: f64 = 86_400.0;
const EPOCHS: [f64; 3] = [30.0, 365.0, 3650.0];
const EARTH: usize = 3;
const MOON: usize = 4;

struct SolarSystem {
    bodies: Gravitation,
    state: State,
    cases: Vec<Value>,
}

fn triple(value: &Value) -> [f64; 3] {
    golden::vector(value).try_into().expect("three components")
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

fn solar_system() -> SolarSystem {
    let cases = golden::load("solar_system").cases;
    let start = cases.iter().find(|case| case["kind"] == "ephemeris").expect("epoch 0")["bodies"].clone();
    let list = |key: &str| start.as_array().expect("bodies").iter().map(|body| triple(&body[key])).collect::<Vec<_>>();
    let parameters = start.as_array().expect("bodies").iter().map(|body| golden::number(&body["GM"])).collect();
    let bodies = Gravitation::new(parameters).unwrap();
    let state = State::new(0.0, bodies.state(&list("position"), &list("velocity")).unwrap()).unwrap();
    SolarSystem { bodies, state, cases }
}

/// The largest change of an invariant, relative to its scale.
struct Drift {
    start: GravitationInvariants,
    days: Vec<f64>,
    energy: Vec<f64>,
    momentum: Vec<f64>,
    moment: Vec<f64>,
}

impl Drift {
    fn add(&mut self, time: f64, now: GravitationInvariants) {
        let start = self.start;
        self.days.push(time / DAY);
        self.energy.push((now.energy - start.energy) / start.energy.abs());
        self.momentum.push(distance(now.momentum, start.momentum) / start.momentum_scale);
        self.moment.push(distance(now.angular_momentum, start.angular_momentum) / start.angular_momentum_scale);
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// What a straight line through the values grows by over the whole run.
fn linear_growth(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len() as f64;
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let covariance: f64 = x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = x.iter().map(|x| (x - mean_x).powi(2)).sum();
    covariance / variance * (x[x.len() - 1] - x[0])
}

#[test]
fn newtonian_solar_system_equals_prediction_and_keeps_its_invariants() {
    let SolarSystem { mut bodies, mut state, cases } = solar_system();
    let reader = bodies.clone();
    let prediction = cases.iter().find(|case| case["kind"] == "newtonian_prediction").expect("the prediction");
    let start = reader.invariants(&state.values);
    let mut drift = Drift { start, days: vec![], energy: vec![], momentum: vec![], moment: vec![] };
    let mut method = Composition::new(Order::Eight, 0.5 * DAY).unwrap();
    for (epoch, predicted) in EPOCHS.into_iter().zip(prediction["predictions"].as_array().expect("three epochs")) {
        method
            .integrate(&mut bodies, &mut state, epoch * DAY, |step| {
                if step.number % 20 == 0 {
                    drift.add(step.time, reader.invariants(step.values));
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        let positions = predicted["positions"].as_array().expect("positions");
        for (body, expected) in positions.iter().enumerate() {
            let error = distance(reader.position(&state.values, body), triple(expected));
            assert!(error < 1.0, "body {body} after {epoch} days: {error} m");
        }
        let velocities = predicted["velocities"].as_array().expect("velocities");
        for (body, expected) in velocities.iter().enumerate() {
            let error = distance(reader.velocity(&state.values, body), triple(expected));
            // A metre at the fastest rate, that of the Moon about the Earth, 2.7e-6 rad/s.
            assert!(error < 2.7e-6, "body {body} after {epoch} days: {error} m/s");
        }
    }
    for (what, values) in [("energy", &drift.energy), ("momentum", &drift.momentum), ("moment", &drift.moment)] {
        let (drift, growth) = (largest(values), linear_growth(&drift.days, values).abs());
        // 450 ulp: the rounding of all steps walks at random.
        assert!(drift < 1e-13, "{what}: {drift:e}");
        // A systematic error of one in 2⁵³ a step would grow to 8e-13.
        assert!(growth < 2e-14, "{what} grows by {growth:e} of {drift:e}");
    }
}

/// The data themselves: epochs, names, parameters, and how far the prediction is from the ephemeris.
#[test]
fn prediction_differs_from_the_ephemeris_by_the_stated_distances() {
    let cases = golden::load("solar_system").cases;
    let ephemeris: Vec<&Value> = cases.iter().filter(|case| case["kind"] == "ephemeris").collect();
    let prediction = cases.iter().find(|case| case["kind"] == "newtonian_prediction").expect("the prediction");
    let start = ephemeris[0]["bodies"].as_array().expect("bodies");
    assert!(golden::number(&prediction["initial_state_days"]).abs() <= 0.0);
    for (index, entry) in start.iter().enumerate() {
        assert_eq!(golden::text(&entry["body"]), golden::text(&prediction["bodies"][index]));
        let [listed, used] = [&entry["GM"], &prediction["GM_used"][index]].map(golden::number);
        assert!(ulps_between(listed, used) <= 2.0, "{listed} and {used}");
    }
    let mut compared = 0;
    for predicted in prediction["predictions"].as_array().expect("three epochs") {
        let days = golden::number(&predicted["days_after"]);
        let case = ephemeris.iter().find(|case| (golden::number(&case["days_after"]) - days).abs() < 0.5);
        let case = case.expect("the epoch");
        assert!((golden::number(&case["jd_tdb"]) - 2_451_545.0 - days).abs() <= 0.0, "epoch {days}");
        for (index, entry) in case["bodies"].as_array().expect("bodies").iter().enumerate() {
            let stated = golden::number(&predicted["difference_to_de421_m"][index]);
            let found = distance(triple(&predicted["positions"][index]), triple(&entry["position"]));
            // Positions are rounded to half an ulp of 7e12 m, some 1e-3 m with both and their components.
            assert!(
                (found - stated).abs() < 2e-3,
                "{} after {days}: {found} and {stated}",
                golden::text(&entry["body"])
            );
            compared += 1;
        }
    }
    assert_eq!(compared, 33);
}

#[test]
fn post_newtonian_solar_system_equals_ephemeris() {
    let SolarSystem { bodies, mut state, cases } = solar_system();
    let mut bodies = bodies.with_post_newtonian(PostNewtonian::of(0)).unwrap();
    let reader = bodies.clone();
    let mut method = GaussLegendre::new(Order::Eight, 0.5 * DAY).unwrap();
    for epoch in EPOCHS {
        method.integrate_to(&mut bodies, &mut state, epoch * DAY).unwrap();
        let ephemeris = cases
            .iter()
            .find(|case| case["kind"] == "ephemeris" && (golden::number(&case["days_after"]) - epoch).abs() < 0.5)
            .expect("the epoch");
        let expected = ephemeris["bodies"].as_array().expect("bodies");
        let relative = |x: [f64; 3], sun: [f64; 3]| [x[0] - sun[0], x[1] - sun[1], x[2] - sun[2]];
        let (sun, expected_sun) = (reader.position(&state.values, 0), triple(&expected[0]["position"]));
        for (body, entry) in expected.iter().enumerate().skip(1) {
            let x = relative(reader.position(&state.values, body), sun);
            let e = relative(triple(&entry["position"]), expected_sun);
            let error = distance(x, e) / distance(e, [0.0; 3]);
            let allowed = if body == MOON { 1.5e-6 } else { 3e-8 };
            assert!(error < allowed, "{} after {epoch} days: {error:e}", golden::text(&entry["body"]));
            // Velocities relative to the speed about the Sun. The Moon moves the Earth with an 81st part of its own error.
            let own = |x: [f64; 3], sun: &Value| relative(x, triple(&sun["velocity"]));
            let sun = reader.velocity(&state.values, 0);
            let v = relative(reader.velocity(&state.values, body), sun);
            let e = own(triple(&entry["velocity"]), &expected[0]);
            let error = distance(v, e) / distance(e, [0.0; 3]);
            let allowed = match body {
                MOON => 2e-5,
                EARTH => 2e-5 / 81.0,
                _ => 3e-8,
            };
            assert!(error < allowed, "velocity of {} after {epoch} days: {error:e}", golden::text(&entry["body"]));
        }
    }
}

/// The largest relative change of the post-Newtonian energy in ten years, with the masses of all bodies but the
/// Sun and the speed of light multiplied by the given factors.
fn post_newtonian_energy_change(masses: f64, light: f64) -> f64 {
    let SolarSystem { bodies, mut state, .. } = solar_system();
    let scaled = |(body, &parameter): (usize, &f64)| if body == 0 { parameter } else { masses * parameter };
    let parameters = bodies.parameters().iter().enumerate().map(scaled).collect();
    let term = PostNewtonian { centre: 0, speed_of_light: light * SPEED_OF_LIGHT };
    let mut bodies = Gravitation::new(parameters).unwrap().with_post_newtonian(term).unwrap();
    let reader = bodies.clone();
    let start = reader.invariants(&state.values);
    let mut largest = 0.0_f64;
    let mut method = GaussLegendre::new(Order::Eight, DAY).unwrap();
    for month in 1..=120 {
        method.integrate_to(&mut bodies, &mut state, f64::from(month) * 30.0 * DAY).unwrap();
        let change = reader.invariants(&state.values).post_newtonian_energy - start.post_newtonian_energy;
        largest = largest.max((change / start.energy).abs());
    }
    largest
}

#[test]
fn post_newtonian_energy_changes_by_the_terms_of_order_m_over_mc2_that_are_left_out() {
    let change = post_newtonian_energy_change(1.0, 1.0);
    // m/M v²/c² is 1e-3 · 1e-8.
    assert!(change < 1e-11, "{change:e}");
    // Proportional to the masses of the planets and to 1/c², but for the next orders and the changed orbits.
    let lighter = post_newtonian_energy_change(0.1, 1.0) / change;
    let slower = post_newtonian_energy_change(1.0, 0.5) / change;
    assert!((0.08..0.12).contains(&lighter) && (3.6..4.4).contains(&slower), "{lighter} {slower}");
}
