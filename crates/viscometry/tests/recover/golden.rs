//! The tables of `viscometric.json`: 25 rows each of a discharge or a speed, and the shear rates that made them.

use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, assert_close};
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

fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values
}

/// What 25 rows are worth: bounds of the relative error of the rate and of the relative width of its band, each of the largest and of
/// the median of the points.
struct Worth {
    error: [f64; 2],
    width: [f64; 2],
}

/// Tables of powers are straight in the logarithms: rounding is left, and a band some hundred times as wide.
const STRAIGHT: Worth = Worth { error: [5e-13, 2e-14], width: [3e-11, 1e-12] };
/// A plateau bends the table: splines of degree 7 through rows at e^0.15; at its ends they are worst.
const BENT: Worth = Worth { error: [5e-5, 1e-6], width: [5e-3, 3e-4] };
/// The slower bend of the exponent 5/4.
const SLOWLY_BENT: Worth = Worth { error: [2e-6, 3e-7], width: [3e-4, 1e-4] };
/// The first row lies 2 % above yield, where ζ has a kink: ζ is there a fiftieth of what it is at the next rows.
const YIELDING: Worth = Worth { error: [0.5, 1e-4], width: [2.0, 5e-2] };

fn worth(case: &Value) -> Worth {
    match (text(&case["fluid"]), case["params"]["a"].as_f64()) {
        ("newtonian" | "power_law" | "oldroyd_b", None) => STRAIGHT,
        ("carreau_yasuda", Some(exponent)) => {
            if 1.5 < exponent {
                BENT
            } else {
                SLOWLY_BENT
            }
        }
        ("bingham", None) => YIELDING,
        other => unreachable!("{other:?}"),
    }
}

#[test]
fn rates_of_the_tables_equal_those_that_made_them_within_narrow_bands() {
    let mut count = 0;
    for case in cases() {
        let worth = worth(&case);
        for flow in ["pipe", "channel", "couette"] {
            let what = format!("{}, {flow}", text(&case["id"]));
            let (curve, truth) = recovered(&case, flow, || 0.0).expect("a curve");
            let curve = curve.with_band(0.95).expect("a band");
            assert_eq!(curve.smoothing().criterion, Criterion::Interpolation, "{what}: {:?}", curve.smoothing());
            assert_eq!(curve.monotonicity(), Monotonicity::Rising, "{what}");
            let (mut errors, mut widths) = (Vec::new(), Vec::new());
            for [stress, rate] in truth {
                let point = curve.at(stress).expect("measured");
                let [low, high] = point.band.expect("asked for");
                assert!(low <= rate && rate <= high, "{what}: {rate} at {stress} is not in {low} .. {high}");
                errors.push((point.shear_rate / rate - 1.0).abs());
                widths.push((high - low) / rate);
                count += 1;
            }
            for (name, found, bounds) in [("error", sorted(errors), worth.error), ("band", sorted(widths), worth.width)]
            {
                let found = [found[found.len() - 1], found[found.len() / 2]];
                assert!(found[0] <= bounds[0] && found[1] <= bounds[1], "{what}: {name} {found:?}, bounds {bounds:?}");
            }
        }
    }
    // Nine fluids, three flows, 25 rows.
    assert_eq!(count, 9 * 3 * 25);
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
                let inverse = number(&case["params"]["n"]).recip();
                assert_close("1/n", &[exponent], &[inverse], Tol::stated(1e-12, "the slope of a spline at its end"));
            }
            _ => assert!(matches!(found, BelowSmallest::Powers { .. }), "{found:?}"),
        }
    }
}
