//! Comparison with reference values.

use core::ops::ControlFlow;
use std::collections::HashMap;

use nalgebra::{DMatrix, Vector3};
use piola_integrators::{DormandPrince853, Field, GaussLegendre, Order, State, Tolerance};
use piola_kinematics::{Attitude, Inertia, Placement, RigidBody};
use piola_lagrangian::rigid_motion::RigidRotation;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, Potential};
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_each_close_at_scales, golden};
use serde_json::Value;

use crate::systems::*;

/// Calls `$run` with the Lagrangian of a case.
macro_rules! with_system {
    ($case:expr, $lagrangian:ident => $run:expr) => {{
        let parameters = parameters($case);
        let p = |name: &str| *parameters.get(name).unwrap_or_else(|| panic!("no parameter {name}"));
        match golden::text(&$case["system"]) {
            "double_pendulum" => {
                let system = DoublePendulum { mass: [p("m1"), p("m2")], length: [p("l1"), p("l2")] };
                let $lagrangian = Lagrangian::of(system).with_uniform_gravity([0.0, -p("g"), 0.0]);
                $run
            }
            "spherical_pendulum" => {
                let system = SphericalPendulum { mass: p("m"), length: p("l") };
                let $lagrangian = Lagrangian::of(system).with_gravity(p("g"));
                $run
            }
            "cart_pole" => {
                let system = CartPole { cart: p("M"), mass: p("m"), length: p("l") };
                let $lagrangian = Lagrangian::of(system).with_uniform_gravity([0.0, -p("g"), 0.0]);
                $run
            }
            "bead_on_hoop" => {
                let system = BeadOnHoop {
                    mass: p("m"),
                    radius: p("R"),
                    rate: p("Omega"),
                    wobble: p("epsilon"),
                    frequency: p("nu"),
                };
                let $lagrangian = Lagrangian::of(system).with_gravity(p("g"));
                $run
            }
            "heavy_top" => {
                let system = HeavyTop::new(p("m"), p("h"), p("A"), p("C"));
                let $lagrangian = Lagrangian::of(system).with_gravity(p("g"));
                $run
            }
            "elastic_pendulum" => {
                let $lagrangian = Lagrangian::of(ElasticPendulum { mass: p("m") })
                    .with_gravity(p("g"))
                    .with_potential(RadialSpring { stiffness: p("k"), rest: p("l0") });
                $run
            }
            "torus" => {
                let system = Torus { mass: p("m"), large: p("R"), small: p("a") };
                let $lagrangian = Lagrangian::of(system).with_gravity(p("g"));
                $run
            }
            "charged_particle" => {
                let $lagrangian = Lagrangian::of(Cylindrical { mass: p("m") }).with_potential(Lorentz {
                    charge: p("e"),
                    electric: [p("E1"), p("E2"), p("E3")],
                    magnetic: [p("B1"), p("B2"), p("B3")],
                });
                $run
            }
            "foucault" => {
                let pendulum = Foucault { mass: p("m"), length: p("l"), rate: p("Omega"), latitude: p("lam") };
                let $lagrangian =
                    Lagrangian::of(&pendulum).with_potential(Height { pendulum: &pendulum, gravity: p("g") });
                $run
            }
            "hinge_planar" => {
                let system = HingedBodies::new([p("m1"), p("m2")], [p("I1"), p("I2")], [p("a1"), p("a2")]);
                let $lagrangian = Lagrangian::of(system)
                    .with_uniform_gravity([0.0, -p("g"), 0.0])
                    .with_potential(Torsion { stiffness: p("k") });
                $run
            }
            other => panic!("unknown system {other}"),
        }
    }};
}

fn parameters(case: &Value) -> HashMap<String, f64> {
    case["parameters"].as_object().expect("parameters").iter().map(|(k, v)| (k.clone(), golden::number(v))).collect()
}

/// The forces of a case: given numbers.
struct Given(Vec<f64>);

impl Forces for Given {
    const GENERALISED: bool = true;
    fn generalised<T: Real>(&self, _q: &[T], _v: &[T], _t: T, q_out: &mut [T]) {
        for (out, &force) in q_out.iter_mut().zip(&self.0) {
            *out += T::lit(force);
        }
    }
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        other => vec![golden::number(other)],
    }
}

#[test]
fn lagrangian_data_equal_reference() {
    let data = golden::load("lagrange");
    let mut compared = 0;
    for case in &data.cases {
        with_system!(case, lagrangian => check_case(case, lagrangian));
        compared += 1;
    }
    assert_eq!(compared, 13);
}

fn check_case<S: Holonomic, P: Potential>(case: &Value, bare: Lagrangian<S, P>) {
    let name = golden::text(&case["name"]);
    let (q, v, t) = (golden::vector(&case["q"]), golden::vector(&case["qdot"]), golden::number(&case["t"]));
    let forces = golden::vector(&case["Q_nonconservative"]);
    let lagrangian = bare.with_forces(Given(forces.clone()));
    let check = |what: &str, actual: &[f64], key: &str, tol: f64| {
        assert_close(
            &format!("{name}: {what}"),
            actual,
            &flat(&case[key]),
            Tol::stated(tol, "the data's stated digits"),
        );
    };
    // Small results of large cancelling terms are compared at the size of their terms.
    let scale = golden::number(&case["E"]).abs() + golden::number(&case["V"]).abs();
    let check_at_scale = |what: &str, actual: f64, key: &str| {
        let tol = Tol::stated(1e-13, "algebraic quantities at the scale of the energies");
        assert_close_at_scale(&format!("{name}: {what}"), &[actual], &flat(&case[key]), scale, tol);
    };

    let energies = lagrangian.energies(&q, &v, t).unwrap();
    check("E", &[energies.kinetic], "E", 1e-13);
    check("V", &[energies.potential], "V", 1e-13);
    check_at_scale("L", energies.lagrangian(), "L");
    let metric = lagrangian.inertia_metric(&q, t).unwrap();
    check("metric", metric.transpose().as_slice(), "metric", 1e-13);
    let parts = lagrangian.kinetic_energy_parts(&q, t);
    check("E₀", &[parts.constant], "E_part0", 1e-13);
    check("E₁", parts.linear.as_slice(), "E_part1_coefficients", 1e-13);
    let christoffel: Vec<f64> = lagrangian
        .christoffel_second(&q, t)
        .unwrap()
        .iter()
        .flat_map(|matrix| matrix.transpose().as_slice().to_vec())
        .collect();
    check_christoffel(case, &lagrangian.christoffel_first(&q, t).unwrap(), &christoffel);
    check("∂L/∂q", lagrangian.coordinate_gradient(&q, &v, t).unwrap().as_slice(), "dL_dq", 1e-13);
    check("p", lagrangian.momenta(&q, &v, t).unwrap().as_slice(), "momenta", 1e-13);
    check_at_scale("∂L/∂t", lagrangian.time_derivative(&q, &v, t).unwrap(), "dL_dt_explicit");
    check("q̈", lagrangian.acceleration(&q, &v, t).unwrap().as_slice(), "qddot", 1e-13);
    check_at_scale("h", lagrangian.jacobi_integral(&q, &v, t).unwrap(), "jacobi_integral");
    let generalised = lagrangian.generalised_forces(&q, &v, t).unwrap();
    assert_close(name, generalised.as_slice(), &forces, Tol::ulps(1.0));
    let power: f64 = generalised.iter().zip(&v).map(|(f, v)| f * v).sum();
    check_at_scale("power", power, "power");
    check_at_scale("dh/dt", power - lagrangian.time_derivative(&q, &v, t).unwrap(), "dh_dt");
}

/// W(6.5–6.6): `[AB, D] = g_DC Γ^C_AB` of the reference, and `Γ^C_AB`, each at its own size: components of one symbol have different units.
fn check_christoffel(case: &Value, first: &[DMatrix<f64>], second: &[f64]) {
    let name = golden::text(&case["name"]);
    let (metric, symbols) = (golden::matrix(&case["metric"]), flat(&case["christoffel"]));
    let n = metric.len();
    let reference = |c: usize, a: usize, b: usize| symbols[(c * n + a) * n + b];
    let contracted = |d: usize, a: usize, b: usize| (0..n).map(|c| metric[d][c] * reference(c, a, b)).sum::<f64>();
    let terms = |d: usize, a: usize, b: usize| (0..n).map(|c| (metric[d][c] * reference(c, a, b)).abs()).sum::<f64>();
    // Derivatives of the metric along coordinates of the size of one, in the units of the three places.
    let unit = |a: usize| metric[a][a].sqrt();
    let largest = (0..n).map(unit).fold(0.0, f64::max);
    let scale = |d: usize, a: usize, b: usize| {
        terms(d, a, b).max(terms(a, b, d)).max(terms(b, a, d)) + unit(a) * unit(b) * largest
    };
    let inverse = DMatrix::from_fn(n, n, |i, j| metric[i][j]).try_inverse().expect("a regular metric");
    let places = || (0..n).flat_map(|c| (0..n).flat_map(move |a| (0..n).map(move |b| (c, a, b))));
    let found: Vec<f64> = places().map(|(d, a, b)| first[d][(a, b)]).collect();
    let expected: Vec<f64> = places().map(|(d, a, b)| contracted(d, a, b)).collect();
    let scales: Vec<f64> = places().map(|(d, a, b)| scale(d, a, b)).collect();
    let few = Tol::ulps(64.0);
    assert_each_close_at_scales(&format!("{name}: [AB, D]"), &found, &expected, &scales, few);
    let scales: Vec<f64> =
        places().map(|(c, a, b)| (0..n).map(|d| inverse[(c, d)].abs() * scale(d, a, b)).sum()).collect();
    assert_each_close_at_scales(&format!("{name}: Γ"), second, &symbols, &scales, few);
    assert_eq!(found.len(), n * n * n, "{name}");
}

/// 1e-14 of the sensitivity, or 1e-11, whichever is larger, of the state's own size.
fn allowed(case: &Value, index: usize) -> Tol {
    let sensitivity = case["sensitivity"].get(index).map_or(1.0, golden::number);
    Tol::stated((1e-14 * sensitivity).max(1e-11), "rounding of the state, blown up by the motion's sensitivity")
}

/// Follows a motion through all listed times, with an adaptive and with an implicit method.
fn follow<S: Holonomic, P: Potential>(case: &Value, lagrangian: &Lagrangian<S, P>, gauss_step: f64) {
    let name = golden::text(&case["name"]);
    let start = golden::vector(&case["initial_state"]);
    let n = start.len() / 2;
    let mut adaptive = State::new(0.0, start.clone()).unwrap();
    let mut implicit = adaptive.clone();
    for (index, expected) in case["states"].as_array().unwrap().iter().enumerate() {
        let (t, values) = (golden::number(&expected["t"]), golden::vector(&expected["state"]));
        let mut method = DormandPrince853::new(Tolerance::relative(1e-15).unwrap());
        method.integrate(&mut lagrangian.motion(n), &mut adaptive, t, |_| ControlFlow::Continue(())).unwrap();
        GaussLegendre::new(Order::Eight, gauss_step)
            .unwrap()
            .integrate_to(&mut lagrangian.motion(n), &mut implicit, t)
            .unwrap();
        for (what, state) in [("adaptive", &adaptive), ("Gauss–Legendre", &implicit)] {
            let what = format!("{name} at {t}, {what}");
            assert_close_at_scale(&what, &state.values, &values, 1.0, allowed(case, index));
        }
    }
}

/// Collects the places of particles.
struct ParticlePlaces<T>(Vec<[T; 3]>);

impl<T: Real> Placement<T> for ParticlePlaces<T> {
    fn particle(&mut self, _mass: f64, position: Vector3<T>) {
        self.0.push(position.into());
    }
    fn body(&mut self, _body: &RigidBody, _centre: Vector3<T>, _attitude: Attitude<T>) {}
}

/// Energy, momenta and places in every state of the reference, where it states them.
fn check_invariants<S: Holonomic, P: Potential>(case: &Value, lagrangian: &Lagrangian<S, P>) -> usize {
    let name = golden::text(&case["name"]);
    let names: Vec<&str> = case["state_names"].as_array().unwrap().iter().map(golden::text).collect();
    let n = names.len() / 2;
    let mut checked = 0;
    for state in case["states"].as_array().unwrap() {
        let (t, values) = (golden::number(&state["t"]), golden::vector(&state["state"]));
        let (q, v) = values.split_at(n);
        let momenta = lagrangian.momenta(q, v, t).unwrap();
        let energies = lagrangian.energies(q, v, t).unwrap();
        // The coordinates are rounded: the condition of the energy is the work of an ulp of each.
        let size = energies.kinetic.abs() + energies.potential.abs();
        for (invariant, expected) in case["invariants"].as_object().unwrap() {
            let (found, size) = match invariant.strip_prefix("p_") {
                None => (energies.total(), size),
                Some(coordinate) => {
                    let index = names.iter().position(|name| *name == coordinate).unwrap();
                    (momenta[index], momenta.amax())
                }
            };
            let what = format!("{name} at {t}: {invariant}");
            assert_close_at_scale(&what, &[found], &[golden::number(expected)], size, Tol::ulps(64.0));
            checked += 1;
        }
        if state.get("momenta").is_some() {
            let what = format!("{name} at {t}: momenta");
            assert_close_at_scale(
                &what,
                momenta.as_slice(),
                &golden::vector(&state["momenta"]),
                momenta.amax(),
                Tol::ulps(64.0),
            );
            checked += 1;
        }
        if state.get("position_velocity").is_some() {
            let moving: Vec<Dual<f64>> = q.iter().zip(v).map(|(&q, &v)| Dual::new(q, v)).collect();
            let mut places = ParticlePlaces(Vec::new());
            lagrangian.system().place(&moving, Dual::new(t, 1.0), &mut places);
            let place = places.0[0];
            let found = [place.map(|x| x.value), place.map(|x| x.tangent)].concat();
            assert_close(name, &found, &golden::vector(&state["position_velocity"]), Tol::ulps(16.0));
            checked += 1;
        }
    }
    checked
}

#[test]
fn invariants_of_reference_trajectories_are_theirs() {
    let data = golden::load("trajectories");
    let mut checked = 0;
    for case in &data.cases {
        if matches!(
            golden::text(&case["system"]),
            "double_pendulum" | "spherical_pendulum" | "heavy_top" | "elastic_pendulum"
        ) {
            with_system!(case, lagrangian => checked += check_invariants(case, &lagrangian));
        }
    }
    // Four states each: energies of six cases, five momenta of symmetries, two tables of momenta, one of places.
    assert_eq!(checked, 4 * (6 + 5 + 2 + 1));
}

#[test]
fn mechanisms_follow_reference_trajectories() {
    let data = golden::load("trajectories");
    let mut followed = 0;
    for case in &data.cases {
        let gauss_step = match golden::text(&case["name"]) {
            "heavy_top_fast" => 0.002,
            "double_pendulum_high" => 0.0025,
            _ => 0.01,
        };
        if matches!(
            golden::text(&case["system"]),
            "double_pendulum" | "spherical_pendulum" | "heavy_top" | "elastic_pendulum"
        ) {
            with_system!(case, lagrangian => follow(case, &lagrangian, gauss_step));
            followed += 1;
        }
    }
    assert_eq!(followed, 6);
}

fn cases_of(system: &str) -> Vec<Value> {
    golden::load("trajectories").cases.into_iter().filter(|case| golden::text(&case["system"]) == system).collect()
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
fn free_rotation_follows_reference_trajectories() {
    let mut followed = 0;
    for case in cases_of("free_rigid_body") {
        let p = parameters(&case);
        let body = RigidBody::new(1.0, Inertia::principal([p["I1"], p["I2"], p["I3"]]).unwrap()).unwrap();
        let initial = golden::vector(&case["initial_state"]);
        let mut start = golden::vector(&case["initial_quaternion_wxyz"]);
        start.extend_from_slice(&initial[..3]);
        // The data's state: ω, then the rows of Q in f_i = Q_ij e_j.
        let reading = |y: &[f64]| {
            let rows = Attitude { w: y[0], x: y[1], y: y[2], z: y[3] }.to_matrix().transpose();
            [&y[4..], rows.as_slice()].concat()
        };
        assert_close("the start", &reading(&start), &initial, Tol::ulps(8.0));
        follow_implicitly(&case, &mut RigidRotation::free(&body).unwrap(), start, 0.02, reading);
        followed += 1;
    }
    assert_eq!(followed, 2);
}
