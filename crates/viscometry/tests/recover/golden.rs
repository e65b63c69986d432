//! The tables of `viscometric.json`: 25 rows each of a discharge or a speed, and the shear rates that made them.

use piola_testkit::golden::{self, number, text, vector};
use piola_viscometry::ViscometryError;
use piola_viscometry::recover::{self, BelowSmallest, Criterion, FlowCurve, FlowTable, Monotonicity};
use serde_json::Value;

pub(super) fn cases() -> Vec<Value> {
    let all = golden::load("viscometric").cases;
    let cases: Vec<_> = all.into_iter().filter(|case| text(&case["geometry"]) == "inverse_tables").collect();
    assert_eq!(cases.len(), 9);
    cases
}

fn rows(drive: &Value, response: &Value) -> Vec<[f64; 2]> {
    vector(drive).into_iter().zip(vector(response)).map(|(drive, response)| [drive, response]).collect()
}

/// The curve of a flow from rows with relative errors, and the true points.
pub(super) fn recovered(
    case: &Value,
    flow: &str,
    errors: impl FnMut() -> f64,
) -> Result<(FlowCurve, Vec<[f64; 2]>), ViscometryError> {
    let (input, output) = (&case["input"][flow], &case["output"][flow]);
    let mut errors = errors;
    let mut spoilt = |rows: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
        rows.into_iter().map(|[drive, response]| [drive, response * (1.0 + errors())]).collect()
    };
    Ok(match flow {
        "pipe" => {
            let rows = spoilt(rows(&input["c"], &input["Q"]));
            let curve = recover::pipe(&FlowTable::pipe(number(&input["R0"]), &rows)?)?;
            (curve, self::rows(&output["tau_wall"], &output["kappa_wall"]))
        }
        "channel" => {
            let rows = spoilt(rows(&input["c"], &input["Q_per_width"]));
            let curve = recover::channel(&FlowTable::channel(number(&input["d"]), &rows)?)?;
            (curve, self::rows(&output["tau_wall"], &output["kappa_wall"]))
        }
        _ => {
            let rows = spoilt(rows(&input["M"], &input["delta_omega"]));
            let table = FlowTable::couette(number(&input["R1"]), number(&input["R2"]), &rows)?;
            (recover::couette(&table)?, self::rows(&output["tau_inner"], &output["kappa_inner"]))
        }
    })
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn errors_of_the_tables_lie_in_the_bands_and_are_small_for_smooth_fluids() {
    for case in cases() {
        for flow in ["pipe", "channel", "couette"] {
            let what = format!("{}, {flow}", text(&case["id"]));
            let (curve, truth) = recovered(&case, flow, || 0.0).expect("a curve");
            let curve = curve.with_band(0.95).expect("a band");
            assert_eq!(curve.smoothing().criterion, Criterion::Interpolation, "{what}: {:?}", curve.smoothing());
            assert_eq!(curve.monotonicity(), Monotonicity::Rising, "{what}");
            let mut errors = Vec::new();
            for [stress, rate] in truth {
                let point = curve.at(stress).expect("measured");
                let [low, high] = point.band.expect("asked for");
                assert!(low <= rate && rate <= high, "{what}: {rate} at {stress} is not in {low} .. {high}");
                errors.push((point.shear_rate / rate - 1.0).abs());
            }
            let error = median(&mut errors);
            let smooth = text(&case["fluid"]) != "bingham";
            assert!(!smooth || error <= 1e-6, "{what}: median error {error}");
        }
    }
}

#[test]
fn what_holds_below_the_smallest_torque_is_named() {
    for case in cases() {
        let (pipe, _) = recovered(&case, "pipe", || 0.0).expect("a curve");
        assert_eq!(pipe.below_smallest(), BelowSmallest::NotNeeded);
        let (curve, _) = recovered(&case, "couette", || 0.0).expect("a curve");
        let found = curve.below_smallest();
        match text(&case["fluid"]) {
            "newtonian" | "oldroyd_b" => assert_eq!(found, BelowSmallest::Newtonian),
            "power_law" => {
                let BelowSmallest::PowerLaw { exponent } = found else { panic!("{found:?}") };
                assert!((exponent * number(&case["params"]["n"]) - 1.0).abs() < 1e-10);
            }
            _ => assert!(matches!(found, BelowSmallest::Powers { .. }), "{found:?}"),
        }
    }
}
