//! Fluids from the discharges and speeds of `viscometric.json`.

use piola_fit::FitError;
use piola_fit::fluids::{FlowData, Options, fit_flow};
use piola_fluids::{Bingham, CarreauYasuda, Newtonian, Parameters, PowerLaw, ViscometricFluid};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use piola_viscometry::recover::FlowTable;
use serde_json::Value;

fn rows(drive: &Value, response: &Value) -> Vec<[f64; 2]> {
    vector(drive).into_iter().zip(vector(response)).map(|(drive, response)| [drive, response]).collect()
}

/// All four kinds of data of a case.
fn data(case: &Value) -> Result<[FlowData; 4], FitError> {
    let (pipe, channel, couette) = (&case["input"]["pipe"], &case["input"]["channel"], &case["input"]["couette"]);
    let curve = &case["output"]["pipe"];
    Ok([
        FlowData::pipe(&FlowTable::pipe(number(&pipe["R0"]), &rows(&pipe["c"], &pipe["Q"]))?),
        FlowData::channel(&FlowTable::channel(number(&channel["d"]), &rows(&channel["c"], &channel["Q_per_width"]))?),
        FlowData::couette(&FlowTable::couette(
            number(&couette["R1"]),
            number(&couette["R2"]),
            &rows(&couette["M"], &couette["delta_omega"]),
        )?),
        FlowData::flow_curve(&rows(&curve["kappa_wall"], &curve["tau_wall"]))?,
    ])
}

/// Each kind of data alone and all at once give the parameters.
fn check<F: Parameters<N> + ViscometricFluid, const N: usize>(case: &Value, start: [f64; N], truth: [f64; N]) {
    let what = text(&case["id"]);
    let tol = Tol::stated(1e-7, "answers to 1e-10, of parameters that 25 rows determine to a condition below 1000");
    let sets = data(case).expect("data");
    for set in sets.iter().map(core::slice::from_ref).chain([&sets[..]]) {
        let fit = fit_flow::<F, N>(set, &[start], &Options::default()).expect("a fit");
        assert!(fit.outcome.is_converged(), "{what}: {:?}", fit.outcome);
        for (found, exact) in fit.parameters.iter().zip(truth) {
            assert_close(&format!("{what}: {}", found.name), &[found.value], &[exact], tol);
        }
        let most = fit.residuals.iter().flatten().fold(0.0, |most: f64, r| most.max(r.abs()));
        let residual =
            Tol::stated(1e-8, "the tables are exact: parameters to 1e-7 of answers that they change by a tenth of it");
        assert_close_at_scale(what, &[most], &[0.0], 1.0, residual);
    }
}

#[test]
fn discharges_speeds_and_flow_curves_give_the_fluid_that_made_them() {
    let (mut fitted, mut left_out) = (0, Vec::new());
    let cases = golden::load("viscometric").cases;
    for case in cases.iter().filter(|case| text(&case["geometry"]) == "inverse_tables") {
        let parameter = |name: &str| number(&case["params"][name]);
        match text(&case["fluid"]) {
            "newtonian" => check::<Newtonian, 1>(case, [1.0], [parameter("mu")]),
            "power_law" => check::<PowerLaw, 2>(case, [1.0, 1.0], [parameter("K"), parameter("n")]),
            "bingham" => check::<Bingham, 2>(case, [0.4, 1.0], [parameter("tau_y"), parameter("mu")]),
            // Discharges and speeds know nothing of its normal stresses.
            "oldroyd_b" => check::<Newtonian, 1>(case, [1.0], [parameter("eta_s") + parameter("eta_p")]),
            "carreau_yasuda" if 0.0 < parameter("eta_inf") => {
                let truth = ["eta0", "eta_inf", "lam", "n", "a"].map(parameter);
                check::<CarreauYasuda, 5>(case, [1.0, 0.1, 1.0, 0.5, 1.5], truth);
            }
            // Its second viscosity is zero, an end of the interval of the parameter.
            "carreau_yasuda" => {
                left_out.push(text(&case["id"]));
                continue;
            }
            other => unreachable!("{other}"),
        }
        fitted += 1;
    }
    assert_eq!((fitted, left_out), (8, vec!["carreau_yasuda_6/inverse"]));
}
