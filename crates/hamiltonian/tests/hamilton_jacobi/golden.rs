//! Reference values made at fifty digits by other tools: `testdata/golden/hamilton_jacobi.json`.

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{Constants, Event, Extremal, GeodeticDistance, SearchRegion};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use serde_json::Value;

use super::systems::{Magnetic, OscillatorByEnergy, Particle};

/// What boundary-value problems are held to.
const BOUNDARY: f64 = 1e-10;

fn compare(case: &Value, system: &impl PhaseFunction) {
    let (q0, q1) = (vector(&case["q0"]), vector(&case["q1"]));
    let (from, to) = (Event::new(&q0, number(&case["t0"])), Event::new(&q1, number(&case["t1"])));
    let distance = GeodeticDistance::new(system);
    let found = distance.between(&from, &to, &vec![0.0; q0.len()]).unwrap();
    let name = text(&case["name"]);
    let close = |what: &str, actual: &[f64], key: &str| {
        let tolerance = Tol::stated(BOUNDARY, "shooting with the relative tolerance 1e-13");
        let expected = if case[key].is_array() { vector(&case[key]) } else { vec![number(&case[key])] };
        assert_close(&format!("{name}: {what}"), actual, &expected, tolerance);
    };
    let negative = |x: &[f64]| x.iter().map(|x| -x).collect::<Vec<f64>>();
    close("G", &[found.distance], "G");
    close("∂G/∂q₀ = −p₀", &negative(&found.initial_momenta), "dG_dq0");
    close("∂G/∂q₁ = p₁", &found.final_momenta, "dG_dq1");
    close("∂G/∂t₀ = H₀", &[found.initial_energy], "dG_dt0");
    close("∂G/∂t₁ = −H₁", &[-found.final_energy], "dG_dt1");
    let expected: Vec<f64> = golden::matrix(&case["mixed_hessian_q0_q1"]).concat();
    let actual: Vec<f64> = found.mixed_hessian.transpose().as_slice().to_vec();
    let tolerance = Tol::stated(BOUNDARY, "shooting with the relative tolerance 1e-13");
    assert_close(&format!("{name}: ∂²G/∂q₀∂q₁"), &actual, &expected, tolerance);
    let sheets =
        distance.all_between(&from, &to, &SearchRegion::new(&vec![-9.0; q0.len()], &vec![9.0; q0.len()], 3).unwrap());
    let sheets: Vec<Extremal> = sheets.unwrap();
    assert_eq!(sheets.len(), 1, "{name}: the extremal is unique");
}

#[test]
fn geodetic_distance_and_its_gradients() {
    let golden = golden::load("hamilton_jacobi");
    let mut count = 0;
    for case in golden.cases.iter().filter(|case| text(&case["kind"]) == "geodetic_distance") {
        let of = |key: &str| number(&case["parameters"][key]);
        let freedom = vector(&case["q0"]).len();
        match text(&case["system"]) {
            "free_particle" => compare(case, &Particle::oscillator(of("m"), 0.0, freedom)),
            "harmonic_oscillator" => compare(case, &Particle::oscillator(of("m"), of("omega"), freedom)),
            "uniform_field" => {
                let gravity = vector(&case["parameters"]["g"]);
                compare(case, &Particle { mass: of("m"), omega: 0.0, gravity });
            }
            "charged_particle_uniform_B_2d" => {
                compare(case, &Magnetic { mass: of("m"), charge: of("e"), field: of("B") });
            }
            other => panic!("no system {other}"),
        }
        count += 1;
    }
    assert!(6 <= count, "{count} cases");
}

#[test]
fn oscillator_by_its_complete_integral() {
    let golden = golden::load("hamilton_jacobi");
    let case = golden.cases.iter().find(|case| text(&case["kind"]) == "complete_integral_oscillator").unwrap();
    let of = |key: &str| number(&case["parameters"][key]);
    let (mass, omega, energy) = (of("m"), of("omega"), of("E"));
    let (system, integral) = (Particle::oscillator(mass, omega, 1), OscillatorByEnergy { mass, omega });
    let tolerance = Tol::stated(1e-12, "a formula and Newton's iteration in double precision");
    for point in case["points"].as_array().unwrap() {
        let (q, p, time) = (number(&point["q"]), number(&point["p"]), number(&point["dS_dE"]));
        let motion = Constants::through(&system, &integral, (&[q], &[p], 0.0), &[energy + 1.0]).unwrap();
        assert_close("E", motion.constants(), &[energy], tolerance);
        assert_close_at_scale("−P = t since q = 0", motion.momenta(), &[-time], 1.0, tolerance);
        // From there the motion is that of the oscillator, as long as p stays positive.
        let (q1, p1) = motion.at(-time, (&[q], 0.0)).unwrap();
        assert_close_at_scale("q(−time) = 0", &q1, &[0.0], 1.0, tolerance);
        assert_close("p(−time) = √(2mE)", &p1, &[(2.0 * mass * energy).sqrt()], tolerance);
    }
}
