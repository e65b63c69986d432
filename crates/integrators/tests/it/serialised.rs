//! What is written comes back to the last bit; what is invalid is refused.

use piola_integrators::{Composition, Ending, Order, Report, State, Tolerance};

use crate::problems::{kepler, kepler_at};

#[test]
fn tolerance_round_trips_and_invalid_ones_are_refused() {
    let tolerance = Tolerance::new(1e-10, 1e-12).unwrap();
    let text = serde_json::to_string(&tolerance).unwrap();
    assert_eq!(serde_json::from_str::<Tolerance>(&text).unwrap(), tolerance);
    assert_eq!(serde_json::from_str::<Tolerance>(r#"{"relative": 1e-9}"#).unwrap(), Tolerance::relative(1e-9).unwrap());
    for invalid in [
        r#"{"relative": -1e-9}"#,
        r#"{"relative": 1.0}"#,
        r#"{"relative": 0.0}"#,
        r#"{"relative": 1e-9, "absolute": -1.0}"#,
        r#"{"relative": 1e-9, "absolut": 1.0}"#,
        r#"{"absolute": 1.0}"#,
    ] {
        assert!(serde_json::from_str::<Tolerance>(invalid).is_err(), "{invalid}");
    }
}

#[test]
fn run_continued_from_a_file_equals_the_unbroken_run() {
    let mut unbroken = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let mut method = Composition::new(Order::Six, 1.0 / 64.0).unwrap();
    method.integrate_to(&mut kepler(), &mut unbroken, 10.0).unwrap();
    let text = serde_json::to_string(&unbroken).unwrap();
    let mut continued: State = serde_json::from_str(&text).unwrap();
    assert_eq!(continued, unbroken);
    for state in [&mut unbroken, &mut continued] {
        method.integrate_to(&mut kepler(), state, 20.0).unwrap();
    }
    assert_eq!(continued, unbroken);
}

#[test]
fn invalid_states_are_refused() {
    for invalid in [
        r#"{"time": 0.0, "values": [1.0, 2.0], "carry": [0.0], "time_carry": 0.0}"#,
        r#"{"time": 1e999, "values": [1.0], "carry": [0.0], "time_carry": 0.0}"#,
        r#"{"time": 0.0, "values": [1.0]}"#,
    ] {
        assert!(serde_json::from_str::<State>(invalid).is_err(), "{invalid}");
    }
}

#[test]
fn reports_and_orders_round_trip() {
    let report = Report { steps: 3, rejected: 1, evaluations: 40, stiff_steps: 0, ending: Ending::Event(2) };
    assert_eq!(serde_json::from_str::<Report>(&serde_json::to_string(&report).unwrap()).unwrap(), report);
    for order in Order::ALL {
        assert_eq!(serde_json::from_str::<Order>(&serde_json::to_string(&order).unwrap()).unwrap(), order);
    }
}
