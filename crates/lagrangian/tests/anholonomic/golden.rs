//! Comparison with reference values.

use piola_lagrangian::anholonomic::{BodyAngularVelocity, InFrame, QuasiVelocities, structure_coefficients};
use piola_testkit::{Tol, assert_close, golden};
use serde_json::Value;

use crate::systems::{All, Applied, Forms, Frame, Height, System, all, body};

/// The reference is exact to the last digit; sums of a few dozen terms lose some ulp of the largest.
fn stated() -> Tol {
    Tol::stated(1e-13, "acceptance of the reference data")
}

fn case_of(case: &Value) -> (System, [f64; 3], f64, Applied) {
    let p = |name: &str| golden::number(&case["parameters"][name]);
    let quasi = golden::vector(&case["Q_quasi"]);
    let coframe = golden::matrix(&case["coframe"]);
    // Q_C = A^A_C Ω_A
    let constant = core::array::from_fn(|c| (0..3).map(|a| coframe[a][c] * quasi[a]).sum());
    let applied = Applied { constant, drag: 0.0 };
    match golden::text(&case["frame"]) {
        "so3_body" => {
            let top = System::Top(body(1.0, [p("I1"), p("I2"), p("I3")]));
            (top, [0.0; 3], p("m") * p("g") * p("h"), applied)
        }
        "se2_sleigh" => {
            let moment = p("J");
            let sleigh = System::Sleigh { body: body(p("m"), [moment, moment, moment]), ahead: p("a") };
            (sleigh, [0.0, -p("g"), 0.0], 0.0, applied)
        }
        "r3_smooth" => (System::Particle(p("m")), [0.0, 0.0, -p("g")], 0.0, applied),
        frame => panic!("no frame {frame}"),
    }
}

fn compare<W: QuasiVelocities>(name: &str, case: &Value, system: InFrame<System, Height, Applied, W>) -> usize {
    let what = |quantity: &str| format!("{name}: {quantity}");
    let vector = |quantity: &str| golden::vector(&case[quantity]);
    let flat = |quantity: &str| golden::matrix(&case[quantity]).concat();
    let rows = |matrix: nalgebra::DMatrix<f64>| matrix.transpose().as_slice().to_vec();
    let (q, u) = (vector("q"), vector("u"));

    let frame = system.frame_matrix(&q, 0.0).expect("a frame");
    let coframe = system.coframe_matrix(&q, 0.0).expect("a coframe");
    assert_close(&what("frame_matrix"), &rows(frame), &flat("frame_matrix"), stated());
    assert_close(&what("coframe"), &rows(coframe), &flat("coframe"), stated());
    let structure = structure_coefficients(system.map(), &q, 0.0).expect("coefficients");
    let structure: Vec<f64> = structure.into_iter().flat_map(rows).collect();
    let expected: Vec<f64> = case["K"].as_array().expect("K").iter().flat_map(|k| golden::matrix(k).concat()).collect();
    assert_close(&what("K"), &structure, &expected, stated());

    let velocities = system.velocities(&q, &u, 0.0).expect("velocities");
    assert_close(&what("qdot"), velocities.as_slice(), &vector("qdot"), stated());
    let back = system.quasi_velocities(&q, velocities.as_slice(), 0.0).expect("quasi-velocities");
    assert_close(&what("u"), back.as_slice(), &u, stated());
    let metric = system.inertia_metric(&q, 0.0).expect("metric");
    assert_close(&what("metric_quasi"), &rows(metric), &flat("metric_quasi"), stated());
    let momenta = system.momenta(&q, &u, 0.0).expect("momenta");
    assert_close(&what("momenta_quasi"), momenta.as_slice(), &vector("momenta_quasi"), stated());
    let energies = system.energies(&q, &u, 0.0).expect("energies");
    let expected = [golden::number(&case["E"]), golden::number(&case["V"])];
    assert_close(&what("E, V"), &[energies.kinetic, energies.potential], &expected, stated());
    let forces = system.generalised_forces(&q, &u, 0.0).expect("forces");
    assert_close(&what("Q_quasi"), forces.as_slice(), &vector("Q_quasi"), stated());

    let rates = system.acceleration(&q, &u, 0.0).expect("accelerations");
    assert_close(&what("udot"), rates.as_slice(), &vector("udot"), stated());
    let accelerations = system.coordinate_acceleration(&q, &u, 0.0).expect("accelerations");
    assert_close(&what("qddot"), accelerations.as_slice(), &vector("qddot"), stated());
    let terms = system.boltzmann_hamel(&q, &u, &vector("udot"), 0.0).expect("terms");
    let scale = terms.momentum_rate.amax().max(terms.structure_term.amax()).max(terms.force.amax());
    assert!(terms.residual().amax() <= stated().value() * scale, "{name}: residual {:?}", terms.residual());

    let mut held_still = 0;
    if let Some(nonholonomic) = case.get("nonholonomic") {
        let indices = golden::vector(&nonholonomic["constrained_u_index_zero_based"]);
        let listed = |a: &usize| indices.iter().any(|index| (index - *a as f64).abs() < 0.5);
        let held: Vec<usize> = (0..3).filter(listed).collect();
        let free = |all: &[f64]| -> Vec<f64> { (0..3).filter(|a| !held.contains(a)).map(|a| all[a]).collect() };
        let constrained = system.holding(&held).expect("indices");
        let w = free(&u);
        let rates = constrained.acceleration(&q, &w, 0.0).expect("accelerations");
        let expected = free(&golden::vector(&nonholonomic["udot"]));
        assert_close(&what("nonholonomic udot"), rates.as_slice(), &expected, stated());
        let reactions = constrained.reactions(&q, &w, 0.0).expect("reactions");
        // The reaction is what is left of terms as large as the momentum's rate.
        let expected = golden::vector(&nonholonomic["reaction"]);
        piola_testkit::assert_close_at_scale(&what("reaction"), reactions.as_slice(), &expected, scale, stated());
        held_still += 1;
    }
    held_still
}

#[test]
fn quasi_velocity_data_equal_reference() {
    let cases = golden::load("boltzmann_hamel").cases;
    assert_eq!(cases.len(), 6);
    let mut held_still = 0;
    for case in &cases {
        let name = golden::text(&case["name"]);
        let system = || -> All {
            let (system, gravity, height, applied) = case_of(case);
            all(system, gravity, height, applied)
        };
        held_still += match golden::text(&case["frame"]) {
            "so3_body" => compare(name, case, system().in_coframe(Forms::Body(BodyAngularVelocity::default()))),
            "se2_sleigh" => {
                compare(name, case, system().in_frame(Frame::Blade))
                    + compare(name, case, system().in_coframe(Forms::Blade))
            }
            _ => compare(name, case, system().in_frame(Frame::Smooth)),
        };
    }
    // One sleigh on its blade, by its frame and by its coframe.
    assert_eq!(held_still, 2);
}
