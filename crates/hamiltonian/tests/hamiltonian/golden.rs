//! Hamiltonians, brackets and canonical maps against reference values made with sympy and mpmath.

use piola_hamiltonian::{
    Bracket, DegenerateGenerated, Generated, GeneratingFunction, GeneratingKind, HamiltonianField, Identities, Inverse,
    InvertiblePhaseMap, LegendreTransform, OscillatorActionAngle, PhaseFunction, PhaseMap, PolarCoordinates,
    differential, hessian, image_and_jacobian, poisson_bracket, symplectic_gradient,
};
use piola_integrators::Field;
use piola_lagrangian::{Holonomic, Lagrangian, NoForces, Potential};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use serde_json::Value;

use super::placed::{DoublePendulum, HeavyTop};
use super::systems::{Charged, Kepler, SphericalPendulum};

/// Rounding of a formula of some tens of operations, in all its parts.
fn some_ulps() -> Tol {
    Tol::ulps(40.0)
}

/// H = p²/2m + ½ k x².
struct Oscillator {
    mass: f64,
    stiffness: f64,
}

impl PhaseFunction for Oscillator {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        p[0] * p[0] / T::lit(2.0 * self.mass) + T::lit(0.5 * self.stiffness) * q[0] * q[0]
    }
}

/// Kepler's problem in polar coordinates.
struct PolarKepler(Kepler);

impl PhaseFunction for PolarKepler {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let across = p[1] / q[0];
        (p[0] * p[0] + across * across) / T::lit(2.0 * self.0.mass) - T::lit(self.0.strength) / q[0]
    }
}

fn check_hamiltonian(name: &str, case: &Value, hamiltonian: &impl PhaseFunction) {
    let of = |key: &str| golden::vector(&case[key]);
    let (q, p) = (of("q"), of("p"));
    let n = q.len();
    let expected = [of("dH_dq"), of("dH_dp")].concat();
    let slope = differential(hamiltonian, &q, &p, 0.0).expect("a regular point");
    assert_close(&format!("{name}: dH"), slope.as_slice(), &expected, some_ulps());
    let vector = symplectic_gradient(hamiltonian, &q, &p, 0.0).expect("a regular point");
    assert_close(&format!("{name}: vector field"), vector.as_slice(), &of("vector_field"), some_ulps());
    let mut rate = vec![0.0; 2 * n];
    HamiltonianField::new(hamiltonian, n).rate(0.0, &[&q[..], &p].concat(), &mut rate).expect("a regular point");
    assert_eq!(rate, vector.as_slice());
    let value = hamiltonian.value(&q, &p, 0.0);
    let power: f64 = p.iter().zip(&of("qdot")).map(|(p, v)| (p * v).abs()).sum();
    let h = golden::number(&case["H"]);
    assert_close_at_scale(&format!("{name}: H"), &[value], &[h], power.max(h.abs()), some_ulps());
    let l = golden::number(&case["L"]);
    let lagrangian: f64 = p.iter().zip(&rate).map(|(p, v)| p * v).sum::<f64>() - value;
    assert_close_at_scale(&format!("{name}: L"), &[lagrangian], &[l], power.max(h.abs()), some_ulps());
    let second = hessian(hamiltonian, &q, &p, 0.0).expect("a regular point");
    let expected: Vec<f64> = golden::matrix(&case["hessian_H"]).concat();
    assert_close(&format!("{name}: ∂²H"), second.as_slice(), &expected, Tol::ulps(200.0));
}

/// The same through the Legendre map of a system, whose differential is −∂L/∂q and the velocity.
fn check_legendre<S: Holonomic, P: Potential>(name: &str, case: &Value, system: &Lagrangian<S, P, NoForces>) {
    check_hamiltonian(name, case, &LegendreTransform(system));
    let of = |key: &str| golden::vector(&case[key]);
    let (q, p) = (of("q"), of("p"));
    let expected = [of("dH_dq"), of("dH_dp")].concat();
    let slope = system.hamiltonian_differential(&q, &p, 0.0).expect("a regular point");
    assert_close(&format!("{name}: dH by dL"), slope.as_slice(), &expected, some_ulps());
}

#[test]
fn hamiltonians_and_their_derivatives_are_those_of_the_reference_values() {
    let file = golden::load("hamiltonian");
    let mut seen = 0;
    for case in file.cases.iter().filter(|case| golden::text(&case["kind"]) == "hamiltonian") {
        let parameter = |key: &str| golden::number(&case["parameters"][key]);
        let name = golden::text(&case["name"]);
        match golden::text(&case["system"]) {
            "harmonic_oscillator" => {
                check_hamiltonian(name, case, &Oscillator { mass: parameter("m"), stiffness: parameter("k") });
            }
            "kepler_cartesian" => {
                check_hamiltonian(name, case, &Kepler { mass: parameter("m"), strength: parameter("k") });
            }
            "kepler_polar" => {
                let kepler = Kepler { mass: parameter("m"), strength: parameter("k") };
                check_hamiltonian(name, case, &PolarKepler(kepler));
            }
            "pendulum" | "spherical_pendulum" => {
                let system = SphericalPendulum { mass: parameter("m"), length: parameter("l") };
                check_legendre(name, case, &Lagrangian::of(system).with_gravity(parameter("g")));
            }
            "double_pendulum" => {
                let system = DoublePendulum {
                    mass: [parameter("m1"), parameter("m2")],
                    length: [parameter("l1"), parameter("l2")],
                };
                let gravity = [0.0, -parameter("g"), 0.0];
                check_legendre(name, case, &Lagrangian::of(system).with_uniform_gravity(gravity));
            }
            "heavy_top" => {
                let system = HeavyTop::new(parameter("m"), parameter("h"), parameter("A"), parameter("C"));
                check_legendre(name, case, &Lagrangian::of(system).with_gravity(parameter("g")));
            }
            "charged_particle" => {
                let system = Charged {
                    mass: parameter("m"),
                    charge: parameter("e"),
                    electric: ["E1", "E2", "E3"].map(parameter),
                    magnetic: ["B1", "B2", "B3"].map(parameter),
                };
                check_legendre(name, case, &Lagrangian::from_function(system));
            }
            other => panic!("no system `{other}`"),
        }
        seen += 1;
    }
    assert_eq!(seen, 8);
}

/// The functions of the reference brackets.
struct Named<'a> {
    name: &'a str,
    mass: f64,
    strength: f64,
}

impl PhaseFunction for Named<'_> {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let moment = |i: usize| q[(i + 1) % 3] * p[(i + 2) % 3] - q[(i + 2) % 3] * p[(i + 1) % 3];
        let radius = || (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]).sqrt();
        let runge = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            p[j] * moment(k) - p[k] * moment(j) - T::lit(self.mass * self.strength) * q[i] / radius()
        };
        match self.name {
            "x" => q[0],
            "y" => q[1],
            "z" => q[2],
            "p_x" => p[0],
            "p_y" => p[1],
            "p_z" => p[2],
            "L_x" => moment(0),
            "L_y" => moment(1),
            "L_z" => moment(2),
            "A_x" => runge(0),
            "A_y" => runge(1),
            "A_z" => runge(2),
            "H" => Kepler { mass: self.mass, strength: self.strength }.value(q, p, T::zero()),
            "f1" => p[0] * q[2].sin() + p[1] * q[0] * q[0],
            "f2" => p[0] * q[1] + p[2] * p[2] * (T::lit(0.25) * q[0] * q[1]).exp(),
            "f3" => p[0] * q[0] + p[1] * q[1] + p[2] * q[2],
            other => panic!("no function `{other}`"),
        }
    }
}

#[test]
fn brackets_and_nested_brackets_are_those_of_the_reference_values() {
    let file = golden::load("hamiltonian");
    let case = file.cases.iter().find(|case| golden::text(&case["kind"]) == "poisson").expect("a case");
    let parameter = |key: &str| golden::number(&case["parameters"][key]);
    let named = |name| Named { name, mass: parameter("m"), strength: parameter("k") };
    let (q, p) = (golden::vector(&case["q"]), golden::vector(&case["p"]));
    let values = case["values"].as_object().expect("a table");
    for (name, value) in values {
        assert_close_at_scale(name, &[named(name).value(&q, &p, 0.0)], &[golden::number(value)], 5.0, some_ulps());
    }
    let brackets = case["brackets"].as_array().expect("a list");
    assert!(30 < brackets.len());
    for bracket in brackets {
        let (left, right) = (golden::text(&bracket["left"]), golden::text(&bracket["right"]));
        let value = poisson_bracket(&named(left), &named(right), &q, &p, 0.0).expect("a regular point");
        let expected = golden::number(&bracket["value"]);
        // The terms of each bracket are of the size of the functions, a few units.
        assert_close_at_scale(&format!("{{{left}, {right}}}"), &[value], &[expected], 5.0, some_ulps());
    }
    let nested = poisson_bracket(&named("f1"), &Bracket(named("f2"), named("f3")), &q, &p, 0.0);
    let expected = golden::number(&case["nested"][0]["value"]);
    assert_close("{f1, {f2, f3}}", &[nested.expect("a regular point")], &[expected], Tol::ulps(100.0));
}

/// The generating functions of the reference maps, F₁(q, Q).
enum Known {
    ActionAngle(f64),
    Exchange,
    Rotation(f64),
    Mixed(f64),
}

impl GeneratingFunction for Known {
    fn value<T: Real>(&self, q: &[T], new: &[T], _t: T) -> T {
        match *self {
            Self::ActionAngle(impedance) => T::lit(0.5 * impedance) * q[0] * q[0] / new[0].tan(),
            Self::Exchange => q[0] * new[0] + q[1] * new[1],
            Self::Rotation(angle) => {
                let (s, c) = T::lit(angle).sin_cos();
                ((q[0] * q[0] + new[0] * new[0]) * c - T::lit(2.0) * q[0] * new[0]) / (T::lit(2.0) * s)
            }
            Self::Mixed(a) => {
                T::lit(0.5 * a) * q[0] * q[0] * new[0]
                    + q[0] * new[1]
                    + q[1] * new[0]
                    + q[1] * q[1] * q[1] / T::lit(6.0)
            }
        }
    }
}

/// The same with the sign of the text.
struct OfTheText(Known);

impl GeneratingFunction for OfTheText {
    fn value<T: Real>(&self, q: &[T], new: &[T], t: T) -> T {
        -self.0.value(q, new, t)
    }
}

fn check_map(name: &str, case: &Value, map: &impl InvertiblePhaseMap) {
    let of = |key: &str| golden::vector(&case[key]);
    check_forwards(name, case, map);
    let mut old = vec![0.0; 2 * of("q").len()];
    Inverse(map).map(&of("Q"), &of("P"), 0.0, &mut old).expect("a regular point");
    assert_close(&format!("{name}: (q, p)"), &old, &[of("q"), of("p")].concat(), Tol::ulps(40.0));
}

fn check_forwards(name: &str, case: &Value, map: &impl PhaseMap) {
    let of = |key: &str| golden::vector(&case[key]);
    let (image, jacobian) = image_and_jacobian(map, &of("q"), &of("p"), 0.0).expect("a regular point");
    assert_close(&format!("{name}: (Q, P)"), image.as_slice(), &[of("Q"), of("P")].concat(), some_ulps());
    let expected = golden::matrix(&case["jacobian"]).concat();
    assert_close(&format!("{name}: J"), jacobian.transpose().as_slice(), &expected, some_ulps());
}

#[test]
fn canonical_maps_and_generating_functions_make_the_reference_images() {
    let file = golden::load("hamiltonian");
    let mut seen = 0;
    for case in file.cases.iter().filter(|case| golden::text(&case["kind"]) == "canonical") {
        let name = golden::text(&case["name"]);
        let parameter = |key: &str| golden::number(&case["parameters"][key]);
        let new_coordinates = golden::vector(&case["Q"]);
        // The guess is a tenth off: what is found is found, not given.
        let guess: Vec<f64> = new_coordinates.iter().map(|q| 1.1 * q).collect();
        let make = || match name {
            "oscillator_action_angle" => Some(Known::ActionAngle(parameter("m") * parameter("omega"))),
            "exchange" => Some(Known::Exchange),
            "phase_rotation" => Some(Known::Rotation(parameter("alpha"))),
            "mixed_2dof" => Some(Known::Mixed(parameter("a"))),
            _ => None,
        };
        if let (Some(function), Some(again)) = (make(), make()) {
            let old = golden::vector(&case["q"]);
            let value = function.value(&old, &new_coordinates, 0.0);
            assert_close(&format!("{name}: W"), &[value], &[golden::number(&case["W"])], some_ulps());
            // Backwards the guess is of the old coordinates.
            let back: Vec<f64> = old.iter().map(|q| 1.1 * q).collect();
            check_forwards(name, case, &Generated::new(function, GeneratingKind::First, &guess));
            check_forwards(name, case, &Generated::new(OfTheText(again), GeneratingKind::Text, &guess));
            if let Some(function) = make() {
                let generated = Generated::new(function, GeneratingKind::First, &back);
                let mut found = vec![0.0; 2 * old.len()];
                let new_momenta = golden::vector(&case["P"]);
                generated.invert(&new_coordinates, &new_momenta, 0.0, &mut found).expect("a regular point");
                let expected = [old, golden::vector(&case["p"])].concat();
                assert_close(&format!("{name}: back"), &found, &expected, Tol::ulps(40.0));
            }
        }
        match name {
            "polar" => check_map(name, case, &PolarCoordinates),
            "oscillator_action_angle" => {
                let map = OscillatorActionAngle::new(parameter("m"), parameter("omega")).expect("positive numbers");
                check_map(name, case, &map);
            }
            "identity" => {
                let map = DegenerateGenerated::new(Nothing, Same, &guess, &[0.1, 0.2]);
                check_forwards(name, case, &map);
                let of = |key: &str| golden::vector(&case[key]);
                let found = map.multipliers(&of("q"), &of("p"), 0.0).expect("independent identities");
                // The text's multipliers have the other sign.
                let expected: Vec<f64> = of("multipliers").iter().map(|l| -l).collect();
                assert_close("λ", &found, &expected, some_ulps());
            }
            "exchange" | "phase_rotation" | "mixed_2dof" => {}
            other => panic!("no map `{other}`"),
        }
        seen += 1;
    }
    assert_eq!(seen, 6);
}

struct Nothing;

impl GeneratingFunction for Nothing {
    fn value<T: Real>(&self, _q: &[T], _new: &[T], _t: T) -> T {
        T::zero()
    }
}

struct Same;

impl Identities for Same {
    fn count(&self) -> usize {
        2
    }
    fn values<T: Real>(&self, q: &[T], new_q: &[T], _t: T, out: &mut [T]) {
        for i in 0..2 {
            out[i] = q[i] - new_q[i];
        }
    }
}
