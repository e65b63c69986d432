//! What is written comes back to the last bit.

use piola_integrators::{Ending, Report};
use piola_stiff::{RadauOrder, RadauReport};

#[test]
fn reports_and_orders_round_trip() {
    let run = Report { steps: 3, rejected: 1, evaluations: 40, stiff_steps: 0, ending: Ending::Event(2) };
    let report = RadauReport { run, jacobians: 2, factorisations: 5 };
    assert_eq!(serde_json::from_str::<RadauReport>(&serde_json::to_string(&report).unwrap()).unwrap(), report);
    for order in RadauOrder::ALL {
        assert_eq!(serde_json::from_str::<RadauOrder>(&serde_json::to_string(&order).unwrap()).unwrap(), order);
    }
}
